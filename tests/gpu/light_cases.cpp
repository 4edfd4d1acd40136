// Random lights and receivers, see light_cases.h.
#include "tests/gpu/light_cases.h"

#include "renderer/lights_cpp/lights_f32.h"
#include "renderer/lights_cpp/lights_f64.h"
#include "renderer/source_picture.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace kilolux::test {
namespace {

using glm::vec2;
using glm::vec3;

constexpr double kPi = 3.14159265358979323846;

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

} // namespace

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

} // namespace kilolux::test
