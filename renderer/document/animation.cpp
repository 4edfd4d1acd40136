// Evaluates animation curves (glTF 2.0, appendix C) and poses the scene with them.
#include "renderer/document/animation.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace kilolux {

namespace {

using Poses = std::map<int, Trs>; // by node

glm::dquat quatFrom(const glm::dvec4& xyzw) {
    return glm::dquat(xyzw.w, xyzw.x, xyzw.y, xyzw.z);
}

glm::dvec4 vectorFrom(const glm::dquat& rotation) {
    return glm::dvec4(rotation.x, rotation.y, rotation.z, rotation.w);
}

// A cubic through opposite quaternions passes 0, which is no rotation: the key before it holds there.
glm::dvec4 normalizedOr(const glm::dvec4& rotation, const glm::dvec4& key) {
    const double length = glm::length(rotation);
    return length > 1e-9 && std::isfinite(length) ? rotation / length : glm::normalize(key);
}

// Appendix C.5; `key` is the one before, `u` the share of the way of `stepS` seconds to the next one.
glm::dvec4 hermite(const AnimationSampler& sampler, std::size_t key, double u, double stepS) {
    const glm::dvec4* here = &sampler.values[3 * key];
    const glm::dvec4 value = here[1], tangentOut = here[2], tangentIn = here[3], next = here[4];
    const double u2 = u * u, u3 = u2 * u;
    return (2.0 * u3 - 3.0 * u2 + 1.0) * value + stepS * (u3 - 2.0 * u2 + u) * tangentOut +
           (3.0 * u2 - 2.0 * u3) * next + stepS * (u3 - u2) * tangentIn;
}

double loopedTimeS(const Animation& animation, double timeS) {
    if (!(animation.durationS > 0.0) || !std::isfinite(timeS)) return 0.0;
    const double remainderS = std::fmod(timeS, animation.durationS);
    return remainderS < 0.0 ? remainderS + animation.durationS : remainderS;
}

// The editor may have deleted a node that an animation still speaks of.
bool isPosable(const Scene& scene, const AnimationChannel& channel) {
    return channel.node >= 0 && channel.node < static_cast<int>(scene.nodes.size()) &&
           scene.nodes[channel.node].restTrs;
}

Poses posesAt(const Scene& scene, double timeS) {
    Poses poses;
    for (const auto& animation : scene.animations) {
        const double localS = loopedTimeS(*animation, timeS);
        for (const AnimationChannel& channel : animation->channels) {
            if (!isPosable(scene, channel)) continue;
            Trs& trs = poses.try_emplace(channel.node, *scene.nodes[channel.node].restTrs).first->second;
            const glm::dvec4 value = sampleCurve(animation->samplers[channel.sampler], channel.path, localS);
            switch (channel.path) {
            case AnimationPath::Translation:
                trs.translation = glm::dvec3(value);
                break;
            case AnimationPath::Rotation:
                trs.rotation = quatFrom(value);
                break;
            case AnimationPath::Scale:
                trs.scale = glm::dvec3(value);
                break;
            }
        }
    }
    return poses;
}

// False where a transform leaves the range that the renderer can hold.
bool applyPoses(Scene& scene, const Poses& poses, const std::vector<bool>& moving) {
    for (const auto& [node, trs] : poses)
        scene.nodes[node].localFromNode = matrixFrom(trs);
    updateWorldTransforms(scene);
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        if (moving[i] &&
            !(fitsSinglePrecision(node.localFromNode) && fitsSinglePrecision(node.worldFromNode)))
            return false;
    }
    return true;
}

} // namespace

glm::dvec4 sampleCurve(const AnimationSampler& sampler, AnimationPath path, double timeS) {
    const bool isCubic = sampler.interpolation == Interpolation::CubicSpline;
    const auto valueAt = [&](std::size_t key) { return sampler.values[isCubic ? 3 * key + 1 : key]; };
    const auto finished = [&](const glm::dvec4& value, std::size_t key) {
        return path == AnimationPath::Rotation ? normalizedOr(value, valueAt(key)) : value;
    };
    const std::vector<double>& timesS = sampler.timesS;
    const auto after = std::upper_bound(timesS.begin(), timesS.end(), timeS);
    const auto next = static_cast<std::size_t>(after - timesS.begin());
    const std::size_t key = next > 0 ? next - 1 : 0;
    if (next == 0 || next == timesS.size() || sampler.interpolation == Interpolation::Step)
        return finished(valueAt(key), key);
    const double stepS = timesS[next] - timesS[key];
    const double u = (timeS - timesS[key]) / stepS;
    if (isCubic) return finished(hermite(sampler, key, u, stepS), key);
    if (path != AnimationPath::Rotation) return glm::mix(valueAt(key), valueAt(next), u);
    return finished(vectorFrom(glm::slerp(quatFrom(valueAt(key)), quatFrom(valueAt(next)), u)), key);
}

void poseScene(Scene& scene, double timeS) {
    if (scene.animations.empty()) return;
    const std::vector<bool> moving = movingNodes(scene);
    Poses poses = posesAt(scene, timeS);
    if (!applyPoses(scene, poses, moving)) {
        for (auto& [node, trs] : poses)
            trs = *scene.nodes[node].restTrs;
        applyPoses(scene, poses, moving);
    }
    for (Camera& camera : scene.cameras) {
        if (camera.node < 0 || camera.node >= static_cast<int>(scene.nodes.size()) || !moving[camera.node])
            continue;
        camera.worldFromCamera = rigidFrame(scene.nodes[camera.node].worldFromNode);
    }
}

double animationDurationS(const Scene& scene) {
    double durationS = 0.0;
    for (const auto& animation : scene.animations)
        durationS = std::max(durationS, animation->durationS);
    return durationS;
}

std::vector<bool> movingNodes(const Scene& scene) {
    const int count = static_cast<int>(scene.nodes.size());
    std::vector<bool> moving(scene.nodes.size(), false), known(scene.nodes.size(), false);
    for (const auto& animation : scene.animations) {
        for (const AnimationChannel& channel : animation->channels) {
            if (isPosable(scene, channel)) moving[channel.node] = known[channel.node] = true;
        }
    }
    std::vector<int> path; // from a node up to its first ancestor whose answer is known
    for (int start = 0; start < count; ++start) {
        int node = start;
        while (node >= 0 && node < count && !known[node]) {
            known[node] = true; // as still, until the path's end says otherwise; ends a cycle too
            path.push_back(node);
            node = scene.nodes[node].parent;
        }
        const bool isBelowMoving = node >= 0 && node < count && moving[node];
        for (; !path.empty(); path.pop_back())
            moving[path.back()] = isBelowMoving;
    }
    return moving;
}

} // namespace kilolux
