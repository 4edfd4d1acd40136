// Animation curves against their closed forms, and what a pose does to nodes, cameras and lights, on scenes
// made in memory.
#include "renderer/document/animation.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <limits>

namespace kilolux::test {
namespace {

constexpr double kPi = 3.14159265358979323846;

glm::dvec4 turnedAboutZ(double angleRad) {
    return {0.0, 0.0, std::sin(angleRad / 2.0), std::cos(angleRad / 2.0)};
}

double angleAboutZ(const glm::dvec4& rotation) {
    return 2.0 * std::atan2(rotation.z, rotation.w);
}

void expectNear(const glm::dvec4& found, const glm::dvec4& expected, double tolerance = 1e-12) {
    EXPECT_LT(glm::distance(found, expected), tolerance)
        << found.x << " " << found.y << " " << found.z << " " << found.w;
}

// A scene of `count` nodes without parents, and what moves them.
struct Stage {
    Scene scene;
    Animation animation;

    explicit Stage(int count) {
        scene.nodes.resize(count);
        for (Node& node : scene.nodes)
            node.restTrs = Trs{};
    }
    void move(int node, AnimationPath path, std::vector<double> timesS, std::vector<glm::dvec4> values,
              Interpolation interpolation = Interpolation::Linear) {
        animation.durationS = std::max(animation.durationS, timesS.back());
        animation.samplers.push_back({interpolation, std::move(timesS), std::move(values)});
        animation.channels.push_back({node, path, static_cast<int>(animation.samplers.size()) - 1});
    }
    // Closes the current animation; what is moved afterwards belongs to the next one.
    void finish() { scene.animations.push_back(std::make_shared<const Animation>(std::move(animation))); }
    glm::dvec3 positionAt(int node, double timeS) {
        poseScene(scene, timeS);
        return glm::dvec3(scene.nodes[node].worldFromNode[3]);
    }
};

TEST(AnimationCurve, LinearIsHeldOutsideItsKeys) {
    const AnimationSampler sampler{
        Interpolation::Linear, {1.0, 2.0, 4.0}, {{0, 1, 2, 0}, {4, 1, 2, 0}, {8, 5, 2, 0}}};
    const auto at = [&](double timeS) { return sampleCurve(sampler, AnimationPath::Translation, timeS); };
    expectNear(at(0.0), {0, 1, 2, 0});
    expectNear(at(1.0), {0, 1, 2, 0});
    expectNear(at(1.25), {1, 1, 2, 0});
    expectNear(at(2.0), {4, 1, 2, 0});
    expectNear(at(3.5), {7, 4, 2, 0});
    expectNear(at(4.0), {8, 5, 2, 0});
    expectNear(at(1e9), {8, 5, 2, 0});
}

TEST(AnimationCurve, StepHoldsEachKeyUntilTheNext) {
    const AnimationSampler sampler{Interpolation::Step, {0.0, 1.0}, {{1, 1, 1, 0}, {2, 2, 2, 0}}};
    EXPECT_EQ(sampleCurve(sampler, AnimationPath::Scale, std::nextafter(1.0, 0.0)).x, 1.0);
    EXPECT_EQ(sampleCurve(sampler, AnimationPath::Scale, 1.0).x, 2.0);
    const AnimationSampler one{Interpolation::Linear, {0.5}, {{3, 0, 0, 0}}};
    for (const double timeS : {0.0, 0.5, 1.0})
        EXPECT_EQ(sampleCurve(one, AnimationPath::Translation, timeS).x, 3.0);
}

TEST(AnimationCurve, SlerpTurnsEvenlyOnTheShorterArc) {
    const AnimationSampler quarter{
        Interpolation::Linear, {0.0, 2.0}, {turnedAboutZ(0.0), turnedAboutZ(kPi / 2.0)}};
    for (const double u : {0.0, 0.1, 0.5, 0.9, 1.0}) {
        const glm::dvec4 turned = sampleCurve(quarter, AnimationPath::Rotation, 2.0 * u);
        EXPECT_NEAR(angleAboutZ(turned), u * kPi / 2.0, 1e-12);
        EXPECT_NEAR(glm::length(turned), 1.0, 1e-14);
    }
    // The same end written with the other sign lies three quarters away in the space of quaternions.
    const AnimationSampler flipped{
        Interpolation::Linear, {0.0, 1.0}, {turnedAboutZ(0.0), -turnedAboutZ(kPi / 2.0)}};
    EXPECT_NEAR(angleAboutZ(sampleCurve(flipped, AnimationPath::Rotation, 0.5)), kPi / 4.0, 1e-12);
    const AnimationSampler nearlySame{
        Interpolation::Linear, {0.0, 1.0}, {turnedAboutZ(1.0), turnedAboutZ(1.0 + 1e-9)}};
    EXPECT_NEAR(angleAboutZ(sampleCurve(nearlySame, AnimationPath::Rotation, 0.5)), 1.0 + 5e-10, 1e-12);
}

// A cubic through the values and slopes of a polynomial of third degree is that polynomial, whatever the
// distance of its keys: tangents count per second.
TEST(AnimationCurve, CubicSplineIsThePolynomialOfItsTangents) {
    const auto value = [](double t) {
        return glm::dvec4(t * t * t - 2.0 * t * t + 3.0, 1.0 - t, 4.0 * t * t, 0.0);
    };
    const auto slope = [](double t) { return glm::dvec4(3.0 * t * t - 4.0 * t, -1.0, 8.0 * t, 0.0); };
    AnimationSampler sampler{Interpolation::CubicSpline, {0.5, 1.0, 4.0}, {}};
    for (const double t : sampler.timesS)
        sampler.values.insert(sampler.values.end(), {slope(t), value(t), slope(t)});
    for (const double t : {0.5, 0.6, 0.99, 1.0, 1.5, 2.7, 3.9, 4.0})
        expectNear(sampleCurve(sampler, AnimationPath::Translation, t), value(t), 1e-11);
    expectNear(sampleCurve(sampler, AnimationPath::Translation, 0.0), value(0.5));
    expectNear(sampleCurve(sampler, AnimationPath::Translation, 9.0), value(4.0));
}

TEST(AnimationCurve, CubicSplineTakesEachSideOfAKeyForItself) {
    // Tangents that a curve of 0 and 1 must not see: in of the first key, out of the last.
    const glm::dvec4 zero(0.0), far(1e6), one(1.0);
    const AnimationSampler sampler{Interpolation::CubicSpline, {0.0, 2.0}, {far, zero, zero, zero, one, far}};
    EXPECT_NEAR(sampleCurve(sampler, AnimationPath::Scale, 0.5).x, 0.15625, 1e-14); // 3 u^2 - 2 u^3
    // The out tangent of the first key alone: 2 s * (u^3 - 2 u^2 + u) * 1.
    const AnimationSampler leaving{
        Interpolation::CubicSpline, {0.0, 2.0}, {zero, zero, one, zero, zero, zero}};
    EXPECT_NEAR(sampleCurve(leaving, AnimationPath::Scale, 0.5).x, 2.0 * 0.140625, 1e-14);
    const AnimationSampler arriving{
        Interpolation::CubicSpline, {0.0, 2.0}, {zero, zero, zero, one, zero, zero}};
    EXPECT_NEAR(sampleCurve(arriving, AnimationPath::Scale, 0.5).x, 2.0 * -0.046875, 1e-14);
}

TEST(AnimationCurve, CubicRotationsHaveUnitLengthEvenThroughZero) {
    const glm::dvec4 zero(0.0), start = turnedAboutZ(0.3);
    const AnimationSampler sampler{
        Interpolation::CubicSpline, {0.0, 1.0}, {zero, start, zero, zero, turnedAboutZ(1.1), zero}};
    const glm::dvec4 middle = sampleCurve(sampler, AnimationPath::Rotation, 0.5);
    EXPECT_NEAR(glm::length(middle), 1.0, 1e-14);
    EXPECT_NEAR(angleAboutZ(middle), 0.7, 1e-12);
    const AnimationSampler opposite{
        Interpolation::CubicSpline, {0.0, 1.0}, {zero, start, zero, zero, -start, zero}};
    expectNear(sampleCurve(opposite, AnimationPath::Rotation, 0.5), start);
}

TEST(Animation, PartsThatNoChannelMovesStayAtRest) {
    Stage stage(1);
    stage.scene.nodes[0].restTrs =
        Trs{{1, 2, 3}, glm::dquat(std::sqrt(0.5), 0, 0, std::sqrt(0.5)), {2, 2, 2}};
    stage.move(0, AnimationPath::Scale, {0, 2}, {{1, 1, 1, 0}, {5, 3, 1, 0}});
    stage.finish();
    poseScene(stage.scene, 1.0);
    const glm::dmat4& world = stage.scene.nodes[0].worldFromNode;
    expectNear(world * glm::dvec4(0, 0, 0, 1), {1, 2, 3, 1});
    expectNear(world * glm::dvec4(1, 0, 0, 0), {0, 3, 0, 0}); // X turned to Y
    expectNear(world * glm::dvec4(0, 1, 0, 0), {-2, 0, 0, 0});
}

TEST(Animation, EachLoopsOverItsOwnDuration) {
    Stage stage(2);
    stage.move(0, AnimationPath::Translation, {0, 2}, {{0, 0, 0, 0}, {2, 0, 0, 0}});
    stage.finish();
    stage.move(1, AnimationPath::Translation, {1, 3}, {{1, 0, 0, 0}, {3, 0, 0, 0}});
    stage.finish();
    EXPECT_EQ(animationDurationS(stage.scene), 3.0);
    EXPECT_EQ(animationDurationS(Scene{}), 0.0);
    const double positions[][3] = {{0, 0, 1},     {1.5, 1.5, 1.5},  {2, 0, 2},  {2.5, 0.5, 2.5},
                                   {3.5, 1.5, 1}, {-0.5, 1.5, 2.5}, {601, 1, 1}};
    for (const auto& [timeS, first, second] : positions) {
        EXPECT_NEAR(stage.positionAt(0, timeS).x, first, 1e-12) << timeS;
        EXPECT_NEAR(stage.positionAt(1, timeS).x, second, 1e-12) << timeS;
    }
    for (const double timeS : {std::numeric_limits<double>::infinity(), std::nan("")})
        EXPECT_EQ(stage.positionAt(0, timeS).x, 0.0);
}

TEST(Animation, ChildrenFollowAndTheLaterAnimationCounts) {
    Stage stage(3);
    stage.scene.nodes[0].parent = 2; // parents may come later
    stage.scene.nodes[0].restTrs->translation = {1, 0, 0};
    stage.scene.nodes[0].localFromNode = matrixFrom(*stage.scene.nodes[0].restTrs);
    stage.move(2, AnimationPath::Rotation, {0, 1}, {turnedAboutZ(0.0), turnedAboutZ(kPi)});
    stage.move(2, AnimationPath::Translation, {0}, {{9, 9, 9, 0}});
    stage.finish();
    stage.move(2, AnimationPath::Translation, {0}, {{0, 0, 7, 0}});
    stage.finish();
    EXPECT_LT(glm::distance(stage.positionAt(0, 0.5), glm::dvec3(0, 1, 7)), 1e-12);
    EXPECT_EQ(stage.positionAt(1, 0.5), glm::dvec3(0.0));
}

TEST(Animation, MovingNodesAreThoseBelowAChannel) {
    Stage stage(6);
    stage.scene.nodes[0].parent = 1;
    stage.scene.nodes[1].parent = 3;
    stage.scene.nodes[2].parent = 3;
    stage.scene.nodes[4].parent = 5; // a broken graph: two nodes above each other
    stage.scene.nodes[5].parent = 4;
    stage.move(1, AnimationPath::Translation, {0}, {{1, 0, 0, 0}});
    stage.finish();
    EXPECT_EQ(movingNodes(stage.scene), (std::vector<bool>{true, true, false, false, false, false}));
    EXPECT_EQ(movingNodes(Scene{}), std::vector<bool>{});
}

TEST(Animation, APoseDependsOnTheTimeAloneAndLeavesOthersAlone) {
    Stage stage(3);
    stage.scene.nodes[1].parent = 0;
    stage.scene.nodes[2].localFromNode[3] = glm::dvec4(0.1, 0.2, 0.3, 1.0);
    stage.move(0, AnimationPath::Rotation, {0, 1, 2},
               {turnedAboutZ(0.1), turnedAboutZ(2.0), turnedAboutZ(0.7)});
    stage.finish();
    poseScene(stage.scene, 0.37);
    const Scene direct = stage.scene;
    for (const double timeS : {1.9, 0.0, 0.8, 0.37})
        poseScene(stage.scene, timeS);
    for (std::size_t i = 0; i < direct.nodes.size(); ++i)
        EXPECT_EQ(stage.scene.nodes[i].worldFromNode, direct.nodes[i].worldFromNode) << i;
    EXPECT_EQ(stage.scene.nodes[2].worldFromNode, stage.scene.nodes[2].localFromNode);
}

TEST(Animation, CamerasFollowTheirNodeWithoutItsScale) {
    Stage stage(2);
    stage.scene.cameras.resize(3);
    stage.scene.cameras[0].node = 1;
    stage.scene.cameras[1].node = 0; // does not move: a camera that the user has turned keeps its view
    for (Camera& camera : stage.scene.cameras)
        camera.worldFromCamera[3] = glm::dvec4(5, 5, 5, 1);
    stage.move(1, AnimationPath::Translation, {0, 1}, {{0, 0, 0, 0}, {4, 0, 0, 0}});
    stage.move(1, AnimationPath::Scale, {0}, {{-3, 3, 3, 0}});
    stage.move(1, AnimationPath::Rotation, {0}, {turnedAboutZ(kPi / 2.0)});
    stage.finish();
    poseScene(stage.scene, 0.25);
    const glm::dmat4& view = stage.scene.cameras[0].worldFromCamera;
    expectNear(view[3], {1, 0, 0, 1});
    expectNear(view[1], {-1, 0, 0, 0}); // up
    expectNear(view[2], {0, 0, 1, 0});
    EXPECT_NEAR(glm::determinant(glm::dmat3(view)), 1.0, 1e-12);
    EXPECT_EQ(stage.scene.cameras[1].worldFromCamera[3].x, 5.0);
    EXPECT_EQ(stage.scene.cameras[2].worldFromCamera[3].x, 5.0) << "has no node";
}

TEST(Animation, APoseBeyondSinglePrecisionIsReplacedByTheRest) {
    Stage stage(2);
    stage.scene.nodes[1].parent = 0;
    stage.scene.nodes[0].restTrs->translation = {1, 2, 3};
    for (const int node : {0, 1})
        stage.move(node, AnimationPath::Scale, {0, 1}, {{1, 1, 1, 0}, {1e12, 1, 1, 0}});
    stage.finish();
    EXPECT_EQ(stage.positionAt(1, 1e-9), glm::dvec3(1, 2, 3));
    EXPECT_GT(stage.scene.nodes[1].worldFromNode[0].x, 1.0);
    EXPECT_EQ(stage.positionAt(1, 0.9), glm::dvec3(1, 2, 3));
    EXPECT_EQ(stage.scene.nodes[1].worldFromNode[0].x, 1.0);
}

TEST(Animation, NodesThatAreGoneOrHaveAMatrixAreLeftAlone) {
    Stage stage(2);
    stage.scene.nodes[1].restTrs.reset();
    for (const int node : {-1, 1, 7})
        stage.move(node, AnimationPath::Translation, {0}, {{1, 0, 0, 0}});
    stage.finish();
    EXPECT_EQ(stage.positionAt(1, 0.0).x, 0.0);
    EXPECT_EQ(movingNodes(stage.scene), (std::vector<bool>{false, false}));
}

} // namespace
} // namespace kilolux::test
