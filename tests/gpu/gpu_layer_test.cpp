// The GPU layer itself: declarations checked against SPIR-V, derived barriers, features, staging, allocator.
#include "tests/gpu/support/gpu_fixture.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <random>

namespace kilolux::gpu {
namespace {

using test::GpuTest;
using ::testing::HasSubstr;

constexpr const char* kAddOne = R"(#version 460
layout(local_size_x = 64) in;
layout(constant_id = 3) const uint kStep = 1u;
layout(scalar) readonly buffer Source { uint source[]; };
layout(scalar) writeonly buffer Target { uint target[]; };
layout(push_constant) uniform Push { uint count; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < count) target[i] = source[i] + kStep;
}
)";

ShaderCode compile(const char* text, const char* name = "test.comp") {
    Result<ShaderCode> code = compileShaderText(name, text);
    if (!code) ADD_FAILURE() << code.error();
    return std::move(code.value());
}

std::string contractError(PassResources& resources, std::vector<PassUse> uses) {
    try {
        ComputePass pass(resources, compile(kAddOne), std::move(uses));
    } catch (const std::logic_error& error) {
        return error.what();
    }
    return "";
}

TEST_F(GpuTest, DeclarationIsCheckedAgainstTheShader) {
    EXPECT_EQ(contractError(resources(), {{"Source"}, {"Target", Access::Write}}), "");
    EXPECT_THAT(contractError(resources(), {{"Source"}}), HasSubstr("'Target', which is not declared"));
    EXPECT_THAT(contractError(resources(), {{"Source"}, {"Target", Access::ReadWrite}}),
                HasSubstr("'Target' is declared as read write but the shader has it as write"));
    EXPECT_THAT(contractError(resources(), {{"Source"}, {"Target", Access::Write}, {"Ghost"}}),
                HasSubstr("'Ghost' is declared but the shader lacks it"));
}

TEST_F(GpuTest, CompilerWordsNameFileAndLine) {
    const Result<ShaderCode> code =
        compileShaderText("broken.comp", "#version 460\nvoid main() {\n  x = 1;\n}\n");
    ASSERT_FALSE(code);
    EXPECT_THAT(code.error(), HasSubstr("broken.comp"));
    EXPECT_THAT(code.error(), HasSubstr(":3"));
}

// A chain of dispatches that each read what the one before wrote.
std::vector<std::uint32_t> runChain(Device& device, PassResources& resources, int length,
                                    const SpecValues& features, PassTimes* times = nullptr) {
    ComputePass pass(resources, compile(kAddOne), {{"Source"}, {"Target", Access::Write}});
    Buffer a(device, {"a", 4096 * 4}), b(device, {"b", 4096 * 4});
    std::vector<std::uint32_t> start(4096);
    for (std::uint32_t i = 0; i < 4096; ++i)
        start[i] = i;
    a.upload(start);
    Commands commands(device, times);
    for (int i = 0; i < length; ++i) {
        const Buffer& from = i % 2 ? b : a;
        const Buffer& to = i % 2 ? a : b;
        pass.record(commands, features, {{"Source", from}, {"Target", to}}, std::uint32_t{4096}, {64});
    }
    commands.submitAndWait();
    return (length % 2 ? b : a).downloadAs<std::uint32_t>();
}

TEST_F(GpuTest, DerivedBarriersOrderAChain) {
    PassTimes times;
    const std::vector<std::uint32_t> result = runChain(device(), resources(), 9, {}, &times);
    for (std::uint32_t i = 0; i < 4096; ++i)
        ASSERT_EQ(result[i], i + 9);
    ASSERT_EQ(times.entries().size(), 1u);
    EXPECT_EQ(times.entries()[0].ms.size(), 9u);
}

// What a pass wrote can be had from its declaration alone, although a later pass overwrites it.
TEST_F(GpuTest, CaptureKeepsWhatAPassWrote) {
    ComputePass first(resources(), compile(kAddOne, "first.comp"), {{"Source"}, {"Target", Access::Write}});
    ComputePass second(resources(), compile(kAddOne, "second.comp"), {{"Source"}, {"Target", Access::Write}});
    Buffer a(device(), {"a", 4096 * 4}), b(device(), {"b", 4096 * 4});
    a.upload(std::vector<std::uint32_t>(4096, 5));
    Commands commands(device());
    commands.captureAfter("first.comp");
    first.record(commands, {}, {{"Source", a}, {"Target", b}}, 4096u, {64});
    second.record(commands, {{3, 100}}, {{"Source", a}, {"Target", b}}, 4096u, {64});
    commands.submitAndWait();
    const std::vector<Captured> captured = commands.captured();
    ASSERT_EQ(captured.size(), 1u);
    EXPECT_EQ(captured[0].name, "Target");
    std::uint32_t value = 0;
    std::memcpy(&value, captured[0].bytes.data() + 40, 4);
    EXPECT_EQ(value, 6u);
    EXPECT_EQ(b.downloadAs<std::uint32_t>()[10], 105u);
}

