#include "renderer/light_tree.h"

#include "renderer/document/light_shapes.h"
#include "renderer/lights_cpp/lights_f64.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace kilolux {

using namespace shared;

namespace {

constexpr double kPi = glm::pi<double>();
constexpr int kBins = 12; // per axis, in which splits are tried

struct Box {
    glm::dvec3 least{1e300}, most{-1e300};

    void add(const Box& other) {
        least = glm::min(least, other.least);
        most = glm::max(most, other.most);
    }
    glm::dvec3 size() const { return most - least; }
    double areaM2() const {
        const glm::dvec3 s = size();
        return 2.0 * (s.x * s.y + s.y * s.z + s.z * s.x);
    }
};

// Lights of one leaf, or together.
struct Bound {
    Box box;
    LightCone cone;
    double intensity = 0.0;
    double reachM = 0.0;
    bool any = false;

    void add(const Bound& other) {
        if (!other.any) return;
        cone = any ? coneAbout(cone, other.cone) : other.cone;
        box.add(other.box);
        intensity += other.intensity;
        reachM = std::max(reachM, other.reachM);
        any = true;
    }
};

struct Leaf {
    Bound bound;
    std::uint32_t slot = 0;
    glm::dvec3 middle{0.0}; // of the box; distant: the direction, which they are sorted by
};

// The part of space that a light's source fills.
Box sourceBox(const LightHot& hot) {
    const f64::LightHot light = f64::fromF32(hot);
    const std::uint32_t type = hot.typeFlags & LIGHT_TYPE_MASK;
    const glm::dmat3 frame = f64::lightFrame(light);
    glm::dvec3 reach(light.sizeM.x); // sphere, spot, disk
    if (type == LIGHT_TUBE) reach += glm::abs(frame[0]) * light.sizeM.y;
    if (type == LIGHT_RECT) reach = glm::abs(frame[0]) * light.sizeM.x + glm::abs(frame[1]) * light.sizeM.y;
    return {light.positionWs - reach, light.positionWs + reach};
}

LightCone emissionCone(const LightHot& hot) {
    const std::uint32_t type = hot.typeFlags & LIGHT_TYPE_MASK;
    if (type == LIGHT_DOME) return {{0.0, 0.0, 1.0}, kPi, 0.0};
    const glm::dvec3 axis = glm::normalize(glm::dvec3(hot.dirWs));
    if (type == LIGHT_DIRECTIONAL) return {axis, std::atan(double(hot.sizeM.x)), 0.0};
    if (shapeOf(LightType(type)).isFlat) return {axis, 0.0, kPi / 2.0};
    // A photometric profile may shine to where a cone does not.
    const bool shaped = hot.typeFlags >> LIGHT_SHAPING_SHIFT != 0u;
    if (type == LIGHT_SPOT && !shaped && hot.shaping.x > 0.0f) {
        const double outerRad = std::acos(std::clamp(-double(hot.shaping.y) / hot.shaping.x, -1.0, 1.0));
        if (outerRad < kPi / 2.0) return {axis, 0.0, outerRad};
    }
    return {axis, kPi, kPi / 2.0};
}

bool isDistant(const LightHot& hot) {
    const std::uint32_t type = hot.typeFlags & LIGHT_TYPE_MASK;
    return type == LIGHT_DIRECTIONAL || type == LIGHT_DOME;
}

Leaf leafOf(const LightHot& hot, std::uint32_t slot) {
    Leaf leaf;
    leaf.slot = slot;
    leaf.bound.any = true;
    leaf.bound.cone = emissionCone(hot);
    leaf.bound.intensity = 0.2126 * double(hot.intensity.x) + 0.7152 * double(hot.intensity.y) +
                           0.0722 * double(hot.intensity.z);
    leaf.bound.reachM = hot.invRange > 0.0f ? 1.0 / double(hot.invRange) : 1e30;
    const bool distant = isDistant(hot);
    if ((hot.typeFlags & LIGHT_TYPE_MASK) == LIGHT_DOME)
        leaf.bound.intensity *= kPi * double(hot.sizeM.x); // mean lux
    leaf.bound.box = distant ? Box{glm::dvec3(0.0), glm::dvec3(0.0)} : sourceBox(hot);
    leaf.middle = distant ? leaf.bound.cone.axis : 0.5 * (leaf.bound.box.least + leaf.bound.box.most);
    return leaf;
}

struct Split {
    double cost = 1e300;
    int axis = -1;
    int bin = 0; // lights of bins up to this one go to the first child
};

int binOf(const Leaf& leaf, const Box& middles, int axis) {
    const double t = (leaf.middle[axis] - middles.least[axis]) / middles.size()[axis];
    return std::clamp(int(t * kBins), 0, kBins - 1);
}

// Sections 4.2 and 4.3: intensity times area times measure of directions of both sides, times how much longer
// the box is elsewhere. A box without extent still has its directions to be told apart by.
double sideCost(const Bound& side) {
    return side.intensity * (side.box.areaM2() + 1e-9) * coneMeasure(side.cone);
}

void tryAxis(std::span<const Leaf> leaves, const Box& middles, const Box& box, int axis, Split& best) {
    if (middles.size()[axis] <= 0.0) return;
    std::array<Bound, kBins> bins;
    for (const Leaf& leaf : leaves)
        bins[std::size_t(binOf(leaf, middles, axis))].add(leaf.bound);
    const glm::dvec3 size = glm::max(box.size(), glm::dvec3(1e-6));
    const double elongation = std::max({size.x, size.y, size.z}) / size[axis];
    for (int bin = 0; bin + 1 < kBins; ++bin) {
        Bound first, second;
        for (int i = 0; i < kBins; ++i)
            (i <= bin ? first : second).add(bins[std::size_t(i)]);
        if (!first.any || !second.any) continue;
        const double cost = elongation * (sideCost(first) + sideCost(second));
        if (cost < best.cost) best = {cost, axis, bin};
    }
}

// How many of the leaves, put in order, go to the first child: at least one and not all.
std::size_t splitLeaves(std::span<Leaf> leaves, const Box& box) {
    Box middles;
    for (const Leaf& leaf : leaves)
        middles.add({leaf.middle, leaf.middle});
    Split best;
    for (int axis = 0; axis < 3; ++axis)
        tryAxis(leaves, middles, box, axis, best);
    if (best.axis < 0) return leaves.size() / 2; // all at one place
    const auto second = std::partition(leaves.begin(), leaves.end(), [&](const Leaf& leaf) {
        return binOf(leaf, middles, best.axis) <= best.bin;
    });
    return std::size_t(second - leaves.begin());
}

LightTreeNode nodeOf(const Bound& bound, bool distant) {
    LightTreeNode node{};
    node.leastWs = glm::vec3(bound.box.least);
    node.mostWs = glm::vec3(bound.box.most);
    node.slot = NO_RESERVOIR;
    node.axisWs = glm::vec3(bound.cone.axis);
    node.intensity = float(bound.intensity);
    node.cosSpread = float(std::cos(bound.cone.spreadRad));
    node.cosEmission = float(std::cos(bound.cone.emissionRad));
    node.reachM = float(bound.reachM);
    node.distant = distant;
    return node;
}

Bound boundOf(std::span<const Leaf> leaves) {
    Bound bound;
    for (const Leaf& leaf : leaves)
        bound.add(leaf.bound);
    return bound;
}

void appendNodes(std::span<Leaf> leaves, bool distant, std::vector<LightTreeNode>& nodes) {
    const Bound bound = boundOf(leaves);
    const std::size_t at = nodes.size();
    nodes.push_back(nodeOf(bound, distant));
    if (leaves.size() == 1) {
        nodes[at].slot = leaves.front().slot;
        return;
    }
    const std::size_t first = splitLeaves(leaves, bound.box);
    appendNodes(leaves.first(first), distant, nodes);
    nodes[at].second = std::uint32_t(nodes.size());
    appendNodes(leaves.subspan(first), distant, nodes);
}

} // namespace

