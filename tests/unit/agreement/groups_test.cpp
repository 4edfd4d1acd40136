// Light groups: the same factor for the renderer's records and the oracle's lights.
#include "renderer/gpu_lights.h"
#include "renderer/reference/oracle.h"
#include "renderer/reference/oracle_light.h"

#include <gtest/gtest.h>

namespace kilolux {
namespace {

TEST(Groups, ActAlikeInRendererAndOracle) {
    Scene scene;
    LightDef def;
    def.intensity = 10.0;
    def.rangeM = 100.0;
    scene.lightDefs = {def};
    scene.nodes = {Node{}};
    LightNode light;
    light.id = 1;
    light.node = light.def = 0;
    light.group = 5;
    scene.lights = {light};
    LightGroup group;
    group.id = 5;
    group.name = "Key";
    group.intensity = 3.0;
    group.exposureEv = 1.0;
    group.tint = {1.0, 0.5, 0.25};
    scene.groups = {group};
    const auto expectBoth = [&](const glm::dvec3& candela) {
        const glm::vec3 record = makeGpuLights(scene, glm::dvec3(0.0), 0.0).hot[0].intensity;
        const glm::dvec3 truth = oracle::Oracle(scene).light(0).intensityCd;
        for (int c = 0; c < 3; ++c) {
            EXPECT_FLOAT_EQ(record[c], static_cast<float>(candela[c]));
            EXPECT_DOUBLE_EQ(truth[c], candela[c]);
        }
    };
    expectBoth({60.0, 30.0, 15.0});
    scene.groups[0].muted = true;
    expectBoth({0.0, 0.0, 0.0});
    scene.lights[0].group = 0;
    expectBoth({10.0, 10.0, 10.0});
}

} // namespace
} // namespace kilolux
