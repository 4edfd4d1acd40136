#include "content/make/ltc_fit.h"

#include "renderer/lights_cpp/lights_f64.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <thread>
#include <vector>

namespace kilolux {
namespace {

constexpr double kPi = 3.14159265358979323846;
const glm::dvec3 kNormal(0.0, 0.0, 1.0);

// The surface lies in z = 0 and the viewer in the x-z plane.
struct View {
    double noV;
    double alpha;
    glm::dvec3 dir;
};

struct Sample {
    glm::dvec3 dir;
    double value;  // GGX D * V * cosine
    double perPdf; // solid angle that the sample stands for
};

// Half vectors as the viewer sees them (Heitz, "Sampling the GGX Distribution of Visible Normals", JCGT 2018,
// appendix A), for a point of the unit disk; then mirrored. Symmetric about y = 0, so half the disk will do.
glm::dvec3 mirroredDirection(const View& view, double u, double v) {
    const glm::dvec3 stretched = glm::normalize(glm::dvec3(view.alpha * view.dir.x, 0.0, view.dir.z));
    const glm::dvec3 bitangent(0.0, 1.0, 0.0);
    const glm::dvec3 tangent = glm::cross(bitangent, stretched);
    const double r = std::sqrt(u);
    const double phi = kPi * v;
    const double p1 = r * std::sin(phi); // along +y only
    double p2 = r * std::cos(phi);
    const double s = 0.5 * (1.0 + stretched.z);
    p2 = (1.0 - s) * std::sqrt(1.0 - p1 * p1) + s * p2;
    const double p3 = std::sqrt(std::max(0.0, 1.0 - p1 * p1 - p2 * p2));
    // Heitz's T1 is square to the view direction and level, T2 completes the frame.
    const glm::dvec3 h = p1 * bitangent - p2 * tangent + p3 * stretched;
    const glm::dvec3 micro =
        glm::normalize(glm::dvec3(view.alpha * h.x, view.alpha * h.y, std::max(1e-12, h.z)));
    return 2.0 * glm::dot(view.dir, micro) * micro - view.dir;
}

// Samples of the half hemisphere y >= 0, each standing for itself and its mirror image.
std::vector<Sample> sampleLobe(const View& view, int count) {
    const double a2 = view.alpha * view.alpha;
    const double g1 = 2.0 * view.noV / (view.noV + std::sqrt(a2 + (1.0 - a2) * view.noV * view.noV));
    std::vector<Sample> samples;
    for (int i = 0; i < count; ++i)
        for (int j = 0; j < count; ++j) {
            const glm::dvec3 dir = mirroredDirection(view, (i + 0.5) / count, (j + 0.5) / count);
            if (dir.z <= 0.0) continue;
            const glm::dvec3 half = glm::normalize(dir + view.dir);
            const double sin2 = half.x * half.x + half.y * half.y;
            const double pdf = g1 * f64::ggxD(half.z, sin2, view.alpha) / (4.0 * view.noV);
            const double value = f64::ggxTimesCosine(kNormal, view.dir, view.noV, dir, view.alpha).x;
            samples.push_back({dir, value, 1.0 / (pdf * count * count)});
        }
    return samples;
}

struct Albedo {
    double all = 0.0;     // integral of D * V * cosine
    double grazing = 0.0; // the same times Schlick's weight
};

Albedo integrateLobe(const View& view) {
    Albedo albedo;
    for (const Sample& sample : sampleLobe(view, 192)) {
        const double value = sample.value * sample.perPdf;
        albedo.all += value;
        albedo.grazing += value * f64::ggxTimesCosine(kNormal, view.dir, view.noV, sample.dir, view.alpha).y;
    }
    return albedo;
}

f64::LtcLobe lobeOf(const View& view, const glm::dvec4& parameters, double integral) {
    f64::LtcLobe lobe = f64::ltcLobeFromParameters(glm::dmat3(1.0), view.noV, view.alpha, parameters);
    lobe.amplitude = integral / std::max(f64::ltcShareAboveHorizon(lobe, kNormal), 1e-3);
    return lobe;
}

// What the search minimizes: squared error against value plus 2 % of the peak, so that neither the peak nor
// the flanks are given up.
struct ShapeError {
    const View& view;
    const std::vector<Sample>& samples;
    double integral;
    double peak;

