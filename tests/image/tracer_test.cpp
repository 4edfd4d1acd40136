// Both tracing back ends give the same picture within ties, as cause of the G-buffer and of shadows.
#include "tests/image/image_kit.h"
#include "tests/image/image_scenes.h"
#include "tests/unit/accel/scene_kit.h"

#include <iostream>

namespace kilolux::test {
namespace {

// The stage with a masked screen, so that candidates are asked.
Scene maskedStage() {
    Scene stage = stageScene({lightCases()[0], lightCases()[4], lightCases()[5]});
    SceneBuilder b;
    b.scene = std::move(stage);
    const int mask = b.material({0.5, 0.6, 0.3}, 0.0, 0.7);
    Material& material = b.scene.materials[std::size_t(mask)];
    material.alphaMode = AlphaMode::Mask;
    material.doubleSided = true;
    b.scene.images.push_back(makeImage(
        [](int x, int y) { return glm::dvec4(0.7, 0.8, 0.6, (x / 16 + y / 16) % 2 == 0 ? 1.0 : 0.0); }));
    material.baseColor.image = int(b.scene.images.size()) - 1;
    b.quad(lookingAlong({-0.9, 1.4, 0.9}, {0.4, -0.6, -1}), 1.0, 1.0, mask);
    return std::move(b.scene);
}

bool lacksRayQuery(const Scene& scene) {
    return !Renderer::create(scene, smallOptions(8, 8, {"tracer=rayQuery"}));
}

// A ray that passes within rounding of an edge may go either way; the two tracers round differently. Of a few
// thousand pixels with several rays each, fewer than 1 in 200 may differ.
void expectSamePicture(const Scene& scene, const std::string& method) {
    if (lacksRayQuery(scene)) GTEST_SKIP() << "the device has no ray query";
    RenderOptions options = smallOptions(64, 48, {"gbuffer=compute", "raysPerLight=2", "tracer=compute"});
    options.method = method;
    const Rendered compute = renderScene(scene, options);
    options.settings.tracer = TracerChoice::RayQuery;
    const Rendered query = renderScene(scene, options);
    int surfaces = 0, otherTriangle = 0, otherLight = 0;
    for (std::size_t i = 0; i < compute.targets.pixels(); ++i) {
        const PixelSurface a = compute.targets.surface(i), b = query.targets.surface(i);
        surfaces += a.seen;
        const bool same = a.seen == b.seen && a.instance == b.instance && a.primitive == b.primitive;
        otherTriangle += !same;
        const glm::dvec3 x = compute.targets.rgb("litDiffuse", i), y = query.targets.rgb("litDiffuse", i);
        otherLight += same && glm::length(x - y) > 1e-5 * glm::length(x + y);
    }
    std::cout << surfaces << " surface pixels, " << otherTriangle << " of other triangles, " << otherLight
              << " of other light\n";
    EXPECT_GT(surfaces, 1000);
    EXPECT_LE(otherTriangle, surfaces / 200);
    EXPECT_LE(otherLight, surfaces / 200);
    EXPECT_NEAR(double(query.statistics.rays), double(compute.statistics.rays),
                0.01 * double(compute.statistics.rays));
}

TEST(Tracer, BackEndsAgreeOnSplit) {
    expectSamePicture(maskedStage(), "split");
}

TEST(Tracer, BackEndsAgreeOnTrue) {
    expectSamePicture(maskedStage(), "true");
}

TEST(Tracer, BackEndsAgreeTenKilometresOff) {
    expectSamePicture(placedScene(maskedStage(), 1.0, {1e4, 0.0, -4e3}), "all-lights");
}

} // namespace
} // namespace kilolux::test
