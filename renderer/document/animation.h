// Node animation: what glTF 2.0 calls animations, channels and samplers (section 3.11 and appendix C), and
// the pose that they give a scene at a time. Times are seconds, all in double precision.
#pragma once

#include "renderer/document/scene.h"

namespace kilolux {

enum class Interpolation : std::uint8_t { Linear, Step, CubicSpline }; // Linear turns on the shorter arc
enum class AnimationPath : std::uint8_t { Translation, Rotation, Scale };

// A curve through key values, held before its first key and after its last one.
struct AnimationSampler {
    Interpolation interpolation = Interpolation::Linear;
    std::vector<double> timesS; // at least one (two for CubicSpline), from 0 up, strictly increasing
    // One per time; for CubicSpline three: tangent in, value, tangent out, tangents per second. Translation
    // and scale stand in xyz, a rotation is the quaternion x, y, z, w.
    std::vector<glm::dvec4> values;
};

struct AnimationChannel {
    int node = -1; // into Scene::nodes
    AnimationPath path = AnimationPath::Translation;
    int sampler = -1; // into Animation::samplers
};

struct Animation {
    std::string name;
    double durationS = 0.0; // the latest key of all channels that the file has for nodes
    std::vector<AnimationSampler> samplers;
    std::vector<AnimationChannel> channels;
};

// The curve's value at a time within the animation; a rotation comes out with unit length.
glm::dvec4 sampleCurve(const AnimationSampler& sampler, AnimationPath path, double timeS);

// Gives every animated node its transform at `timeS`, by the time alone whatever the pose was before, and
// brings the world transforms and the cameras on moving nodes up to date; lights follow as they refer to
// their node. All animations of the file play together and each loops over its own duration, so that its last
// key and time 0 are one moment; where two speak of the same part of a node the later one in the file counts.
// Times below 0 loop as well. A pose that leaves single precision's range is replaced by the rest pose. The
// size of an area light stays the one of its node's scale in the file.
void poseScene(Scene& scene, double timeS);

// The longest duration of the scene's animations; 0 without any.
double animationDurationS(const Scene& scene);

// For each node, whether poseScene() can change its world transform: it or one above it has a channel.
std::vector<bool> movingNodes(const Scene& scene);

} // namespace kilolux
