// What a scene lacks costs nothing: with a feature off, what is left of each shader that models it, once its
// constants are folded and dead code is gone, is strictly shorter and names fewer resources.
#include "tests/gpu/support/gpu_fixture.h"

#include "shaders/shared/features.h"

#include <algorithm>
#include <spirv-tools/libspirv.hpp>
#include <spirv-tools/optimizer.hpp>

namespace kilolux::test {
namespace {

struct Size {
    std::size_t instructions = 0;
    std::string text;
};

// The shader as a driver would build it for these values.
Size specialized(const gpu::ShaderCode& code, const gpu::SpecValues& values) {
    spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_3);
    std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> words;
    for (const auto& [id, value] : values)
        words[id] = {std::uint32_t(value)};
    optimizer.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(words))
        .RegisterPass(spvtools::CreateFreezeSpecConstantValuePass())
        .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass())
        .RegisterPass(spvtools::CreateMergeReturnPass())
        .RegisterPass(spvtools::CreateInlineExhaustivePass())
        .RegisterPass(spvtools::CreateLocalSingleBlockLoadStoreElimPass())
        .RegisterPass(spvtools::CreateLocalSingleStoreElimPass())
        .RegisterPass(spvtools::CreateScalarReplacementPass(0))
        .RegisterPass(spvtools::CreateSSARewritePass())
        .RegisterPass(spvtools::CreateCCPPass())
        .RegisterPass(spvtools::CreateSimplificationPass())
        .RegisterPass(spvtools::CreateDeadBranchElimPass())
        .RegisterPass(spvtools::CreateBlockMergePass())
        .RegisterPass(spvtools::CreateAggressiveDCEPass());
    std::vector<std::uint32_t> binary;
    spvtools::OptimizerOptions options;
    options.set_run_validator(false); // it would have to be told of scalar layout
    EXPECT_TRUE(optimizer.Run(code.spirv.data(), code.spirv.size(), &binary, options)) << code.name;
    Size size;
    const spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_3);
    EXPECT_TRUE(tools.Disassemble(binary, &size.text, SPV_BINARY_TO_TEXT_OPTION_FRIENDLY_NAMES)) << code.name;
    size.instructions = std::size_t(std::count(size.text.begin(), size.text.end(), '\n'));
    return size;
}

struct Feature {
    const char* name;
    int id;
    const char* resource; // that only it needs
};

class Features : public testing::TestWithParam<Feature> {};

TEST_P(Features, WhatIsAbsentCostsNothing) {
    const Feature feature = GetParam();
    gpu::SpecValues others;
    for (const int id :
         {shared::FEATURE_BARN_DOORS, shared::FEATURE_IES_PROFILES, shared::FEATURE_LIGHT_FUNCTIONS,
          shared::FEATURE_LIGHT_CHANNELS, shared::FEATURE_DOME, shared::FEATURE_TEXTURED_LIGHTS})
        others[std::uint32_t(id)] = id == feature.id;
    gpu::SpecValues none = others;
    none[std::uint32_t(feature.id)] = 0;
    for (const char* file :
         {"passes/sample_lights.comp", "passes/shade_samples.comp", "passes/cull_fine.comp"}) {
        const Result<gpu::ShaderCode> code = gpu::compileShader(file, {"KX_MAX_SAMPLES 1"});
        ASSERT_TRUE(code) << code.error();
        const Size with = specialized(code.value(), others), without = specialized(code.value(), none);
        std::printf("%s %s: %zu instructions with, %zu without\n", feature.name, file, with.instructions,
                    without.instructions);
        const bool inCulling = std::string(file) == "passes/cull_fine.comp";
        const bool bounds =
            feature.id == shared::FEATURE_BARN_DOORS || feature.id == shared::FEATURE_IES_PROFILES;
        if (inCulling && !bounds) continue;
        EXPECT_LT(without.instructions, with.instructions) << file;
        if (inCulling) continue;
        EXPECT_NE(with.text.find(feature.resource), std::string::npos) << file;
        EXPECT_EQ(without.text.find(feature.resource), std::string::npos) << file;
    }
}

INSTANTIATE_TEST_SUITE_P(
    All, Features,
    testing::Values(Feature{"barn doors", shared::FEATURE_BARN_DOORS, "lightShapings"},
                    Feature{"profiles", shared::FEATURE_IES_PROFILES, "iesProfiles"},
                    Feature{"functions", shared::FEATURE_LIGHT_FUNCTIONS, "functionImages"},
                    Feature{"dome", shared::FEATURE_DOME, "domeDistribution"},
                    Feature{"channels", shared::FEATURE_LIGHT_CHANNELS, "lightShapings"},
                    Feature{"pictures", shared::FEATURE_TEXTURED_LIGHTS, "lightPictures"}));

TEST(TraceFeatures, ChannelShadowsCostNothingWhereNoLightHasThem) {
    const Result<gpu::ShaderCode> code = gpu::compileShader("passes/trace_samples.comp");
    ASSERT_TRUE(code) << code.error();
    gpu::SpecValues on{{shared::FEATURE_CHANNEL_SHADOWS, 1}}, off{{shared::FEATURE_CHANNEL_SHADOWS, 0}};
    EXPECT_LT(specialized(code.value(), off).instructions, specialized(code.value(), on).instructions);
}

} // namespace
} // namespace kilolux::test
