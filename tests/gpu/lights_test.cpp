// The light functions on the device against the same source compiled as C++ in float and in double: random
// lights of every type at ordinary and at hard receivers, and the functions with only the needed features on.
#include "tests/gpu/support/gpu_fixture.h"

#include "renderer/gpu_pictures.h"
#include "renderer/lights_cpp/light_tables.h"
#include "renderer/lights_cpp/lights_f32.h"
#include "renderer/lights_cpp/lights_f64.h"
#include "renderer/lights_cpp/ltc_table.h"
#include "renderer/source_picture.h"
#include "shaders/shared/features.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>

namespace kilolux::test {
namespace {

using glm::vec2;
using glm::vec3;

// As in shaders/lights.comp.
struct LightTestCase {
    vec3 positionWs;
    float roughness;
    vec3 normalWs;
    vec3 viewDirWs;
    vec2 uv;
    std::uint32_t slot;
};
constexpr std::size_t kOutputs = 42;
constexpr double kPi = 3.14159265358979323846;

struct Part {
    const char* name;
    std::size_t first, count;
};
constexpr Part kParts[] = {{"evaluate", 0, 3},
                           {"irradiance emission", 3, 3},
                           {"irradiance diffuse", 6, 1},
                           {"irradiance specular", 7, 2},
                           {"sample valid", 9, 1},
                           {"sample position", 10, 3},
                           {"sample direction", 13, 3},
                           {"sample distance", 16, 1},
                           {"sample normal", 17, 3},
                           {"sample uv", 20, 2},
                           {"sample pdf", 22, 2},
                           {"sample geometry", 24, 1},
                           {"weight", 25, 1},
                           {"bounds", 26, 8},
                           {"specular emission", 34, 3},
                           {"sample tint", 37, 3},
                           {"cold", 40, 1}};
constexpr const char* kTypes[] = {"directional", "sphere", "spot", "tube", "rect", "disk"};
constexpr int kFeatureOfType[] = {shared::FEATURE_DIRECTIONAL_LIGHTS, shared::FEATURE_SPHERE_LIGHTS,
                                  shared::FEATURE_SPOT_LIGHTS,        shared::FEATURE_TUBE_LIGHTS,
                                  shared::FEATURE_RECT_LIGHTS,        shared::FEATURE_DISK_LIGHTS};

class Numbers {
  public:
    double uniform(double low, double high) { return low + (high - low) * double(engine_()) / 4294967296.0; }
    double logUniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
    bool oneIn(int n) { return engine_() % std::uint32_t(n) == 0; }
    vec3 direction() { return vec3(f64::sphereFromSquare({uniform(0, 1), uniform(0, 1)})); }

  private:
    std::mt19937 engine_{11};
};

LightPicture smoothImage(int width, int height) {
    LightPicture image{width, height, {}};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x)
            image.texels.push_back(
                float(0.5 + 0.3 * std::sin(x * 2.0 * kPi / 24.0) * std::cos(y * 2.0 * kPi / 32.0)));
    }
    return image;
}

Image smoothColors(double phase) {
    Image image{.name = "colours", .width = 64, .height = 48};
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            for (const double turn : {0.0, 2.1, 4.2, 0.0})
                image.rgbaF32.push_back(
                    float(0.55 + 0.4 * std::sin(0.1 * x + turn + phase) * std::cos(0.13 * y)));
        }
    }
    return image;
}

// Every other light has one of these.
LightTables someShapings() {
    Numbers random;
    LightTables tables;
    for (int i = 0; i < 50; ++i) {
        shared::LightShaping shaping{};
        for (int flap = 0; flap < 4; ++flap) {
            const double angle = random.uniform(0.0, 1.5),
                         length = random.oneIn(4) ? 0.0 : random.logUniform(0.1, 3.0);
            shaping.doorReachM[flap] = float(length * std::sin(angle));
            shaping.doorDepthM[flap] = float(length * std::cos(angle));
        }
        // By turns doors alone, with a profile, with a light function.
        if (i % 3 == 1) {
            shaping.profile = std::uint32_t(1 + i % 2);
            shaping.profileIsShape = std::uint32_t(i / 2 % 2);
            shaping.profileCosine = float(random.uniform(-1.0, 1.0));
            shaping.profileSide = random.oneIn(2) ? 1.0f : -1.0f;
            shaping.profileSr = float(random.uniform(0.1, 12.0));
        } else if (i % 3 == 2) {
            shaping.functionKind = std::uint32_t(1 + i / 3 % 5);
            shaping.functionPhase = float(random.uniform(0.0, 1.0));
            shaping.functionMap = {float(random.uniform(-3, 3)), float(random.uniform(-3, 3)),
                                   float(random.uniform(0.3, 1.0)), float(random.uniform(0.0, 0.9))};
        }
        if (i % 5 < 2) {
            shaping.picture = std::uint32_t(1 + i % 5);
            shaping.pictureMean = vec3(0.5f);
        }
        tables.shapings.push_back(shaping);
    }
    for (int i = 0; i < 2; ++i)
        tables.profiles.push_back(std::make_shared<const LightPicture>(smoothImage(145, 361)));
    tables.functionImages.push_back(std::make_shared<const LightPicture>(smoothImage(256, 256)));
    tables.pictures.push_back(std::make_shared<const SourcePicture>(makeSourcePicture(smoothColors(0.0))));
    tables.pictures.push_back(std::make_shared<const SourcePicture>(makeSourcePicture(smoothColors(1.5))));
    return tables;
}

