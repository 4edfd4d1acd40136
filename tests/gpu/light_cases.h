// Random lights of every type and receivers for them, ordinary and hard, for tests of the light functions.
// The same call gives the same numbers.
#pragma once

#include "renderer/lights_cpp/light_tables.h"
#include "shaders/shared/gpu_light.h"

#include <vector>

namespace kilolux::test {

// As in shaders/lights.comp.
struct LightTestCase {
    glm::vec3 positionWs;
    float roughness;
    glm::vec3 normalWs;
    glm::vec3 viewDirWs;
    glm::vec2 uv;
    std::uint32_t slot;
};

// Lights of one type, and receivers that name them by slot.
struct TypeCases {
    std::vector<shared::LightHot> lights;
    std::vector<LightTestCase> cases;
};

// `count` receivers at 200 lights. Every other light has one of someShapings().
TypeCases casesOf(std::uint32_t type, std::size_t count);

// Fifty shapings: barn doors alone, with a profile and with a light function by turns, some with a picture.
LightTables someShapings();

} // namespace kilolux::test
