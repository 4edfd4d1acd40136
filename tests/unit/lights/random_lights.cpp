#include "tests/unit/lights/random_lights.h"

#include "renderer/lights_cpp/ltc_table.h"

#include <cmath>
#include <gtest/gtest.h>

namespace kilolux::test {

double Random::uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine()) / 4294967296.0);
}

double Random::logUniform(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
}

dvec3 Random::direction() {
    const double u = uniform(0, 1);
    return f64::sphereFromSquare({u, uniform(0, 1)});
}

Configuration randomConfiguration(Random& random, shared::uint type) {
    Configuration c;
    c.surface.roughness = random.uniform(0.05, 1.0);
    const double alpha = c.surface.roughness * c.surface.roughness;
    const double noV = random.uniform(0.05, 1.0);
    const double sine = std::sqrt(1.0 - noV * noV);
    const double turn = random.uniform(0.0, 2.0 * kPi);
    c.surface.view = {sine * std::cos(turn), sine * std::sin(turn), noV};
    const dvec3 mirror(-c.surface.view.x, -c.surface.view.y, noV);
    dvec3 toLight = random.direction();
    if (random.uniform(0, 1) < 0.5)
        toLight = glm::normalize(mirror + toLight * (alpha * random.uniform(0.0, 3.0)));
    toLight.z = std::abs(toLight.z);
    const double distance = random.uniform(1.0, 4.0);
    const bool round = type == shared::LIGHT_SPHERE || type == shared::LIGHT_SPOT;
    const double largest = type == shared::LIGHT_DIRECTIONAL ? 0.5 : round ? 0.9 * distance : 2.0 * distance;
    const double size = random.logUniform(1e-3 * distance, largest);
    c.emitter.type = type;
    c.emitter.center = toLight * distance;
    c.emitter.size = {size, 0.0};
    c.emitter.z = random.direction();
    if (type == shared::LIGHT_RECT) c.emitter.size.y = size * random.logUniform(0.1, 1.0);
    if (type == shared::LIGHT_TUBE) c.emitter.size = {size * 0.1, size};
    if (type == shared::LIGHT_RECT || type == shared::LIGHT_DISK) // looks about towards the receiver
        c.emitter.z = glm::normalize(toLight * 1.2 + c.emitter.z);
    if (type == shared::LIGHT_DIRECTIONAL) c.emitter.z = toLight;
    const glm::dmat3 frame = f64::basisFromNormalTangent(c.emitter.z, random.direction());
    c.emitter.x = frame[0];
    c.emitter.y = frame[1];
    return c;
}

double sineOf(const Emitter& emitter) {
    if (emitter.type == shared::LIGHT_DIRECTIONAL) return emitter.size.x;
    const bool tube = emitter.type == shared::LIGHT_TUBE;
    const double radius = tube ? emitter.size.x + emitter.size.y : glm::length(emitter.size);
    return radius / glm::length(emitter.center);
}

dvec3 directionTo(const Emitter& emitter) {
    return emitter.type == shared::LIGHT_DIRECTIONAL ? emitter.z : glm::normalize(emitter.center);
}

void bindCommittedTable() {
    auto table = loadLtcTable(KILOLUX_SOURCE_DIR "/content/ltc_ggx.bin");
    ASSERT_TRUE(table) << table.error();
    useLtcTable(table.value());
}

} // namespace kilolux::test
