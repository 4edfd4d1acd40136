// Photometry of the oracle (sizes are world metres, the importer has applied a node's scale): typed intensity
// -> candela, lux, nit for Lambert emitters, and far-field shaping. Flux of a convex Lambert body is pi L A
// (A all of its emitting surface); its intensity towards a direction is L times the area it projects to that
// direction.
#include "renderer/reference/oracle_light.h"

#include "renderer/document/light_units.h"

#include <algorithm>
#include <cmath>

namespace kilolux::oracle {

namespace {

constexpr double kMinConeCosDifference = 0.001; // KHR_lights_punctual's guard for inner = outer
constexpr double kMinTubeRadiusM = 1e-4;

double square(double x) {
    return x * x;
}

// Area that the light shows to a viewer on its axis (tube: square to its axis), m2.
double projectedAreaM2(const OracleLight& light) {
    switch (light.type) {
    case LightType::Rect:
        return 4.0 * light.halfWidthM * light.halfHeightM;
    case LightType::Tube:
        return 4.0 * light.radiusM * light.halfLengthM + kPi * square(light.radiusM);
    default:
        return kPi * square(light.radiusM);
    }
}

// Surface that emits, m2.
double emittingAreaM2(const OracleLight& light) {
    switch (light.type) {
    case LightType::Rect:
    case LightType::Disk:
        return projectedAreaM2(light);
    case LightType::Tube:
        return 4.0 * kPi * light.radiusM * light.halfLengthM + 4.0 * kPi * square(light.radiusM);
    default:
        return 4.0 * kPi * square(light.radiusM);
    }
}

double candelaFromLumen(const OracleLight& light, double lumen) {
    switch (light.type) {
    case LightType::Sphere:
        return lumen / (4.0 * kPi);
    case LightType::Spot:
        return lumen / coneSolidAngleSr(light.cosInner, light.cosOuter);
    default:
        return lumen / (kPi * emittingAreaM2(light)) * projectedAreaM2(light);
    }
}

// Candela on the axis; lux of a local light is what it gives at 1 m, so the same number.
double candelaOf(const OracleLight& light, const LightDef& def) {
    switch (def.unit) {
    case LightUnit::Lumen:
        return candelaFromLumen(light, def.intensity);
    case LightUnit::Nit:
        return def.intensity * projectedAreaM2(light);
    case LightUnit::Ev100:
        return 0.125 * std::exp2(def.intensity) * projectedAreaM2(light);
    case LightUnit::Candela:
    case LightUnit::Lux:
        break;
    }
    return def.intensity;
}

// Lux on a facing surface: a disk of radiance L and angular radius a gives pi sin^2(a) L.
double luxOf(const OracleLight& light, const LightDef& def) {
    const double projectedSr = kPi * square(std::sin(light.angularRadiusRad));
    if (def.unit == LightUnit::Nit) return def.intensity * projectedSr;
    if (def.unit == LightUnit::Ev100) return 0.125 * std::exp2(def.intensity) * projectedSr;
    return def.unit == LightUnit::Lux ? def.intensity : 0.0; // candela and lumen mean nothing at infinity
}

void placeLight(OracleLight& light, const glm::dmat4& worldFromNode) {
    light.centerWs = glm::dvec3(worldFromNode[3]);
    light.dirWs = glm::normalize(-glm::dvec3(worldFromNode[2]));
    const glm::dvec3 x = glm::dvec3(worldFromNode[0]);
    light.xWs = glm::normalize(x - light.dirWs * glm::dot(x, light.dirWs));
    light.yWs = glm::cross(-light.dirWs, light.xWs);
}

} // namespace

bool OracleLight::isDelta() const {
    if (type == LightType::Directional) return angularRadiusRad <= 0.0;
    return (type == LightType::Sphere || type == LightType::Spot) && radiusM <= 0.0;
}

double coneSolidAngleSr(double cosInner, double cosOuter) {
    const double width = std::max(kMinConeCosDifference, cosInner - cosOuter);
    // The ramp's square integrates to width/3; where the cone is so narrow that the ramp passes cos = 1 it is
    // cut.
    const double rampEnd = std::min(cosOuter + width, 1.0);
    const double ramp = std::pow((rampEnd - cosOuter) / width, 3.0) * width / 3.0;
    return 2.0 * kPi * (ramp + (1.0 - rampEnd));
}

OracleLight makeLight(const LightDef& def, const glm::dmat4& worldFromNode, std::optional<double> rangeM) {
    OracleLight light;
    light.type = def.type;
    placeLight(light, worldFromNode);
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
        for (std::size_t i = 0; i < 4; ++i) {
            // The document has the top before the bottom.
            constexpr BarnDoorSide kSides[] = {BarnDoorSide::Left, BarnDoorSide::Right, BarnDoorSide::Bottom,
                                               BarnDoorSide::Top};
            const BarnDoor& door = def.barnDoors[std::size_t(kSides[i])];
            light.flaps[i] = {door.angleRad, door.lengthM};
        }
        break;
    case LightType::Disk:
        light.radiusM = 0.5 * def.widthM;
        break;
    case LightType::Sphere:
    case LightType::Spot:
        light.radiusM = def.radiusM;
        break;
    }
    light.cosInner = std::cos(def.innerConeRad);
    light.cosOuter = std::cos(def.outerConeRad);
    light.rangeM = rangeM ? rangeM : def.rangeM;
    light.rayEndBiasM = def.rayEndBiasM;
    glm::dvec3 tint = def.color;
    if (def.temperatureK) tint *= temperatureColor(*def.temperatureK);
    if (def.type == LightType::Directional) {
        light.illuminanceLux = tint * luxOf(light, def);
        if (!light.isDelta())
            light.radianceNit = light.illuminanceLux / (kPi * square(std::sin(light.angularRadiusRad)));
    } else {
        light.intensityCd = tint * candelaOf(light, def);
        if (!light.isDelta()) light.radianceNit = light.intensityCd / projectedAreaM2(light);
    }
    return light;
}

