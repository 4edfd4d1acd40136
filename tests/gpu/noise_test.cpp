// Blue and white noise on the device: the committed mask uploaded as the renderer does, and the very numbers
// of the same source compiled as C++, beyond the tile's edge and the mask's last frame.
#include "tests/gpu/support/gpu_fixture.h"

#include "renderer/lights_cpp/lights_f32.h"
#include "renderer/noise.h"
#include "shaders/shared/features.h"

namespace kilolux::test {
namespace {

constexpr std::uint32_t kWidth = 80, kHeight = 72;

struct NoisePush { // as in shaders/noise.comp
    std::uint32_t frameIndex;
    std::uint32_t seed;
};

f32::PixelNoise expected(const NoiseMask& mask, bool white, glm::uvec2 pixel, NoisePush how) {
    if (white) return f32::whitePixelNoise(pixel, how.frameIndex, how.seed);
    const glm::uvec3 at = f32::noiseTexel(pixel, how.frameIndex, how.seed);
    const NoiseMask::Texel& texel = mask.at(at.x, at.y, at.z);
    return f32::bluePixelNoise({texel[0], texel[1], texel[2], texel[3]}, pixel, how.frameIndex, how.seed);
}

TEST_F(GpuTest, NoiseIsThatOfCpp) {
    const Result<NoiseMask> mask = loadNoiseMask(KILOLUX_SOURCE_DIR "/content/blue_noise.bin");
    ASSERT_TRUE(mask) << mask.error();
    gpu::Image image(device(), {.name = "noiseMask",
                                .format = VK_FORMAT_R16G16B16A16_UINT,
                                .width = NoiseMask::kWidth,
                                .height = NoiseMask::kHeight,
                                .layers = NoiseMask::kLayers,
                                .arrayed = true,
                                .usage = VK_IMAGE_USAGE_SAMPLED_BIT});
    constexpr std::size_t kLayerTexels = NoiseMask::kWidth * NoiseMask::kHeight;
    for (std::uint32_t layer = 0; layer < NoiseMask::kLayers; ++layer)
        image.upload(
            std::as_bytes(std::span(mask.value().texels).subspan(layer * kLayerTexels, kLayerTexels)), 0,
            layer);
    gpu::ComputePass pass(resources(), "noise", {{"noiseMask"}, {"Numbers", gpu::Access::Write}},
                          "../tests/gpu/shaders/noise.comp");
    gpu::Buffer numbers(device(), {"numbers", kWidth * kHeight * 5 * sizeof(float)});
    for (const std::uint32_t white : {0u, 1u})
        for (const NoisePush how :
             {NoisePush{0, 0}, NoisePush{31, 5}, NoisePush{32, 5}, NoisePush{100001, 77}}) {
            gpu::Commands commands(device());
            pass.record(commands, {{shared::CHOICE_WHITE_NOISE, white}},
                        {{"noiseMask", image, gpu::SamplerKind::NearestClamp}, {"Numbers", numbers}}, how,
                        {kWidth / 8, kHeight / 8});
            commands.submitAndWait();
            const std::vector<float> got = numbers.downloadAs<float>();
            int wrong = 0;
            for (std::uint32_t i = 0; i < kWidth * kHeight; ++i) {
                const f32::PixelNoise noise =
                    expected(mask.value(), white != 0, {i % kWidth, i / kWidth}, how);
                for (int k = 0; k < 3; ++k)
                    wrong += got[5 * i + k] != noise.numbers[k] ? 1 : 0;
                for (int k = 0; k < 2; ++k)
                    wrong += got[5 * i + 3 + k] != noise.point[k] ? 1 : 0;
            }
            EXPECT_EQ(wrong, 0) << (white != 0 ? "white" : "blue") << " frame " << how.frameIndex;
        }
}

} // namespace
} // namespace kilolux::test
