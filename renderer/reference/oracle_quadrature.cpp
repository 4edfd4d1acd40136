// Graded and adaptive Gauss-Legendre cubature over a light's directions. A GGX lobe is analytic except near
// half vectors within about alpha of the normal, so cells whose half vectors span less than their distance to
// the normal (or alpha) converge geometrically; that is the grading rule.
#include "renderer/reference/oracle_quadrature.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <span>

namespace kilolux::oracle {

namespace {

using glm::dvec3;

struct Node {
    double at; // in [-1,1]
    double weight;
};

// Abramowitz and Stegun, table 25.4.
constexpr Node kGauss4[] = {{-0.861136311594052575, 0.347854845137453857},
                            {-0.339981043584856265, 0.652145154862546143},
                            {0.339981043584856265, 0.652145154862546143},
                            {0.861136311594052575, 0.347854845137453857}};
constexpr Node kGauss6[] = {
    {-0.932469514203152028, 0.171324492379170345}, {-0.661209386466264514, 0.360761573048138608},
    {-0.238619186083196909, 0.467913934572691047}, {0.238619186083196909, 0.467913934572691047},
    {0.661209386466264514, 0.360761573048138608},  {0.932469514203152028, 0.171324492379170345}};

constexpr double kGradeRatio = 0.8;
constexpr int kMaxDepth = 40;
constexpr std::size_t kMaxCells = 6000;

std::span<const Node> gaussRule(int order) {
    return order == 4 ? std::span<const Node>(kGauss4) : std::span<const Node>(kGauss6);
}

LobeIntegral& operator+=(LobeIntegral& a, const LobeIntegral& b) {
    a.diffuse += b.diffuse;
    a.specularF0 += b.specularF0;
    a.specularOne += b.specularOne;
    return a;
}

LobeIntegral scaled(const LobeValue& value, double factor) {
    return {value.noL * factor, value.specularF0 * factor, value.specularOne * factor};
}

double specularOf(const LobeIntegral& integral) {
    return integral.specularF0 + integral.specularOne;
}

dvec3 halfVector(const dvec3& view, const dvec3& lightDir) {
    const dvec3 sum = view + lightDir;
    const double length = glm::length(sum);
    return length > 0.0 ? sum / length : dvec3(0.0);
}

} // namespace

LobeQuadrature::LobeQuadrature(const SourceRegion& region, const Lobe& lobe, double tolerance)
    : region_(region), lobe_(lobe) {
    const std::vector<double>& breaks = region_.breaks();
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
        grade({breaks[i], breaks[i + 1], 0.0, 1.0, {}, {}}, 0);
    for (Cell& cell : cells_) {
        evaluate(cell);
        total_ += cell.sum;
    }
    refine(tolerance);
}

dvec3 LobeQuadrature::direction(double phiRad, double thetaRad) const {
    return region_.pole() * std::cos(thetaRad) + region_.azimuth(phiRad) * std::sin(thetaRad);
}

void LobeQuadrature::grade(const Cell& cell, int depth) {
    const double phiMid = 0.5 * (cell.phi0 + cell.phi1);
    const double sMid = 0.5 * (cell.s0 + cell.s1);
    const auto halfAt = [&](double phi, double s) {
        return halfVector(lobe_.view, direction(phi, s * region_.thetaMax(phi)));
    };
    const dvec3 outer[3] = {halfAt(cell.phi0, cell.s1), halfAt(phiMid, cell.s1), halfAt(cell.phi1, cell.s1)};
    const dvec3 inner = halfAt(phiMid, cell.s0);
    const dvec3 middle = halfAt(phiMid, sMid);
    double nearest = glm::length(middle - lobe_.normal);
    for (const dvec3& h : {outer[0], outer[1], outer[2], inner})
        nearest = std::min(nearest, glm::length(h - lobe_.normal));
    const double acrossPhi = glm::length(outer[1] - outer[0]) + glm::length(outer[2] - outer[1]);
    const double acrossS = glm::length(outer[1] - middle) + glm::length(middle - inner);
    const double allowed = kGradeRatio * std::sqrt(lobe_.alpha * lobe_.alpha + nearest * nearest);
    if (depth >= kMaxDepth || std::max(acrossPhi, acrossS) <= allowed) {
        cells_.push_back(cell);
        return;
    }
    Cell low = cell;
    Cell high = cell;
    if (acrossPhi > acrossS)
        low.phi1 = high.phi0 = phiMid;
    else
        low.s1 = high.s0 = sMid;
    grade(low, depth + 1);
    grade(high, depth + 1);
}

LobeIntegral LobeQuadrature::sumWithOrder(const Cell& cell, int order) const {
    const double phiHalf = 0.5 * (cell.phi1 - cell.phi0);
    const double sHalf = 0.5 * (cell.s1 - cell.s0);
    LobeIntegral sum;
    for (const Node& phiNode : gaussRule(order)) {
        const double phi = cell.phi0 + phiHalf * (1.0 + phiNode.at);
        const dvec3 azimuth = region_.azimuth(phi);
        const double thetaMax = region_.thetaMax(phi);
        for (const Node& sNode : gaussRule(order)) {
            const double theta = (cell.s0 + sHalf * (1.0 + sNode.at)) * thetaMax;
            const double sinTheta = std::sin(theta);
            const dvec3 l = region_.pole() * std::cos(theta) + azimuth * sinTheta;
            const double weight = phiNode.weight * phiHalf * sNode.weight * sHalf * thetaMax * sinTheta;
            sum += scaled(lobe_(l), weight);
        }
    }
    return sum;
}

void LobeQuadrature::evaluate(Cell& cell) const {
    cell.sum = sumWithOrder(cell, 6);
    cell.coarse = sumWithOrder(cell, 4);
}

double LobeQuadrature::disagreement(const Cell& cell) const {
    constexpr double kNegligibleSpecular = 1e-6; // of the diffuse part
    const double diffuse =
        std::abs(cell.sum.diffuse - cell.coarse.diffuse) / std::max(total_.diffuse, 1e-300);
    const double specular = std::abs(specularOf(cell.sum) - specularOf(cell.coarse)) /
                            std::max(specularOf(total_) + kNegligibleSpecular * total_.diffuse, 1e-300);
    return std::max(diffuse, specular);
}

void LobeQuadrature::refine(double tolerance) {
    using Entry = std::pair<double, std::size_t>;
    std::priority_queue<Entry> worst;
    double error = 0.0;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        worst.push({disagreement(cells_[i]), i});
        error += disagreement(cells_[i]);
    }
    while (error > tolerance && cells_.size() < kMaxCells) {
        const auto [cellError, index] = worst.top();
        worst.pop();
        error -= cellError;
        const Cell parent = cells_[index];
        const double phiMid = 0.5 * (parent.phi0 + parent.phi1);
        const double sMid = 0.5 * (parent.s0 + parent.s1);
        for (int child = 0; child < 4; ++child) {
            Cell cell = parent;
            ((child & 1) ? cell.phi0 : cell.phi1) = phiMid;
            ((child & 2) ? cell.s0 : cell.s1) = sMid;
            evaluate(cell);
            const std::size_t slot = child == 0 ? index : cells_.size();
            if (child == 0)
                cells_[index] = cell;
            else
                cells_.push_back(cell);
            worst.push({disagreement(cell), slot});
            error += disagreement(cell);
        }
    }
    total_ = {};
    for (const Cell& cell : cells_)
        total_ += cell.sum;
}

