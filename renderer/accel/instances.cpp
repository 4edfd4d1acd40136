// Enumerates instances and decides which surfaces stop rays.
#include "renderer/accel/instances.h"

#include <algorithm>

namespace kilolux {

namespace {

// The whole image's alpha is 255: a mask that can never fail.
bool isOpaque(const Image& image) {
    for (std::size_t texel = 0; texel * 4 < image.rgba8.size(); ++texel)
        if (image.rgba8[texel * 4 + 3] != 255) return false;
    for (std::size_t texel = 0; texel * 4 < image.rgbaF32.size(); ++texel)
        if (image.rgbaF32[texel * 4 + 3] < 1.0f) return false;
    return true;
}

bool hasVaryingAlpha(const Scene& scene, const Material& material, const Primitive& primitive) {
    const int image = material.baseColor.image;
    if (image >= 0 && image < int(scene.images.size()) && scene.images[image] &&
        !isOpaque(*scene.images[image]))
        return true;
    return std::any_of(primitive.colors.begin(), primitive.colors.end(),
                       [](const glm::vec4& color) { return color.a < 1.0f; });
}

} // namespace

bool castsShadow(const Material& material) {
    const double coverage = material.alphaMode == AlphaMode::Blend ? material.baseColorFactor.a : 1.0;
    return coverage * (1.0 - material.transmission) >= 0.5;
}

double alphaCutoff(const Material& material) {
    return material.alphaMode == AlphaMode::Mask ? material.alphaCutoff : 0.5;
}

SurfaceRole surfaceRole(const Scene& scene, const Primitive& primitive) {
    if (primitive.material < 0 || primitive.material >= int(scene.materials.size()))
        return SurfaceRole::Opaque;
    const Material& material = scene.materials[primitive.material];
    if (!castsShadow(material)) return SurfaceRole::Absent;
    if (material.alphaMode == AlphaMode::Opaque) return SurfaceRole::Opaque;
    if (hasVaryingAlpha(scene, material, primitive)) return SurfaceRole::AlphaTested;
    return material.baseColorFactor.a >= alphaCutoff(material) ? SurfaceRole::Opaque : SurfaceRole::Absent;
}

const Primitive& primitiveOf(const Scene& scene, const Instance& instance) {
    return scene.meshes[instance.mesh]->primitives[instance.primitive];
}

std::vector<Instance> enumerateInstances(const Scene& scene) {
    // Roles depend on the primitive alone, and scanning an image's alpha is slow: once per primitive.
    std::vector<std::vector<SurfaceRole>> roles(scene.meshes.size());
    std::vector<Instance> instances;
    std::uint32_t firstTriangle = 0;
    for (std::size_t node = 0; node < scene.nodes.size(); ++node) {
        const int mesh = scene.nodes[node].mesh;
        if (!scene.nodes[node].visible || mesh < 0 || mesh >= int(scene.meshes.size()) || !scene.meshes[mesh])
            continue;
        const std::vector<Primitive>& primitives = scene.meshes[mesh]->primitives;
        if (roles[mesh].empty())
            for (const Primitive& primitive : primitives)
                roles[mesh].push_back(surfaceRole(scene, primitive));
        for (std::size_t index = 0; index < primitives.size(); ++index) {
            Instance instance;
            instance.node = int(node);
            instance.mesh = mesh;
            instance.primitive = int(index);
            instance.material = primitives[index].material;
            instance.worldFromLocal = scene.nodes[node].worldFromNode;
            instance.triangleCount = std::uint32_t(primitives[index].indices.size() / 3);
            instance.firstTriangle = firstTriangle;
            instance.role = roles[mesh][index];
            firstTriangle += instance.triangleCount;
            instances.push_back(instance);
        }
    }
    return instances;
}

} // namespace kilolux
