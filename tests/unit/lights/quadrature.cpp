#include "tests/unit/lights/quadrature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace kilolux::test {
namespace {

// Gauss-Legendre, five points on [0, 1].
constexpr std::array<double, 5> kNodes = {0.04691007703066800, 0.23076534494715845, 0.5, 0.76923465505284155,
                                          0.95308992296933200};
constexpr std::array<double, 5> kWeights = {0.11846344252809454, 0.23931433524968324, 0.28444444444444444,
                                            0.23931433524968324, 0.11846344252809454};

// A point of the emitter as the receiver sees it.
struct Patch {
    dvec3 dir;
    double solidAngle; // per unit of parameter area
};

Patch fromPoint(const dvec3& toPoint, const dvec3& normal, double area) {
    const double distance2 = glm::dot(toPoint, toPoint);
    const dvec3 dir = toPoint / std::sqrt(distance2);
    return {dir, area * std::max(-glm::dot(normal, dir), 0.0) / distance2};
}

Patch conePatch(const dvec3& axis, double oneMinusCos, double u, double v) {
    const dvec3 side = glm::normalize(std::abs(axis.x) > 0.5 ? glm::cross(axis, dvec3(0, 1, 0))
                                                             : glm::cross(axis, dvec3(1, 0, 0)));
    const dvec3 other = glm::cross(axis, side);
    const double m = u * u * oneMinusCos; // u^2 keeps it smooth at the axis
    const double sine = std::sqrt(m * (2.0 - m));
    const double phi = 2.0 * kPi * v;
    return {axis * (1.0 - m) + side * (sine * std::cos(phi)) + other * (sine * std::sin(phi)),
            2.0 * kPi * oneMinusCos * 2.0 * u};
}

// A ring of the tube, v turning over what the receiver sees of it: normals x * along + around * ring about a
// point on the axis, `areaPerTurn` for the whole ring.
Patch ringPatch(const Emitter& e, const dvec3& toAxisPoint, double along, double ring, double areaPerTurn,
                double v) {
    const double y = -glm::dot(toAxisPoint, e.y);
    const double z = -glm::dot(toAxisPoint, e.z);
    const double side = std::max(std::hypot(y, z) * ring, 1e-9);
    const double limit =
        (e.size.x + along * glm::dot(toAxisPoint, e.x)) / side; // seen where cos(turn) is above
    const double halfTurn = std::acos(std::clamp(limit, -1.0, 1.0));
    const double phi = std::atan2(z, y) + (2.0 * v - 1.0) * halfTurn;
    const dvec3 normal = e.x * along + (e.y * std::cos(phi) + e.z * std::sin(phi)) * ring;
    return fromPoint(toAxisPoint + normal * e.size.x, normal, areaPerTurn * halfTurn / kPi);
}

Patch tubePatch(const Emitter& e, const dvec3& toCenter, double u, double v) {
    const double radius = e.size.x;
    const double halfLength = e.size.y;
    // u: a third for each end by its angle, a third for the side.
    const double part = u * 3.0;
    if (part >= 1.0 && part <= 2.0)
        return ringPatch(e, toCenter + e.x * ((2.0 * part - 3.0) * halfLength), 0.0, 1.0,
                         3.0 * 2.0 * halfLength * 2.0 * kPi * radius, v);
    const double end = part < 1.0 ? -1.0 : 1.0;
    const double angle = (part < 1.0 ? part : 3.0 - part) * 0.5 * kPi; // from the pole
    return ringPatch(e, toCenter + e.x * (end * halfLength), end * std::cos(angle), std::sin(angle),
                     3.0 * 0.5 * kPi * radius * radius * std::sin(angle) * 2.0 * kPi, v);
}

Patch patchAt(const Emitter& e, const dvec3& toCenter, double u, double v) {
    const double distance = glm::length(toCenter);
    switch (e.type) {
    case shared::LIGHT_RECT:
        return fromPoint(toCenter + e.x * ((2.0 * u - 1.0) * e.size.x) + e.y * ((2.0 * v - 1.0) * e.size.y),
                         -e.z, 4.0 * e.size.x * e.size.y);
    case shared::LIGHT_DISK: {
        const dvec3 offset = e.x * std::cos(2.0 * kPi * v) + e.y * std::sin(2.0 * kPi * v);
        return fromPoint(toCenter + offset * (u * e.size.x), -e.z, 2.0 * kPi * u * e.size.x * e.size.x);
    }
    case shared::LIGHT_TUBE:
        return tubePatch(e, toCenter, u, v);
    case shared::LIGHT_DIRECTIONAL: {
        const double cosine = 1.0 / std::sqrt(1.0 + e.size.x * e.size.x);
        return conePatch(e.z, e.size.x * e.size.x * cosine * cosine / (1.0 + cosine), u, v);
    }
    default: {
        const double sine = e.size.x / distance;
        return conePatch(toCenter / distance, sine * sine / (1.0 + std::sqrt(1.0 - sine * sine)), u, v);
    }
    }
}

struct Integrator {
    const Emitter& emitter;
    const Surface& surface;
    dvec3 toCenter;
    dvec3 mirror;
    double alpha;
    double tolerance;

