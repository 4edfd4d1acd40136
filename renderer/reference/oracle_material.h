// Materials of the oracle: textures read at base level with bilinear (or nearest) filtering in double
// precision, sRGB decoded per texel, KHR_texture_transform and wrap modes applied per use.
#pragma once

#include "renderer/document/scene.h"

namespace kilolux::oracle {

// What a primitive's attributes give at a point of a triangle; barycentric weights of its three corners.
struct SurfaceSample {
    glm::dvec2 uv[2];
    glm::dvec4 color{1.0};
    glm::dvec3 normal{0.0, 1.0, 0.0}; // object space, unit
    glm::dvec4 tangent{0.0};          // object space; 0 where the primitive has none
};

SurfaceSample interpolate(const Primitive& primitive, std::uint32_t triangle, const glm::dvec3& weights,
                          const glm::dvec3& faceNormal);

struct MaterialValue {
    glm::dvec3 baseColor;
    double alpha;
    double metallic;
    double roughness;
    glm::dvec3 emissionNit;
    glm::dvec3 tangentNormal; // of the normal map, unit; (0,0,1) without
};

class MaterialReader {
  public:
    MaterialReader(std::vector<Material> materials, std::vector<std::shared_ptr<const Image>> images);

    static constexpr double kOpaqueFrom = 0.5; // blended surfaces below this opacity are drawn later

    const Material& material(int index) const; // -1: glTF's default material
    // The whole surface is neither seen nor does it shade. (A blend texture decides point by point.)
    bool isDrawnLater(int index) const;
    double alpha(int index, const SurfaceSample& at) const;
    MaterialValue evaluate(int index, const SurfaceSample& at) const;

  private:
    glm::dvec4 read(const TextureRef& texture, ColorSpace space, const SurfaceSample& at) const;

    std::vector<Material> materials_;
    std::vector<std::shared_ptr<const Image>> images_;
    Material default_;
};

} // namespace kilolux::oracle
