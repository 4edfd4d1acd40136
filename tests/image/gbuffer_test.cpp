// Both producers of the G-buffer give the same surfaces within ties at edges, on scenes with masks, mirrored
// nodes and back faces, and every pixel of every target is written at sizes that no tile fits.
#include "tests/image/image_scenes.h"
#include "tests/image/oracle_kit.h"
#include "tests/unit/accel/scene_kit.h"

#include <iostream>

namespace kilolux::test {
namespace {

using glm::dvec3;

// Boxes, balls, a masked quad, mirrored nodes, and single-sided quads of which half show their back.
Scene clutterScene() {
    SceneBuilder b;
    const int plain = b.material({0.6, 0.5, 0.4}, 0.0, 0.6), mask = b.material({0.4, 0.7, 0.4}, 0.0, 0.7);
    b.scene.images.push_back(makeImage(
        [](int x, int y) { return glm::dvec4(0.8, 0.9, 0.7, (x / 32 + y / 32) % 2 == 0 ? 1.0 : 0.2); }));
    b.scene.materials[std::size_t(mask)].alphaMode = AlphaMode::Mask;
    b.scene.materials[std::size_t(mask)].baseColor.image = 0;
    b.scene.materials[std::size_t(mask)].doubleSided = true;
    b.quad(floorAt({0, 0, 0}), 8, 8, plain);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (int i = 0; i < 14; ++i) {
        const glm::dmat4 moved = glm::translate(
            glm::dmat4(1.0), dvec3(unit(random) * 2.0, 0.9 + 0.6 * unit(random), unit(random) * 1.5));
        glm::dmat4 place = glm::rotate(moved, 3.0 * unit(random), glm::normalize(dvec3(1, 2, unit(random))));
        if (i % 3 == 0) place = glm::scale(place, dvec3(-1.0, 1.0, 1.4));
        if (i % 4 == 0) addPrimitive(b, makeSphere(12, 18, 0.3), Shading::Round, place, plain);
        if (i % 4 == 1) addPrimitive(b, makeBox({0.2, 0.3, 0.15}), Shading::Flat, place, plain);
        if (i % 4 == 2) b.quad(place, 0.8, 0.6, mask);
        if (i % 4 == 3) b.quad(place, 0.7, 0.9, plain);
    }
    const LightCase& light = lightCases()[2];
    b.light(light.def, light.worldFromLight);
    b.scene.cameras.push_back(cameraLooking({0.4, 2.2, 4.8}, {0, 0.8, 0}));
    return std::move(b.scene);
}

struct Difference {
    int surfaces = 0; // pixels that show something
    int ties = 0;     // pixels that show different triangles
    int words = 0;    // pixels of the same triangle with another word in the G-buffer
};

Difference compareProducers(const Scene& scene, RenderOptions options) {
    const int width = options.width, height = options.height;
    options.settings.gbuffer = GBufferChoice::Raster;
    const Rendered raster = renderScene(scene, options);
    options.settings.gbuffer = GBufferChoice::Compute;
    const Rendered compute = renderScene(scene, options);
    EXPECT_TRUE(raster.targets.has("rasterDepth"));
    EXPECT_FALSE(compute.targets.has("rasterDepth"));
    Difference result;
    for (std::size_t i = 0; i < raster.targets.pixels(); ++i) {
        const PixelSurface a = raster.targets.surface(i), b = compute.targets.surface(i);
        result.surfaces += a.seen || b.seen;
        if (a.seen != b.seen || (a.seen && (a.instance != b.instance || a.primitive != b.primitive))) {
            if (result.ties++ < 3) {
                std::cout << "pixel " << i << ": raster " << a.instance << "/" << a.primitive << ", compute "
                          << b.instance << "/" << b.primitive << "\n";
            }
            continue;
        }
        for (const char* target : {"gDepth", "gSurface", "gMaterial", "gEmissive"}) {
            const std::vector<std::byte>& x = raster.targets.named(target).texels;
            const std::vector<std::byte>& y = compute.targets.named(target).texels;
            const std::size_t bytes = x.size() / raster.targets.pixels();
            if (std::equal(x.begin() + std::ptrdiff_t(i * bytes), x.begin() + std::ptrdiff_t((i + 1) * bytes),
                           y.begin() + std::ptrdiff_t(i * bytes))) {
                continue;
            }
            ++result.words;
            break;
        }
    }
    std::cout << width << " x " << height << ": " << result.surfaces << " surface pixels, " << result.ties
              << " ties, " << result.words << " other words\n";
    return result;
}

// Raster snaps corners to 1/256 px, so about 1/256 of the pixels on an edge may turn over: of a picture whose
// every fifth pixel lies on one, fewer than 1 in 500.
void expectEqualProducers(const Scene& scene, int width, int height, const char* jitter = "jitter=false") {
    RenderOptions options = smallOptions(width, height, {jitter});
    options.frames = 3; // the third has an offset of its own
    const Difference difference = compareProducers(scene, options);
    EXPECT_GT(difference.surfaces, width * height / 2);
    EXPECT_LE(difference.ties, std::max(2, difference.surfaces / 500));
    EXPECT_EQ(difference.words, 0); // one shader writes them from the triangle's number
}

TEST(GBuffer, ProducersAgreeOnClutter) {
    expectEqualProducers(clutterScene(), 160, 120);
}

TEST(GBuffer, ProducersAgreeOnJitteredFrames) {
    expectEqualProducers(clutterScene(), 96, 64, "jitter=true");
}

TEST(GBuffer, ProducersAgreeOnTheStage) {
    expectEqualProducers(stageScene({lightCases()[0]}), 96, 64);
}

TEST(GBuffer, ProducersAgreeOnCornell) {
    Scene scene = loadScene("cornell.glb");
    // Off the axis of symmetry, where seams and diagonals of the walls run through pixel centres, all of them
    // ties.
    scene.cameras[0].worldFromCamera[3] += glm::dvec4(0.0137, 0.0071, 0.0, 0.0);
    expectEqualProducers(scene, 96, 64);
}

TEST(GBuffer, ProducersAgreeOnTheGallery) {
    expectEqualProducers(loadScene("gallery.glb"), 160, 90);
}

TEST(GBuffer, ProducersAgreeTenKilometresOff) {
    expectEqualProducers(placedScene(clutterScene(), 1.0, {1e4, -20.0, 3e3}), 96, 64);
}

TEST(GBuffer, ProducersAgreeWithAnOrthographicCamera) {
    Scene scene = clutterScene();
    scene.cameras[0].orthographic = true;
    scene.cameras[0].ymagM = 1.6;
    scene.cameras[0].xmagM = 2.1;
    scene.cameras[0].zfarM = 50.0;
    expectEqualProducers(scene, 96, 72);
}

// Every surface pixel of the clutter is the one that the oracle sees, by either producer.
TEST(GBuffer, SurfacesAreTheOracles) {
    const Scene scene = clutterScene();
    const oracle::Oracle oracle(scene);
    for (const char* producer : {"gbuffer=raster", "gbuffer=compute"}) {
        const Rendered frame = renderScene(scene, smallOptions(120, 90, {producer}));
        const MatchedPixels matched = matchPixels(scene, oracle, scene.cameras[0], frame.targets);
        const SurfaceErrors errors = compareSurfaces(matched, scene.cameras[0], frame);
        std::cout << producer << ": " << matched.pixels.size() << " pixels, " << matched.ties << " ties; "
                  << errors << "\n";
        EXPECT_LE(matched.ties, 20);
        expectSurfaces(errors, scene);
    }
}

// Targets that start as NaN give the same bytes as others: no pass forgets a pixel, none reads what nobody
// wrote. Sizes that are no multiple of a tile, or smaller than one.
TEST(GBuffer, EveryPixelOfEveryTargetIsWritten) {
    const Scene scene = clutterScene();
    const std::vector<std::pair<glm::ivec2, const char*>> cases{{{45, 27}, "gbuffer=raster"},
                                                                {{45, 27}, "gbuffer=compute"},
                                                                {{3, 2}, "gbuffer=compute"},
                                                                {{1, 1}, "gbuffer=raster"}};
    for (const auto& [size, producer] : cases) {
        RenderOptions options = smallOptions(size.x, size.y, {producer});
        options.view = "depth-range";
        const Rendered plain = renderScene(scene, options);
        options.poisonTargets = true;
        const Rendered poisoned = renderScene(scene, options);
        for (const auto& [name, image] : plain.targets.all()) {
            EXPECT_EQ(image.texels, poisoned.targets.named(name).texels)
                << name << " at " << size.x << " x " << size.y << ", " << producer;
        }
    }
}

} // namespace
} // namespace kilolux::test
