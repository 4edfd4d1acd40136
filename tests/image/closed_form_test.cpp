// Closed forms through the whole renderer: one light over a white floor that an orthographic camera looks
// down on, and the luminance of its pixels in nit.
#include "tests/image/image_kit.h"
#include "tests/image/image_scenes.h"

#include "renderer/gpu_lights.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace kilolux::test {
namespace {

using glm::dvec3;

constexpr double kPi = glm::pi<double>();
constexpr int kWidth = 24, kHeight = 16;
constexpr double kHalfHeightM = 1.0; // of the part of the floor that is seen

// A white Lambert floor. Its specular lobe is left out: only litDiffuse is read.
Scene floorScene(const LightDef& def, const glm::dmat4& worldFromLight) {
    SceneBuilder b;
    b.quad(floorAt({0, 0, 0}), 40, 40, b.material({1, 1, 1}, 0.0, 1.0));
    b.light(def, worldFromLight);
    Camera camera;
    camera.orthographic = true;
    camera.ymagM = kHalfHeightM;
    camera.xmagM = kHalfHeightM * kWidth / kHeight;
    camera.zfarM = 100.0;
    camera.worldFromCamera = lookingAlong({0, 3, 0}, {0, -1, 0});
    b.scene.cameras.push_back(camera);
    return std::move(b.scene);
}

// Where the ray of a pixel meets the floor.
dvec3 floorPoint(const Scene& scene, std::size_t pixel) {
    const double x = (double(pixel % kWidth) + 0.5) / kWidth * 2.0 - 1.0;
    const double y = 1.0 - (double(pixel / kWidth) + 0.5) / kHeight * 2.0;
    const glm::dmat4& m = scene.cameras[0].worldFromCamera;
    dvec3 at =
        dvec3(m[3]) + dvec3(m[0]) * (x * kHalfHeightM * kWidth / kHeight) + dvec3(m[1]) * (y * kHalfHeightM);
    at.y = 0.0;
    return at;
}

// Every pixel's illuminance against `expectedLux(point)`, relative to max(value, 1/1000 of the picture's
// largest).
void expectLux(const LightDef& def, const glm::dmat4& worldFromLight,
               const std::function<double(const dvec3&)>& expectedLux, double tolerance) {
    const Scene scene = floorScene(def, worldFromLight);
    for (const double ev100 : {2.0, 5.0}) {
        RenderOptions options = smallOptions(kWidth, kHeight);
        options.settings.exposureEv100 = {.automatic = false, .value = ev100};
        const Rendered frame = renderScene(scene, options);
        const double exposure = 1.0 / (1.2 * std::exp2(ev100));
        double worst = 0.0, largest = 0.0;
        for (std::size_t i = 0; i < frame.targets.pixels(); ++i) {
            largest = std::max(largest, expectedLux(floorPoint(scene, i)));
        }
        ASSERT_GT(largest, 0.0);
        for (std::size_t i = 0; i < frame.targets.pixels(); ++i) {
            const double expected = expectedLux(floorPoint(scene, i));
            const double lux = luminanceOf(frame.targets.rgb("litDiffuse", i)) * kPi / exposure;
            worst = std::max(worst, std::abs(lux - expected) / std::max(expected, 1e-3 * largest));
            // The picture is not exposed: diffuse plus specular, in nit.
            const double nit = luminanceOf(
                {frame.picture.rgb[3 * i], frame.picture.rgb[3 * i + 1], frame.picture.rgb[3 * i + 2]});
            const double specular = luminanceOf(frame.targets.rgb("litSpecular", i)) / exposure;
            EXPECT_NEAR(nit, lux / kPi + specular, 1e-4 * nit) << "pixel " << i;
        }
        EXPECT_LT(worst, tolerance) << "EV100 " << ev100;
        std::cout << "EV100 " << ev100 << ": worst " << 100.0 * worst << " %\n";
    }
}

// Far enough that the range window takes nothing.
LightDef unwindowed(LightDef def) {
    def.rangeM = 1e4;
    return def;
}

TEST(ClosedForm, PointFollowsTheInverseSquare) {
    const dvec3 light(0.3, 1.7, -0.2);
    expectLux(
        unwindowed(lightDef(LightType::Sphere, 250.0, LightUnit::Candela)), lookingAlong(light, {0, -1, 0}),
        [&](const dvec3& p) {
            const dvec3 to = light - p;
            return 250.0 * to.y / std::pow(glm::length(to), 3.0);
        },
        1e-5);
}

TEST(ClosedForm, RangeWindowIsGltfs) {
    const dvec3 light(0.0, 1.0, 0.0);
    LightDef def = lightDef(LightType::Sphere, 100.0, LightUnit::Candela);
    def.rangeM = 1.4;
    expectLux(
        def, lookingAlong(light, {0, -1, 0}),
        [&](const dvec3& p) {
            const dvec3 to = light - p;
            const double d = glm::length(to);
            return 100.0 * std::max(1.0 - std::pow(d / 1.4, 4.0), 0.0) * to.y / (d * d * d);
        },
        1e-4);
}

// A sphere that is wholly above the horizon lights like its centre.
TEST(ClosedForm, SphereLightsLikeItsCentre) {
    const dvec3 light(0.2, 1.2, 0.1);
    LightDef def = unwindowed(lightDef(LightType::Sphere, 1000.0, LightUnit::Lumen));
    def.radiusM = 0.4;
    expectLux(
        def, lookingAlong(light, {0, -1, 0}),
        [&](const dvec3& p) {
            const dvec3 to = light - p;
            return 1000.0 / (4.0 * kPi) * to.y / std::pow(glm::length(to), 3.0);
        },
        1e-4);
}

TEST(ClosedForm, SunGivesItsLuxTimesTheCosine) {
    for (const double diameterRad : {0.0, 0.1}) {
        LightDef def = lightDef(LightType::Directional, 120.0, LightUnit::Lux);
        def.angularDiameterRad = diameterRad;
        expectLux(
            def, lookingAlong({0, 5, 0}, {0.5, -1.0, 0.2}),
            [](const dvec3&) { return 120.0 / glm::length(dvec3(0.5, 1.0, 0.2)); }, 1e-4);
    }
}

TEST(ClosedForm, SpotHasGltfsCone) {
    LightDef def = unwindowed(lightDef(LightType::Spot, 500.0, LightUnit::Candela));
    def.innerConeRad = 0.3;
    def.outerConeRad = 0.6;
    const dvec3 light(0.1, 1.6, 0.0);
    expectLux(
        def, lookingAlong(light, {0, -1, 0}),
        [&](const dvec3& p) {
            const dvec3 to = light - p;
            const double d = glm::length(to), cosine = to.y / d;
            const double c = std::clamp((cosine - std::cos(0.6)) / (std::cos(0.3) - std::cos(0.6)), 0.0, 1.0);
            return 500.0 * c * c * cosine / (d * d);
        },
        1e-3); // the outer edge is a difference of near cosines
}

// Form factor of a rectangle from a parallel receiver below one of its corners (Howell, "A Catalog of
// Radiation Heat Transfer Configuration Factors", B-4), signed by the corner's side.
double cornerFactor(double a, double b, double h) {
    const double x = a / h, y = b / h, x2 = 1.0 + x * x, y2 = 1.0 + y * y;
    return (x / std::sqrt(x2) * std::atan(y / std::sqrt(x2)) +
            y / std::sqrt(y2) * std::atan(x / std::sqrt(y2))) /
           (2.0 * kPi);
}

TEST(ClosedForm, RectangleFormFactor) {
    LightDef def = unwindowed(lightDef(LightType::Rect, 700.0, LightUnit::Nit));
    def.widthM = 1.3;
    def.heightM = 0.6;
    const glm::dmat4 place = lookingAlong({0.2, 0.9, -0.1}, {0, -1, 0});
    expectLux(
        def, place,
        [&](const dvec3& p) {
            const dvec3 to = dvec3(place[3]) - p;
            const double u = glm::dot(to, dvec3(place[0])), v = glm::dot(to, dvec3(place[1]));
            const double factor =
                cornerFactor(u + 0.65, v + 0.3, to.y) - cornerFactor(u - 0.65, v + 0.3, to.y) -
                cornerFactor(u + 0.65, v - 0.3, to.y) + cornerFactor(u - 0.65, v - 0.3, to.y);
            return kPi * 700.0 * factor;
        },
        1e-4);
}

// From a parallel receiver off the axis (Howell, B-12).
TEST(ClosedForm, DiskFormFactor) {
    LightDef def = unwindowed(lightDef(LightType::Disk, 700.0, LightUnit::Nit));
    def.widthM = 1.0;
    const dvec3 light(-0.2, 1.1, 0.1);
    expectLux(
        def, lookingAlong(light, {0, -1, 0}),
        [&](const dvec3& p) {
            const double offset = std::hypot(light.x - p.x, light.z - p.z);
            const double h = light.y / offset, r = 0.5 / offset;
            const double z = 1.0 + h * h + r * r;
            const double near = 0.5 / light.y; // on the axis: sin^2 of the half angle
            const double onAxis = near * near / (1.0 + near * near);
            const double off = 0.5 * (1.0 - (1.0 + h * h - r * r) / std::sqrt(z * z - 4.0 * r * r));
            return kPi * 700.0 * (offset < 1e-6 ? onAxis : off);
        },
        2e-3); // a circle of 8 to 16 edges with the circle's area
}

// Four flaps of lengths of their own, straight ahead: each darkens its side of the floor from where its tip
// hides the light's far edge. The light's -X (left), +X (right), +Y (top) and -Y (bottom) are -Z, +Z, +X and
// -X here.
TEST(ClosedForm, EachFlapDarkensItsOwnSide) {
    constexpr double kEdgeM = 0.1, kHeightM = 1.0, kRadianceNit = 1000.0;
    LightDef def = unwindowed(lightDef(LightType::Rect, kRadianceNit, LightUnit::Nit));
    def.widthM = def.heightM = 2.0 * kEdgeM;
    const double left = 0.25, right = 0.4, top = 0.2, bottom = 0.3;
    def.barnDoors[std::size_t(BarnDoorSide::Left)] = {0.0, left};
    def.barnDoors[std::size_t(BarnDoorSide::Right)] = {0.0, right};
    def.barnDoors[std::size_t(BarnDoorSide::Top)] = {0.0, top};
    def.barnDoors[std::size_t(BarnDoorSide::Bottom)] = {0.0, bottom};
    // How far the source is seen towards one side from `besideM` on it.
    const auto seenTo = [&](double lengthM, double besideM) {
        const double at = (kEdgeM - besideM * lengthM / kHeightM) / (1.0 - lengthM / kHeightM);
        return std::clamp(at, -kEdgeM, kEdgeM);
    };
    expectLux(
        def, lookingAlong({0, kHeightM, 0}, {0, -1, 0}),
        [&](const dvec3& p) {
            const dvec3 low(-seenTo(bottom, -p.x), kHeightM, -seenTo(left, -p.z)),
                high(seenTo(top, p.x), kHeightM, seenTo(right, p.z));
            constexpr int kSteps = 12;
            double lux = 0.0;
            for (int i = 0; i < kSteps * kSteps; ++i) {
                const dvec3 share((i % kSteps + 0.5) / kSteps, 0.0, (i / kSteps + 0.5) / kSteps);
                const dvec3 to = glm::mix(low, high, share) - p;
                lux += kRadianceNit * kHeightM * kHeightM / std::pow(glm::dot(to, to), 2.0);
            }
            return lux * std::max(high.x - low.x, 0.0) * std::max(high.z - low.z, 0.0) / (kSteps * kSteps);
        },
        2e-3);
}

} // namespace
} // namespace kilolux::test
