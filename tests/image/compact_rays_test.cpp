// Tracing and shading by the list of rays changes no byte: in every mode of sampling, at sizes that fill no
// whole tiles, for pixels with and without a light, a turn or a surface.
#include "tests/image/image_kit.h"
#include "tests/image/image_scenes.h"

namespace kilolux::test {
namespace {

Rendered renderListed(const Scene& scene, const glm::ivec2& size, const std::string& mode,
                      const char* compact) {
    RenderOptions options = smallOptions(size.x, size.y, {mode, compact, "picture=raw"});
    options.method = "stochastic";
    options.frames = 3; // the third one is guided
    options.poisonTargets = true;
    return renderScene(scene, options);
}

TEST(CompactRays, ChangeNoByte) {
    const Scene scene = stageScene(lightCases());
    for (const char* mode : {"raysPerPixel=1", "raysPerPixel=4", "raysPerPixel=0.25", "sampling=rooks"}) {
        for (const glm::ivec2& size : {glm::ivec2(7, 5), glm::ivec2(67, 35), glm::ivec2(48, 32)}) {
            const Rendered listed = renderListed(scene, size, mode, "compactRays=true"),
                           plain = renderListed(scene, size, mode, "compactRays=false");
            for (const auto& [name, image] : plain.targets.all())
                EXPECT_EQ(image.texels, listed.targets.named(name).texels)
                    << name << ", " << mode << ", " << size.x << " x " << size.y;
            EXPECT_EQ(listed.statistics.rays, plain.statistics.rays);
            EXPECT_GT(listed.statistics.rays, 0u);
        }
    }
}

} // namespace
} // namespace kilolux::test