    Reflected cell(double u0, double v0, double du, double dv) const {
        Reflected sum;
        for (int i = 0; i < 5; ++i)
            for (int j = 0; j < 5; ++j) {
                const Patch patch = patchAt(emitter, toCenter, u0 + du * kNodes[i], v0 + dv * kNodes[j]);
                const double weight = patch.solidAngle * kWeights[i] * kWeights[j] * du * dv;
                const dvec2 ggx = referenceGgx(surface, patch.dir);
                sum.diffuse += weight * std::max(glm::dot(patch.dir, surface.normal), 0.0);
                sum.specular += dvec2(1.0 - ggx.y, ggx.y) * (ggx.x * weight);
            }
        return sum;
    }

    // Whether the cell is small against the lobe where it lies.
    bool resolves(double u0, double v0, double du, double dv) const {
        const dvec3 middle = patchAt(emitter, toCenter, u0 + du * 0.5, v0 + dv * 0.5).dir;
        double size = 0.0;
        for (int corner = 0; corner < 4; ++corner)
            size = std::max(
                size,
                glm::length(patchAt(emitter, toCenter, u0 + du * (corner & 1), v0 + dv * (corner >> 1)).dir -
                            middle));
        return size < 0.5 * (alpha + std::max(0.0, glm::length(middle - mirror) - size));
    }

    Reflected refine(const Reflected& coarse, double u0, double v0, double du, double dv, int depth) const {
        std::array<Reflected, 4> quarter;
        Reflected sum;
        const double hu = du * 0.5;
        const double hv = dv * 0.5;
        for (int i = 0; i < 4; ++i) {
            quarter[i] = cell(u0 + hu * (i & 1), v0 + hv * (i >> 1), hu, hv);
            sum.diffuse += quarter[i].diffuse;
            sum.specular += quarter[i].specular;
        }
        const dvec2 change = sum.specular - coarse.specular;
        const double error =
            std::max({std::abs(change.x), std::abs(change.y), std::abs(sum.diffuse - coarse.diffuse) * 0.3});
        if (depth >= 11 ||
            (depth >= 2 && error < tolerance * std::pow(0.5, 0.5 * depth) && resolves(u0, v0, du, dv)))
            return sum;
        sum = {};
        for (int i = 0; i < 4; ++i) {
            const Reflected part =
                refine(quarter[i], u0 + hu * (i & 1), v0 + hv * (i >> 1), hu, hv, depth + 1);
            sum.diffuse += part.diffuse;
            sum.specular += part.specular;
        }
        return sum;
    }
};

} // namespace

