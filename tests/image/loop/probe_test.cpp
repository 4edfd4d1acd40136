// The probe tells what the frame did: probabilities that sum to one and are those of the choices, energies
// that are the analytic light, and rays that agree with the picture.
#include "tests/image/loop/loop_kit.h"

#include <nlohmann/json.hpp>

namespace kilolux::test {
namespace {

Probe probed(Loop& loop, glm::ivec2 pixel) {
    Result<Probe> probe = loop.renderer().probe(pixel);
    if (!probe) throw std::runtime_error(probe.error());
    return probe.value();
}

double probabilitySum(const Probe& probe) {
    double sum = 0.0;
    for (const ProbedLight& light : probe.lights)
        sum += light.probability;
    return sum;
}

class ProbeModes : public testing::TestWithParam<std::vector<std::string>> {};

// The sample that the frame stored is one that the probe saw as possible, with the probability that belongs
// to its contribution where nothing else is in it.
TEST_P(ProbeModes, ProbabilitiesSumToOne) {
    const Scene scene = crowdScene(40, 3);
    Loop loop(scene, loopOptions(24, 16, GetParam()));
    int chosen = 0;
    for (int frame = 0; frame < 4; ++frame) {
        loop.frames(1);
        for (const glm::ivec2 pixel : {glm::ivec2(5, 11), glm::ivec2(12, 13), glm::ivec2(20, 14)}) {
            const Probe probe = probed(loop, pixel);
            ASSERT_TRUE(probe.surface);
            EXPECT_NEAR(probabilitySum(probe), 1.0, 1e-4) << "frame " << frame;
            EXPECT_EQ(probe.pixel, pixel);
            std::uint32_t samples = 0, candidates = 0;
            for (const ProbedLight& light : probe.lights) {
                samples += light.chosen;
                candidates += light.candidate;
                if (light.chosen > 0) EXPECT_GT(light.probability, 0.0) << light.id;
                if (!light.candidate) EXPECT_EQ(light.probability, 0.0);
                if (light.list == "visible") EXPECT_TRUE(light.listed || light.fresh);
                if (light.list == "hidden") EXPECT_TRUE(light.inCell && !light.listed);
                EXPECT_LE(light.chosenVisible, light.chosen);
            }
            EXPECT_EQ(candidates, probe.candidates);
            chosen += int(samples);
            EXPECT_TRUE(frame == 0 || probe.listLights > 0 || GetParam().size() > 1);
        }
    }
    EXPECT_GE(chosen, 12);
}

INSTANTIATE_TEST_SUITE_P(Settings, ProbeModes,
                         testing::Values(std::vector<std::string>{},
                                         std::vector<std::string>{"raysPerPixel=4"},
                                         std::vector<std::string>{"sampling=rooks", "guiding=true"},
                                         std::vector<std::string>{"guiding=false", "lightGrid=false"}));

// Over many frames a light is chosen as often as the probe says.
TEST(ProbeFrequency, IsTheReportedProbability) {
    Loop loop(crowdScene(24, 5), loopOptions(16, 8));
    const glm::ivec2 pixel(9, 6);
    std::map<std::uint64_t, glm::dvec3> lights; // sum of probabilities, their variance, times chosen
    constexpr int kFrames = 400;
    for (int frame = 0; frame < kFrames; ++frame) {
        loop.frames(1);
        for (const ProbedLight& light : probed(loop, pixel).lights)
            lights[light.id] += glm::dvec3(light.probability, light.probability * (1.0 - light.probability),
                                           double(light.chosen));
    }
    double expected = 0.0, chosen = 0.0, worst = 0.0;
    int often = 0;
    for (const auto& [id, sums] : lights) {
        expected += sums.x;
        chosen += sums.z;
        worst = std::max(worst, std::abs(sums.z - sums.x) / std::sqrt(sums.y + 1.0));
        often += sums.x > 10.0;
    }
    EXPECT_EQ(chosen, kFrames);
    EXPECT_NEAR(expected, kFrames, 0.5);
    EXPECT_GE(often, 4) << "or the test sees little";
    EXPECT_LT(worst, 4.0) << "standard deviations of the light that is farthest off";
}

// Nothing in the way: what the probe adds up is the picture, and the illuminance is that of the closed form.
TEST(ProbeEnergy, IsTheAnalyticLight) {
    SceneBuilder b;
    b.quad(floorAt({0, 0, 0}), 20, 20, b.material({0.5, 0.5, 0.5}, 0.0, 1.0));
    const glm::dvec3 at(1.0, 2.0, -0.5);
    LightDef point = lightDef(LightType::Sphere, 100.0, LightUnit::Candela);
    point.rangeM = 1000.0;
    b.light(point, glm::translate(glm::dmat4(1.0), at));
    LightDef rect = lightDef(LightType::Rect, 500.0, LightUnit::Nit);
    rect.rangeM = 1000.0;
    b.light(rect, lookingAlong({-1, 2, 0}, {0.2, -1, 0}));
    b.scene.cameras.push_back(cameraLooking({0, 3, 3}, {0, 0, 0}));
    const Scene scene = withIds(b.scene);
    RenderOptions options = loopOptions(17, 9);
    options.method = "all-lights";
    Loop loop(scene, options);
    const Picture picture = loop.next();
    const Probe probe = probed(loop, {8, 4});
    ASSERT_EQ(probe.lights.size(), 2u);
    EXPECT_EQ(probe.lightsSeen, 2u);
    glm::dvec3 sum(0.0);
    for (const ProbedLight& light : probe.lights) {
        sum += light.reflectedNit;
        EXPECT_EQ(light.visibility, 1.0);
        EXPECT_EQ(light.rays.size(), 16u);
        for (const ProbeRay& ray : light.rays)
            EXPECT_TRUE(ray.visible);
    }
    const float* shown = &picture.rgb[3 * (4 * 17 + 8)];
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(sum[c], double(shown[c]), 1e-4 * sum[c]);
        EXPECT_NEAR(probe.pictureNit[c], double(shown[c]), 1e-5 * sum[c]);
    }
    EXPECT_NEAR(probe.nit, luminanceOf(sum), 1e-6 * probe.nit);
    EXPECT_NEAR(probe.lux, probe.illuminanceLux, 1e-3 * probe.lux);
    EXPECT_LT(glm::length(probe.normalWs - glm::dvec3(0, 1, 0)), 1e-4);
    const ProbedLight& sphere = probe.lights[probe.lights[0].type == "sphere" ? 0 : 1];
    const glm::dvec3 to = at - probe.positionWs;
    const double lux = 100.0 * to.y / std::pow(glm::length(to), 3.0);
    EXPECT_NEAR(sphere.lux, lux, 2e-3 * lux);
    EXPECT_NEAR(luminanceOf(sphere.irradianceLux), sphere.lux, 1e-9);
    EXPECT_LT(glm::distance(sphere.rays[0].pointWs, at), 1e-3);
}

// A wall hides one of two lights.
TEST(ProbeRays, MeetWhatIsInTheWay) {
    SceneBuilder b;
    const int grey = b.material({0.5, 0.5, 0.5}, 0.0, 1.0);
    b.quad(floorAt({0, 0, 0}), 20, 20, grey);
    b.quad(lookingAlong({1, 1, 0}, {-1, 0, 0}), 6, 2, grey);
    LightDef def = lightDef(LightType::Sphere, 100.0, LightUnit::Candela);
    def.rangeM = 50.0;
    b.light(def, glm::translate(glm::dmat4(1.0), {-2, 1, 0}));
    b.light(def, glm::translate(glm::dmat4(1.0), {2, 1, 0}));
    b.scene.cameras.push_back(cameraLooking({0, 3, 3}, {0, 0, 0}));
    const Scene scene = withIds(b.scene);
    Loop loop(scene, loopOptions(17, 9));
    loop.frames(20);
    const Probe probe = probed(loop, {8, 4});
    ASSERT_EQ(probe.lights.size(), 2u);
    EXPECT_EQ(probe.lights[0].id, 1u);
    EXPECT_EQ(probe.lights[0].visibility, 1.0);
    EXPECT_EQ(probe.lights[1].visibility, 0.0);
    EXPECT_EQ(probe.lights[1].nit, 0.0);
    EXPECT_GT(luminanceOf(probe.lights[1].reflectedNit), 0.0) << "that it would give";
    EXPECT_EQ(probe.lights[0].share, 1.0);
    EXPECT_EQ(probe.effectiveLights, 1.0);
    EXPECT_TRUE(probe.lights[0].listed);
}

TEST(ProbeFrame, ChangesNothing) {
    const auto last = [](bool probing) {
        Loop loop(crowdScene(12, 7), loopOptions(24, 16));
        for (int frame = 0; frame < 3; ++frame) {
            loop.frames(1);
            if (probing) probed(loop, {12, 12});
        }
        const FrameStatistics statistics = loop.renderer().statistics();
        EXPECT_EQ(statistics.frames, 3);
        return std::pair(loop.next().srgb8, statistics.rays);
    };
    EXPECT_EQ(last(true), last(false));
}

TEST(ProbeFrame, IsThereAtOnceAndAfterSettings) {
    Loop loop(crowdScene(6, 7), loopOptions(24, 16));
    EXPECT_TRUE(probed(loop, {12, 12}).surface) << "before any frame";
    Settings settings = loopOptions(24, 16).settings;
    settings.raysPerPixel = 4.0;
    ASSERT_FALSE(loop.renderer().setSettings(settings));
    std::uint32_t chosen = 0;
    for (const ProbedLight& light : probed(loop, {12, 12}).lights)
        chosen += light.chosen;
    EXPECT_EQ(chosen, 4u);
    EXPECT_FALSE(loop.renderer().probe({24, 0}));
    EXPECT_FALSE(loop.renderer().probe({0, -1}));
}

TEST(ProbeText, JsonHoldsWhatItFound) {
    Loop loop(crowdScene(12, 7), loopOptions(24, 16));
    loop.frames(3);
    const Probe probe = probed(loop, {12, 12});
    const auto json = probeJson(probe);
    EXPECT_EQ(json["pixel"], nlohmann::json({12, 12}));
    EXPECT_EQ(json["lights"].size(), probe.lights.size());
    EXPECT_EQ(json["choice"]["candidates"], probe.candidates);
    double last = 1e30;
    for (const auto& light : json["lights"]) {
        for (const char* key : {"id", "slot", "name", "type", "reaches", "inCell", "listed", "fresh",
                                "candidate", "list", "areaMask", "unseenFrames", "weight", "probability",
                                "chosen", "chosenVisible", "visibility", "energy", "rays"})
            EXPECT_TRUE(light.contains(key)) << key;
        EXPECT_LE(light["energy"]["nit"].get<double>(), last);
        last = light["energy"]["nit"].get<double>();
    }
}

} // namespace
} // namespace kilolux::test
