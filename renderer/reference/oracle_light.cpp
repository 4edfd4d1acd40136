// Photometry of the oracle (sizes are world metres, the importer has applied a node's scale): typed intensity
// -> candela, lux, nit for Lambert emitters, and far-field shaping. Flux of a convex Lambert body is pi L A
// (A all of its emitting surface); its intensity towards a direction is L times the area it projects to that
// direction.
#include "renderer/reference/oracle_light.h"

#include "renderer/document/ies_profile.h"
#include "renderer/document/light_units.h"
#include "renderer/reference/oracle_shape.h"
#include "renderer/reference/oracle_terms.h"

#include <algorithm>
#include <cmath>

namespace kilolux::oracle {

namespace {

constexpr double kMinConeCosDifference = 0.001; // KHR_lights_punctual's guard for inner = outer

double square(double x) {
    return x * x;
}

double candelaFromLumen(const OracleLight& light, double lumen) {
    if (light.profileIsShape) return lumen * light.profile->maxCandela() / light.profile->fluxLm();
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
    if (light.profileMultiplier > 0.0) return light.profile->maxCandela() * light.profileMultiplier;
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

Flap flapOf(const LightDef& def, BarnDoorSide side) {
    const BarnDoor& door = def.barnDoors[static_cast<std::size_t>(side)];
    return {door.angleRad, door.lengthM};
}

void placeLight(OracleLight& light, const glm::dmat4& worldFromNode) {
    light.centerWs = glm::dvec3(worldFromNode[3]);
    light.dirWs = glm::normalize(-glm::dvec3(worldFromNode[2]));
    const glm::dvec3 x = glm::dvec3(worldFromNode[0]);
    light.xWs = glm::normalize(x - light.dirWs * glm::dot(x, light.dirWs));
    light.yWs = glm::cross(-light.dirWs, light.xWs);
}

} // namespace

namespace {

// Relative to the profile's maximum. As a light's shape it stands in place of the area's projection; a flat
// source seen at less than 3 degrees keeps that of 3 degrees (cosine 0.05).
double profileFactor(const OracleLight& light, const glm::dvec3& dir) {
    const double value = light.profile->candelaAt(dir) / light.profile->maxCandela();
    if (!light.profileIsShape) return value;
    if (isFlat(light)) return value / std::max(-dir.z, 0.05);
    if (light.type != LightType::Tube) return value;
    const double side = 4.0 * light.radiusM * light.halfLengthM * std::sqrt(1.0 - dir.x * dir.x);
    return value * projectedAreaM2(light) / (side + kPi * square(light.radiusM));
}

double smoothOpen(double edge, double at, double softness) {
    const double t = std::clamp((edge - at) / std::max(softness, 1e-3) + 0.5, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

glm::dvec3 linearTexel(const Image& image, int column, int row) {
    const std::size_t at = 4 * (std::size_t(row) * std::size_t(image.width) + std::size_t(column));
    glm::dvec3 rgb;
    for (int c = 0; c < 3; ++c) {
        if (image.rgba8.empty()) {
            rgb[c] = double(image.rgbaF32[at + std::size_t(c)]);
            continue;
        }
        const double s = image.rgba8[at + std::size_t(c)] / 255.0;
        rgb[c] = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
    }
    return rgb;
}

template<typename Texel>
auto bilinear(const Image& image, double u, double v, const Texel& texel) {
    const double x = u * image.width - 0.5, y = v * image.height - 0.5;
    const int left = int(std::floor(x)), top = int(std::floor(y));
    const auto a = glm::mix(texel(left, top), texel(left + 1, top), x - left);
    const auto b = glm::mix(texel(left, top + 1), texel(left + 1, top + 1), x - left);
    return glm::mix(a, b, y - top);
}

double imageLuminance(const Image& image, double u, double v) {
    return bilinear(image, u, v, [&](int column, int row) {
        const auto wrap = [](int i, int n) { return (i % n + n) % n; };
        const glm::dvec3 rgb = linearTexel(image, wrap(column, image.width), wrap(row, image.height));
        return std::clamp(luminanceOf(rgb), 0.0, 1.0);
    });
}

// A flame's level: eight random values a second at speed 1, joined by smooth steps.
double flicker(const LightFunction& function, double timeS) {
    const double at = 8.0 * function.speed * timeS, before = std::floor(at), rest = at - before;
    const auto level = [&](double step) {
        const double noise = 43758.5453 * std::sin(12.9898 * step + 78.233 * function.seed);
        return noise - std::floor(noise);
    };
    return glm::mix(level(before), level(before + 1.0), rest * rest * (3.0 - 2.0 * rest));
}

double functionFactor(const LightFunction& function, double timeS, const glm::dvec2& plane) {
    const double c = std::cos(function.angleRad), s = std::sin(function.angleRad);
    const glm::dvec2 at = glm::dvec2(plane.x * c + plane.y * s, plane.y * c - plane.x * s) / function.scale;
    const glm::dvec2 middle = glm::abs(at - glm::floor(at) - 0.5) * 2.0;
    double pattern = 1.0;
    switch (function.kind) {
    case LightFunctionKind::None:
        return 1.0;
    case LightFunctionKind::Flicker:
        pattern = flicker(function, timeS);
        break;
    case LightFunctionKind::Image:
        if (!function.image) return 1.0;
        pattern = imageLuminance(*function.image, at.x + 0.5, 0.5 - at.y);
        break;
    case LightFunctionKind::Grid:
        pattern =
            smoothOpen(0.85, middle.x, function.softness) * smoothOpen(0.85, middle.y, function.softness);
        break;
    case LightFunctionKind::Blinds:
        pattern = smoothOpen(0.5, middle.y, function.softness);
        break;
    case LightFunctionKind::Caustics: {
        const double x = 2.0 * kPi * at.x, y = 2.0 * kPi * at.y,
                     phase = 2.4 * function.seed + function.speed * timeS;
        const double bentX = 0.8 * std::sin(y + phase), bentY = 0.8 * std::sin(x - phase);
        const double waves =
            std::sin(x + bentX + phase) + std::sin(y + bentY - phase) + std::sin(x - y + bentX - bentY);
        pattern = std::pow(1.0 - std::abs(waves) / 3.0, 8.0 - 7.0 * function.softness);
        break;
    }
    }
    return 1.0 - function.strength * (1.0 - pattern);
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
    takeSize(light, def);
    if (def.type == LightType::Rect) {
        light.picture = def.sourceImage;
        light.pictureCenterWs = light.centerWs;
        light.pictureHalfM = {light.halfWidthM, light.halfHeightM};
        light.flaps = {flapOf(def, BarnDoorSide::Left), flapOf(def, BarnDoorSide::Right),
                       flapOf(def, BarnDoorSide::Bottom), flapOf(def, BarnDoorSide::Top)};
    }
    light.cosInner = std::cos(def.innerConeRad);
    light.cosOuter = std::cos(def.outerConeRad);
    light.rangeM = rangeM ? rangeM : def.rangeM;
    light.rayEndBiasM = def.rayEndBiasM;
    light.channels = def.channels;
    if (!def.channelsCast) light.shadowChannels = def.channels;
    light.penumbraScale = def.penumbraScale;
    light.penumbraCenterWs = light.centerWs;
    light.function = def.function;
    const bool hasPlace = def.type != LightType::Directional;
    if (hasPlace && def.iesUse != IesUse::None && def.ies && def.ies->maxCandela() > 0.0)
        light.profile = def.ies;
    light.profileIsShape = light.profile && def.iesUse == IesUse::Shape;
    light.profileMultiplier = light.profileIsShape && def.iesIntensity ? def.iesMultiplier : 0.0;
    glm::dvec3 tint = def.color * std::exp2(def.exposureEv);
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

glm::dvec3 pictureAt(const OracleLight& light, const glm::dvec3& pointWs) {
    if (!light.picture) return glm::dvec3(1.0);
    const glm::dvec3 from = pointWs - light.pictureCenterWs;
    const double u = 0.5 - 0.5 * glm::dot(from, light.xWs) / light.pictureHalfM.x,
                 v = 0.5 - 0.5 * glm::dot(from, light.yWs) / light.pictureHalfM.y;
    const Image& image = *light.picture;
    return bilinear(image, u, v, [&](int column, int row) {
        return linearTexel(image, std::clamp(column, 0, image.width - 1),
                           std::clamp(row, 0, image.height - 1));
    });
}

double shapingAt(const OracleLight& light, const glm::dvec3& receiverWs) {
    const glm::dvec3 toReceiver = receiverWs - light.centerWs;
    const glm::dvec3 local(glm::dot(toReceiver, light.xWs), glm::dot(toReceiver, light.yWs),
                           -glm::dot(toReceiver, light.dirWs));
    if (light.type == LightType::Directional)
        return functionFactor(light.function, light.timeS, glm::dvec2(local));
    const double distanceM = glm::length(toReceiver);
    double factor = functionFactor(light.function, light.timeS,
                                   glm::dvec2(local) / std::max(std::abs(local.z), 1e-4 * distanceM));
    if (light.profile && distanceM > 0.0) factor *= profileFactor(light, local / distanceM);
    if (light.rangeM) factor *= std::max(1.0 - std::pow(distanceM / *light.rangeM, 4.0), 0.0);
    if (light.type == LightType::Spot && !light.profileIsShape && distanceM > 0.0) {
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
