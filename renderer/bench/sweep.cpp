#include "renderer/bench/sweep.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <numeric>
#include <random>

namespace kilolux::bench {

namespace {

struct SweepRow {
    Sweep sweep;
    std::string_view name;
    std::array<double, 5> factors;
    std::size_t count;
};

constexpr std::array kSweeps = {
    SweepRow{Sweep::None, "", {1.0}, 1},
    SweepRow{Sweep::Lights, "lights", {0.125, 0.5, 1.0, 4.0, 16.0}, 5},
    SweepRow{Sweep::Resolution, "resolution", {0.25, 0.5, 1.0, 2.0, 4.0}, 5}, // of pixels
    SweepRow{Sweep::Triangles, "triangles", {1.0, 4.0, 16.0}, 3},
    SweepRow{Sweep::Rays, "rays", {0.25, 0.5, 1.0, 2.0, 4.0}, 5},
};

const SweepRow& rowOf(Sweep sweep) {
    return *std::find_if(kSweeps.begin(), kSweeps.end(),
                         [&](const SweepRow& row) { return row.sweep == sweep; });
}

void keepLights(Scene& scene, double share) {
    const std::vector<LightNode>& lights = scene.lights.read();
    std::vector<std::size_t> order(lights.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::shuffle(order.begin(), order.end(), std::mt19937(1));
    order.resize(
        std::clamp<std::size_t>(std::size_t(std::lround(share * double(order.size()))), 1, order.size()));
    std::sort(order.begin(), order.end());
    std::vector<LightNode> kept;
    for (const std::size_t i : order)
        kept.push_back(lights[i]);
    scene.lights = kept;
}

void copyLights(Scene& scene, int copies) {
    for (LightDef& def : scene.lightDefs.write())
        def.intensity /= copies;
    std::mt19937 random(2);
    std::uniform_real_distribution<double> offsetM(-0.5, 0.5);
    std::vector<Node>& nodes = scene.nodes.write();
    std::vector<LightNode> lights = scene.lights.read();
    std::uint64_t lastId = 0;
    for (const LightNode& light : lights)
        lastId = std::max(lastId, light.id);
    const std::size_t count = lights.size();
    for (int copy = 1; copy < copies; ++copy) {
        for (std::size_t i = 0; i < count; ++i) {
            // A node of its own, below none: where it is in the world is where it is.
            Node node = nodes[std::size_t(lights[i].node)];
            const glm::dvec3 offset(offsetM(random), 0.2 * offsetM(random), offsetM(random));
            node.worldFromNode = glm::translate(glm::dmat4(1.0), offset) * node.worldFromNode;
            node.localFromNode = node.worldFromNode;
            node.restTrs.reset();
            node.parent = -1;
            node.mesh = -1;
            LightNode light = lights[i];
            light.node = int(nodes.size());
            light.id = lastId == 0 ? 0 : ++lastId;
            nodes.push_back(node);
            lights.push_back(light);
        }
    }
    scene.lights = lights;
}

template<typename T>
void appendMiddle(std::vector<T>& values, std::uint32_t a, std::uint32_t b) {
    if (!values.empty()) values.push_back(0.5f * (values[a] + values[b]));
}

void splitTriangles(Primitive& primitive) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [at, isNew] =
            middles.try_emplace(std::minmax(a, b), std::uint32_t(primitive.positions.size()));
        if (isNew) {
            appendMiddle(primitive.positions, a, b);
            appendMiddle(primitive.normals, a, b); // shaders make them unit
            appendMiddle(primitive.tangents, a, b);
            appendMiddle(primitive.uv0, a, b);
            appendMiddle(primitive.uv1, a, b);
            appendMiddle(primitive.colors, a, b);
        }
        return at->second;
    };
    std::vector<std::uint32_t> indices;
    for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        const std::uint32_t a = primitive.indices[i], b = primitive.indices[i + 1],
                            c = primitive.indices[i + 2];
        const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        indices.insert(indices.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
    }
    primitive.indices = std::move(indices);
}

} // namespace

std::string_view sweepName(Sweep sweep) {
    return rowOf(sweep).name;
}

std::optional<Sweep> sweepFromName(std::string_view name) {
    for (const SweepRow& row : kSweeps)
        if (row.name == name) return row.sweep;
    return std::nullopt;
}

std::span<const double> sweepFactors(Sweep sweep) {
    const SweepRow& row = rowOf(sweep);
    return {row.factors.data(), row.count};
}

void scaleLights(Scene& scene, double factor) {
    if (scene.lights.empty()) return;
    if (factor < 1.0)
        keepLights(scene, factor);
    else if (factor > 1.0)
        copyLights(scene, int(std::lround(factor)));
}

void scaleTriangles(Scene& scene, double factor) {
    for (double left = factor; left > 3.9; left /= 4.0) {
        for (std::shared_ptr<const Mesh>& mesh : scene.meshes) {
            auto split = std::make_shared<Mesh>(*mesh);
            for (Primitive& primitive : split->primitives)
                splitTriangles(primitive);
            mesh = split;
        }
    }
}

void applySweep(Sweep sweep, double factor, Scene& scene, int& width, int& height) {
    if (sweep == Sweep::Lights) scaleLights(scene, factor);
    if (sweep == Sweep::Triangles) scaleTriangles(scene, factor);
    if (sweep != Sweep::Resolution) return;
    width = std::max(8, int(std::lround(width * std::sqrt(factor))));
    height = std::max(8, int(std::lround(height * std::sqrt(factor))));
}

void applySweep(Sweep sweep, double factor, Settings& settings) {
    if (sweep != Sweep::Rays) return;
    settings.raysPerPixel = factor;
    settings.raysPerLight = std::max(1, int(factor));
}

} // namespace kilolux::bench
