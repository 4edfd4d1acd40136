// Transparent surfaces by the project's rule: below half opacity they are in neither G-buffer nor shadow rays
// and are drawn sorted over the lit picture, as a tint and an emission; from half on they are surfaces like
// any other.
#include "tests/image/image_kit.h"
#include "tests/image/image_scenes.h"

namespace kilolux::test {
namespace {

using glm::dvec3;

constexpr int kSize = 32;

// A floor lit by a small sphere from above, seen straight down; panes lie between camera and light, or under
// both.
struct PaneScene {
    SceneBuilder b;
    int floor = b.material({0.8, 0.8, 0.8}, 0.0, 1.0);

    PaneScene() {
        b.quad(floorAt({0, 0, 0}), 6, 6, floor);
        LightDef def = lightDef(LightType::Sphere, 300.0, LightUnit::Candela);
        def.radiusM = 0.05;
        def.rangeM = 100.0;
        b.light(def, lookingAlong({1.5, 3.0, 0.2}, {0, -1, 0}));
        b.scene.cameras.push_back(cameraLooking({0, 4, 0.001}, {0, 0, 0}, 0.5));
    }
    Material& pane(double height, double size = 8.0) {
        const int material = b.material({1, 1, 1}, 0.0, 1.0);
        b.quad(floorAt({0, height, 0}), size, size, material);
        b.scene.materials[std::size_t(material)].doubleSided = true;
        return b.scene.materials[std::size_t(material)];
    }
    Rendered render(const char* producer = "gbuffer=raster") const {
        return renderScene(b.scene, smallOptions(kSize, kSize, {producer, "exposureEv100=4"}));
    }
};

dvec3 pixelOf(const Rendered& frame, std::size_t i) {
    return {frame.picture.rgb[3 * i], frame.picture.rgb[3 * i + 1], frame.picture.rgb[3 * i + 2]};
}

// Every pixel is `expected(plain pixel)` to half a per mille.
void expectPicture(const Rendered& frame, const Rendered& plain,
                   const std::function<dvec3(const dvec3&)>& expected) {
    for (std::size_t i = 0; i < plain.targets.pixels(); ++i) {
        const dvec3 want = expected(pixelOf(plain, i)), got = pixelOf(frame, i);
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(got[c], want[c], 5e-4 * want[c] + 1e-6) << "pixel " << i;
    }
}

TEST(Transparent, BlendTintsByItsOpacity) {
    const Rendered plain = PaneScene().render();
    for (const char* producer : {"gbuffer=raster", "gbuffer=compute"}) {
        PaneScene scene;
        Material& pane = scene.pane(2.0);
        pane.alphaMode = AlphaMode::Blend;
        pane.baseColorFactor = {0.9, 0.4, 0.1, 0.3};
        const Rendered frame = scene.render(producer);
        expectPicture(frame, plain, [](const dvec3& p) { return p * (0.7 + 0.3 * dvec3(0.9, 0.4, 0.1)); });
        for (std::size_t i = 0; i < plain.targets.pixels(); ++i) {
            EXPECT_EQ(frame.targets.surface(i).instance, 0u) << "the G-buffer shows the floor";
        }
    }
}

TEST(Transparent, TransmissionTintsByItsBaseColor) {
    const Rendered plain = PaneScene().render();
    PaneScene scene;
    Material& pane = scene.pane(2.0);
    pane.transmission = 0.8;
    pane.baseColorFactor = {0.3, 0.6, 0.9, 1.0};
    expectPicture(scene.render(), plain, [](const dvec3& p) { return p * (0.8 * dvec3(0.3, 0.6, 0.9)); });
}

// An emitter between two tints: what it adds passes the nearer one only. Files hold them in any order.
TEST(Transparent, PanesAreSortedByDistance) {
    const Rendered plain = PaneScene().render();
    const dvec3 nearTint(0.5, 0.9, 0.7), farTint(0.9, 0.3, 0.6), glowNit(40.0, 20.0, 10.0),
        glowTint(0.8, 0.8, 0.8);
    for (const std::vector<int>& order : {std::vector<int>{0, 1, 2}, {2, 1, 0}, {1, 2, 0}}) {
        PaneScene scene;
        for (const int which : order) {
            Material& pane = scene.pane(1.0 + 0.8 * which);
            pane.transmission = 1.0;
            const dvec3 tint = which == 0 ? farTint : which == 1 ? glowTint : nearTint;
            pane.baseColorFactor = glm::dvec4(tint, 1.0);
            if (which == 1) pane.emissiveNit = glowNit;
        }
        expectPicture(scene.render(), plain,
                      [&](const dvec3& p) { return (p * farTint * glowTint + glowNit) * nearTint; });
    }
}

// An opaque surface in front hides a pane, one behind does not.
TEST(Transparent, OpaqueSurfacesHidePanes) {
    PaneScene bare;
    bare.pane(2.5, 0.4);
    const Rendered plain = bare.render();
    PaneScene scene;
    scene.pane(2.5, 0.4);
    Material& pane = scene.pane(2.0);
    pane.transmission = 1.0;
    pane.baseColorFactor = {0.5, 0.5, 0.5, 1.0};
    const Rendered frame = scene.render();
    int hidden = 0;
    for (std::size_t i = 0; i < plain.targets.pixels(); ++i) {
        const bool inFront = plain.targets.surface(i).instance == 1;
        hidden += inFront;
        const double factor = inFront ? 1.0 : 0.5;
        EXPECT_NEAR(pixelOf(frame, i).y, factor * pixelOf(plain, i).y, 1e-3 * pixelOf(plain, i).y + 1e-6)
            << i;
    }
    EXPECT_GT(hidden, 50);
    EXPECT_LT(hidden, 500);
}

// From half opacity on a surface is opaque: it hides the floor and casts a shadow.
TEST(Transparent, HalfOpaqueIsOpaque) {
    for (const double opacity : {0.3, 0.49, 0.5, 0.8}) {
        for (const bool transmits : {false, true}) {
            PaneScene scene;
            Material& pane = scene.pane(1.0, 0.5);
            if (transmits) pane.transmission = 1.0 - opacity;
            if (!transmits) {
                pane.alphaMode = AlphaMode::Blend;
                pane.baseColorFactor = {1, 1, 1, opacity};
            }
            const Rendered frame = scene.render();
            int seen = 0, shadowed = 0;
            for (std::size_t i = 0; i < frame.targets.pixels(); ++i) {
                seen += frame.targets.surface(i).instance == 1;
                shadowed += luminanceOf(frame.targets.rgb("litDiffuse", i)) == 0.0;
            }
            EXPECT_EQ(seen > 0, opacity >= 0.5) << opacity << (transmits ? " transmission" : " blend");
            EXPECT_EQ(shadowed > 0, opacity >= 0.5) << opacity << (transmits ? " transmission" : " blend");
        }
    }
}

} // namespace
} // namespace kilolux::test
