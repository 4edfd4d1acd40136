// Animations of node transforms (glTF 2.0, section 3.11). A broken curve costs a warning, not the scene. A
// channel that only repeats what its node says anyway, as exporters write them for every node, is left out,
// so that the node counts as still.
#include "renderer/document/animation.h"
#include "renderer/document/gltf_accessor.h"

#include <algorithm>
#include <cmath>

namespace kilolux::gltf {

namespace {

constexpr double kHuge = 1e18;          // as for the nodes' transforms
constexpr double kRestTolerance = 1e-6; // the file's floats against its decimal numbers

struct NamedPath {
    std::string_view name;
    AnimationPath path;
};
constexpr NamedPath kPaths[] = {{"translation", AnimationPath::Translation},
                                {"rotation", AnimationPath::Rotation},
                                {"scale", AnimationPath::Scale}};

std::string pathText(const Json& target) {
    return target["path"].get<std::string>();
}

Interpolation interpolationOf(const Json& sampler, const std::string& place) {
    const std::string name = sampler.value("interpolation", "LINEAR");
    if (name == "LINEAR") return Interpolation::Linear;
    if (name == "STEP") return Interpolation::Step;
    if (name == "CUBICSPLINE") return Interpolation::CubicSpline;
    fail(place + "/interpolation", "expected LINEAR, STEP or CUBICSPLINE, found '{}'", printable(name));
}

std::vector<double> readTimes(const AccessorReader& reader, const std::string& place) {
    std::vector<double> timesS(reader.count());
    for (std::size_t i = 0; i < timesS.size(); ++i) {
        timesS[i] = reader.readFloats(i)[0];
        if (!(timesS[i] >= 0.0) || !std::isfinite(timesS[i]))
            fail(place, "expected finite times from 0 up, found {:.6g} at {}", timesS[i], i);
        if (i > 0 && !(timesS[i] > timesS[i - 1])) {
            fail(place, "expected strictly increasing times, found {:.6g} after {:.6g} at {}", timesS[i],
                 timesS[i - 1], i);
        }
    }
    return timesS;
}

std::vector<glm::dvec4> readValues(const AccessorReader& reader, const std::string& place) {
    std::vector<glm::dvec4> values(reader.count());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto raw = reader.readFloats(i);
        values[i] = glm::dvec4(raw[0], raw[1], raw[2], raw[3]);
        for (int c = 0; c < 4; ++c) {
            if (!(std::abs(values[i][c]) < kHuge))
                fail(place, "expected finite numbers below {}, found {:.6g} at {}", kHuge, values[i][c], i);
        }
    }
    return values;
}

// Gives the keys of linear and stepped curves unit length; a cubic's belong to its tangents and stay as they
// are.
void checkRotations(AnimationSampler& sampler, const std::string& place) {
    const bool isCubic = sampler.interpolation == Interpolation::CubicSpline;
    for (std::size_t i = isCubic ? 1 : 0; i < sampler.values.size(); i += isCubic ? 3 : 1) {
        const double length = glm::length(sampler.values[i]);
        if (!(length > 1e-6)) fail(place, "expected unit quaternions, found length {:.6g} at {}", length, i);
        if (!isCubic) sampler.values[i] /= length;
    }
}

bool isNear(const glm::dvec4& a, const glm::dvec4& b) {
    return glm::length(a - b) <= kRestTolerance * std::max(1.0, glm::length(b));
}

bool repeatsRest(const AnimationSampler& sampler, AnimationPath path, const Trs& rest) {
    const bool isCubic = sampler.interpolation == Interpolation::CubicSpline;
    const glm::dquat& turned = rest.rotation;
    const glm::dvec4 value = path == AnimationPath::Translation ? glm::dvec4(rest.translation, 0.0)
                             : path == AnimationPath::Scale
                                 ? glm::dvec4(rest.scale, 0.0)
                                 : glm::dvec4(turned.x, turned.y, turned.z, turned.w);
    for (std::size_t i = 0; i < sampler.values.size(); ++i) {
        const bool isTangent = isCubic && i % 3 != 1;
        if (isTangent ? sampler.values[i] != glm::dvec4(0.0) : !isNear(sampler.values[i], value))
            return false;
    }
    return true;
}

class AnimationImporter {
  public:
    AnimationImporter(ImportContext& context, const tinygltf::Model& model, int index)
        : context_(context), model_(model), place_(fmt::format("/animations/{}", index)),
          json_(context.json["animations"][index]) {}

    void run();

  private:
    void importChannel(const Json& channel, const std::string& place);
    // The path that a target names, or none with a warning.
    const NamedPath* pathOf(const Json& target, const std::string& place);
    // Where animation_.samplers holds the file's sampler, read at its first use; -1 for a broken one, which
    // is told once.
    int samplerFor(std::size_t index, bool isRotation);
    AnimationSampler readSampler(const Json& json, bool isRotation, const std::string& place);