void LobeQuadrature::prepareSampling(double f0) {
    f0_ = f0;
    const auto specular = [&](const LobeIntegral& i) { return f0_ * i.specularF0 + i.specularOne; };
    const double specularTotal = specular(total_);
    cumulative_.clear();
    double sum = 0.0;
    for (Cell& cell : cells_) {
        cell.weight = std::max(cell.sum.diffuse, 0.0) / std::max(total_.diffuse, 1e-300);
        if (specularTotal > 0.0) cell.weight += std::max(specular(cell.sum), 0.0) / specularTotal;
        sum += cell.weight;
        cumulative_.push_back(sum);
    }
}

LobeQuadrature::Sample LobeQuadrature::draw(double u, double v) const {
    const double sum = cumulative_.back();
    const double target = u * sum;
    std::size_t index =
        std::upper_bound(cumulative_.begin(), cumulative_.end(), target) - cumulative_.begin();
    index = std::min(index, cells_.size() - 1);
    const Cell& cell = cells_[index];
    const double before = index == 0 ? 0.0 : cumulative_[index - 1];
    const double rest = std::clamp((target - before) / std::max(cell.weight, 1e-300), 0.0, 1.0);
    const double phi = cell.phi0 + (cell.phi1 - cell.phi0) * rest;
    // s has density proportional to s: the measure sin(theta) dtheta vanishes at the pole.
    const double sRange2 = cell.s1 * cell.s1 - cell.s0 * cell.s0;
    const double s = std::sqrt(cell.s0 * cell.s0 + v * sRange2);
    const double thetaMax = region_.thetaMax(phi);
    const double theta = s * thetaMax;
    const double sinOverS = theta > 0.0 ? std::sin(theta) / s : thetaMax;
    const double pdf = cell.weight / sum * 2.0 / ((cell.phi1 - cell.phi0) * sRange2); // per dphi (s ds)
    Sample sample;
    sample.direction = direction(phi, theta);
    sample.value = scaled(lobe_(sample.direction), sinOverS * thetaMax / pdf);
    return sample;
}

