// Pictures of more tiles than a device has workgroups in one dimension: 65,535, or 2048 x 2048 pixels.
#include "tests/image/image_kit.h"
#include "tests/image/image_scenes.h"

namespace kilolux::test {
namespace {

constexpr int kWidth = 2048, kHeight = 2056; // 256 x 257 tiles

Picture renderLarge(const Scene& scene, const char* method, int divisor) {
    RenderOptions options = smallOptions(kWidth / divisor, kHeight / divisor, {"picture=raw"});
    options.method = method;
    Result<std::unique_ptr<Renderer>> renderer = Renderer::create(scene, options);
    if (!renderer) throw std::runtime_error(renderer.error());
    Result<Picture> picture = renderer.value()->render({});
    if (!picture) throw std::runtime_error(picture.error());
    return std::move(picture.value());
}

// Luminance of a square part of the picture, its corners as shares of the picture.
double meanOf(const Picture& picture, const glm::dvec2& from, double side) {
    double sum = 0.0;
    int count = 0;
    for (int y = int(from.y * picture.height); y < int((from.y + side) * picture.height); ++y) {
        for (int x = int(from.x * picture.width); x < int((from.x + side) * picture.width); ++x, ++count) {
            const float* rgb =
                &picture.rgb[(std::size_t(y) * std::size_t(picture.width) + std::size_t(x)) * 3];
            sum += luminanceOf(glm::dvec3(rgb[0], rgb[1], rgb[2]));
        }
    }
    return sum / count;
}

TEST(LargePicture, IsWholeBeyondTheGroupsOfOneDimension) {
    const Scene scene = stageScene({lightCases().front()});
    const Picture large = renderLarge(scene, "stochastic", 1), small = renderLarge(scene, "all-lights", 8);
    constexpr double kSide = 0.25;
    double least = 1e30;
    for (double y = 0.0; y < 1.0; y += kSide) {
        for (double x = 0.0; x < 1.0; x += kSide) {
            const double expected = meanOf(small, {x, y}, kSide);
            EXPECT_NEAR(meanOf(large, {x, y}, kSide), expected, 0.05 * expected) << x << ", " << y;
            least = std::min(least, expected);
        }
    }
    EXPECT_GT(least, 0.0); // each part has light to compare
}

} // namespace
} // namespace kilolux::test