dvec2 referenceGgx(const Surface& surface, const dvec3& lightDir) {
    const double noL = glm::dot(surface.normal, lightDir);
    const double noV = glm::dot(surface.normal, surface.view);
    if (noL <= 0.0) return dvec2(0.0);
    const double a2 = std::pow(surface.roughness, 4.0);
    const dvec3 half = glm::normalize(lightDir + surface.view);
    const double noH = glm::dot(surface.normal, half);
    const dvec3 across = glm::cross(surface.normal, half);
    const double d = a2 / (kPi * std::pow(noH * noH * a2 + glm::dot(across, across), 2.0));
    const auto lambda = [&](double cosine) {
        return 0.5 * (std::sqrt(1.0 + a2 * (1.0 / (cosine * cosine) - 1.0)) - 1.0);
    };
    const double g = 1.0 / (1.0 + lambda(noV) + lambda(noL));
    return {d * g / (4.0 * noV), std::pow(1.0 - glm::dot(half, lightDir), 5.0)};
}

Reflected integrate(const Emitter& emitter, const Surface& surface) {
    const dvec3 mirror = 2.0 * glm::dot(surface.normal, surface.view) * surface.normal - surface.view;
    Integrator integrator{
        emitter, surface, emitter.center - surface.position, mirror, surface.roughness * surface.roughness,
        0.0};
    if (emitter.type == shared::LIGHT_DIRECTIONAL) integrator.toCenter = emitter.z;
    // Two rounds: the first finds the size of the value. In thirds, so that no cell holds a seam of the tube.
    Reflected sum;
    for (const double tolerance : {1e-3, 1e-4}) {
        const double value = std::max({sum.specular.x + sum.specular.y, 0.2 * sum.diffuse, 1e-12});
        integrator.tolerance = tolerance == 1e-3 ? tolerance : tolerance * value;
        sum = {};
        for (int third = 0; third < 3; ++third) {
            const Reflected coarse = integrator.cell(third / 3.0, 0.0, 1.0 / 3.0, 1.0);
            const Reflected part = integrator.refine(coarse, third / 3.0, 0.0, 1.0 / 3.0, 1.0, 0);
            sum.diffuse += part.diffuse;
            sum.specular += part.specular;
        }
    }
    return sum;
}

double lobePeak(const Surface& surface, double f0) {
    const dvec3 tangent = glm::normalize(
        surface.view - surface.normal * glm::dot(surface.view, surface.normal) + dvec3(1e-12, 0.0, 0.0));
    const double mirrorAngle = -std::acos(std::min(glm::dot(surface.view, surface.normal), 1.0));
    const double alpha = surface.roughness * surface.roughness;
    double peak = 0.0;
    for (int i = -400; i <= 400; ++i) {
        const double angle = mirrorAngle + alpha * i * 0.01;
        const dvec3 dir = surface.normal * std::cos(angle) + tangent * std::sin(angle);
        const dvec2 ggx = referenceGgx(surface, dir);
        peak = std::max(peak, ggx.x * (f0 + (1.0 - f0) * ggx.y));
    }
    return peak;
}

shared::LightHot hotRecord(const Emitter& emitter, const glm::vec3& intensity) {
    shared::LightHot light{};
    light.positionWs = glm::vec3(emitter.center);
    light.dirWs = glm::vec3(-emitter.z);
    light.tangentOct = f64::packOct16(emitter.x);
    light.intensity = intensity;
    light.typeFlags = emitter.type;
    light.sizeM = glm::vec2(emitter.size);
    if (emitter.type == shared::LIGHT_SPOT) light.shaping = {1.0f, 2.0f}; // open on all sides
    return light;
}

Emitter emitterOf(const f64::LightHot& light) {
    const glm::dmat3 frame = f64::lightFrame(light);
    return {light.typeFlags & shared::LIGHT_TYPE_MASK,
            light.positionWs,
            frame[0],
            frame[1],
            frame[2],
            light.sizeM};
}

std::string describe(const Emitter& e, const Surface& s) {
    char text[400];
    std::snprintf(
        text, sizeof(text),
        "center (%.4f %.4f %.4f) x (%.3f %.3f %.3f) z (%.3f %.3f %.3f) size (%.4f %.4f); surface at 0, "
        "normal (0 0 1), view (%.3f %.3f %.3f), roughness %.3f",
        e.center.x, e.center.y, e.center.z, e.x.x, e.x.y, e.x.z, e.z.x, e.z.y, e.z.z, e.size.x, e.size.y,
        s.view.x, s.view.y, s.view.z, s.roughness);
    return text;
}

} // namespace kilolux::test
