// The light grid changes no picture: every light that reaches a pixel is in its cell's list, whatever the
// lights, the camera, the size of the picture and the room for lists. Sums run in slot order, so pictures are
// equal to the byte.
#include "tests/image/image_kit.h"
#include "tests/image/image_scenes.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <random>

namespace kilolux::test {
namespace {

// The stage under `count` lights of every kind, anywhere around it, turned anyhow, with ranges of 0.3 to 6 m.
Scene crowdedScene(int count, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    const auto within = [&](double low, double high) { return low + (high - low) * uniform(random); };
    std::vector<LightCase> lights;
    while (int(lights.size()) < count) {
        LightCase light = lightCases()[random() % lightCases().size()];
        if (light.def.type == LightType::Directional && uniform(random) < 0.9) continue;
        if (light.def.type != LightType::Directional) light.def.rangeM = within(0.3, 6.0);
        light.def.outerConeRad = within(0.1, 1.55);
        light.def.innerConeRad = 0.5 * light.def.outerConeRad;
        const glm::dquat turn =
            glm::normalize(glm::dquat(within(-1, 1), within(-1, 1), within(-1, 1), within(-1, 1) + 1e-3));
        const glm::dvec3 place(within(-4, 4), within(-0.5, 3), within(-4, 4));
        light.worldFromLight = glm::translate(glm::dmat4(1.0), place) * glm::mat4_cast(turn);
        lights.push_back(light);
    }
    return stageScene(lights);
}

void expectSameLight(const Rendered& gridded, const Rendered& plain, const std::string& what) {
    for (const char* name : {"litDiffuse", "litSpecular", "lightCounts"}) {
        EXPECT_EQ(gridded.targets.named(name).texels, plain.targets.named(name).texels)
            << what << ": " << name;
    }
}

RenderOptions options(int width, int height, const char* grid) {
    return smallOptions(width, height, {grid});
}

TEST(LightGrid, ChangesNoPicture) {
    for (std::uint32_t seed = 1; seed <= 3; ++seed) {
        Scene scene = crowdedScene(120, seed);
        // From far, from near, and from within, at sizes that fill no whole cells.
        const double distances[] = {0.4, 1.0, 8.0};
        const glm::dvec3 from = glm::normalize(glm::dvec3(std::cos(seed * 1.7), 0.5, std::sin(seed * 1.7)));
        scene.cameras[0] =
            cameraLooking(from * distances[seed % 3] + glm::dvec3(0, 0.6, 0), {0, 0.3, 0}, 1.1);
        const int width = 67 + int(seed) * 13, height = 33 + int(seed) * 7;
        const Rendered gridded = renderScene(scene, options(width, height, "lightGrid=true")),
                       plain = renderScene(scene, options(width, height, "lightGrid=false"));
        expectSameLight(gridded, plain, "seed " + std::to_string(seed));
        EXPECT_GT(gridded.statistics.gridIndices, 0u);
        EXPECT_EQ(gridded.statistics.gridCoarseCells, 0u);
        // Every light that shines on a pixel is on its list, and the list is shorter than all lights.
        EXPECT_GE(gridded.statistics.lightsTestedMean, gridded.statistics.lightsInRangeMean);
        EXPECT_LT(gridded.statistics.lightsTestedMean, 0.8 * plain.statistics.lightsTestedMean);
        EXPECT_EQ(gridded.statistics.lightsInRangeMean, plain.statistics.lightsInRangeMean);
        std::printf("seed %u: %.1f of 120 lights shine on a pixel, %.1f are on its list\n", seed,
                    gridded.statistics.lightsInRangeMean, gridded.statistics.lightsTestedMean);
    }
}

TEST(LightGrid, SmallAndOrthographicPictures) {
    Scene scene = crowdedScene(60, 21);
    for (const glm::ivec2& size : {glm::ivec2(7, 5), glm::ivec2(31, 33), glm::ivec2(64, 32)}) {
        expectSameLight(renderScene(scene, options(size.x, size.y, "lightGrid=true")),
                        renderScene(scene, options(size.x, size.y, "lightGrid=false")), "perspective");
    }
    scene.cameras[0].orthographic = true;
    scene.cameras[0].xmagM = scene.cameras[0].ymagM = 2.0;
    expectSameLight(renderScene(scene, options(70, 50, "lightGrid=true")),
                    renderScene(scene, options(70, 50, "lightGrid=false")), "orthographic");
}

// Without room, cells take their coarse cell's list; the next frame has the room that was missing.
TEST(LightGrid, CellsWithoutRoomTakeCoarseListsUntilThereIs) {
    const Scene scene = crowdedScene(150, 31);
    RenderOptions tight = options(96, 64, "lightGrid=true");
    tight.gridRoom = 10;
    tight.frames = 1;
    // The frame of one tile that compiles the pipelines has grown the buffer already if it asked for more; a
    // picture of many cells asks for more again.
    const Rendered plain = renderScene(scene, options(96, 64, "lightGrid=false"));
    const Rendered first = renderScene(scene, tight);
    expectSameLight(first, plain, "first frame");
    EXPECT_GT(first.statistics.gridCoarseCells, 0u);
    tight.frames = 2;
    RenderOptions plainTwice = options(96, 64, "lightGrid=false");
    plainTwice.frames = 2;
    const Rendered second = renderScene(scene, tight);
    expectSameLight(second, renderScene(scene, plainTwice), "second frame");
    EXPECT_EQ(second.statistics.gridCoarseCells, 0u);
}

// More than a uniform block holds: hot records come from the texel buffer.
TEST(LightGrid, ThousandsOfLights) {
    const Scene scene = crowdedScene(3000, 41);
    const Rendered gridded = renderScene(scene, options(48, 32, "lightGrid=true")),
                   plain = renderScene(scene, options(48, 32, "lightGrid=false"));
    expectSameLight(gridded, plain, "3000 lights");
    RecordProperty("testsPerIndex", int(gridded.statistics.gridTests / gridded.statistics.gridIndices));
    EXPECT_LT(gridded.statistics.lightsInRangeMean, 3000.0);
}

} // namespace
} // namespace kilolux::test
