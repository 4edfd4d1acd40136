// Terms that the estimators of lights and of the dome share: what a material makes of light, and the standard
// error of replicas.
#pragma once

#include "renderer/reference/oracle.h"

#include <array>

namespace kilolux::oracle {

inline constexpr int kReplicas = 8; // independently shifted point sets: they give the standard error

// Of linear Rec. 709, in the unit of `rgb`.
inline double luminanceOf(const glm::dvec3& rgb) {
    return glm::dot(rgb, glm::dvec3(0.2126, 0.7152, 0.0722));
}

// Reflectance at normal incidence: 4 % for dielectrics (glTF 2.0, appendix B), the base colour for metals.
inline glm::dvec3 f0Of(const PointMaterial& material) {
    constexpr double kDielectricF0 = 0.04;
    return glm::mix(glm::dvec3(kDielectricF0), material.baseColor, material.metallic);
}

inline glm::dvec3 diffuseAlbedoOf(const PointMaterial& material) {
    return material.baseColor * (1.0 - material.metallic);
}

// Of `mean`, the replicas' mean, per channel and in their unit.
inline glm::dvec3 standardErrorOf(const std::array<glm::dvec3, kReplicas>& replicas, const glm::dvec3& mean) {
    glm::dvec3 squares(0.0);
    for (const glm::dvec3& one : replicas)
        squares += (one - mean) * (one - mean);
    return glm::sqrt(squares / (kReplicas * (kReplicas - 1.0)));
}

} // namespace kilolux::oracle
