// The tree of lights: cones and measures with known answers, and a tree that holds every light once, each
// node about all below it.
#include "renderer/light_tree.h"

#include "renderer/lights_cpp/lights_f32.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>
#include <random>
#include <set>

namespace kilolux {
namespace {

using namespace shared;

constexpr double kPi = glm::pi<double>();

TEST(LightTree, MeasuresOfConesByHand) {
    const glm::dvec3 up(0.0, 1.0, 0.0);
    EXPECT_NEAR(coneMeasure({up, kPi, kPi / 2.0}), 4.0 * kPi, 1e-12) << "everywhere alike";
    EXPECT_NEAR(coneMeasure({up, 0.0, kPi / 2.0}), kPi, 1e-12) << "the integral of the cosine";
    // Of sin w cos w up to 60 degrees, times 2 pi.
    EXPECT_NEAR(coneMeasure({up, 0.0, kPi / 3.0}), kPi * std::pow(std::sin(kPi / 3.0), 2.0), 1e-12);
}

TEST(LightTree, ConesGrowAboutBoth) {
    const glm::dvec3 x(1.0, 0.0, 0.0), y(0.0, 1.0, 0.0);
    const LightCone both = coneAbout({x, 0.0, 0.3}, {y, 0.0, 0.5});
    EXPECT_NEAR(both.spreadRad, kPi / 4.0, 1e-12);
    EXPECT_NEAR(glm::dot(both.axis, glm::normalize(x + y)), 1.0, 1e-12);
    EXPECT_DOUBLE_EQ(both.emissionRad, 0.5);
    EXPECT_DOUBLE_EQ(coneAbout({x, 1.0, 0.3}, {x, 0.5, 0.3}).spreadRad, 1.0) << "inside";
    EXPECT_DOUBLE_EQ(coneAbout({x, 0.0, 0.3}, {-x, 0.0, 0.3}).spreadRad, kPi) << "opposite: everywhere";
}

std::vector<LightHot> manyLights() {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> number(-1.0f, 1.0f);
    const std::uint32_t types[] = {LIGHT_DIRECTIONAL, LIGHT_SPHERE, LIGHT_SPOT,
                                   LIGHT_TUBE,        LIGHT_RECT,   LIGHT_DISK};
    std::vector<LightHot> lights;
    for (int i = 0; i < 120; ++i) {
        LightHot light{};
        light.typeFlags = types[i % 6];
        light.positionWs = {10.0f * number(random), number(random), 10.0f * number(random)};
        light.invRange = 0.1f;
        light.dirWs = glm::normalize(glm::vec3(number(random), -1.0f, number(random)));
        light.tangentOct = f32::packOct16(glm::normalize(glm::cross(light.dirWs, glm::vec3(0, 0, 1))));
        light.intensity = glm::vec3(1.0f + float(i));
        light.sizeM = {0.1f, 0.2f};
        light.shaping = {4.0f, -3.0f};
        lights.push_back(light);
    }
    lights[5].typeFlags |= LIGHT_FLAG_DEAD;
    lights[6].typeFlags |= LIGHT_FLAG_MUTED;
    lights[7].intensity = glm::vec3(0.0f);
    return lights;
}

struct Walk {
    const std::vector<LightTreeNode>& nodes;
    std::multiset<std::uint32_t> slots;

    // The leaves below a node; every node holds its own, the root of local and distant lights excepted.
    std::vector<LightTreeNode> check(std::uint32_t at) {
        const LightTreeNode& node = nodes[at];
        if (node.slot != NO_RESERVOIR) {
            slots.insert(node.slot);
            return {node};
        }
        std::vector<LightTreeNode> leaves;
        for (const std::uint32_t child : {at + 1u, node.second}) {
            if (child <= at || child >= nodes.size()) {
                ADD_FAILURE() << "child " << child << " of " << at;
                return leaves;
            }
            for (const LightTreeNode& leaf : check(child))
                leaves.push_back(leaf);
        }
        double sum = 0.0;
        for (const LightTreeNode& leaf : leaves) {
            sum += leaf.intensity;
            if (at > 0) checkHolds(node, leaf);
        }
        if (at > 0) EXPECT_NEAR(node.intensity, sum, 1e-4 * sum) << at;
        return leaves;
    }
    static void checkHolds(const LightTreeNode& node, const LightTreeNode& leaf) {
        EXPECT_EQ(node.distant, leaf.distant);
        EXPECT_TRUE(glm::all(glm::lessThanEqual(node.leastWs, leaf.leastWs)));
        EXPECT_TRUE(glm::all(glm::greaterThanEqual(node.mostWs, leaf.mostWs)));
        EXPECT_GE(node.reachM, leaf.reachM);
        EXPECT_LE(node.cosEmission, leaf.cosEmission + 1e-6);
        const double between = std::acos(std::clamp(double(glm::dot(node.axisWs, leaf.axisWs)), -1.0, 1.0));
        EXPECT_GE(std::acos(double(node.cosSpread)) + 1e-3,
                  std::min(between + std::acos(double(leaf.cosSpread)), kPi));
    }
};

TEST(LightTree, HoldsEveryLightThatShinesOnce) {
    const std::vector<LightHot> lights = manyLights();
    const std::vector<LightTreeNode> nodes = makeLightTree(lights);
    EXPECT_EQ(nodes.size(), 2u * 117u - 1u);
    Walk walk{nodes, {}};
    walk.check(0);
    std::multiset<std::uint32_t> wanted;
    for (std::uint32_t slot = 0; slot < lights.size(); ++slot)
        if (slot < 5 || slot > 7) wanted.insert(slot);
    EXPECT_EQ(walk.slots, wanted);
}

TEST(LightTree, OneLightOrNone) {
    EXPECT_EQ(makeLightTree({}).size(), 1u);
    EXPECT_EQ(makeLightTree({})[0].slot, NO_RESERVOIR);
    std::vector<LightHot> lights = manyLights();
    lights.resize(1);
    ASSERT_EQ(makeLightTree(lights).size(), 1u);
    EXPECT_EQ(makeLightTree(lights)[0].slot, 0u);
    const std::vector<LightHot> same(9, manyLights()[1]);
    EXPECT_EQ(makeLightTree(same).size(), 17u) << "all at one place";
}

} // namespace
} // namespace kilolux