TEST_F(GpuTest, SpecializationConstantsSelectTheFeature) {
    const std::vector<std::uint32_t> result = runChain(device(), resources(), 3, {{3, 10}, {77, 5}});
    EXPECT_EQ(result[5], 35u);
}

TEST_F(GpuTest, UnboundNamesAndWrongKindsAreContractFailures) {
    ComputePass pass(resources(), compile(kAddOne), {{"Source"}, {"Target", Access::Write}});
    Buffer buffer(device(), {"buffer", 4096 * 4});
    Image image(device(), {"image", VK_FORMAT_R32_UINT});
    Commands commands(device());
    EXPECT_THROW(pass.record(commands, {}, {{"Source", buffer}}, 4096u, {64}), std::logic_error);
}

TEST_F(GpuTest, UnboundOptionalGetsADummyOfItsKind) {
    const char* text = R"(#version 460
layout(local_size_x = 1) in;
layout(constant_id = 0) const bool hasExtra = true;
uniform sampler2DArray extraImage;
uniform usamplerBuffer extraTexels;
layout(scalar) readonly buffer ExtraList { uint extraList[]; };
layout(scalar) writeonly buffer Target { uint target[]; };
void main() {
    uint v = 7u;
    if (hasExtra) v += extraList[0] + texelFetch(extraTexels, 0).x + uint(texelFetch(extraImage, ivec3(0), 0).x);
    target[0] = v;
}
)";
    ComputePass pass(resources(), compile(text),
                     {{"extraImage", Access::Read, Presence::Optional},
                      {"extraTexels", Access::Read, Presence::Optional},
                      {"ExtraList", Access::Read, Presence::Optional},
                      {"Target", Access::Write}});
    Buffer target(device(), {"target", 16});
    Commands commands(device());
    pass.record(commands, {{0, 0}}, {{"Target", target}}, {1});
    commands.submitAndWait();
    EXPECT_EQ(target.downloadAs<std::uint32_t>()[0], 7u);
}

// A pipeline with every feature on stands in until the exact one is built, and gives the same result.
TEST_F(GpuTest, AllFeaturesPipelineStandsInForTheExactOne) {
    ComputePass pass(resources(), compile(kAddOne), {{"Source"}, {"Target", Access::Write}});
    Buffer a(device(), {"a", 4096 * 4}), b(device(), {"b", 4096 * 4});
    a.upload(std::vector<std::uint32_t>(4096, 5));
    pass.setWait(PipelineWait::AllFeaturesMeanwhile);
    // The constant's default (1) is what "all features" means; the exact value is the same here.
    for (int i = 0; i < 3; ++i) {
        Commands commands(device());
        pass.record(commands, {{3, 1}}, {{"Source", a}, {"Target", b}}, 4096u, {64});
        commands.submitAndWait();
        EXPECT_EQ(b.downloadAs<std::uint32_t>()[7], 6u);
    }
}

// A shader that no longer compiles keeps its pipeline and says why; one that does is taken over.
TEST_F(GpuTest, ReloadKeepsTheOldPipelineOnFailure) {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "kilolux_reload_test";
    std::filesystem::create_directories(folder / "passes");
    const auto write = [&](const std::string& text) { std::ofstream(folder / "passes/add.comp") << text; };
    setenv("KILOLUX_SHADERS", folder.c_str(), 1);
    write(kAddOne);
    ComputePass pass(resources(), "add", {{"Source"}, {"Target", Access::Write}});
    Buffer a(device(), {"a", 4096 * 4}), b(device(), {"b", 4096 * 4});
    a.upload(std::vector<std::uint32_t>(4096, 5));
    const auto run = [&] {
        Commands commands(device());
        pass.record(commands, {}, {{"Source", a}, {"Target", b}}, 4096u, {64});
        commands.submitAndWait();
        return b.downloadAs<std::uint32_t>()[7];
    };
    EXPECT_EQ(run(), 6u);
    write(std::string(kAddOne) + "this is no GLSL\n");
    EXPECT_THAT(pass.reload(), HasSubstr("add.comp"));
    EXPECT_EQ(run(), 6u);
    std::string changed = kAddOne;
    changed.replace(changed.find("source[i] + kStep"), 17, "source[i] * kStep");
    write(changed);
    EXPECT_EQ(pass.reload(), "");
    EXPECT_EQ(run(), 5u);
    unsetenv("KILOLUX_SHADERS");
    std::filesystem::remove_all(folder);
}

