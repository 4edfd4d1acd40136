// libFuzzer target: any bytes as a .gltf or .glb file. What is opened must hold together, as the renderer
// believes it.
#include "renderer/document/animation.h"
#include "renderer/document/gltf_import.h"
#include "tests/fuzz/fuzz_input.h"

#include <cmath>

namespace {

void check(bool good) {
    if (!good) __builtin_trap();
}

void checkPrimitive(const kilolux::Primitive& primitive, std::size_t materialCount) {
    const std::size_t vertices = primitive.positions.size();
    check(primitive.indices.size() % 3 == 0);
    for (const std::uint32_t index : primitive.indices)
        check(index < vertices);
    check(primitive.normals.size() == vertices);
    for (const glm::vec3& normal : primitive.normals)
        check(std::abs(glm::length(normal) - 1.0f) < 1e-3f);
    check(primitive.tangents.empty() || primitive.tangents.size() == vertices);
    check(primitive.uv0.empty() || primitive.uv0.size() == vertices);
    check(primitive.uv1.empty() || primitive.uv1.size() == vertices);
    check(primitive.colors.empty() || primitive.colors.size() == vertices);
    check(primitive.material < static_cast<int>(materialCount));
}

void checkScene(const kilolux::Scene& scene) {
    for (const auto& mesh : scene.meshes) {
        check(mesh != nullptr);
        for (const auto& primitive : mesh->primitives)
            checkPrimitive(primitive, scene.materials.size());
    }
    for (const auto& node : scene.nodes) {
        check(node.mesh < static_cast<int>(scene.meshes.size()));
        check(std::isfinite(node.worldFromNode[3].x));
    }
    for (const auto& light : scene.lights) {
        check(light.def >= 0 && light.def < static_cast<int>(scene.lightDefs.size()));
        check(light.node >= 0 && light.node < static_cast<int>(scene.nodes.size()));
        check(std::isfinite(scene.lightDefs[light.def].intensity));
    }
    for (const auto& material : scene.materials) {
        for (const auto* ref :
             {&material.baseColor, &material.metallicRoughness, &material.normal, &material.emissive}) {
            check(ref->image < static_cast<int>(scene.images.size()));
            check(ref->image < 0 || scene.images[ref->image]->width > 0);
        }
    }
    const kilolux::Bounds bounds = kilolux::worldBounds(scene);
    check(std::isfinite(bounds.max.x - bounds.min.x));
}

void checkAnimations(kilolux::Scene scene) {
    for (const auto& animation : scene.animations) {
        for (const auto& channel : animation->channels) {
            check(channel.node >= 0 && channel.node < static_cast<int>(scene.nodes.size()));
            check(channel.sampler >= 0 && channel.sampler < static_cast<int>(animation->samplers.size()));
        }
    }
    const double durationS = kilolux::animationDurationS(scene);
    for (const double timeS : {0.0, 0.3 * durationS, 0.5, durationS, -1e30, 1e300}) {
        kilolux::poseScene(scene, timeS);
        for (const auto& node : scene.nodes)
            check(kilolux::fitsSinglePrecision(node.worldFromNode));
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const kilolux::fuzz::InputFile file("input.gltf");
    file.write(data, size);
    const auto scene = kilolux::importGltf(file.path());
    if (scene) {
        checkScene(scene.value());
        checkAnimations(scene.value());
    } else {
        check(!scene.error().empty() && scene.error().find('\n') == std::string::npos);
    }
    return 0;
}