shared::LightHot randomLight(Numbers& random, std::uint32_t type) {
    shared::LightHot light{};
    light.positionWs = vec3(random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-5, 5));
    light.invRange = random.oneIn(3) ? 0.0f : float(1.0 / random.logUniform(2.0, 200.0));
    light.dirWs = random.direction();
    light.tangentOct = f32::packOct16(f32::basisFromNormal(light.dirWs)[0]);
    light.intensity = vec3(random.logUniform(1, 1e4), random.logUniform(1, 1e4), random.logUniform(1, 1e4));
    light.typeFlags = type | (random.oneIn(20) ? shared::LIGHT_FLAG_MUTED : 0u);
    const double size = random.logUniform(0.01, 2.0);
    light.sizeM = vec2(
        size, type == shared::LIGHT_TUBE || type == shared::LIGHT_RECT ? random.logUniform(0.05, 3.0) : 0.0);
    if (type == shared::LIGHT_DIRECTIONAL) {
        light.positionWs = vec3(0.0f);
        light.invRange = 0.0f;
        light.sizeM.x = float(random.logUniform(1e-3, 0.3));
    }
    const bool noExtent =
        type == shared::LIGHT_DIRECTIONAL || type == shared::LIGHT_SPHERE || type == shared::LIGHT_SPOT;
    if (noExtent && random.oneIn(4)) light.sizeM.x = 0.0f;
    if (type == shared::LIGHT_SPOT) {
        const double outer = std::cos(random.uniform(0.3, 1.5));
        const double scale = 1.0 / std::max(0.001, random.uniform(0.0, 1.0 - outer));
        light.shaping = vec2(scale, -outer * scale);
    }
    return light;
}

// One in three is hard: on the light, far away, behind it, in its plane, seen at a grazing angle, or smooth.
LightTestCase randomCase(Numbers& random, const shared::LightHot& light, std::uint32_t slot) {
    LightTestCase c{};
    c.slot = slot;
    c.positionWs = light.positionWs + random.direction() * float(random.logUniform(0.2, 20.0));
    c.normalWs = random.direction();
    do
        c.viewDirWs = random.direction();
    while (glm::dot(c.viewDirWs, c.normalWs) <= 0.02f);
    c.roughness = float(random.uniform(0.0, 1.0));
    c.uv = vec2(random.uniform(0, 1), random.uniform(0, 1));
    if (!random.oneIn(3)) return c;
    const vec3 aside = f32::basisFromNormal(light.dirWs)[1];
    switch (int(random.uniform(0, 6))) {
    case 0:
        c.positionWs =
            light.positionWs + random.direction() * (light.sizeM.x * float(random.uniform(0.5, 1.1)));
        break;
    case 1:
        c.positionWs = light.positionWs + random.direction() * float(random.logUniform(100, 1e5));
        break;
    case 2:
        c.positionWs = light.positionWs - light.dirWs * float(random.logUniform(1e-4, 1.0));
        break;
    case 3:
        c.positionWs = light.positionWs + aside * float(random.uniform(0.0, 3.0));
        break;
    case 4:
        c.viewDirWs = glm::normalize(f32::basisFromNormal(c.normalWs)[0] + c.normalWs * 1e-4f);
        break;
    default:
        c.roughness = 0.0f;
        break;
    }
    return c;
}

