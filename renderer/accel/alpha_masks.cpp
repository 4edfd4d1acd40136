// Gathers alpha channels, records and corner attributes; images and primitives that are shared are stored
// once.
#include "renderer/accel/alpha_masks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace kilolux {

namespace {

using namespace shared;

std::uint8_t toUnorm8(float value) {
    return std::uint8_t(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
}

std::uint32_t wrapBits(WrapMode mode) {
    switch (mode) {
    case WrapMode::ClampToEdge:
        return ALPHA_WRAP_CLAMP;
    case WrapMode::MirroredRepeat:
        return ALPHA_WRAP_MIRROR;
    case WrapMode::Repeat:
        break;
    }
    return ALPHA_WRAP_REPEAT;
}

class Builder {
  public:
    Builder(const Scene& scene, AlphaMasks& masks) : scene_(scene), masks_(masks) {}

    std::uint32_t recordOf(const Instance& instance) {
        if (instance.role != SurfaceRole::AlphaTested) return ALPHA_RECORD_NONE;
        const auto key = std::make_pair(instance.mesh, instance.primitive);
        const auto known = records_.find(key);
        if (known != records_.end()) return known->second;
        const std::uint32_t index = std::uint32_t(masks_.records.size());
        masks_.records.push_back(
            makeRecord(scene_.materials[instance.material], primitiveOf(scene_, instance)));
        records_[key] = index;
        return index;
    }

  private:
    AlphaRecord makeRecord(const Material& material, const Primitive& primitive) {
        const TextureRef& texture = material.baseColor;
        AlphaRecord record{};
        record.factor = float(material.baseColorFactor.a);
        record.cutoff = float(alphaCutoff(material));
        record.uvRow0 = glm::vec3(1.0f, 0.0f, 0.0f);
        record.uvRow1 = glm::vec3(0.0f, 1.0f, 0.0f);
        if (texture.image >= 0 && texture.image < int(scene_.images.size()) && scene_.images[texture.image]) {
            const Image& image = *scene_.images[texture.image];
            record.firstTexel = firstTexelOf(texture.image);
            record.width = std::uint32_t(image.width);
            record.height = std::uint32_t(image.height);
            record.flags = wrapBits(texture.wrapS) | wrapBits(texture.wrapT) << ALPHA_WRAP_T_SHIFT |
                           (texture.nearestFilter ? ALPHA_FLAG_NEAREST : 0u);
            // KHR_texture_transform: offset + rotation * scale * uv, the rotation turning uv clockwise.
            const double c = std::cos(texture.rotationRad), s = std::sin(texture.rotationRad);
            record.uvRow0 = glm::vec3(glm::dvec3(c * texture.scale.x, s * texture.scale.y, texture.offset.x));
            record.uvRow1 =
                glm::vec3(glm::dvec3(-s * texture.scale.x, c * texture.scale.y, texture.offset.y));
        }
        record.firstTriangle = std::uint32_t(masks_.triangles.size());
        appendTriangles(primitive, texture.texCoord == 1 ? primitive.uv1 : primitive.uv0);
        return record;
    }

    void appendTriangles(const Primitive& primitive, const std::vector<glm::vec2>& uvs) {
        for (std::size_t first = 0; first + 2 < primitive.indices.size(); first += 3) {
            glm::vec2 uv[3];
            AlphaTriangle triangle{};
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const std::uint32_t vertex = primitive.indices[first + corner];
                uv[corner] = vertex < uvs.size() ? uvs[vertex] : glm::vec2(0.0f);
                const float alpha = vertex < primitive.colors.size() ? primitive.colors[vertex].a : 1.0f;
                triangle.alpha8x3 |= std::uint32_t(toUnorm8(alpha)) << (8 * corner);
            }
            triangle.uv0 = uv[0];
            triangle.uv1 = uv[1];
            triangle.uv2 = uv[2];
            masks_.triangles.push_back(triangle);
        }
    }

    std::uint32_t firstTexelOf(int imageIndex) {
        const auto known = firstTexels_.find(imageIndex);
        if (known != firstTexels_.end()) return known->second;
        const Image& image = *scene_.images[imageIndex];
        const std::uint32_t first = std::uint32_t(masks_.texels.size());
        const std::size_t count = std::size_t(image.width) * std::size_t(image.height);
        masks_.texels.reserve(masks_.texels.size() + count);
        for (std::size_t texel = 0; texel < count; ++texel)
            masks_.texels.push_back(image.rgba8.empty() ? toUnorm8(image.rgbaF32[texel * 4 + 3])
                                                        : image.rgba8[texel * 4 + 3]);
        firstTexels_[imageIndex] = first;
        return first;
    }

    const Scene& scene_;
    AlphaMasks& masks_;
    std::map<std::pair<int, int>, std::uint32_t> records_;
    std::map<int, std::uint32_t> firstTexels_;
};

} // namespace

AlphaMasks buildAlphaMasks(const Scene& scene, const std::vector<Instance>& instances) {
    AlphaMasks masks;
    Builder builder(scene, masks);
    masks.recordOfInstance.reserve(instances.size());
    for (const Instance& instance : instances)
        masks.recordOfInstance.push_back(builder.recordOf(instance));
    return masks;
}

} // namespace kilolux
