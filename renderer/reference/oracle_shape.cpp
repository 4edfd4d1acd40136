#include "renderer/reference/oracle_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kilolux::oracle {

using glm::dvec3;

constexpr double kMinTubeRadiusM = 1e-4;

void takeSize(OracleLight& light, const LightDef& def) {
    switch (def.type) {
    case LightType::Directional:
        light.angularRadiusRad = 0.5 * def.angularDiameterRad;
        break;
    case LightType::Tube:
        light.radiusM = std::max(def.radiusM, kMinTubeRadiusM);
        light.halfLengthM = 0.5 * def.lengthM;
        break;
    case LightType::Rect:
        light.halfWidthM = 0.5 * def.widthM;
        light.halfHeightM = 0.5 * def.heightM;
        break;
    case LightType::Disk:
        light.radiusM = 0.5 * def.widthM;
        break;
    case LightType::Sphere:
    case LightType::Spot:
        light.radiusM = def.radiusM;
        break;
    }
}

bool isFlat(const OracleLight& light) {
    return light.type == LightType::Rect || light.type == LightType::Disk;
}

double projectedAreaM2(const OracleLight& light) {
    switch (light.type) {
    case LightType::Rect:
        return 4.0 * light.halfWidthM * light.halfHeightM;
    case LightType::Tube:
        return 4.0 * light.radiusM * light.halfLengthM + kPi * light.radiusM * light.radiusM;
    default:
        return kPi * light.radiusM * light.radiusM;
    }
}

double emittingAreaM2(const OracleLight& light) {
    switch (light.type) {
    case LightType::Rect:
    case LightType::Disk:
        return projectedAreaM2(light);
    case LightType::Tube:
        return 4.0 * kPi * light.radiusM * light.halfLengthM + 4.0 * kPi * light.radiusM * light.radiusM;
    default:
        return 4.0 * kPi * light.radiusM * light.radiusM;
    }
}

namespace {

double sign(double x) {
    return x > 0.0 ? 1.0 : (x < 0.0 ? -1.0 : 0.0);
}

} // namespace

dvec3 supportPoint(const OracleLight& light, const dvec3& n) {
    switch (light.type) {
    case LightType::Rect:
        return light.xWs * (sign(glm::dot(n, light.xWs)) * light.halfWidthM) +
               light.yWs * (sign(glm::dot(n, light.yWs)) * light.halfHeightM);
    case LightType::Disk: {
        const dvec3 inPlane = n - light.dirWs * glm::dot(n, light.dirWs);
        const double length = glm::length(inPlane);
        return length > 0.0 ? inPlane * (light.radiusM / length) : dvec3(0.0);
    }
    case LightType::Tube:
        return light.xWs * (sign(glm::dot(n, light.xWs)) * light.halfLengthM) + n * light.radiusM;
    case LightType::Directional:
        return n * std::sin(light.angularRadiusRad); // a ball of that radius at distance 1
    default:
        return n * light.radiusM;
    }
}

bool receiverSeesSurface(const OracleLight& light, const dvec3& toCenter) {
    switch (light.type) {
    case LightType::Directional:
        return true;
    case LightType::Rect:
    case LightType::Disk:
        return glm::dot(light.dirWs, toCenter) < 0.0;
    case LightType::Tube: {
        const double along =
            std::clamp(glm::dot(-toCenter, light.xWs), -light.halfLengthM, light.halfLengthM);
        return glm::length(toCenter + light.xWs * along) > light.radiusM;
    }
    default:
        return glm::length(toCenter) > light.radiusM;
    }
}