double shapingAt(const OracleLight& light, const glm::dvec3& receiverWs) {
    if (light.type == LightType::Directional) return 1.0;
    const glm::dvec3 toReceiver = receiverWs - light.centerWs;
    const double distanceM = glm::length(toReceiver);
    double factor = 1.0;
    if (light.rangeM) factor *= std::max(1.0 - std::pow(distanceM / *light.rangeM, 4.0), 0.0);
    if (light.type == LightType::Spot && distanceM > 0.0) {
        const double cosAngle = glm::dot(light.dirWs, toReceiver) / distanceM;
        const double width = std::max(kMinConeCosDifference, light.cosInner - light.cosOuter);
        factor *= square(std::clamp((cosAngle - light.cosOuter) / width, 0.0, 1.0));
    }
    return factor;
}

namespace {

// In the plane of an axis that points out over the flap's edge and the light's direction: x along the axis
// from the light's middle, y ahead. The part -edge .. result of the source is seen from `receiver`; empty
// when below -edge.
double seenUpTo(const Flap& flap, double edgeM, const glm::dvec2& receiver) {
    if (flap.lengthM <= 0.0) return edgeM;
    const glm::dvec2 hinge(edgeM, 0.0);
    const glm::dvec2 leaf = flap.lengthM * glm::dvec2(std::sin(flap.angleRad), std::cos(flap.angleRad));
    const glm::dvec2 tip = hinge + leaf;
    if (receiver.y <= tip.y) {
        const glm::dvec2 to = receiver - hinge;
        const bool outside = to.x * leaf.y - to.y * leaf.x > 0.0;
        return outside ? -2.0 * edgeM : edgeM;
    }
    // The line from the receiver over the tip, as far as the source's plane.
    const double steps = receiver.y / (receiver.y - tip.y);
    return std::min(edgeM, receiver.x + (tip.x - receiver.x) * steps);
}

} // namespace

std::optional<OracleLight> openPart(const OracleLight& light, const glm::dvec3& receiverWs) {
    if (light.type != LightType::Rect) return light;
    const glm::dvec3 to = receiverWs - light.centerWs;
    const double x = glm::dot(to, light.xWs), y = glm::dot(to, light.yWs), ahead = glm::dot(to, light.dirWs);
    if (ahead <= 0.0) return {};
    const double left = seenUpTo(light.flaps[0], light.halfWidthM, {-x, ahead}),
                 right = seenUpTo(light.flaps[1], light.halfWidthM, {x, ahead}),
                 below = seenUpTo(light.flaps[2], light.halfHeightM, {-y, ahead}),
                 above = seenUpTo(light.flaps[3], light.halfHeightM, {y, ahead});
    if (left + right <= 0.0 || below + above <= 0.0) return {};
    OracleLight part = light;
    part.centerWs += light.xWs * (0.5 * (right - left)) + light.yWs * (0.5 * (above - below));
    part.halfWidthM = 0.5 * (left + right);
    part.halfHeightM = 0.5 * (below + above);
    return part;
}

} // namespace kilolux::oracle
