// The dome as the oracle sees it: radiance from every direction by the document's own picture, interpolated
// between texels and taken apart into directions, in double precision. Unshadowed light is the sum over all
// of them; shadow rays are drawn in proportion to what each direction would add.
#pragma once

#include "renderer/reference/oracle_estimate.h"

#include <memory>

namespace kilolux::oracle {

class OracleDome {
  public:
    static std::unique_ptr<OracleDome> make(const Dome& dome); // null where it gives no light

    glm::dvec3 radianceNit(const glm::dvec3& directionWs) const;

    // As estimateLight(). Split: the visibility is the mean over the directions above the horizon, each
    // counted by its radiance.
    OraclePointResult estimate(const OraclePoint& point, const Occlusion& occlusion, Estimator estimator,
                               int samples, std::uint64_t seed) const;

  private:
    struct Cell { // a small part of the sphere
        glm::dvec3 directionWs;
        glm::dvec3 light;      // radiance times solid angle
        double turn, polarRad; // of its middle, in the picture
    };
    struct Response {             // of a surface to light
        glm::dvec3 diffuse{0.0};  // irradiance
        glm::dvec3 specular{0.0}; // radiance towards the viewer
        void add(const Response& other, double factor) {
            diffuse += other.diffuse * factor;
            specular += other.specular * factor;
        }
    };
    struct Seen;
    struct Drawn;

    Seen respond(const OraclePoint& point, Estimator estimator) const;
    Drawn draw(const OraclePoint& point, const Seen& seen, const Occlusion& occlusion, int rays,
               std::uint64_t seed) const;
    glm::dvec3 texel(int x, int y) const;
    glm::dvec3 directionAt(double turn, double polarRad) const;

    std::shared_ptr<const Image> image_;
    glm::dvec3 nit_{0.0}; // of a texel of 1
    double rotationRad_ = 0.0;
    std::vector<Cell> cells_;
    int columns_ = 0, rows_ = 0; // that they lie in
};

} // namespace kilolux::oracle
