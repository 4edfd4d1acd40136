// The light functions on the device against the same source compiled as C++ in float and in double: random
// lights of every type at ordinary and at hard receivers, and the functions with only the needed features on.
#include "tests/gpu/light_cases.h"
#include "tests/gpu/support/gpu_fixture.h"

#include "renderer/gpu_pictures.h"
#include "renderer/lights_cpp/lights_f32.h"
#include "renderer/lights_cpp/lights_f64.h"
#include "renderer/lights_cpp/ltc_table.h"
#include "shaders/shared/features.h"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace kilolux::test {
namespace {

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
constexpr unsigned featureOf(unsigned type) {
    return unsigned(shared::FEATURE_LIGHT_TYPES) + type;
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
    for (unsigned type = 0; type < std::size(kTypes); ++type)
        needed[featureOf(type)] = type == GetParam();
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
    const std::vector<float> device = run(made.lights, made.cases, {{featureOf(GetParam()), 0}});
    for (std::size_t i = 0; i < made.cases.size(); ++i)
        EXPECT_EQ(device[i * kOutputs + 9], 0.0f) << "sample valid";
}

INSTANTIATE_TEST_SUITE_P(Types, LightsByType, testing::Range(0u, 6u),
                         [](const auto& tested) { return kTypes[tested.param]; });

} // namespace
} // namespace kilolux::test
