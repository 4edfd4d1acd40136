// The whole chain from a light as typed to light at a surface, twice: the renderer's (units, light record,
// analytic irradiance, the shaders' source in double) and the oracle's. Shares only the document and the
// colour of a temperature.
#include "renderer/document/ies_profile.h"
#include "renderer/gpu_lights.h"
#include "renderer/lights_cpp/lights_f64.h"
#include "renderer/lights_cpp/ltc_table.h"
#include "renderer/reference/oracle_estimate.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <random>

namespace kilolux {
namespace {

using glm::dvec3;

class Random {
  public:
    double between(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine_);
    }
    dvec3 direction() {
        std::normal_distribution<double> normal;
        return glm::normalize(dvec3(normal(engine_), normal(engine_), normal(engine_)));
    }

  private:
    std::mt19937 engine_{7};
};

enum class Shaped { No, BarnDoors, ProfileShape, ProfileMask, Image, Grid, Blinds, Caustics, Flicker };

struct Kind {
    LightType type;
    Shaped shaped = Shaped::No;
};

// Type C over a quarter of the turn, with light above and below; its angles are those of the renderer's
// pictures.
std::shared_ptr<const IesProfile> someProfile() {
    auto profile = std::make_shared<IesProfile>();
    for (int i = 0; i <= 24; ++i)
        profile->verticalDeg.push_back(5.0 * i);
    profile->horizontalDeg = {0.0, 22.5, 45.0, 67.5, 90.0};
    for (const double turn : profile->horizontalDeg) {
        for (const double at : profile->verticalDeg)
            profile->candela.push_back(at == 120.0 ? 0.0
                                                   : 300.0 + 200.0 * std::cos(at / 20.0) +
                                                         100.0 * std::sin(turn / 15.0 + at / 40.0));
    }
    return profile;
}

// As fine as the renderer keeps pictures, so that none is resampled.
std::shared_ptr<const Image> somePicture() {
    auto image = std::make_shared<Image>();
    image->width = image->height = 256;
    for (int y = 0; y < 256; ++y) {
        for (int x = 0; x < 256; ++x) {
            const auto level = float(0.5 + 0.25 * std::sin(x * glm::two_pi<double>() / 64.0) +
                                     0.2 * std::cos(y * glm::two_pi<double>() / 128.0));
            for (int c = 0; c < 3; ++c)
                image->rgbaF32.push_back(level);
            image->rgbaF32.push_back(1.0f);
        }
    }
    return image;
}

void addProfileOrFunction(LightDef& def, Random& random, Shaped shaped) {
    static const std::shared_ptr<const IesProfile> profile = someProfile();
    static const std::shared_ptr<const Image> picture = somePicture();
    if (shaped == Shaped::ProfileShape || shaped == Shaped::ProfileMask) {
        def.ies = profile;
        def.iesUse = shaped == Shaped::ProfileShape ? IesUse::Shape : IesUse::Mask;
        def.iesIntensity = random.between(0.0, 1.0) < 0.5;
        def.iesMultiplier = random.between(0.1, 3.0);
        return;
    }
    def.function = {.kind = shaped == Shaped::Image     ? LightFunctionKind::Image
                            : shaped == Shaped::Grid    ? LightFunctionKind::Grid
                            : shaped == Shaped::Blinds  ? LightFunctionKind::Blinds
                            : shaped == Shaped::Flicker ? LightFunctionKind::Flicker
                                                        : LightFunctionKind::Caustics,
                    .imageUri = {},
                    .image = picture,
                    .scale = random.between(0.1, 2.0),
                    .angleRad = random.between(-3.0, 3.0),
                    .softness = random.between(0.1, 1.0),
                    .strength = random.between(0.0, 1.0),
                    .seed = random.between(0.0, 2.0),
                    .speed = random.between(0.2, 2.0)};
}

LightDef randomDef(Random& random, const Kind& kind) {
    const LightType type = kind.type;
    LightDef def;
    def.type = type;
    const bool directional = type == LightType::Directional;
    const LightUnit local[] = {LightUnit::Lumen, LightUnit::Candela, LightUnit::Lux, LightUnit::Nit,
                               LightUnit::Ev100};
    def.unit = directional ? LightUnit::Lux : local[static_cast<int>(random.between(0.0, 4.999))];
    def.intensity = def.unit == LightUnit::Ev100 ? random.between(5.0, 12.0) : random.between(10.0, 5000.0);
    def.color = {random.between(0.2, 1.0), random.between(0.2, 1.0), random.between(0.2, 1.0)};
    if (random.between(0.0, 1.0) < 0.5) def.temperatureK = random.between(1500.0, 15000.0);
    if (random.between(0.0, 1.0) < 0.5) def.rangeM = random.between(4.0, 20.0);
    def.radiusM = random.between(0.02, 0.4);
    def.lengthM = random.between(0.1, 2.0);
    def.widthM = random.between(0.1, 2.0);
    def.heightM = random.between(0.1, 2.0);
    def.outerConeRad = random.between(0.3, 1.5);
    def.innerConeRad = def.outerConeRad * random.between(0.0, 0.9);
    def.angularDiameterRad = random.between(0.0, 0.3);
    if (kind.shaped == Shaped::BarnDoors) {
        for (BarnDoor& door : def.barnDoors)
            door = {random.between(0.0, 1.5), random.between(0.0, 1.5)};
    } else if (kind.shaped != Shaped::No) {
        addProfileOrFunction(def, random, kind.shaped);
    }
    return def;
}

struct Difference {
    double diffuse = 0.0;  // relative; 0 where both give nothing
    double specular = 0.0; // relative to the larger of value and 1 % of the diffuse albedo's share
    bool lit = false;
};

Difference compare(Random& random, const Kind& kind) {
    const LightType type = kind.type;
    Scene scene;
    scene.lightDefs = {randomDef(random, kind)};
    Node node;
    const dvec3 position = random.direction() * random.between(0.0, 3.0);
    node.worldFromNode =
        glm::rotate(glm::translate(glm::dmat4(1.0), position), random.between(0.0, 6.0), random.direction());
    scene.nodes = {node};
    scene.lights = {{0, 0, false}};
    if (!scene.lightDefs[0].rangeM) scene.lightDefs[0].rangeM = 1e6; // else the renderer derives one
    const double timeS = random.between(0.0, 20.0);
    const GpuLights records = makeGpuLights(scene, dvec3(0.0), 0.0, timeS);
    const BindLightTables bound(records.tables);

    oracle::OraclePoint point;
    point.positionWs = position + random.direction() * random.between(0.6, 4.0);
    // Half the surfaces look towards the light, so that whole lights stand above the horizon.
    const dvec3 toLight = type == LightType::Directional ? -dvec3(glm::normalize(-node.worldFromNode[2]))
                                                         : glm::normalize(position - point.positionWs);
    point.shadingNormalWs = glm::normalize(toLight + random.direction() * random.between(0.0, 1.0));
    point.viewDirWs = glm::normalize(point.shadingNormalWs + random.direction() * 0.9);
    point.geometricNormalWs = point.shadingNormalWs;
    point.material = {dvec3(1.0), 0.0, random.between(0.1, 1.0)};

    oracle::OracleLight light = oracle::makeLight(scene.lightDefs[0], node.worldFromNode);
    light.timeS = timeS;
    const auto truth = oracle::estimateLight(light, point, {}, oracle::Estimator::Split, 8, 1);
    const f64::LightHot hot = f64::fromF32(records.hot[0]);
    const auto at = f64::makeShadingPoint(point.positionWs, point.shadingNormalWs, point.viewDirWs,
                                          point.material.roughness);
    const auto analytic = f64::lightIrradiance(hot, at, f64::makeLtcLobe(at));
    const dvec3 irradianceLux = analytic.emission * analytic.diffuse;
    const dvec3 specularNit = analytic.emission * (0.04 * analytic.specular.x + analytic.specular.y);

    Difference difference;
    difference.lit = truth.unshadowedIrradianceLux.g > 1e-6 * scene.lightDefs[0].intensity;
    if (!difference.lit) return difference;
    for (int c = 0; c < 3; ++c)
        difference.diffuse =
            std::max(difference.diffuse, std::abs(irradianceLux[c] / truth.unshadowedIrradianceLux[c] - 1.0));
    const double floorNit = 0.01 * truth.unshadowedDiffuseNit.g;
    difference.specular = std::abs(specularNit.g - truth.unshadowedSpecularNit.g) /
                          std::max(truth.unshadowedSpecularNit.g, floorNit);
    return difference;
}

class Agreement : public testing::TestWithParam<Kind> {};

TEST_P(Agreement, RendererAndOracleGiveTheSameLight) {
    Result<LtcTable> table = loadLtcTable(KILOLUX_SOURCE_DIR "/content/ltc_ggx.bin");
    ASSERT_TRUE(table) << table.error();
    useLtcTable(std::move(table.value()));
    Random random;
    std::vector<double> diffuse, specular;
    while (diffuse.size() < 600) {
        const Difference difference = compare(random, GetParam());
        if (!difference.lit) continue;
        diffuse.push_back(difference.diffuse);
        specular.push_back(difference.specular);
    }
    std::sort(diffuse.begin(), diffuse.end());
    std::sort(specular.begin(), specular.end());
    RecordProperty("diffuseWorst", std::to_string(diffuse.back()));
    RecordProperty("specularWorst", std::to_string(specular.back()));
    EXPECT_LT(diffuse[300], 3e-4);
    EXPECT_LT(diffuse[570], 5e-3);
    EXPECT_LT(specular[300], 0.01);
    EXPECT_LT(specular[570], 0.05);
}

INSTANTIATE_TEST_SUITE_P(
    Types, Agreement,
    testing::Values(Kind{LightType::Directional}, Kind{LightType::Sphere}, Kind{LightType::Spot},
                    Kind{LightType::Tube}, Kind{LightType::Rect}, Kind{LightType::Disk},
                    Kind{LightType::Rect, Shaped::BarnDoors}, Kind{LightType::Sphere, Shaped::ProfileShape},
                    Kind{LightType::Spot, Shaped::ProfileShape}, Kind{LightType::Spot, Shaped::ProfileMask},
                    Kind{LightType::Rect, Shaped::ProfileShape}, Kind{LightType::Disk, Shaped::ProfileMask},
                    Kind{LightType::Tube, Shaped::ProfileShape}, Kind{LightType::Tube, Shaped::ProfileMask},
                    Kind{LightType::Spot, Shaped::Image}, Kind{LightType::Rect, Shaped::Grid},
                    Kind{LightType::Directional, Shaped::Blinds}, Kind{LightType::Sphere, Shaped::Caustics},
                    Kind{LightType::Tube, Shaped::Flicker}));

} // namespace
} // namespace kilolux