LightCone coneAbout(const LightCone& a, const LightCone& b) {
    if (b.spreadRad > a.spreadRad) return coneAbout(b, a);
    const double between = std::acos(std::clamp(glm::dot(a.axis, b.axis), -1.0, 1.0));
    const double emission = std::max(a.emissionRad, b.emissionRad);
    if (std::min(between + b.spreadRad, kPi) <= a.spreadRad) return {a.axis, a.spreadRad, emission};
    const double spread = 0.5 * (a.spreadRad + between + b.spreadRad);
    if (spread >= kPi) return {a.axis, kPi, emission};
    // a's axis turned towards b's.
    const double turn = spread - a.spreadRad;
    const glm::dvec3 across = b.axis - a.axis * glm::dot(a.axis, b.axis);
    const double length = glm::length(across);
    if (length < 1e-12) return {a.axis, kPi, emission}; // opposite axes: any turn would do
    const glm::dvec3 axis = a.axis * std::cos(turn) + across * (std::sin(turn) / length);
    return {glm::normalize(axis), spread, emission};
}

double coneMeasure(const LightCone& cone) {
    const double o = cone.spreadRad, w = std::min(o + cone.emissionRad, kPi);
    return 2.0 * kPi * (1.0 - std::cos(o)) +
           0.5 * kPi * (2.0 * w * std::sin(o) - std::cos(o - 2.0 * w) - 2.0 * o * std::sin(o) + std::cos(o));
}

std::vector<LightTreeNode> makeLightTree(std::span<const LightHot> hot) {
    std::vector<Leaf> local, distant;
    for (std::size_t slot = 0; slot < hot.size(); ++slot) {
        if (hot[slot].typeFlags & (LIGHT_FLAG_DEAD | LIGHT_FLAG_MUTED)) continue;
        Leaf leaf = leafOf(hot[slot], std::uint32_t(slot));
        if (!(leaf.bound.intensity > 0.0)) continue;
        (isDistant(hot[slot]) ? distant : local).push_back(leaf);
    }
    std::vector<LightTreeNode> nodes;
    if (local.empty() && distant.empty()) return {nodeOf(Bound{}, false)};
    const bool both = !local.empty() && !distant.empty();
    if (both) nodes.push_back(nodeOf(boundOf(local), false)); // only its children are ever weighed
    if (!local.empty()) appendNodes(local, false, nodes);
    if (both) nodes[0].second = std::uint32_t(nodes.size());
    if (!distant.empty()) appendNodes(distant, true, nodes);
    return nodes;
}

} // namespace kilolux
