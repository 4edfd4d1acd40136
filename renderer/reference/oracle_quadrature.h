// Converged integrals of the diffuse and specular integrand over the directions in which a light is seen, in
// double precision: Gauss-Legendre cells, graded towards the specular peak and then refined where two orders
// disagree. The cells double as a sampling density that follows the integrand.
#pragma once

#include "renderer/reference/oracle_brdf.h"
#include "renderer/reference/oracle_region.h"

namespace kilolux::oracle {

struct LobeIntegral {
    double diffuse = 0.0;    // Int NoL dw
    double specularF0 = 0.0; // rgb specular = F0 * specularF0 + specularOne
    double specularOne = 0.0;
};

class LobeQuadrature {
  public:
    // `tolerance` bounds the summed disagreement of the two orders, relative to each integral; the result is
    // better than that by one to three digits.
    LobeQuadrature(const SourceRegion& region, const Lobe& lobe, double tolerance = 2e-4);

    const LobeIntegral& integral() const { return total_; }
    std::size_t cellCount() const { return cells_.size(); }

    struct Sample {
        glm::dvec3 direction;
        LobeIntegral value; // integrand over density: its mean is integral()
    };
    // Prepares draw(): density proportional to the sum of both integrals' shares. `f0` is the luminance of
    // F0.
    void prepareSampling(double f0);
    Sample draw(double u, double v) const; // u, v in [0,1)

  private:
    struct Cell {
        double phi0, phi1, s0, s1; // theta = s thetaMax(phi)
        LobeIntegral sum;
        LobeIntegral coarse;
        double weight = 0.0;
    };

    void grade(const Cell& cell, int depth);
    void evaluate(Cell& cell) const;
    void refine(double tolerance);
    LobeIntegral sumWithOrder(const Cell& cell, int order) const;
    double disagreement(const Cell& cell) const;
    glm::dvec3 direction(double phiRad, double thetaRad) const;

    const SourceRegion region_;
    const Lobe lobe_;
    std::vector<Cell> cells_;
    LobeIntegral total_;
    std::vector<double> cumulative_;
    double f0_ = 0.04;
};

// Int NoL dw over the region, by exact integration in theta and adaptive quadrature in azimuth (relative
// error below 1e-9): the irradiance that unit radiance gives.
double diffuseIntegral(const SourceRegion& region, const glm::dvec3& normalWs);

} // namespace kilolux::oracle
