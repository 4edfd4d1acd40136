// Photometric profiles on the way from the document to the renderer: how far its pictures of them are off,
// the cones that bound them, and the flux of every kind of light with and without shaping, counted on a
// sphere about it.
#include "renderer/document/ies_profile.h"
#include "renderer/document/light_units.h"
#include "renderer/gpu_lights.h"
#include "renderer/light_shaping.h"
#include "renderer/lights_cpp/lights_f64.h"
#include "renderer/lights_cpp/ltc_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <gtest/gtest.h>
#include <random>

namespace kilolux {
namespace {

using glm::dvec3;

// Evenly spread over the sphere (Fibonacci).
dvec3 spreadDirection(int i, int count) {
    const double z = 1.0 - 2.0 * (i + 0.5) / count, phi = i * 2.39996322972865332;
    const double r = std::sqrt(1.0 - z * z);
    return {r * std::cos(phi), r * std::sin(phi), z};
}

dvec3 unitOf(const glm::dvec2& uv) {
    return f64::sphereFromSquare(uv);
}

// The renderer's own value of a profile in a direction of the light's frame.
double pictureAt(const LightProfile& profile, const dvec3& dir) {
    LightTables tables;
    tables.shapings.resize(1);
    tables.shapings[0].profile = 1;
    tables.profiles = {profile.image};
    const BindLightTables bound(tables);
    f64::LightHot light{};
    light.dirWs = {0, 0, -1};
    light.tangentOct = f64::packOct16({1, 0, 0});
    light.typeFlags = shared::LIGHT_SPHERE | 1u << shared::LIGHT_SHAPING_SHIFT;
    return f64::lightFilter(light, dir);
}

std::vector<std::pair<std::string, IesProfile>> knownProfiles() {
    std::vector<std::pair<std::string, IesProfile>> profiles;
    for (const char* folder : {KILOLUX_SOURCE_DIR "/../shared/content/ies",
                               KILOLUX_SOURCE_DIR "/tests/content/ies", KILOLUX_SOURCE_DIR "/content/ies"}) {
        if (!std::filesystem::is_directory(folder)) continue;
        for (const auto& entry : std::filesystem::directory_iterator(folder)) {
            if (entry.path().extension() != ".ies") continue;
            if (Result<IesProfile> read = readIes(entry.path()))
                profiles.emplace_back(entry.path().filename().string(), read.value());
        }
    }
    std::sort(profiles.begin(), profiles.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    // Narrow, with angles that are on no row, and one of type B and of A.
    IesProfile narrow;
    narrow.horizontalDeg = {0.0};
    for (int i = 0; i <= 40; ++i) {
        narrow.verticalDeg.push_back(0.77 * i);
        narrow.candela.push_back(5000.0 * std::exp(-0.02 * i * i));
    }
    profiles.emplace_back("(narrow)", narrow);
    for (const IesPhotometry type : {IesPhotometry::B, IesPhotometry::A}) {
        IesProfile flood;
        flood.photometry = type;
        for (int i = -9; i <= 9; ++i) {
            flood.verticalDeg.push_back(10.0 * i);
            flood.horizontalDeg.push_back(10.0 * i);
        }
        for (const double h : flood.horizontalDeg) {
            for (const double v : flood.verticalDeg)
                flood.candela.push_back(1000.0 *
                                        std::pow(std::cos(glm::radians(h)) * std::cos(glm::radians(v)), 2.0));
        }
        profiles.emplace_back(type == IesPhotometry::A ? "(type A)" : "(type B)", flood);
    }
    return profiles;
}

TEST(LightProfile, PicturesKeepIntensityFluxAndExtent) {
    std::mt19937 engine(3);
    std::uniform_real_distribution<double> number(0.0, 1.0);
    for (const auto& [name, profile] : knownProfiles()) {
        if (!(profile.maxCandela() > 0.0)) continue;
        const LightProfile made = makeLightProfile(profile);
        std::vector<double> errors;
        for (int i = 0; i < 20000; ++i) {
            const dvec3 dir = unitOf({number(engine), number(engine)});
            const double truth = profile.candelaAt(dir) / profile.maxCandela(), found = pictureAt(made, dir);
            errors.push_back(std::abs(found - truth));
            ASSERT_TRUE(std::isfinite(found) && found >= 0.0 && found <= 1.0 + 1e-6) << name;
            if (found > 0.0) {
                ASSERT_GE(dir.z * -made.side, std::cos(made.halfAngleRad) - 1e-9) << name;
            }
        }
        std::sort(errors.begin(), errors.end());
        double sr = 0.0;
        for (const double row : made.rowSr)
            sr += row;
        const double fluxError = sr * profile.maxCandela() / profile.fluxLm() - 1.0;
        std::printf("%-28s of the maximum: mean %.1e  p99 %.1e  worst %.1e; flux %+.3f %%, within %.0f "
                    "degrees of %s\n",
                    name.c_str(), std::accumulate(errors.begin(), errors.end(), 0.0) / double(errors.size()),
                    errors[errors.size() * 99 / 100], errors.back(), 100.0 * fluxError,
                    glm::degrees(made.halfAngleRad), made.side > 0.0 ? "-Z" : "+Z");
        EXPECT_LT(errors[errors.size() / 2], 2e-3) << name;
        EXPECT_LT(errors[errors.size() * 99 / 100], 0.02) << name;
        EXPECT_LT(std::abs(fluxError), 5e-3) << name;
    }
}

std::shared_ptr<const IesProfile> lobes() {
    auto profile = std::make_shared<IesProfile>();
    for (int i = 0; i <= 36; ++i)
        profile->verticalDeg.push_back(5.0 * i);
    profile->horizontalDeg = {0.0, 45.0, 90.0, 135.0, 180.0};
    for (const double turn : profile->horizontalDeg) {
        for (const double at : profile->verticalDeg)
            profile->candela.push_back(200.0 + 150.0 * std::cos(glm::radians(2.0 * at)) *
                                                   std::cos(glm::radians(turn)));
    }
    return profile;
}

// Lumens that arrive on a far sphere.
double countedLm(const f64::LightHot& light) {
    constexpr int kReceivers = 20000;
    constexpr double kRadiusM = 300.0;
    double sum = 0.0;
    for (int i = 0; i < kReceivers; ++i) {
        const dvec3 out = spreadDirection(i, kReceivers);
        const f64::ShadingPoint point =
            f64::makeShadingPoint(light.positionWs + out * kRadiusM, -out, -out, 1.0);
        const f64::LightIrradiance lit = f64::lightIrradiance(light, point, f64::makeLtcLobe(point));
        sum += f64::luminance(lit.emission) * lit.diffuse;
    }
    return sum / kReceivers * 4.0 * glm::pi<double>() * kRadiusM * kRadiusM;
}

TEST(Flux, CountedLumensAreTheStatedOnes) {
    useLtcTable(loadLtcTable(KILOLUX_SOURCE_DIR "/content/ltc_ggx.bin").value());
    const std::shared_ptr<const IesProfile> profile = lobes();
    for (const LightType type :
         {LightType::Sphere, LightType::Spot, LightType::Tube, LightType::Rect, LightType::Disk}) {
        for (const IesUse use : {IesUse::None, IesUse::Shape, IesUse::Mask}) {
            Scene scene;
            LightDef def;
            def.type = type;
            def.unit = LightUnit::Lumen;
            def.intensity = 800.0;
            def.rangeM = 1e9;
            def.radiusM = 0.1;
            def.lengthM = 0.6;
            def.innerConeRad = 0.4;
            def.outerConeRad = 0.9;
            def.ies = profile;
            def.iesUse = use;
            def.iesIntensity = false;
            scene.lightDefs = {def};
            scene.nodes = {Node{}};
            scene.lights = {{.id = 1, .node = 0, .def = 0}};
            const GpuLights records = makeGpuLights(scene, dvec3(0.0), 0.0);
            const BindLightTables bound(records.tables);
            const f64::LightHot light = f64::fromF32(records.hot[0]);
            const double counted = countedLm(light);
            std::printf("type %d, profile use %d: counted %.1f lm, stated %.1f lm\n", int(type), int(use),
                        counted, f64::lightFlux(light));
            EXPECT_NEAR(counted, f64::lightFlux(light), 5e-3 * counted);
            const bool flat = type == LightType::Rect || type == LightType::Disk;
            // A flat light has no back for the profile's light behind it.
            if (use == IesUse::None || (use == IesUse::Shape && !flat)) {
                EXPECT_NEAR(counted, 800.0, 4.0);
            }
            EXPECT_LE(counted, 800.0 * 1.005) << "masks take light away";
        }
    }
}

} // namespace
} // namespace kilolux
