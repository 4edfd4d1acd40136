// The oracle's BRDF: Lambert plus GGX (Walter et al. 2007, section 5.2) with the height-correlated Smith term
// (Heitz 2014, section 5.3) and Schlick's Fresnel (1994) with F90 = 1. The specular value is kept as two
// colourless parts so that one integral serves all three channels: rgb = F0 * first + second.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace kilolux::oracle {

inline constexpr double kMinRoughness = 0.05;
inline constexpr double kMinNoV = 1e-4;

struct LobeValue {
    double noL = 0.0;         // clamped cosine: the diffuse integrand
    double specularF0 = 0.0;  // D Vis (1 - k) NoL
    double specularOne = 0.0; // D Vis k NoL
};

struct Lobe {
    glm::dvec3 normal;
    glm::dvec3 view;
    double alpha;
    double noV;

    Lobe(const glm::dvec3& normalWs, const glm::dvec3& viewWs, double roughness)
        : normal(normalWs), view(viewWs),
          alpha(std::max(roughness, kMinRoughness) * std::max(roughness, kMinRoughness)),
          noV(std::max(glm::dot(normalWs, viewWs), kMinNoV)) {}

    LobeValue operator()(const glm::dvec3& lightDir) const {
        LobeValue value;
        value.noL = glm::dot(normal, lightDir);
        if (value.noL <= 0.0) return {};
        const glm::dvec3 sum = view + lightDir;
        const double sumLength = glm::length(sum);
        if (sumLength <= 0.0) return value;
        const glm::dvec3 half = sum / sumLength;
        const double a2 = alpha * alpha;
        // sin^2 by the cross product: 1 - cos^2 loses the digits that a narrow lobe lives on.
        const glm::dvec3 cross = glm::cross(normal, half);
        const double sin2 = glm::dot(cross, cross);
        const double noH = glm::dot(normal, half);
        const double denominator = noH * noH * a2 + sin2;
        const double d = noH > 0.0 ? a2 / (3.14159265358979323846 * denominator * denominator) : 0.0;
        const double smithV = value.noL * std::sqrt(noV * noV * (1.0 - a2) + a2);
        const double smithL = noV * std::sqrt(value.noL * value.noL * (1.0 - a2) + a2);
        const double voH = std::clamp(glm::dot(view, half), 0.0, 1.0);
        const double k = std::pow(1.0 - voH, 5.0);
        const double common = d * 0.5 / (smithV + smithL) * value.noL;
        value.specularF0 = common * (1.0 - k);
        value.specularOne = common * k;
        return value;
    }
};

} // namespace kilolux::oracle
