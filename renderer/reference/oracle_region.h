// The set of directions in which a receiver sees a light, cut by the receiver's horizon, in polar coordinates
// about a direction inside it: { direction(phi, theta) : 0 <= theta <= thetaMax(phi) }. Every light is a
// convex body, so the set is convex and one angle per azimuth describes its edge exactly: half-spaces
// (rectangle edges, horizon), circles (sphere, sun, tube ends) and one elliptic cone (disk).
#pragma once

#include "renderer/reference/oracle_light.h"

#include <array>
#include <vector>

namespace kilolux::oracle {

class SourceRegion {
  public:
    // `normalWs` is the receiver's shading normal. Absent when nothing of the light is above the horizon,
    // when the receiver is behind a one-sided light or inside a light, or for a light without extent.
    static std::optional<SourceRegion> make(const OracleLight& light, const glm::dvec3& receiverWs,
                                            const glm::dvec3& normalWs);

    glm::dvec3 azimuth(double phiRad) const {
        return tangent_ * std::cos(phiRad) + bitangent_ * std::sin(phiRad);
    }
    const glm::dvec3& pole() const { return pole_; }
    double thetaMax(double phiRad) const;
    // Azimuths between which thetaMax is smooth and varies little, ascending over one full turn, at most pi/2
    // apart.
    const std::vector<double>& breaks() const { return breaks_; }

  private:
    struct Circle {
        glm::dvec3 axis;
        double cosRadius;
        double sinRadius;
    };

    void setPole(const glm::dvec3& poleWs);
    void addRect(const OracleLight& light, const glm::dvec3& toCenter);
    void addDisk(const OracleLight& light, const glm::dvec3& toCenter);
    void addTube(const OracleLight& light, const glm::dvec3& toCenter);
    void addCircle(const glm::dvec3& toCenter, double radiusM);
    void addHorizonBreaks(const glm::dvec3& normalWs);
    void addBreakTowards(const glm::dvec3& directionWs);
    void finishBreaks();
    void addGraded(double phi0, double theta0, double phi1, double theta1, std::vector<double>& result) const;
    double circleExit(const Circle& circle, const glm::dvec3& azimuthWs) const;
    double tubeExit(const glm::dvec3& azimuthWs) const;
    double diskExit(const glm::dvec3& azimuthWs) const;
    double halfSpaceExit(const glm::dvec3& inwardWs, const glm::dvec3& azimuthWs) const;
    double diskForm(const glm::dvec3& a, const glm::dvec3& b) const;

    glm::dvec3 pole_{0.0, 0.0, 1.0}, tangent_{1.0, 0.0, 0.0}, bitangent_{0.0, 1.0, 0.0};
    std::vector<glm::dvec3> halfSpaces_; // inward normals; the horizon is one of them
    std::vector<Circle> circles_;        // their union, with the strip below, is convex
    std::vector<std::array<glm::dvec3, 3>>
        strip_; // tube: inward normal of each silhouette line, its two ends
    bool isDisk_ = false;
    glm::dvec3 diskNormal_{0.0}, diskCenter_{0.0};
    double diskRadiusM_ = 0.0;
    std::vector<double> breaks_;
};

} // namespace kilolux::oracle