// The rows of the shader's output, in float or double, with the lights of the namespace.
#define KX_ROW(ns, Real, light, c)                                                                           \
    [&] {                                                                                                    \
        const auto point = ns::makeShadingPoint(ns::vec3((c).positionWs), ns::vec3((c).normalWs),            \
                                                ns::vec3((c).viewDirWs), Real((c).roughness));               \
        std::vector<double> row;                                                                             \
        const auto put = [&](const auto&... values) { (row.push_back(double(values)), ...); };               \
        const auto put3 = [&](const ns::vec3& v) { put(v.x, v.y, v.z); };                                    \
        put3(ns::lightEvaluate(light, point.positionWs));                                                    \
        const auto irradiance = ns::lightIrradiance(light, point, ns::makeLtcLobe(point));                   \
        put3(irradiance.emission);                                                                           \
        put(irradiance.diffuse, irradiance.specular.x, irradiance.specular.y);                               \
        const auto s = ns::lightSample(light, point.positionWs, ns::vec2((c).uv));                           \
        put(s.valid ? 1.0 : 0.0);                                                                            \
        put3(s.positionWs);                                                                                  \
        put3(s.dirWs);                                                                                       \
        put(s.distanceM);                                                                                    \
        put3(s.emitterNormalWs);                                                                             \
        put(s.uv.x, s.uv.y, s.pdfArea, s.pdfSolidAngle, s.geometry);                                         \
        put(ns::lightWeight(light, point, Real(0.4), Real(0.06)));                                           \
        const auto bounds = ns::lightBounds(light);                                                          \
        put3(bounds.centerWs);                                                                               \
        put(bounds.radiusM);                                                                                 \
        put3(bounds.axisWs);                                                                                 \
        put(bounds.cosHalfAngle);                                                                            \
        put3(irradiance.specularEmission);                                                                   \
        put3(s.tint);                                                                                        \
        put(0.25 * double((c).slot));                                                                        \
        return row;                                                                                          \
    }()

class Lights : public GpuTest {
  protected:
    static void SetUpTestSuite() {
        useLtcTable(loadLtcTable(KILOLUX_SOURCE_DIR "/content/ltc_ggx.bin").value());
    }

    std::vector<float> run(const std::vector<shared::LightHot>& lights,
                           const std::vector<LightTestCase>& cases, const gpu::SpecValues& features) {
        std::vector<shared::LightHot> slots = lights;
        slots.resize(std::max<std::size_t>(slots.size(), shared::LIGHT_UNIFORM_SLOTS));
        std::vector<shared::LightCold> cold(slots.size());
        for (std::size_t i = 0; i < cold.size(); ++i)
            cold[i].rayEndBiasM = 0.25f * float(i);
        gpu::Buffer hot(device(),
                        {"hot", slots.size() * sizeof(shared::LightHot),
                         VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
                         gpu::MemoryUse::DeviceOnly, "test", VK_FORMAT_R32G32B32A32_UINT});
        gpu::Buffer coldBuffer(device(), {"cold", cold.size() * sizeof(shared::LightCold)});
        gpu::Buffer input(device(), {"cases", cases.size() * sizeof(LightTestCase)});
        gpu::Buffer output(device(), {"outputs", cases.size() * kOutputs * 4});
        const std::vector<shared::LightShaping>& shapingRecords = boundLightTables().shapings;
        gpu::Buffer shapings(device(), {"shapings", shapingRecords.size() * sizeof(shared::LightShaping)});
        shapings.upload(shapingRecords);
        hot.upload(slots);
        coldBuffer.upload(cold);
        input.upload(cases);
        const gpu::Image profiles = layersOf("iesProfiles", boundLightTables().profiles);
        const gpu::Image functions = layersOf("functionImages", boundLightTables().functionImages);
        GpuPictures pictures;
        pictures.update(device(), boundLightTables().pictures);
        const gpu::Image parameters = tableImage("ltcParameters", boundLtcTable().parameters);
        const gpu::Image scales = tableImage("ltcScales", boundLtcTable().scales);
        gpu::Commands commands(device());
        gpu::Bindings bindings{{"LightsHot", hot},
                               {"lightsHotTexels", hot},
                               {"LightsCold", coldBuffer},
                               {"LightShapings", shapings},
                               {"iesProfiles", profiles, gpu::SamplerKind::LinearClamp},
                               {"functionImages", functions, gpu::SamplerKind::LinearRepeat},
                               {"ltcParameters", parameters, gpu::SamplerKind::LinearClamp},
                               {"ltcScales", scales, gpu::SamplerKind::LinearClamp},
                               {"Cases", input},
                               {"Outputs", output}};
        for (const gpu::Binding& binding : pictures.bindings())
            bindings.push_back(binding);
        pass_.record(commands, features, bindings, std::uint32_t(cases.size()),
                     {std::uint32_t(cases.size() + 63) / 64});
        commands.submitAndWait();
        return output.downloadAs<float>();
    }

