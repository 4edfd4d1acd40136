// Shadows where none may be and none where they must be: convex bodies lit from outside do not shadow
// themselves at any scale or place, lights at the horizon are not cut short, and a wall of a millimetre lets
// nothing through.
#include "tests/image/image_kit.h"
#include "tests/image/image_scenes.h"
#include "tests/unit/accel/scene_kit.h"

#include <iostream>

namespace kilolux::test {
namespace {

using glm::dvec3;

// A ball and a box, apart from each other and convex, between two lights at a distance.
Scene convexScene() {
    SceneBuilder b;
    const int plain = b.material({0.7, 0.7, 0.7}, 0.0, 0.8);
    addPrimitive(b, makeSphere(24, 36, 0.5), Shading::Round,
                 glm::rotate(glm::translate(glm::dmat4(1.0), dvec3(-0.7, 0, 0)), 0.4, dvec3(0, 0, 1)), plain);
    addPrimitive(
        b, makeBox({0.45, 0.45, 0.45}), Shading::Flat,
        glm::rotate(glm::translate(glm::dmat4(1.0), dvec3(0.7, 0, 0)), 0.6, glm::normalize(dvec3(1, 2, 1))),
        plain);
    LightDef disk = lightDef(LightType::Disk, 3000.0, LightUnit::Candela);
    disk.widthM = 0.6;
    disk.rangeM = 50.0;
    b.light(disk, lookingAlong({0.3, 4.0, 3.0}, {0, -4.0, -3.0}));
    b.scene.cameras.push_back(cameraLooking({0, 0.8, 3.2}, {0, 0, 0}, 0.6));
    return std::move(b.scene);
}

struct Placing {
    double scale;
    dvec3 offsetM;
};
void PrintTo(const Placing& p, std::ostream* out) {
    *out << "scale " << p.scale << " at " << p.offsetM.x << ", " << p.offsetM.y << ", " << p.offsetM.z;
}

class Convex : public testing::TestWithParam<Placing> {};

// With the whole light above a pixel's tangent plane and facet, every ray of `split` reaches it: the frame
// equals the one in which nothing casts a shadow to float rounding. That one is made by ending all rays at
// once: their bias is longer than they are.
TEST_P(Convex, NoSelfShadow) {
    Scene scene = placedScene(convexScene(), GetParam().scale, GetParam().offsetM);
    Scene unshadowed = scene;
    for (LightDef& def : unshadowed.lightDefs)
        def.rayEndBiasM = 1e9;
    const dvec3 lightWs(scene.nodes[std::size_t(scene.lights[0].node)].worldFromNode[3]);
    const double lightRadiusM = 0.5 * scene.lightDefs[0].widthM;
    for (const char* producer : {"gbuffer=raster", "gbuffer=compute"}) {
        RenderOptions options = smallOptions(96, 64, {producer, "raysPerLight=4", "exposureEv100=5"});
        options.method = "split";
        const Rendered lit = renderScene(scene, options), whole = renderScene(unshadowed, options);
        EXPECT_GT(lit.statistics.rays, 2000u);
        EXPECT_EQ(whole.statistics.rays, 0u) << "the reference must cast no ray";
        int above = 0, speckles = 0;
        for (std::size_t i = 0; i < lit.targets.pixels(); ++i) {
            const PixelSurface s = lit.targets.surface(i);
            if (!s.seen) continue;
            const Camera& camera = scene.cameras[0];
            const oracle::CameraRay ray =
                oracle::cameraRay(camera, 96, 64, glm::dvec2(double(i % 96) + 0.5, double(i / 96) + 0.5));
            const double along = s.depthM / glm::dot(ray.directionWs, -dvec3(camera.worldFromCamera[2]));
            const dvec3 to = lightWs - (ray.originWs + ray.directionWs * along);
            const double margin = 1.01 * lightRadiusM;
            if (glm::dot(to, s.geoNormalWs) < margin || glm::dot(to, s.normalWs) < margin) continue;
            ++above;
            speckles += lit.targets.rgb("litDiffuse", i) != whole.targets.rgb("litDiffuse", i);
        }
        EXPECT_GT(above, 300);
        EXPECT_EQ(speckles, 0) << "of " << above << ", " << producer;
    }
}

INSTANTIATE_TEST_SUITE_P(Places, Convex,
                         testing::Values(Placing{0.01, dvec3(0.0)}, Placing{1.0, dvec3(0.0)},
                                         Placing{100.0, dvec3(0.0)}, Placing{10000.0, dvec3(0.0)},
                                         Placing{1.0, {1e4, 0, 0}}, Placing{0.01, {1e4, 50, -1e4}},
                                         Placing{10000.0, {3e5, 0, 1e5}}));

// A closed box with walls of a millimetre around the camera, lights outside on all sides: black, at any
// place. The walls are single slabs with gaps of nothing: their edges meet and overlap.
TEST(Leak, AWallOfAMillimetreIsDark) {
    SceneBuilder b;
    const int white = b.material({1, 1, 1}, 0.0, 0.9);
    b.scene.materials[std::size_t(white)].doubleSided = true;
    const Primitive slab = makeBox({1.001, 0.0005, 1.001});
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            dvec3 at(0.0);
            at[axis] = side * 1.0005;
            glm::dmat4 place = glm::translate(glm::dmat4(1.0), at);
            if (axis != 1) {
                dvec3 turn(0.0);
                turn[2 - axis] = 1.0;
                place = glm::rotate(place, 0.5 * oracle::kPi, turn);
            }
            addPrimitive(b, slab, Shading::Flat, place, white);
        }
    }
    for (const LightCase& light : lightCases()) {
        LightCase outside = light;
        outside.def.rangeM = 100.0;
        b.light(outside.def, lookingAlong({-0.7, 1.4, 0.4}, {0.3, -1.0, -0.1}));
        b.light(outside.def, lookingAlong({1.6, 0.3, 1.3}, {-1.0, -0.2, -0.8}));
        b.light(outside.def, lookingAlong({0.1, -1.3, -0.1}, {0.0, 1.0, 0.1}));
    }
    b.scene.cameras.push_back(cameraLooking({0.5, 0.3, 0.8}, {-0.4, -0.5, -0.6}, 1.6));
    for (const dvec3& offsetM : {dvec3(0.0), dvec3(1e4, 0, 3e3)}) {
        const Scene scene = placedScene(b.scene, 1.0, offsetM);
        for (const char* producer : {"gbuffer=raster", "gbuffer=compute"}) {
            for (const char* method : {"split", "true"}) {
                RenderOptions options = smallOptions(64, 48, {producer, "raysPerLight=4", "exposureEv100=0"});
                options.method = method;
                const Rendered frame = renderScene(scene, options);
                int lit = 0;
                for (std::size_t i = 0; i < frame.targets.pixels(); ++i) {
                    ASSERT_TRUE(frame.targets.surface(i).seen) << "the box is closed";
                    lit += luminanceOf(frame.targets.rgb("litDiffuse", i)) > 0.0;
                }
                EXPECT_EQ(lit, 0) << producer << ", " << method << ", x = " << offsetM.x;
                EXPECT_GT(frame.statistics.rays, 10000u);
            }
        }
    }
}

