// The dome of the oracle, see oracle_dome.h.
#include "renderer/reference/oracle_dome.h"

#include "renderer/reference/oracle_brdf.h"
#include "renderer/reference/oracle_random.h"
#include "renderer/reference/oracle_terms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace kilolux::oracle {

namespace {

using glm::dvec3;

constexpr int kLeastColumns = 256, kMostColumns = 1024;

double soundValue(double value) {
    return value > 0.0 && std::isfinite(value) ? value : 0.0;
}

} // namespace

dvec3 OracleDome::texel(int x, int y) const {
    const int column = (x % image_->width + image_->width) % image_->width,
              row = std::clamp(y, 0, image_->height - 1);
    const std::size_t at = 4 * (std::size_t(row) * std::size_t(image_->width) + std::size_t(column));
    dvec3 rgb;
    for (int c = 0; c < 3; ++c) {
        if (image_->rgba8.empty()) {
            rgb[c] = soundValue(double(image_->rgbaF32[at + std::size_t(c)]));
        } else {
            const double s = image_->rgba8[at + std::size_t(c)] / 255.0;
            rgb[c] = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
        }
    }
    return rgb;
}

// Longitude grows to the right as seen from inside; the picture's middle is -Z, turned about +Y.
dvec3 OracleDome::directionAt(double turn, double polarRad) const {
    const double longitude = 2.0 * kPi * (turn - 0.5) - rotationRad_;
    return {std::sin(polarRad) * std::sin(longitude), std::cos(polarRad),
            -std::sin(polarRad) * std::cos(longitude)};
}

dvec3 OracleDome::radianceNit(const dvec3& directionWs) const {
    if (!image_) return nit_;
    const double longitude = std::atan2(directionWs.x, -directionWs.z) + rotationRad_;
    const double turn = longitude / (2.0 * kPi) + 0.5,
                 polar = std::acos(std::clamp(directionWs.y, -1.0, 1.0)) / kPi;
    const double x = (turn - std::floor(turn)) * image_->width - 0.5, y = polar * image_->height - 0.5;
    const int left = int(std::floor(x)), top = int(std::floor(y));
    const dvec3 upper = glm::mix(texel(left, top), texel(left + 1, top), x - left),
                lower = glm::mix(texel(left, top + 1), texel(left + 1, top + 1), x - left);
    return nit_ * glm::mix(upper, lower, y - top);
}

std::unique_ptr<OracleDome> OracleDome::make(const Dome& dome) {
    auto result = std::make_unique<OracleDome>();
    result->image_ = dome.image;
    result->nit_ = glm::max(dome.color, 0.0) * dome.intensityNit;
    result->rotationRad_ = dome.rotationRad;
    if (!(luminanceOf(result->nit_) > 0.0)) return nullptr;
    // Two cells a texel at least, so that interpolation between texels is followed.
    const int wanted = dome.image ? 2 * dome.image->width : kLeastColumns;
    result->columns_ = std::clamp(wanted, kLeastColumns, kMostColumns);
    result->rows_ = result->columns_ / 2;
    for (int y = 0; y < result->rows_; ++y) {
        const double above = std::cos(kPi * y / result->rows_),
                     below = std::cos(kPi * (y + 1) / result->rows_);
        const double polar = std::acos(0.5 * (above + below));
        const double areaSr = 2.0 * kPi * (above - below) / result->columns_;
        for (int x = 0; x < result->columns_; ++x) {
            const double turn = (x + 0.5) / result->columns_;
            const dvec3 direction = result->directionAt(turn, polar);
            const dvec3 light = result->radianceNit(direction) * areaSr;
            if (luminanceOf(light) > 0.0) result->cells_.push_back({direction, light, turn, polar});
        }
    }
    if (result->cells_.empty()) return nullptr;
    return result;
}

// The directions above a surface's horizon and what each would give.
struct OracleDome::Seen {
    std::vector<std::size_t> cells;
    std::vector<Response> responses;
    std::vector<double> cumulative; // what shadow rays are drawn by
    Response exact;
};

// Of one replica of shadow rays: what arrives, what was drawn, and the share of the rays that arrived.
struct OracleDome::Drawn {
    Response arriving, all;
    double visible = 0.0;
};