  private:
    gpu::Image layersOf(const char* name, const std::vector<std::shared_ptr<const LightPicture>>& layers) {
        gpu::Image image(device(), {.name = name,
                                    .format = VK_FORMAT_R32_SFLOAT,
                                    .width = std::uint32_t(layers[0]->width),
                                    .height = std::uint32_t(layers[0]->height),
                                    .layers = std::uint32_t(layers.size()),
                                    .arrayed = true,
                                    .usage = VK_IMAGE_USAGE_SAMPLED_BIT});
        for (std::uint32_t layer = 0; layer < layers.size(); ++layer)
            image.upload(std::as_bytes(std::span(layers[layer]->texels)), 0, layer);
        return image;
    }

    gpu::Image tableImage(const char* name, const std::vector<glm::vec4>& texels) {
        gpu::Image image(device(), {.name = name,
                                    .format = VK_FORMAT_R32G32B32A32_SFLOAT,
                                    .width = std::uint32_t(boundLtcTable().width),
                                    .height = std::uint32_t(boundLtcTable().height),
                                    .usage = VK_IMAGE_USAGE_SAMPLED_BIT});
        image.upload(std::as_bytes(std::span(texels)));
        return image;
    }

    const LightTables tables_ = someShapings();
    const BindLightTables bound_{tables_};
    gpu::ComputePass pass_{resources(),
                           "lights",
                           {{"LightsHot"},
                            {"lightsHotTexels"},
                            {"LightsCold"},
                            {"LightShapings"},
                            {"iesProfiles"},
                            {"functionImages"},
                            {"domeRadiances", gpu::Access::Read, gpu::Presence::Optional},
                            {"domeIrradiances", gpu::Access::Read, gpu::Presence::Optional},
                            {"domeDistribution", gpu::Access::Read, gpu::Presence::Optional},
                            {"lightPictures"},
                            {"LightWarps"},
                            {"ltcParameters"},
                            {"ltcScales"},
                            {"Cases"},
                            {"Outputs", gpu::Access::Write}},
                           "../tests/gpu/shaders/lights.comp"};
};

struct TypeCases {
    std::vector<shared::LightHot> lights;
    std::vector<LightTestCase> cases;
};

TypeCases casesOf(std::uint32_t type, std::size_t count) {
    Numbers random;
    TypeCases result;
    for (std::size_t i = 0; i < 200; ++i)
        result.lights.push_back(randomLight(random, type));
    for (std::uint32_t i = 0; i < result.lights.size(); i += 2)
        result.lights[i].typeFlags |= (i / 2 % 50 + 1) << shared::LIGHT_SHAPING_SHIFT;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t slot = std::uint32_t(i % result.lights.size());
        result.cases.push_back(randomCase(random, result.lights[slot], slot));
    }
    return result;
}

// What a difference counts against where the value itself is next to nothing: a thousandth of the light's
// solid angle for diffuse light, a hundredth of what the lobe's peak gives for specular light.
double floorOf(const Part& part, const shared::LightHot& light, const LightTestCase& c) {
    const std::string name = part.name;
    if (name != "irradiance diffuse" && name != "irradiance specular" && name != "weight") return 1e-12;
    const f64::ShadingPoint point = f64::makeShadingPoint(f64::vec3(c.positionWs), f64::vec3(c.normalWs),
                                                          f64::vec3(c.viewDirWs), double(c.roughness));
    const f64::LightHot exact = f64::fromF32(light);
    const double solidAngle =
        std::min(f64::lightOutline(exact, point.positionWs, point.alpha).solidAngle, kPi);
    if (name == "irradiance diffuse") return std::max(1e-3 * solidAngle, 1e-12);
    const f64::vec3 mirror =
        point.normalWs * (2.0 * glm::dot(point.normalWs, point.viewDirWs)) - point.viewDirWs;
    const double peak =
        f64::ggxTimesCosine(point.normalWs, point.viewDirWs, point.noV, mirror, point.alpha).x;
    if (name == "weight")
        return std::max(1e-3 * solidAngle * f64::luminance(f64::vec3(light.intensity)), 1e-12);
    return std::max(0.01 * std::min(solidAngle * peak, 1.0), 1e-12);
}