// A floor whose shading normals lean towards the light: where the light is under the facet's horizon it is
// dark, whatever the normal says.
TEST(Horizon, NoLightFromUnderTheFacet) {
    SceneBuilder b;
    b.quad(floorAt({0, 0, 0}), 4, 4, b.material({1, 1, 1}, 0.0, 0.9));
    Mesh leaning = *b.scene.meshes[0];
    for (glm::vec3& normal : leaning.primitives[0].normals)
        normal = glm::normalize(glm::vec3(0.0f, -0.8f, 0.6f));
    b.scene.meshes[0] = std::make_shared<Mesh>(leaning);
    LightDef def = lightDef(LightType::Sphere, 500.0, LightUnit::Candela);
    def.radiusM = 0.2;
    b.light(def, lookingAlong({0, -0.6, 3.0},
                              {0, 0, -1})); // under the floor, on the side that the normals lean to
    b.scene.cameras.push_back(cameraLooking({0, 2, 3}, {0, 0, 0}));
    for (const char* method : {"split", "true"}) {
        RenderOptions options = smallOptions(48, 32, {"exposureEv100=0"});
        options.method = method;
        const Rendered frame = renderScene(b.scene, options);
        int facing = 0;
        for (std::size_t i = 0; i < frame.targets.pixels(); ++i) {
            const PixelSurface s = frame.targets.surface(i);
            if (!s.seen) continue;
            facing += s.normalWs.z > 0.3;
            EXPECT_EQ(luminanceOf(frame.targets.rgb("litDiffuse", i)), 0.0) << method << ", pixel " << i;
        }
        EXPECT_GT(facing, 100);
    }
}

} // namespace
} // namespace kilolux::test
