// Estimators of the oracle. Unshadowed light is quadrature, so a point that sees a whole light has no noise
// at all. True: unbiased control variate around that quadrature, with shadow rays drawn in proportion to the
// integrand. Split: quadrature times the mean visibility under uniform area sampling.
#include "renderer/reference/oracle_estimate.h"

#include "renderer/reference/oracle_quadrature.h"
#include "renderer/reference/oracle_random.h"
#include "renderer/reference/oracle_terms.h"

#include <array>
#include <cmath>
#include <limits>

namespace kilolux::oracle {

namespace {

using glm::dvec3;

bool reaches(const OraclePoint& point, const Occlusion& occlusion, const OracleLight& light,
             dvec3 directionWs, double distanceM) {
    if (light.penumbraScale != 1.0) {
        // Towards the same point of the source, grown about its middle.
        const bool far = light.type == LightType::Directional;
        const dvec3 middle = far ? -light.dirWs : light.penumbraCenterWs - point.positionWs;
        const dvec3 to = middle + (directionWs * (far ? 1.0 : distanceM) - middle) * light.penumbraScale;
        directionWs = glm::normalize(to);
        if (!far) distanceM = glm::length(to);
    }
    if (glm::dot(point.geometricNormalWs, directionWs) <= 0.0) return false;
    const double lengthM = distanceM - light.rayEndBiasM;
    return !occlusion || lengthM <= 0.0 || !occlusion(directionWs, lengthM);
}

// Sums of one replica: integrand with and without visibility.
struct ReplicaSums {
    LobeIntegral visible;
    LobeIntegral all;
};

// Integrals that arrive, each replica corrected by the known unshadowed value with a coefficient from the
// other replicas, which keeps the mean exact.
struct ShadowedIntegrals {
    double diffuse[kReplicas];
    double specularF0[kReplicas];
    double specularOne[kReplicas];
};

void correct(const std::vector<ReplicaSums>& sums, double LobeIntegral::*part, double exact, double* out) {
    double visible = 0.0;
    double all = 0.0;
    for (const ReplicaSums& replica : sums) {
        visible += replica.visible.*part;
        all += replica.all.*part;
    }
    for (int r = 0; r < kReplicas; ++r) {
        const double othersAll = all - sums[r].all.*part;
        const double coefficient =
            othersAll > 0.0 ? std::clamp((visible - sums[r].visible.*part) / othersAll, 0.0, 1.0) : 0.0;
        out[r] = sums[r].visible.*part + coefficient * (exact - sums[r].all.*part);
    }
}

void add(LobeIntegral& sum, const LobeIntegral& value, double factor) {
    sum.diffuse += value.diffuse * factor;
    sum.specularF0 += value.specularF0 * factor;
    sum.specularOne += value.specularOne * factor;
}

ShadowedIntegrals estimateTrue(const OracleLight& light, const OraclePoint& point, const Occlusion& occlusion,
                               LobeQuadrature& quadrature, const LobeIntegral& exact, int samples,
                               std::uint64_t seed) {
    quadrature.prepareSampling(luminanceOf(f0Of(point.material)));
    const int perReplica = samples / kReplicas;
    std::vector<ReplicaSums> sums(kReplicas);
    for (int r = 0; r < kReplicas; ++r) {
        for (int i = 0; i < perReplica; ++i) {
            const glm::dvec2 uv = sobolPoint(i, seedOf({seed, static_cast<std::uint64_t>(r)}));
            const LobeQuadrature::Sample sample = quadrature.draw(uv.x, uv.y);
            add(sums[r].all, sample.value, 1.0 / perReplica);
            const double distanceM = distanceTo(light, point.positionWs, sample.direction);
            if (reaches(point, occlusion, light, sample.direction, distanceM))
                add(sums[r].visible, sample.value, 1.0 / perReplica);
        }
    }
    ShadowedIntegrals result;
    correct(sums, &LobeIntegral::diffuse, exact.diffuse, result.diffuse);
    correct(sums, &LobeIntegral::specularF0, exact.specularF0, result.specularF0);
    correct(sums, &LobeIntegral::specularOne, exact.specularOne, result.specularOne);
    return result;
}

ShadowedIntegrals estimateSplit(const OracleLight& light, const OraclePoint& point,
                                const Occlusion& occlusion, const LobeIntegral& exact, int samples,
                                std::uint64_t seed) {
    constexpr int kMaxRejections = 64; // rounds in search of points above the horizon
    const int perReplica = samples / kReplicas;
    ShadowedIntegrals result;
    for (int r = 0; r < kReplicas; ++r) {
        int valid = 0;
        int visible = 0;
        for (int i = 0; valid < perReplica && i < perReplica * kMaxRejections; ++i) {
            const glm::dvec2 uv = sobolPoint(i, seedOf({seed, static_cast<std::uint64_t>(r)}));
            const SourcePoint source = sampleSource(light, point.positionWs, uv.x, uv.y);
            if (!source.faces || glm::dot(point.shadingNormalWs, source.directionWs) <= 0.0) continue;
            ++valid;
            visible += reaches(point, occlusion, light, source.directionWs, source.distanceM) ? 1 : 0;
        }
        const double mean = valid > 0 ? static_cast<double>(visible) / valid : 0.0;
        result.diffuse[r] = exact.diffuse * mean;
        result.specularF0[r] = exact.specularF0 * mean;
        result.specularOne[r] = exact.specularOne * mean;
    }
    return result;
}

// A light in one direction, without area: `irradianceLux` on a surface that faces it.
OraclePointResult evaluateDelta(const OracleLight& light, const OraclePoint& point,
                                const Occlusion& occlusion, const dvec3& directionWs, double distanceM,
                                const dvec3& irradianceLux) {
    const LobeValue value =
        Lobe(point.shadingNormalWs, point.viewDirWs, point.material.roughness)(directionWs);
    OraclePointResult result;
    if (value.noL <= 0.0) return result;
    result.unshadowedIrradianceLux = irradianceLux * value.noL;
    result.unshadowedDiffuseNit = result.unshadowedIrradianceLux * diffuseAlbedoOf(point.material) / kPi;
    result.unshadowedSpecularNit =
        irradianceLux * (f0Of(point.material) * value.specularF0 + dvec3(value.specularOne));
    if (!reaches(point, occlusion, light, directionWs, distanceM)) return result;
    result.visibility = 1.0;
    result.irradianceLux = result.unshadowedIrradianceLux;
    result.diffuseNit = result.unshadowedDiffuseNit;
    result.specularNit = result.unshadowedSpecularNit;
    return result;
}

// Integrals times the radiance that stands under them.
struct LitIntegral {
    dvec3 diffuse{0.0}, specularF0{0.0}, specularOne{0.0};
};
using LitReplicas = std::array<LitIntegral, kReplicas>;

LitIntegral litBy(const dvec3& radianceNit, double diffuse, double specularF0, double specularOne) {
    return {radianceNit * diffuse, radianceNit * specularF0, radianceNit * specularOne};
}

LitReplicas litBy(const dvec3& radianceNit, const ShadowedIntegrals& shadowed) {
    LitReplicas lit;
    for (std::size_t r = 0; r < kReplicas; ++r)
        lit[r] = litBy(radianceNit, shadowed.diffuse[r], shadowed.specularF0[r], shadowed.specularOne[r]);
    return lit;
}

OraclePointResult assemble(const OraclePoint& point, const LitIntegral& exact, const LitReplicas& shadowed) {
    const dvec3 albedo = diffuseAlbedoOf(point.material);
    const dvec3 f0 = f0Of(point.material);
    OraclePointResult result;
    result.unshadowedIrradianceLux = exact.diffuse;
    result.unshadowedDiffuseNit = exact.diffuse * albedo / kPi;
    result.unshadowedSpecularNit = exact.specularF0 * f0 + exact.specularOne;
    std::array<dvec3, kReplicas> totals;
    const double all = luminanceOf(exact.diffuse);
    for (int r = 0; r < kReplicas; ++r) {
        const LitIntegral& one = shadowed[std::size_t(r)];
        const dvec3 diffuseNit = one.diffuse * albedo / kPi;
        const dvec3 specularNit = one.specularF0 * f0 + one.specularOne;
        result.diffuseNit += diffuseNit / double(kReplicas);
        result.specularNit += specularNit / double(kReplicas);
        result.irradianceLux += one.diffuse / double(kReplicas);
        if (all > 0.0) result.visibility += luminanceOf(one.diffuse) / all / kReplicas; // 1 where all is seen
        totals[std::size_t(r)] = diffuseNit + specularNit;
    }
    result.standardErrorNit = standardErrorOf(totals, result.diffuseNit + result.specularNit);
    return result;
}

void add(LitIntegral& sum, const dvec3& radianceNit, const LobeIntegral& value) {
    sum.diffuse += radianceNit * value.diffuse;
    sum.specularF0 += radianceNit * value.specularF0;
    sum.specularOne += radianceNit * value.specularOne;
}

// Each of the sums over the plain integral of the same samples, times that integral's known value.
LitIntegral ratios(const LitIntegral& sum, const LobeIntegral& plain, const LobeIntegral& exact) {
    const auto over = [](const dvec3& s, double p, double e) { return p > 0.0 ? s * (e / p) : dvec3(0.0); };
    return {over(sum.diffuse, plain.diffuse, exact.diffuse),
            over(sum.specularF0, plain.specularF0, exact.specularF0),
            over(sum.specularOne, plain.specularOne, exact.specularOne)};
}

// Mean visibility of points that are spread over the area and count by their luminance.
double meanVisibility(const OracleLight& light, const OraclePoint& point, const Occlusion& occlusion,
                      int samples, std::uint64_t seed) {
    double all = 0.0, visible = 0.0;
    for (int i = 0; i < samples; ++i) {
        const glm::dvec2 uv = sobolPoint(i, seed);
        const SourcePoint source = sampleSource(light, point.positionWs, uv.x, uv.y);
        if (!source.faces || glm::dot(point.shadingNormalWs, source.directionWs) <= 0.0) continue;
        const double share =
            luminanceOf(pictureAt(light, point.positionWs + source.directionWs * source.distanceM));
        all += share;
        if (share > 0.0 && reaches(point, occlusion, light, source.directionWs, source.distanceM))
            visible += share;
    }
    return all > 0.0 ? visible / all : 0.0;
}

// A rectangle with a picture, by samples that follow the plain integrand.
OraclePointResult estimatePicture(const OracleLight& light, const OraclePoint& point,
                                  const Occlusion& occlusion, Estimator estimator, LobeQuadrature& quadrature,
                                  const LobeIntegral& exact, double shaping, int samples,
                                  std::uint64_t seed) {
    constexpr int kLeastSamples = 1024; // of a replica: what the picture's detail needs
    const int count = std::max(samples / kReplicas, kLeastSamples);
    quadrature.prepareSampling(luminanceOf(f0Of(point.material)));
    LitIntegral unshadowed;
    LitReplicas shadowed;
    for (std::size_t r = 0; r < kReplicas; ++r) {
        const std::uint64_t replicaSeed = seedOf({seed, r});
        LobeIntegral plain;
        LitIntegral all, visible;
        for (int i = 0; i < count; ++i) {
            const glm::dvec2 uv = sobolPoint(i, replicaSeed);
            const LobeQuadrature::Sample sample = quadrature.draw(uv.x, uv.y);
            const double distanceM = distanceTo(light, point.positionWs, sample.direction);
            const dvec3 radianceNit = light.radianceNit * shaping *
                                      pictureAt(light, point.positionWs + sample.direction * distanceM);
            add(plain, sample.value, 1.0);
            add(all, radianceNit, sample.value);
            if (estimator == Estimator::True && reaches(point, occlusion, light, sample.direction, distanceM))
                add(visible, radianceNit, sample.value);
        }
        const LitIntegral lit = ratios(all, plain, exact);
        const double share = 1.0 / kReplicas;
        unshadowed.diffuse += lit.diffuse * share;
        unshadowed.specularF0 += lit.specularF0 * share;
        unshadowed.specularOne += lit.specularOne * share;
        shadowed[r] = ratios(visible, plain, exact);
        if (estimator == Estimator::True) continue;
        const double mean = meanVisibility(light, point, occlusion, count, replicaSeed);
        shadowed[r] = {lit.diffuse * mean, lit.specularF0 * mean, lit.specularOne * mean};
    }
    return assemble(point, unshadowed, shadowed);
}

} // namespace

OraclePointResult estimateLight(const OracleLight& whole, const OraclePoint& point,
                                const Occlusion& occlusion, Estimator estimator, int samples,
                                std::uint64_t seed) {
    const double shaping = shapingAt(whole, point.positionWs);
    const std::optional<OracleLight> open = openPart(whole, point.positionWs);
    if (whole.muted || shaping <= 0.0 || !open) return {};
    const OracleLight& light = *open;
    if (light.isDelta()) {
        if (light.type == LightType::Directional)
            return evaluateDelta(light, point, occlusion, -light.dirWs,
                                 std::numeric_limits<double>::infinity(), light.illuminanceLux * shaping);
        const dvec3 to = light.centerWs - point.positionWs;
        const double distanceM = glm::length(to);
        return evaluateDelta(light, point, occlusion, to / distanceM, distanceM,
                             light.intensityCd * (shaping / (distanceM * distanceM)));
    }
    const std::optional<SourceRegion> region =
        SourceRegion::make(light, point.positionWs, point.shadingNormalWs);
    if (!region) return {};
    LobeQuadrature quadrature(*region,
                              Lobe(point.shadingNormalWs, point.viewDirWs, point.material.roughness));
    LobeIntegral exact = quadrature.integral();
    exact.diffuse = diffuseIntegral(*region, point.shadingNormalWs);
    if (light.picture)
        return estimatePicture(light, point, occlusion, estimator, quadrature, exact, shaping, samples, seed);
    const int rounded = std::max(samples + kReplicas - 1, kReplicas) / kReplicas * kReplicas;
    const ShadowedIntegrals shadowed =
        estimator == Estimator::True ? estimateTrue(light, point, occlusion, quadrature, exact, rounded, seed)
                                     : estimateSplit(light, point, occlusion, exact, rounded, seed);
    const dvec3 radianceNit = light.radianceNit * shaping;
    return assemble(point, litBy(radianceNit, exact.diffuse, exact.specularF0, exact.specularOne),
                    litBy(radianceNit, shadowed));
}

} // namespace kilolux::oracle