    ImportContext& context_;
    const tinygltf::Model& model_;
    std::string place_;
    const Json& json_;
    Animation animation_;
    std::map<std::pair<std::size_t, bool>, int> samplers_; // by index and whether read as rotations
    std::set<std::pair<int, AnimationPath>> targets_;
};

AnimationSampler AnimationImporter::readSampler(const Json& json, bool isRotation, const std::string& place) {
    AnimationSampler sampler;
    sampler.interpolation = interpolationOf(json, place);
    const std::string inputPlace = place + "/input", outputPlace = place + "/output";
    const AccessorReader input(context_, model_, json["input"], {TINYGLTF_TYPE_SCALAR}, inputPlace);
    if (input.componentType() != TINYGLTF_COMPONENT_TYPE_FLOAT) fail(inputPlace, "expected floats");
    const int type = isRotation ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3;
    const AccessorReader output(context_, model_, json["output"], {type}, outputPlace);
    const bool isNormalized = model_.accessors[json["output"].get<std::size_t>()].normalized &&
                              output.componentType() != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    if (output.componentType() != TINYGLTF_COMPONENT_TYPE_FLOAT && !(isRotation && isNormalized)) {
        fail(outputPlace, "expected floats{}", isRotation ? " or normalized integers of 8 or 16 bits" : "");
    }
    const bool isCubic = sampler.interpolation == Interpolation::CubicSpline;
    const std::size_t perKey = isCubic ? 3 : 1;
    if (isCubic && input.count() < 2) fail(inputPlace, "expected at least 2 keys for CUBICSPLINE, found 1");
    if (output.count() != input.count() * perKey) {
        fail(outputPlace, "expected {} values, {} for each of {} keys, found {}", input.count() * perKey,
             perKey, input.count(), output.count());
    }
    context_.chargeGeometry(input.count() * (sizeof(double) + perKey * sizeof(glm::dvec4)), place);
    sampler.timesS = readTimes(input, inputPlace);
    sampler.values = readValues(output, outputPlace);
    if (isRotation) checkRotations(sampler, outputPlace);
    return sampler;
}

int AnimationImporter::samplerFor(std::size_t index, bool isRotation) {
    const auto [it, isNew] = samplers_.try_emplace({index, isRotation}, -1);
    const Json& json = json_["samplers"][index];
    if (!isNew || json.is_null()) return it->second;
    try {
        AnimationSampler sampler =
            readSampler(json, isRotation, fmt::format("{}/samplers/{}", place_, index));
        it->second = static_cast<int>(animation_.samplers.size());
        animation_.samplers.push_back(std::move(sampler));
    } catch (const ImportFailure& failure) {
        context_.addWarning(failure.text + "; its channels are left out");
    }
    return it->second;
}

const NamedPath* AnimationImporter::pathOf(const Json& target, const std::string& place) {
    const std::string text = pathText(target);
    if (text == "weights") {
        context_.warnOnce("morph targets", place, "morph targets are shown in their rest pose");
        return nullptr;
    }
    if (text == "pointer") {
        context_.warnOnce("animated pointers", place, "only nodes are animated; 'pointer' is not played");
        return nullptr;
    }
    for (const NamedPath& each : kPaths) {
        if (each.name == text) return &each;
    }
    context_.warn(place + "/path", "expected translation, rotation, scale or weights, found '{}'; ignored",
                  printable(text));
    return nullptr;
}

void AnimationImporter::importChannel(const Json& channel, const std::string& place) {
    const Json& target = channel["target"];
    const NamedPath* path = pathOf(target, place + "/target");
    const auto nodeJson = target.find("node");
    if (!path || nodeJson == target.end()) return; // an extension may say what else is meant
    const int node = *nodeJson;
    const auto& rest = context_.scene.nodes[node].restTrs;
    if (!rest) {
        context_.warn(place + "/target/node",
                      "expected a node without matrix, node {} has one; the channel is left out", node);
        return;
    }
    if (!targets_.emplace(node, path->path).second) {
        context_.warn(place + "/target",
                      "expected one channel for the {} of node {}, found a second; it is left out",
                      path->name, node);
        return;
    }
    const auto index = channel["sampler"].get<std::size_t>();
    if (index >= json_["samplers"].size()) {
        context_.warn(place + "/sampler",
                      "expected an index under {}, the number of samplers, found {}; the "
                      "channel is left out",
                      json_["samplers"].size(), index);
        return;
    }
    const int sampler = samplerFor(index, path->path == AnimationPath::Rotation);
    if (sampler < 0) return;
    animation_.durationS = std::max(animation_.durationS, animation_.samplers[sampler].timesS.back());
    if (!repeatsRest(animation_.samplers[sampler], path->path, *rest))
        animation_.channels.push_back({node, path->path, sampler});
}

void AnimationImporter::run() {
    animation_.name = json_.value("name", "");
    const Json& channels = json_["channels"];
    for (std::size_t i = 0; i < channels.size(); ++i) {
        if (!channels[i].is_null()) importChannel(channels[i], fmt::format("{}/channels/{}", place_, i));
    }
    if (animation_.channels.empty()) return;
    context_.scene.animations.push_back(std::make_shared<const Animation>(std::move(animation_)));
}

} // namespace

void importAnimations(ImportContext& context, const tinygltf::Model& model) {
    const auto animations = context.json.find("animations");
    if (animations == context.json.end()) return;
    for (std::size_t i = 0; i < animations->size(); ++i)
        AnimationImporter(context, model, static_cast<int>(i)).run();
}

} // namespace kilolux::gltf