// In the plane of a one-sided light, which side a receiver is on is a matter of rounding.
bool isEdgeOn(const std::vector<double>& row) {
    const double cosine = row[13] * row[17] + row[14] * row[18] + row[15] * row[19];
    return std::abs(cosine) < 1e-5;
}

// Source and inputs are the same, so a difference is rounding: the device's sine, arc tangent, root and
// division err by a few units of 2^-24, contraction saves others. Ten to a hundred such steps give 3e-5;
// where the input magnifies rounding, C++ in float is off from double by as much, and the device may be off
// by some of that.
constexpr double kTolerance = 3e-5;
constexpr double kOwnErrors = 8.0;

class LightsByType : public Lights, public testing::WithParamInterface<std::uint32_t> {};

TEST_P(LightsByType, DeviceAgreesWithCpp) {
    const TypeCases made = casesOf(GetParam(), 6000);
    const std::vector<float> device = run(made.lights, made.cases, {});
    std::vector<std::vector<double>> f32Rows, f64Rows;
    for (const LightTestCase& c : made.cases) {
        const shared::LightHot& light = made.lights[c.slot];
        f32Rows.push_back(KX_ROW(f32, float, light, c));
        f64Rows.push_back(KX_ROW(f64, double, f64::fromF32(light), c));
        ASSERT_EQ(f32Rows.back().size(), kOutputs - 1);
    }
    for (const Part& part : kParts) {
        int values = 0, far = 0;
        double worst = 0.0;
        for (std::size_t i = 0; i < made.cases.size(); ++i) {
            if (isEdgeOn(f64Rows[i])) continue;
            const double least = floorOf(part, made.lights[made.cases[i].slot], made.cases[i]);
            for (std::size_t k = part.first; k < part.first + part.count; ++k) {
                const double gpu = double(device[i * kOutputs + k]), cpp = f32Rows[i][k],
                             exact = f64Rows[i][k];
                ASSERT_TRUE(std::isfinite(gpu)) << part.name << ", case " << i;
                const double scale = std::max({std::abs(exact), std::abs(cpp), least});
                const double difference = std::abs(gpu - cpp) / scale, own = std::abs(cpp - exact) / scale;
                ++values;
                far += difference > kTolerance + kOwnErrors * own;
                worst = std::max(worst, difference - kOwnErrors * own);
            }
        }
        std::cout << kTypes[GetParam()] << " " << part.name << ": " << far << " of " << values
                  << " far, worst " << worst << "\n";
        EXPECT_LE(far, values / 500) << part.name;
        // Under a lobe's far tail the sectors of a light nearly cancel: one value in ten thousand is rounding
        // of up to 2 % of the lobe's peak, which is 2 in the measure used here.
        EXPECT_LT(worst, std::string(part.name) == "irradiance specular" ? 2.0 : 0.005) << part.name;
    }
}

// A pipeline that knows that the other types are absent, and reads hot records from the uniform block.
TEST_P(LightsByType, NeededFeaturesAreEnough) {
    const TypeCases made = casesOf(GetParam(), 1500);
    const std::vector<float> all = run(made.lights, made.cases, {});
    gpu::SpecValues needed{{shared::CHOICE_LIGHTS_IN_UNIFORM, 1}};
    for (std::size_t type = 0; type < std::size(kFeatureOfType); ++type) {
        needed[std::uint32_t(kFeatureOfType[type])] = type == GetParam();
    }
    needed[shared::FEATURE_BARN_DOORS] = GetParam() == shared::LIGHT_RECT;
    needed[shared::FEATURE_TEXTURED_LIGHTS] = GetParam() == shared::LIGHT_RECT;
    const std::vector<float> exact = run(made.lights, made.cases, needed);
    int different = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (i % kOutputs == kOutputs - 1) continue; // not written
        different += all[i] != exact[i];
    }
    EXPECT_EQ(different, 0);
}

// Without its feature a type is dark: the constants reach the shader.
TEST_P(LightsByType, AbsentFeaturesAreDark) {
    const TypeCases made = casesOf(GetParam(), 100);
    const std::vector<float> device =
        run(made.lights, made.cases, {{std::uint32_t(kFeatureOfType[GetParam()]), 0}});
    for (std::size_t i = 0; i < made.cases.size(); ++i)
        EXPECT_EQ(device[i * kOutputs + 9], 0.0f) << "sample valid";
}

INSTANTIATE_TEST_SUITE_P(Types, LightsByType, testing::Range(0u, 6u),
                         [](const auto& tested) { return kTypes[tested.param]; });

} // namespace
} // namespace kilolux::test
