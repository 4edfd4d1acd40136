// Inputs at which float fails: every kernel of the lights in float against double from the same source, and
// double against the oracle. Prints the table of the largest relative errors by kernel and kind of input
// (committed as tests/stability/table.md); no NaN, no infinity, no negative light, and never more energy than
// is emitted.
#include "renderer/document/ies_profile.h"
#include "renderer/gpu_lights.h"
#include "renderer/lights_cpp/lights_f32.h"
#include "renderer/lights_cpp/lights_f64.h"
#include "renderer/lights_cpp/ltc_table.h"
#include "renderer/reference/oracle_estimate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace kilolux {
namespace {

using glm::dvec3;

constexpr double kPi = 3.14159265358979323846;
constexpr LightType kTypes[] = {LightType::Directional, LightType::Sphere, LightType::Spot,
                                LightType::Tube,        LightType::Rect,   LightType::Disk};

class Random {
  public:
    double uniform(double low, double high) { return low + (high - low) * double(engine_()) / 4294967296.0; }
    double octaves(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
    dvec3 direction() {
        const double z = uniform(-1, 1), phi = uniform(0, 2 * kPi), r = std::sqrt(1 - z * z);
        return {r * std::cos(phi), r * std::sin(phi), z};
    }

  private:
    std::mt19937 engine_{5};
};

struct HardCase {
    LightDef def;
    glm::dmat4 world{1.0}; // the light looks along -Z of it
    dvec3 receiver{0.0};
    dvec3 normal{0.0, 0.0, 1.0};
    dvec3 view{0.0, 0.0, 1.0};
    double roughness = 0.5;
};

// A light of about half a metre at the origin and a receiver 1 to 3 m away, before it where it has a front.
HardCase plainCase(Random& random, LightType type) {
    HardCase c;
    c.def.type = type;
    c.def.unit = type == LightType::Directional ? LightUnit::Lux : LightUnit::Candela;
    c.def.intensity = 100.0;
    c.def.rangeM = 1e7;
    c.def.radiusM = random.uniform(0.05, 0.4);
    c.def.lengthM = c.def.widthM = c.def.heightM = random.uniform(0.2, 1.0);
    c.def.outerConeRad = 1.2;
    c.def.innerConeRad = 0.4;
    c.def.angularDiameterRad = 0.1;
    dvec3 out = random.direction();
    out.z = -std::abs(out.z) - 0.2;
    c.receiver = glm::normalize(out) * random.uniform(1.0, 3.0);
    const dvec3 toLight = type == LightType::Directional ? dvec3(0, 0, 1) : -glm::normalize(c.receiver);
    c.normal = glm::normalize(toLight + random.direction() * 0.6);
    c.view = glm::normalize(c.normal + random.direction() * 0.7);
    c.roughness = random.uniform(0.15, 1.0);
    return c;
}

std::shared_ptr<const IesProfile> oneAngle() {
    auto profile = std::make_shared<IesProfile>();
    profile->verticalDeg = {0.0, 90.0};
    profile->horizontalDeg = {0.0};
    profile->candela = {1000.0, 200.0};
    return profile;
}

struct Kind {
    const char* name;
    std::function<void(HardCase&, Random&)> change;
};

const std::vector<Kind>& kinds() {
    static const std::shared_ptr<const IesProfile> profile = oneAngle();
    static const std::vector<Kind> all = {
        {"plain", [](HardCase&, Random&) {}},
        {"grazing view",
         [](HardCase& c, Random& r) {
             const dvec3 side = glm::normalize(glm::cross(c.normal, r.direction()));
             c.view = glm::normalize(side + c.normal * r.octaves(1e-6, 1e-2));
         }},
        {"grazing light",
         [](HardCase& c, Random& r) {
             const dvec3 to =
                 c.def.type == LightType::Directional ? dvec3(0, 0, 1) : glm::normalize(c.receiver);
             c.normal = glm::normalize(glm::cross(to, r.direction()) - to * r.octaves(1e-6, 1e-2));
             c.view = glm::normalize(c.normal + r.direction() * 0.7);
         }},
        {"cut by the horizon",
         [](HardCase& c, Random& r) {
             const dvec3 to =
                 c.def.type == LightType::Directional ? dvec3(0, 0, 1) : glm::normalize(c.receiver);
             c.normal = glm::normalize(glm::cross(to, r.direction()) + to * r.uniform(-0.1, 0.1));
             c.view = glm::normalize(c.normal + r.direction() * 0.7);
         }},
        {"on the light", [](HardCase& c, Random& r) { c.receiver *= r.octaves(1e-9, 0.02); }},
        {"in its plane", [](HardCase& c, Random& r) { c.receiver.z = -r.octaves(1e-9, 1e-4); }},
        {"no size",
         [](HardCase& c, Random&) {
             c.def.radiusM = c.def.lengthM = c.def.widthM = c.def.heightM = c.def.angularDiameterRad = 0.0;
         }},
        {"1e-6 m",
         [](HardCase& c, Random&) {
             c.def.radiusM = c.def.lengthM = c.def.widthM = c.def.heightM = 1e-6;
             c.def.angularDiameterRad = 1e-6;
         }},
        {"1 km",
         [](HardCase& c, Random&) {
             c.def.radiusM = 0.4;
             c.def.lengthM = c.def.widthM = c.def.heightM = 1000.0;
             c.def.angularDiameterRad = 3.0;
         }},
        {"cone of 0 degrees", [](HardCase& c, Random&) { c.def.innerConeRad = c.def.outerConeRad = 0.0; }},
        {"cone of 180 degrees",
         [](HardCase& c, Random&) { c.def.innerConeRad = c.def.outerConeRad = 0.5 * kPi; }},
        {"doors at 0",
         [](HardCase& c, Random& r) {
             c.def.barnDoors.fill({0.0, r.uniform(0.0, 2.0)});
         }},
        {"doors at 90",
         [](HardCase& c, Random& r) {
             c.def.barnDoors.fill({0.5 * kPi, r.uniform(0.0, 2.0)});
         }},
        {"doors between",
         [](HardCase& c, Random& r) {
             for (BarnDoor& door : c.def.barnDoors)
                 door = {r.uniform(0.0, 0.5 * kPi), r.octaves(1e-3, 3.0)};
         }},
        {"profile of one angle",
         [](HardCase& c, Random& r) {
             c.def.ies = profile;
             c.def.iesUse = r.uniform(0, 1) < 0.5 ? IesUse::Shape : IesUse::Mask;
         }},
        {"light function",
         [](HardCase& c, Random& r) {
             c.def.function = {.kind = r.uniform(0, 1) < 0.5 ? LightFunctionKind::Grid
                                                             : LightFunctionKind::Caustics,
                               .scale = r.octaves(0.1, 2.0),
                               .softness = r.uniform(0.3, 1.0)};
         }},
        {"1e-6 cd", [](HardCase& c, Random&) { c.def.intensity = 1e-6; }},
        {"1e9 cd", [](HardCase& c, Random&) { c.def.intensity = 1e9; }},
        {"10 km off",
         [](HardCase& c, Random&) {
             const dvec3 off(6000.0, 100.0, -8000.0);
             c.world = glm::translate(glm::dmat4(1.0), off);
             // Where float can stand: the receiver's place is not the kernel's error.
             c.receiver = dvec3(glm::vec3(c.receiver + off));
         }},
        {"denormal",
         [](HardCase& c, Random&) {
             c.def.intensity = 1e-41;
             c.def.radiusM = std::max(c.def.radiusM, 0.1);
         }},
        {"mirror-smooth", [](HardCase& c, Random&) { c.roughness = 0.0; }},
    };
    return all;
}

constexpr const char* kKernels[] = {"evaluate", "diffuse",          "GGX", "weight", "sample",
                                    "hit",      "diffuse to oracle"};
constexpr std::size_t kKernelCount = std::size(kKernels);

struct Errors {
    std::array<double, kKernelCount> largest{};
    std::array<int, kKernelCount> count{};
    void add(std::size_t kernel, double error) {
        largest[kernel] = std::max(largest[kernel], error);
        ++count[kernel];
    }
};

bool sound(double value) {
    return std::isfinite(value) && value >= 0.0;
}

double relative(double found, double truth, double least) {
    return std::abs(found - truth) / std::max(std::abs(truth), least);
}

GpuLights recordsOf(const LightDef& def, const glm::dmat4& world) {
    Scene scene;
    scene.lightDefs = {def};
    Node node;
    node.worldFromNode = world;
    scene.nodes = {node};
    scene.lights = {{.id = 1, .node = 0, .def = 0}};
    return makeGpuLights(scene, dvec3(0.0), 0.0);
}

void checkCase(const HardCase& c, Errors& errors, const char* name, int index) {
    SCOPED_TRACE(testing::Message() << name << ", light type " << int(c.def.type) << ", case " << index);
    const GpuLights records = recordsOf(c.def, c.world);
    const BindLightTables bound(records.tables);
    const shared::LightHot& hot = records.hot[0];
    const f64::LightHot exactHot = f64::fromF32(hot);
    const auto point = f32::makeShadingPoint(glm::vec3(c.receiver), glm::vec3(c.normal), glm::vec3(c.view),
                                             float(c.roughness));
    const auto exactPoint =
        f64::makeShadingPoint(dvec3(glm::vec3(c.receiver)), c.normal, c.view, c.roughness);
    const auto lit = f32::lightIrradiance(hot, point, f32::makeLtcLobe(point));
    const auto lobe = f64::makeLtcLobe(exactPoint);
    const auto exact = f64::lightIrradiance(exactHot, exactPoint, lobe);
    const auto outline = f64::lightOutline(exactHot, exactPoint.positionWs, 1.0);
    const bool delta = f64::lightIsDelta(exactHot);
    for (const double value : {double(lit.emission.x), double(lit.diffuse), double(lit.specular.x),
                               double(lit.specular.y), exact.diffuse, exact.specular.x, exact.specular.y})
        ASSERT_TRUE(sound(value));
    // Of unit radiance no more than a whole sky gives, and no more than the lobe reflects.
    if (!delta) {
        ASSERT_LE(lit.diffuse, kPi * 1.001);
        ASSERT_LE(lit.specular.x + lit.specular.y, 1.02);
    }
    const bool agree = (lit.emission.x > 0.0f) == (exact.emission.x > 0.0);
    if (!agree) return; // on an edge of the light: either is right
    const double full =
        std::max(std::min(outline.solidAngle, kPi), kPi * outline.angularRadius * outline.angularRadius);
    const double most =
        std::min(full / (kPi * 4.0 * exactPoint.alpha * exactPoint.alpha), lobe.albedo.x + lobe.albedo.y);
    errors.add(0, relative(lit.emission.x, exact.emission.x, 1e-37));
    errors.add(1, relative(lit.diffuse, exact.diffuse, std::max(0.01 * full, 1e-30)));
    errors.add(2, relative(lit.specular.x + lit.specular.y, exact.specular.x + exact.specular.y,
                           std::max(0.01 * most, 1e-30)));
    const double weight = f32::lightWeight(hot, point, 0.5f, 0.04f),
                 exactWeight = f64::lightWeight(exactHot, exactPoint, 0.5, 0.04);
    ASSERT_TRUE(sound(weight));
    const double reflected = exact.emission.x * (exact.diffuse + exact.specular.x + exact.specular.y);
    if (reflected > 1e-30 && lit.diffuse > 0.0f) {
        ASSERT_GT(weight, 0.0);
    }
    errors.add(3, relative(weight, exactWeight, std::max(1e-3 * exact.emission.x * full, 1e-35)));
    const glm::vec2 uv(0.3f, 0.8f);
    const auto s = f32::lightSample(hot, point.positionWs, uv);
    const auto exactSample = f64::lightSample(exactHot, exactPoint.positionWs, glm::dvec2(uv));
    ASSERT_TRUE(sound(s.geometry) && sound(s.pdfArea) && sound(s.pdfSolidAngle) && sound(s.distanceM));
    if (!s.valid || !exactSample.valid) return;
    errors.add(4, relative(s.geometry, exactSample.geometry, 1e-3 * full + 1e-30));
    const auto hit = f32::lightIntersect(hot, point.positionWs, s.dirWs);
    ASSERT_TRUE(sound(hit.distanceM) && sound(hit.pdfSolidAngle));
    if (hit.hit) errors.add(5, relative(hit.distanceM, s.distanceM, 1e-6));
    // The oracle's quadrature is slow, and of sources without area it knows points only.
    const bool isArea =
        c.def.type == LightType::Tube || c.def.type == LightType::Rect || c.def.type == LightType::Disk;
    if (index % 5 != 0 || (isArea && c.def.widthM <= 0.0)) return;
    oracle::OraclePoint at;
    at.positionWs = exactPoint.positionWs;
    at.geometricNormalWs = at.shadingNormalWs = c.normal;
    at.viewDirWs = c.view;
    at.material.roughness = std::max(c.roughness, 0.1);
    const auto truth =
        oracle::estimateLight(oracle::makeLight(c.def, c.world), at, {}, oracle::Estimator::Split, 8, 1);
    const double emission = std::max(exact.emission.x, 1e-300);
    errors.add(6, relative(exact.diffuse * emission, truth.unshadowedIrradianceLux.x,
                           std::max(0.01 * full * emission, 1e-300)));
}

TEST(HardCases, FloatAgainstDoubleAgainstTheOracle) {
    useLtcTable(loadLtcTable(KILOLUX_SOURCE_DIR "/content/ltc_ggx.bin").value());
    Random random;
    std::string table = "| input |";
    for (const char* kernel : kKernels)
        table += std::string(" ") + kernel + " |";
    table += "\n| --- |" + std::string(" --- |") + " --- | --- | --- | --- | --- | --- |\n";
    for (const Kind& kind : kinds()) {
        Errors errors;
        for (const LightType type : kTypes) {
            for (int i = 0; i < 150; ++i) {
                HardCase c = plainCase(random, type);
                kind.change(c, random);
                checkCase(c, errors, kind.name, i);
                if (HasFatalFailure()) return;
            }
        }
        table += std::string("| ") + kind.name + " |";
        for (std::size_t kernel = 0; kernel < kKernelCount; ++kernel) {
            char cell[40];
            std::snprintf(cell, sizeof(cell), errors.count[kernel] ? " %.0e |" : " - |",
                          errors.largest[kernel]);
            table += cell;
        }
        table += "\n";
        const std::string name = kind.name;
        // What float can lose at all: in the light's plane or on the light the geometry itself is rounded
        // away.
        const bool degenerate =
            name == "on the light" || name == "in its plane" || name == "1 km" || name == "1e-6 m";
        const bool far = name == "10 km off";
        // A profile's end is a step, which its picture spreads over half a degree.
        const bool stepped = name == "profile of one angle";
        // A circle is a polygon, whose corners the horizon cuts otherwise.
        const bool cut = name == "grazing light" || name == "cut by the horizon";
        EXPECT_LT(errors.largest[1], degenerate ? 2.0 : far ? 0.05 : 0.02) << name << ", diffuse";
        EXPECT_LT(errors.largest[6], degenerate ? 2.0
                                     : cut      ? 0.1
                                     : stepped  ? 0.05
                                                : 0.02)
            << name << ", diffuse against the oracle";
    }
    std::printf("%s", table.c_str());
    if (const char* path = std::getenv("KILOLUX_STABILITY_TABLE")) {
        std::FILE* file = std::fopen(path, "w");
        ASSERT_TRUE(file);
        std::fprintf(
            file,
            "Largest relative error of the lights' kernels, float against double; the last column double "
            "against the oracle.\nGenerated: `KILOLUX_STABILITY_TABLE=tests/stability/table.md "
            "build/stability_tests`.\n\n%s",
            table.c_str());
        std::fclose(file);
    }
}

// A source of unit radiance at `heightM` off its surface: all of the sky that a receiver sees which faces it.
HardCase onTheSurface(LightType type, double heightM, Random& random) {
    HardCase c = plainCase(random, type);
    c.def.rangeM.reset();
    c.def.outerConeRad = c.def.innerConeRad = 0.5 * kPi;
    c.def.angularDiameterRad = 3.13; // nearly half of the sky: float has no tangent of a quarter turn
    c.normal = {0.0, 0.0, 1.0};
    const double along = random.uniform(-0.3, 0.3) * c.def.widthM,
                 across = random.uniform(-0.2, 0.2) * c.def.widthM;
    if (type == LightType::Rect || type == LightType::Disk) {
        c.receiver = {along, across, -heightM};
    } else if (type == LightType::Tube) {
        c.receiver = {along, 0.0, -(c.def.radiusM + heightM)};
    } else {
        c.receiver = {0.0, 0.0, -(c.def.radiusM + heightM)};
    }
    return c;
}

// On the light both lobes give back all that they can, and no more however the surface is turned.
TEST(HardCases, OnTheLightLobesReflectAWholeSky) {
    useLtcTable(loadLtcTable(KILOLUX_SOURCE_DIR "/content/ltc_ggx.bin").value());
    Random random;
    for (const LightType type : kTypes) {
        double worstDiffuse = 0.0, worstGgx = 0.0, most = 0.0, worstFloat = 0.0;
        for (const double heightM : {0.0, 1e-9, 1e-8, 1e-7, 1e-6}) {
            for (int i = 0; i < 80; ++i) {
                HardCase c = onTheSurface(type, heightM, random);
                const bool turned = i % 2 != 0;
                if (turned) c.normal = glm::normalize(c.normal + random.direction() * 0.99);
                c.view = glm::normalize(c.normal + random.direction() * random.uniform(0.0, 0.999));
                c.roughness = i % 3 == 0 ? 0.0 : random.uniform(0.0, 1.0);
                const GpuLights records = recordsOf(c.def, c.world);
                const BindLightTables bound(records.tables);
                const auto point = f32::makeShadingPoint(glm::vec3(c.receiver), glm::vec3(c.normal),
                                                         glm::vec3(c.view), float(c.roughness));
                const auto lobe = f32::makeLtcLobe(point);
                const auto lit = f32::lightIrradiance(records.hot[0], point, lobe);
                const double ggx = double(lit.specular.x) + lit.specular.y,
                             whole = double(lobe.albedo.x) + lobe.albedo.y;
                ASSERT_TRUE(sound(lit.diffuse) && sound(lit.specular.x) && sound(lit.specular.y));
                ASSERT_LE(lit.diffuse, kPi * 1.001);
                ASSERT_LE(ggx, whole * 1.001) << "type " << int(type) << ", " << heightM << " m";
                most = std::max(most, ggx / whole);
                // Nearer, float rounds the light's plane through the receiver, or the receiver into the
                // light.
                if (heightM < 1e-7) continue;
                const auto exactPoint =
                    f64::makeShadingPoint(dvec3(glm::vec3(c.receiver)), c.normal, c.view, c.roughness);
                const auto exact = f64::lightIrradiance(f64::fromF32(records.hot[0]), exactPoint,
                                                        f64::makeLtcLobe(exactPoint));
                worstFloat =
                    std::max(worstFloat, std::abs(ggx - exact.specular.x - exact.specular.y) / whole);
                if (turned) continue;
                worstDiffuse = std::max(worstDiffuse, std::abs(lit.diffuse / kPi - 1.0));
                worstGgx = std::max(worstGgx, std::abs(ggx / whole - 1.0));
            }
        }
        std::printf("light type %d, on its surface: diffuse within %.1e, GGX within %.1e of a whole sky's, "
                    "at most %.4f of it; float from double %.1e of it\n",
                    int(type), worstDiffuse, worstGgx, most, worstFloat);
        EXPECT_LT(worstDiffuse, 1e-3);
        EXPECT_LT(worstGgx, 0.015);
        EXPECT_LT(worstFloat, 0.02);
    }
}

// What no file should hold and some do: such a light is dark, and the others stay as they are.
TEST(HardCases, NumbersThatAreNoneGiveNoLight) {
    useLtcTable(loadLtcTable(KILOLUX_SOURCE_DIR "/content/ltc_ggx.bin").value());
    Random random;
    const double bad[] = {std::nan(""), std::numeric_limits<double>::infinity(),
                          -std::numeric_limits<double>::infinity(), -1.0};
    double LightDef::*const fields[] = {&LightDef::intensity,    &LightDef::radiusM,
                                        &LightDef::lengthM,      &LightDef::widthM,
                                        &LightDef::heightM,      &LightDef::innerConeRad,
                                        &LightDef::outerConeRad, &LightDef::angularDiameterRad};
    for (const LightType type : kTypes) {
        for (const double value : bad) {
            for (double LightDef::*const field : fields) {
                HardCase c = plainCase(random, type);
                c.def.*field = value;
                const GpuLights records = recordsOf(c.def, c.world);
                const BindLightTables bound(records.tables);
                const auto point = f32::makeShadingPoint(glm::vec3(c.receiver), glm::vec3(c.normal),
                                                         glm::vec3(c.view), float(c.roughness));
                const auto lit = f32::lightIrradiance(records.hot[0], point, f32::makeLtcLobe(point));
                const glm::vec3 light = lit.emission * (lit.diffuse + lit.specular.x + lit.specular.y);
                EXPECT_TRUE(sound(light.x) && sound(light.y) && sound(light.z))
                    << "type " << int(type) << ", value " << value;
                EXPECT_TRUE(sound(f32::lightWeight(records.hot[0], point, 0.5f, 0.04f)));
            }
        }
    }
}

} // namespace
} // namespace kilolux
