// Texture lookups and material values of the oracle (glTF 2.0, sections 3.8 and 3.9; KHR_texture_transform).
#include "renderer/reference/oracle_material.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace kilolux::oracle {

namespace {

using glm::dvec2;
using glm::dvec3;
using glm::dvec4;

double decodeSrgb(double value) {
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

const std::array<double, 256>& srgbTable() {
    static const std::array<double, 256> table = [] {
        std::array<double, 256> values{};
        for (int i = 0; i < 256; ++i)
            values[i] = decodeSrgb(i / 255.0);
        return values;
    }();
    return table;
}

int wrapTexel(long long texel, int size, WrapMode mode) {
    if (mode == WrapMode::ClampToEdge) return static_cast<int>(std::clamp<long long>(texel, 0, size - 1));
    const long long period = mode == WrapMode::Repeat ? size : 2ll * size;
    const long long inside = ((texel % period) + period) % period;
    return static_cast<int>(inside < size ? inside : period - 1 - inside);
}

dvec4 texelAt(const Image& image, ColorSpace space, int x, int y) {
    const std::size_t at = (static_cast<std::size_t>(y) * image.width + x) * 4;
    if (!image.rgbaF32.empty()) // floating-point images hold linear values whatever their use
        return {image.rgbaF32[at], image.rgbaF32[at + 1], image.rgbaF32[at + 2], image.rgbaF32[at + 3]};
    const std::uint8_t* p = image.rgba8.data() + at;
    const double alpha = p[3] / 255.0;
    if (space == ColorSpace::Linear) return {p[0] / 255.0, p[1] / 255.0, p[2] / 255.0, alpha};
    const auto& table = srgbTable();
    return {table[p[0]], table[p[1]], table[p[2]], alpha};
}

// uv' = offset + R S uv with the rotation that turns the picture clockwise, v running down (the extension's
// example: the lower left quadrant, offset (0,1), rotation pi/2, scale 1/2).
dvec2 transformUv(const TextureRef& texture, const dvec2& uv) {
    const dvec2 scaled = uv * texture.scale;
    const double c = std::cos(texture.rotationRad);
    const double s = std::sin(texture.rotationRad);
    return texture.offset + dvec2(c * scaled.x + s * scaled.y, c * scaled.y - s * scaled.x);
}

template<typename T>
auto weighted(const std::vector<T>& values, const std::uint32_t* corner, const dvec3& w) {
    using D = glm::vec<T::length(), double>;
    return D(values[corner[0]]) * w.x + D(values[corner[1]]) * w.y + D(values[corner[2]]) * w.z;
}

} // namespace

SurfaceSample interpolate(const Primitive& primitive, std::uint32_t triangle, const dvec3& weights,
                          const dvec3& faceNormal) {
    const std::uint32_t* corner = primitive.indices.data() + 3 * static_cast<std::size_t>(triangle);
    SurfaceSample sample;
    sample.uv[0] = primitive.uv0.empty() ? dvec2(0.0) : weighted(primitive.uv0, corner, weights);
    sample.uv[1] = primitive.uv1.empty() ? dvec2(0.0) : weighted(primitive.uv1, corner, weights);
    if (!primitive.colors.empty()) sample.color = weighted(primitive.colors, corner, weights);
    const dvec3 normal =
        primitive.normals.empty() ? faceNormal : weighted(primitive.normals, corner, weights);
    const double length = glm::length(normal);
    sample.normal = length > 0.0 ? normal / length : faceNormal;
    if (!primitive.tangents.empty()) {
        sample.tangent = weighted(primitive.tangents, corner, weights);
        sample.tangent.w = primitive.tangents[corner[0]].w < 0.0f ? -1.0 : 1.0;
    }
    return sample;
}

MaterialReader::MaterialReader(std::vector<Material> materials,
                               std::vector<std::shared_ptr<const Image>> images)
    : materials_(std::move(materials)), images_(std::move(images)) {}

const Material& MaterialReader::material(int index) const {
    return index < 0 || index >= static_cast<int>(materials_.size()) ? default_ : materials_[index];
}

bool MaterialReader::isDrawnLater(int index) const {
    const Material& m = material(index);
    const double opacity = m.alphaMode == AlphaMode::Blend ? m.baseColorFactor.a : 1.0;
    return opacity * (1.0 - m.transmission) < kOpaqueFrom;
}

dvec4 MaterialReader::read(const TextureRef& texture, ColorSpace space, const SurfaceSample& at) const {
    if (texture.image < 0 || texture.image >= static_cast<int>(images_.size()) || !images_[texture.image])
        return dvec4(1.0);
    const Image& image = *images_[texture.image];
    if (image.width <= 0 || image.height <= 0) return dvec4(1.0);
    const dvec2 uv = transformUv(texture, at.uv[texture.texCoord == 1 ? 1 : 0]);
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) return dvec4(1.0);
    const auto fetch = [&](double x, double y) {
        return texelAt(image, space, wrapTexel(static_cast<long long>(x), image.width, texture.wrapS),
                       wrapTexel(static_cast<long long>(y), image.height, texture.wrapT));
    };
    if (texture.nearestFilter) return fetch(std::floor(uv.x * image.width), std::floor(uv.y * image.height));
    const double x = uv.x * image.width - 0.5;
    const double y = uv.y * image.height - 0.5;
    const double x0 = std::floor(x);
    const double y0 = std::floor(y);
    const dvec4 top = glm::mix(fetch(x0, y0), fetch(x0 + 1.0, y0), x - x0);
    const dvec4 bottom = glm::mix(fetch(x0, y0 + 1.0), fetch(x0 + 1.0, y0 + 1.0), x - x0);
    return glm::mix(top, bottom, y - y0);
}

double MaterialReader::alpha(int index, const SurfaceSample& at) const {
    const Material& m = material(index);
    return m.baseColorFactor.a * at.color.a * read(m.baseColor, ColorSpace::Srgb, at).a;
}

MaterialValue MaterialReader::evaluate(int index, const SurfaceSample& at) const {
    const Material& m = material(index);
    const dvec4 base = m.baseColorFactor * at.color * read(m.baseColor, ColorSpace::Srgb, at);
    const dvec4 packed = read(m.metallicRoughness, ColorSpace::Linear, at);
    MaterialValue value;
    value.baseColor = dvec3(base);
    value.alpha = base.a;
    value.metallic = m.metallicFactor * packed.b;
    value.roughness = m.roughnessFactor * packed.g;
    value.emissionNit = m.emissiveNit * dvec3(read(m.emissive, ColorSpace::Srgb, at));
    value.tangentNormal = dvec3(0.0, 0.0, 1.0);
    if (m.normal.image >= 0) {
        dvec3 n = dvec3(read(m.normal, ColorSpace::Linear, at)) * 2.0 - 1.0;
        n.x *= m.normalScale;
        n.y *= m.normalScale;
        const double length = glm::length(n);
        if (length > 0.0) value.tangentNormal = n / length;
    }
    return value;
}

} // namespace kilolux::oracle