// The layer misses write-after-write between dispatches unless every pass has a command buffer of its own and
// queue-submit validation is on. This test fails when derived barriers go missing, and shows that it would.
TEST(GpuLayer, ValidationSeesAMissingBarrier) {
    Device device({.validation = Validation::On, .commandBufferPerPass = true});
    PassResources resources(device);
    runChain(device, resources, 4, {});
    EXPECT_TRUE(device.takeValidationMessages().empty());
    Commands::dropBarriersForTest = true;
    runChain(device, resources, 4, {});
    Commands::dropBarriersForTest = false;
    EXPECT_THAT(device.takeValidationMessages(), ::testing::Contains(HasSubstr("SYNC-HAZARD")));
}

TEST(GpuLayer, StagingAndNonCoherentMemoryGiveTheSameBytes) {
    Device device(
        {.validation = Validation::On, .memory = {.forceStaging = true, .treatAsNonCoherent = true}});
    PassResources resources(device);
    Buffer probe(device, {"probe", 256});
    EXPECT_EQ(probe.mapped(), nullptr);
    const std::vector<std::uint32_t> result = runChain(device, resources, 3, {});
    for (std::uint32_t i = 0; i < 4096; ++i)
        ASSERT_EQ(result[i], i + 3);
    std::vector<std::byte> texels(64 * 32 * 4);
    for (std::size_t i = 0; i < texels.size(); ++i)
        texels[i] = std::byte(i * 7);
    Image image(device, {"image", VK_FORMAT_R8G8B8A8_UNORM, 64, 32});
    image.upload(texels);
    EXPECT_EQ(image.download(), texels);
    EXPECT_THAT(device.takeValidationMessages(), ::testing::IsEmpty());
}

TEST(GpuLayer, GpuAssistedValidationIsQuietOnAChain) {
    Device device({.validation = Validation::GpuAssisted});
    PassResources resources(device);
    EXPECT_EQ(runChain(device, resources, 2, {})[1], 3u);
    EXPECT_THAT(device.takeValidationMessages(), ::testing::IsEmpty());
}

// Said by name, and before a byte of it is allocated.
TEST_F(GpuTest, BuffersOfMoreTexelsThanTheDeviceTakesAreRefused) {
    BufferDesc desc{"texels", VkDeviceSize(device().limits().maxTexelBufferElements) + 1,
                    VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT};
    desc.texelFormat = VK_FORMAT_R8_UINT;
    try {
        const Buffer buffer(device(), desc);
        FAIL() << "it was made";
    } catch (const DeviceError& error) {
        EXPECT_THAT(error.what(), HasSubstr("'texels' takes"));
    }
}

TEST_F(GpuTest, AllocatorGivesBackEveryByteAndNeverOverlaps) {
    std::mt19937 random(7);
    const auto currentOf = [&](const char* cause) {
        for (const MemoryCauseBytes& entry : device().memory().causes()) {
            if (entry.cause == cause) return entry.current;
        }
        return VkDeviceSize{0};
    };
    std::vector<Buffer> alive;
    for (int i = 0; i < 400; ++i) {
        if (!alive.empty() && random() % 3 == 0) {
            std::swap(alive[random() % alive.size()], alive.back());
            alive.pop_back();
        } else {
            const VkDeviceSize bytes = 16 + random() % (1u << (8 + random() % 15));
            alive.emplace_back(device(), BufferDesc{"piece", bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                                    MemoryUse::DeviceOnly, "allocator test"});
        }
    }
    for (std::size_t i = 0; i < alive.size(); ++i) {
        for (std::size_t j = i + 1; j < alive.size(); ++j) {
            const Allocation &a = alive[i].allocation(), &b = alive[j].allocation();
            if (a.memory != b.memory) continue;
            ASSERT_TRUE(a.offset + a.size <= b.offset || b.offset + b.size <= a.offset);
        }
    }
    EXPECT_GT(currentOf("allocator test"), 0u);
    alive.clear();
    EXPECT_EQ(currentOf("allocator test"), 0u);
}

} // namespace
} // namespace kilolux::gpu