    // point: log x, log y, skew, tilt.
    double operator()(const glm::dvec4& point) const {
        if (std::abs(point.x) > 8.0 || std::abs(point.y) > 8.0 || std::abs(point.w) * view.alpha > kPi)
            return 1e6;
        const f64::LtcLobe lobe =
            lobeOf(view, {std::exp(point.x), std::exp(point.y), point.z, point.w}, integral);
        double sum = 0.0;
        for (const Sample& sample : samples) {
            const double difference = lobe.amplitude * f64::ltcDensity(lobe, sample.dir) - sample.value;
            sum += difference * difference / (sample.value + 0.02 * peak) * sample.perPdf;
        }
        return sum / integral;
    }
};

// Nelder and Mead, "A Simplex Method for Function Minimization", 1965, in four dimensions.
template<typename Function>
glm::dvec4 minimize(const Function& function, const glm::dvec4& start, double step, int iterations) {
    std::array<std::pair<double, glm::dvec4>, 5> simplex;
    for (int i = 0; i < 5; ++i) {
        glm::dvec4 point = start;
        if (i > 0) point[i - 1] += step;
        simplex[i] = {function(point), point};
    }
    const auto lower = [](const auto& a, const auto& b) { return a.first < b.first; };
    for (int iteration = 0; iteration < iterations; ++iteration) {
        std::stable_sort(simplex.begin(), simplex.end(), lower);
        if (simplex[4].first - simplex[0].first < 1e-9 * (1e-6 + simplex[0].first)) break;
        glm::dvec4 center(0.0);
        for (int i = 0; i < 4; ++i)
            center += simplex[i].second * 0.25;
        const auto tryAt = [&](double t) {
            const glm::dvec4 point = center + (simplex[4].second - center) * t;
            return std::pair(function(point), point);
        };
        const auto reflected = tryAt(-1.0);
        if (reflected.first < simplex[0].first) {
            const auto expanded = tryAt(-2.0);
            simplex[4] = expanded.first < reflected.first ? expanded : reflected;
        } else if (reflected.first < simplex[3].first) {
            simplex[4] = reflected;
        } else {
            const auto contracted = tryAt(reflected.first < simplex[4].first ? -0.5 : 0.5);
            if (contracted.first < std::min(reflected.first, simplex[4].first)) {
                simplex[4] = contracted;
            } else {
                for (int i = 1; i < 5; ++i) {
                    simplex[i].second = glm::mix(simplex[0].second, simplex[i].second, 0.5);
                    simplex[i].first = function(simplex[i].second);
                }
            }
        }
    }
    return std::min_element(simplex.begin(), simplex.end(), lower)->second;
}

} // namespace

LtcFit fitLtc(double noV, double roughness, glm::dvec4 start) {
    const View view{noV, roughness * roughness, {std::sqrt(1.0 - noV * noV), 0.0, noV}};
    const Albedo albedo = integrateLobe(view);
    const std::vector<Sample> samples = sampleLobe(view, 28);
    double peak = 0.0;
    for (const Sample& sample : samples)
        peak = std::max(peak, sample.value);
    const ShapeError error{view, samples, albedo.all, peak};
    glm::dvec4 point(std::log(start.x), std::log(start.y), start.z, start.w);
    point = minimize(error, point, 0.1, 200);
    point = minimize(error, point, 0.02, 200); // a fresh simplex gets out of a collapsed one

    LtcFit fit;
    fit.parameters = {std::exp(point.x), std::exp(point.y), point.z, point.w};
    fit.error = error(point);
    const f64::LtcLobe lobe = lobeOf(view, fit.parameters, albedo.all);
    fit.scales = {lobe.amplitude, albedo.all - albedo.grazing, albedo.grazing, fit.error};
    return fit;
}

LtcTable fitLtcTable(int width, int height, int threads) {
    LtcTable table{.width = width, .height = height};
    table.parameters.resize(static_cast<std::size_t>(width) * height);
    table.scales.resize(table.parameters.size());
    std::atomic<int> nextRow = 0;
    const auto fitRows = [&] {
        for (int row = nextRow++; row < height; row = nextRow++) {
            glm::dvec4 start(2.0, 2.0, 0.0, 0.0);
            // From the normal to grazing, each node from its neighbour's result.
            for (int column = width - 1; column >= 0; --column) {
                const glm::dvec2 node(column / (width - 1.0), row / (height - 1.0));
                const glm::dvec2 inputs = f64::ltcInputsFromNode(node);
                const LtcFit fit = fitLtc(inputs.x, inputs.y, start);
                const std::size_t index = static_cast<std::size_t>(row) * width + column;
                table.parameters[index] = glm::vec4(fit.parameters);
                table.scales[index] = glm::vec4(fit.scales);
                start = fit.parameters;
            }
        }
    };
    std::vector<std::thread> pool;
    for (int i = 0; i < threads; ++i)
        pool.emplace_back(fitRows);
    for (std::thread& thread : pool)
        thread.join();
    return table;
}

} // namespace kilolux