OracleDome::Seen OracleDome::respond(const OraclePoint& point, Estimator estimator) const {
    const Lobe lobe(point.shadingNormalWs, point.viewDirWs, point.material.roughness);
    const dvec3 albedo = diffuseAlbedoOf(point.material), f0 = f0Of(point.material);
    Seen seen;
    double sum = 0.0;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        const LobeValue value = lobe(cells_[i].directionWs);
        if (value.noL <= 0.0) continue;
        const Response response{cells_[i].light * value.noL,
                                cells_[i].light * (f0 * value.specularF0 + dvec3(value.specularOne))};
        seen.exact.diffuse += response.diffuse;
        seen.exact.specular += response.specular;
        sum += estimator == Estimator::Split
                   ? luminanceOf(cells_[i].light)
                   : luminanceOf(response.diffuse * (albedo / kPi + 1e-6) + response.specular);
        seen.cells.push_back(i);
        seen.responses.push_back(response);
        seen.cumulative.push_back(sum);
    }
    return seen;
}

OracleDome::Drawn OracleDome::draw(const OraclePoint& point, const Seen& seen, const Occlusion& occlusion,
                                   int rays, std::uint64_t seed) const {
    Drawn drawn;
    const double sum = seen.cumulative.back();
    for (int i = 0; i < rays; ++i) {
        const glm::dvec2 uv = sobolPoint(std::uint32_t(i), seed);
        const auto found = std::upper_bound(seen.cumulative.begin(), seen.cumulative.end() - 1, uv.x * sum);
        const std::size_t k = std::size_t(found - seen.cumulative.begin());
        const double before = k > 0 ? seen.cumulative[k - 1] : 0.0, width = seen.cumulative[k] - before;
        if (!(width > 0.0)) continue;
        // Anywhere in the cell.
        const Cell& cell = cells_[seen.cells[k]];
        const dvec3 direction = directionAt(cell.turn + ((uv.x * sum - before) / width - 0.5) / columns_,
                                            cell.polarRad + (uv.y - 0.5) * kPi / rows_);
        const double weight = sum / (width * rays);
        drawn.all.add(seen.responses[k], weight);
        const bool open = glm::dot(point.geometricNormalWs, direction) > 0.0 &&
                          (!occlusion || !occlusion(direction, std::numeric_limits<double>::infinity()));
        if (!open) continue;
        drawn.visible += 1.0 / rays;
        drawn.arriving.add(seen.responses[k], weight);
    }
    return drawn;
}

OraclePointResult OracleDome::estimate(const OraclePoint& point, const Occlusion& occlusion,
                                       Estimator estimator, int samples, std::uint64_t seed) const {
    OraclePointResult result;
    const Seen seen = respond(point, estimator);
    if (seen.cells.empty() || !(seen.cumulative.back() > 0.0)) return result;
    const dvec3 albedo = diffuseAlbedoOf(point.material);
    result.unshadowedIrradianceLux = seen.exact.diffuse;
    result.unshadowedDiffuseNit = seen.exact.diffuse * albedo / kPi;
    result.unshadowedSpecularNit = seen.exact.specular;
    std::array<Drawn, kReplicas> drawn;
    Response allArriving, all;
    for (int r = 0; r < kReplicas; ++r) {
        drawn[r] =
            draw(point, seen, occlusion, std::max(samples / kReplicas, 1), seedOf({seed, std::uint64_t(r)}));
        allArriving.add(drawn[r].arriving, 1.0);
        all.add(drawn[r].all, 1.0);
    }
    // True: each replica is corrected by the known sum, with a coefficient from the others, which keeps the
    // mean.
    const auto lightOf = [&](dvec3 Response::*part, const Drawn& one) {
        if (estimator == Estimator::Split) return seen.exact.*part * one.visible;
        dvec3 light;
        for (int c = 0; c < 3; ++c) {
            const double others = (all.*part)[c] - (one.all.*part)[c],
                         arriving = (allArriving.*part)[c] - (one.arriving.*part)[c];
            const double share = others > 0.0 ? std::clamp(arriving / others, 0.0, 1.0) : 0.0;
            light[c] = (one.arriving.*part)[c] + share * ((seen.exact.*part)[c] - (one.all.*part)[c]);
        }
        return light;
    };
    std::array<dvec3, kReplicas> totals;
    for (int r = 0; r < kReplicas; ++r) {
        const dvec3 lux = lightOf(&Response::diffuse, drawn[r]), nit = lightOf(&Response::specular, drawn[r]);
        result.irradianceLux += lux / double(kReplicas);
        result.specularNit += nit / double(kReplicas);
        totals[r] = lux * albedo / kPi + nit;
    }
    result.diffuseNit = result.irradianceLux * albedo / kPi;
    result.visibility = luminanceOf(result.irradianceLux) / luminanceOf(seen.exact.diffuse);
    result.standardErrorNit = standardErrorOf(totals, result.diffuseNit + result.specularNit);
    return result;
}

} // namespace kilolux::oracle