double distanceTo(const OracleLight& light, const dvec3& receiverWs, const dvec3& directionWs) {
    const dvec3 toCenter = light.centerWs - receiverWs;
    const auto toBall = [&](const dvec3& center) {
        const double along = glm::dot(center, directionWs);
        const dvec3 across = center - directionWs * along;
        const double chord2 = light.radiusM * light.radiusM - glm::dot(across, across);
        return chord2 < 0.0 ? std::numeric_limits<double>::infinity() : along - std::sqrt(chord2);
    };
    switch (light.type) {
    case LightType::Directional:
        return std::numeric_limits<double>::infinity();
    case LightType::Rect:
    case LightType::Disk:
        return glm::dot(light.dirWs, toCenter) / glm::dot(light.dirWs, directionWs);
    case LightType::Tube:
        break;
    default:
        return std::min(toBall(toCenter), glm::length(toCenter));
    }
    // Capsule: the cylinder where it is met between the end centres, else the nearer end ball.
    const dvec3 across = directionWs - light.xWs * glm::dot(directionWs, light.xWs);
    const dvec3 centerAcross = toCenter - light.xWs * glm::dot(toCenter, light.xWs);
    const double a = glm::dot(across, across);
    const double b = glm::dot(across, centerAcross);
    const double c = glm::dot(centerAcross, centerAcross) - light.radiusM * light.radiusM;
    if (a > 0.0 && b * b - a * c >= 0.0) {
        const double t = (b - std::sqrt(b * b - a * c)) / a;
        if (t > 0.0 && std::abs(glm::dot(directionWs * t - toCenter, light.xWs)) <= light.halfLengthM)
            return t;
    }
    const dvec3 half = light.xWs * light.halfLengthM;
    return std::min({toBall(toCenter - half), toBall(toCenter + half), glm::length(toCenter)});
}

SourcePoint sampleSource(const OracleLight& light, const dvec3& receiverWs, double u, double v) {
    const double phi = 2.0 * kPi * u;
    const dvec3 toCenter = light.centerWs - receiverWs;
    dvec3 offset(0.0);
    dvec3 outward = light.dirWs;
    switch (light.type) {
    case LightType::Directional: {
        const double r = std::tan(light.angularRadiusRad) * std::sqrt(v);
        const dvec3 to = -light.dirWs + light.xWs * (r * std::cos(phi)) + light.yWs * (r * std::sin(phi));
        return {glm::normalize(to), std::numeric_limits<double>::infinity(), true};
    }
    case LightType::Rect:
        offset = light.xWs * ((2.0 * u - 1.0) * light.halfWidthM) +
                 light.yWs * ((2.0 * v - 1.0) * light.halfHeightM);
        break;
    case LightType::Disk: {
        const double r = light.radiusM * std::sqrt(v);
        offset = light.xWs * (r * std::cos(phi)) + light.yWs * (r * std::sin(phi));
        break;
    }
    case LightType::Tube: {
        // Equal areas: the two half balls as one sphere (share r / (r + h)), the cylinder for the rest.
        const double ballShare = light.radiusM / (light.radiusM + light.halfLengthM);
        const dvec3 y = light.yWs;
        const dvec3 z = -light.dirWs;
        if (v < ballShare) {
            const double cosTheta = 1.0 - 2.0 * v / ballShare;
            const double sinTheta = std::sqrt(std::max(1.0 - cosTheta * cosTheta, 0.0));
            outward = light.xWs * cosTheta + (y * std::cos(phi) + z * std::sin(phi)) * sinTheta;
            offset = outward * light.radiusM + light.xWs * std::copysign(light.halfLengthM, cosTheta);
        } else {
            const double along = 2.0 * (v - ballShare) / (1.0 - ballShare) - 1.0;
            outward = y * std::cos(phi) + z * std::sin(phi);
            offset = outward * light.radiusM + light.xWs * (along * light.halfLengthM);
        }
        break;
    }
    case LightType::Sphere:
    case LightType::Spot: {
        // The cap that the receiver sees: cos from r/d to 1 about the direction to it.
        const double distanceM = glm::length(toCenter);
        const dvec3 axis = -toCenter / distanceM;
        const double cosTheta = 1.0 - v * (1.0 - std::min(light.radiusM / distanceM, 1.0));
        const double sinTheta = std::sqrt(std::max(1.0 - cosTheta * cosTheta, 0.0));
        const dvec3 other = std::abs(axis.x) < 0.6 ? dvec3(1.0, 0.0, 0.0) : dvec3(0.0, 1.0, 0.0);
        const dvec3 x = glm::normalize(glm::cross(other, axis));
        outward = axis * cosTheta + (x * std::cos(phi) + glm::cross(axis, x) * std::sin(phi)) * sinTheta;
        offset = outward * light.radiusM;
        break;
    }
    }
    const dvec3 to = toCenter + offset;
    const double distanceM = glm::length(to);
    return {to / distanceM, distanceM, glm::dot(outward, to) < 0.0};
}

} // namespace kilolux::oracle