namespace {

double diffuseWedge(const SourceRegion& region, const dvec3& normalWs, double phi0, double phi1, int order) {
    const double half = 0.5 * (phi1 - phi0);
    const double poleCos = glm::dot(normalWs, region.pole());
    double sum = 0.0;
    for (const Node& node : gaussRule(order)) {
        const double phi = phi0 + half * (1.0 + node.at);
        const double theta = region.thetaMax(phi);
        const double sinTheta = std::sin(theta);
        sum += node.weight * half *
               (0.5 * poleCos * sinTheta * sinTheta +
                0.5 * glm::dot(normalWs, region.azimuth(phi)) * (theta - sinTheta * std::cos(theta)));
    }
    return sum;
}

double diffuseAdaptive(const SourceRegion& region, const dvec3& normalWs, double phi0, double phi1,
                       double whole, double tolerance, int depth) {
    const double mid = 0.5 * (phi0 + phi1);
    const double low = diffuseWedge(region, normalWs, phi0, mid, 6);
    const double high = diffuseWedge(region, normalWs, mid, phi1, 6);
    if (depth >= 30 || std::abs(low + high - whole) <= tolerance) return low + high;
    return diffuseAdaptive(region, normalWs, phi0, mid, low, 0.5 * tolerance, depth + 1) +
           diffuseAdaptive(region, normalWs, mid, phi1, high, 0.5 * tolerance, depth + 1);
}

} // namespace

double diffuseIntegral(const SourceRegion& region, const dvec3& normalWs) {
    constexpr double kRelativeTolerance = 1e-9;
    const std::vector<double>& breaks = region.breaks();
    double rough = 0.0;
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
        rough += diffuseWedge(region, normalWs, breaks[i], breaks[i + 1], 6);
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
        sum += diffuseAdaptive(region, normalWs, breaks[i], breaks[i + 1],
                               diffuseWedge(region, normalWs, breaks[i], breaks[i + 1], 6),
                               kRelativeTolerance * std::abs(rough), 0);
    return sum;
}

} // namespace kilolux::oracle
