// A light as the oracle sees it: placed in the world, in SI photometric units, derived from the document's
// definition by the oracle's own arithmetic (no code of the renderer is used, so that an error there shows).
// Lambert sources: every point of the surface has radiance `radianceNit`, times its picture; shaping (range
// window, spot cone) depends on the receiver and the light's centre only.
#pragma once

#include "renderer/document/scene.h"

#include <array>
#include <memory>
#include <optional>

namespace kilolux::oracle {

inline constexpr double kPi = 3.14159265358979323846;

// A barn door's flap: it leans `angleRad` outward from straight ahead and is `lengthM` long; endless along
// its hinge.
struct Flap {
    double angleRad = 0.0;
    double lengthM = 0.0;
};

struct OracleLight {
    LightType type = LightType::Sphere;
    bool muted = false;
    glm::dvec3 centerWs{0.0};
    glm::dvec3 dirWs{0.0, 0.0, -1.0}; // unit; the light looks this way
    glm::dvec3 xWs{1.0, 0.0, 0.0};    // unit; width of a rectangle, axis of a tube
    glm::dvec3 yWs{0.0, 1.0, 0.0};    // unit; xWs, yWs, -dirWs are right-handed
    double radiusM = 0.0;             // sphere, spot, tube, disk
    double halfLengthM = 0.0;         // tube
    double halfWidthM = 0.0;          // rectangle
    double halfHeightM = 0.0;         // rectangle
    double angularRadiusRad = 0.0;    // directional
    double cosInner = 1.0;            // spot
    double cosOuter = 0.0;            // spot
    std::array<Flap, 4> flaps;        // rectangle: hinged at the edges at -x, +x, -y, +y
    std::optional<double> rangeM;
    double rayEndBiasM = 0.0;
    double penumbraScale = 1.0; // of the source about this centre, as shadow rays see it
    glm::dvec3 penumbraCenterWs{0.0};
    std::shared_ptr<const IesProfile> profile; // of the light's shape or a mask on it; null without
    bool profileIsShape = false;
    double profileMultiplier = 0.0; // where the profile's candela stand in place of the light's intensity
    LightFunction function;
    double timeS = 0.0;                   // of the light function
    std::shared_ptr<const Image> picture; // rectangle; null without. It lies on the whole light:
    glm::dvec3 pictureCenterWs{0.0};
    glm::dvec2 pictureHalfM{0.0};
    std::uint8_t channels = 255;                // of the meshes that it reaches
    std::optional<std::uint8_t> shadowChannels; // of the meshes that cast its shadow; absent: all do
    glm::dvec3 intensityCd{0.0};                // local lights
    glm::dvec3 illuminanceLux{0.0};             // directional, on a surface that faces it
    glm::dvec3 radianceNit{0.0};                // 0 for lights without extent

    // A point or an infinitely distant point: one direction, no area.
    bool isDelta() const;
};

// `rangeM` overrides the definition's range when present (derived ranges come from the caller).
OracleLight makeLight(const LightDef& def, const glm::dmat4& worldFromNode,
                      std::optional<double> rangeM = {});

// Of the picture on the light at a point of its plane, bilinear and clamped; 1 without. Seen from the front
// its top is towards yWs and its left towards xWs.
glm::dvec3 pictureAt(const OracleLight& light, const glm::dvec3& pointWs);

// Window, cone, profile and light function towards a receiver: a factor on the whole light.
double shapingAt(const OracleLight& light, const glm::dvec3& receiverWs);

// What the receiver sees of the light past its flaps: a light of the same radiance, smaller and moved.
// Nothing where they hide it all.
std::optional<OracleLight> openPart(const OracleLight& light, const glm::dvec3& receiverWs);

// Solid angle that a spot's cone passes, weighted by the cone's factor: 2 pi Int C(cos) d cos, in sr.
double coneSolidAngleSr(double cosInner, double cosOuter);

} // namespace kilolux::oracle
