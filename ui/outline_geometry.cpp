#include "ui/outline_geometry.h"

#include "renderer/document/light_shapes.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace kilolux {

namespace {

constexpr double kLeastRadiusPx = 4.0; // unscaled, of a mark
constexpr double kSunRadiusPx = 7.0;
constexpr double kStemPx = 18.0;
constexpr double kSunStemPx = 36.0;
// A click on the middle of a mark means it, though a neighbour's outline passes there.
constexpr double kBehindCenterPx = 1.0;

// So that a curve looks round, and 10,000 small marks stay cheap.
int sidesOf(double radiusPx) {
    return std::clamp(int(4.0 * std::sqrt(radiusPx)), 6, 64);
}

glm::dvec3 unitOr(const glm::dvec3& v, const glm::dvec3& otherwise) {
    const double length = glm::length(v);
    return length > 0.0 ? v / length : otherwise;
}

} // namespace

double distanceToSegment(glm::dvec2 point, glm::dvec2 from, glm::dvec2 to) {
    const glm::dvec2 along = to - from;
    const double length2 = glm::dot(along, along);
    const double t = length2 > 0.0 ? std::clamp(glm::dot(point - from, along) / length2, 0.0, 1.0) : 0.0;
    return glm::distance(point, from + t * along);
}

void OutlineSet::addCircle(glm::dvec2 center, double radiusPx) {
    const int sides = sidesOf(radiusPx);
    glm::dvec2 from = center + glm::dvec2(radiusPx, 0.0);
    for (int i = 1; i <= sides; ++i) {
        const double angle = glm::two_pi<double>() * i / sides;
        const glm::dvec2 to = center + radiusPx * glm::dvec2(std::cos(angle), std::sin(angle));
        segments_.push_back({glm::vec2(from), glm::vec2(to)});
        from = to;
    }
}

void OutlineSet::addLine(const ScreenMap& map, const glm::dvec3& from, const glm::dvec3& to) {
    const ScreenMap::Point a = map.project(from), b = map.project(to);
    // What passes through the near plane is left out: it is wider than the picture there.
    if (a.inFront && b.inFront) segments_.push_back({glm::vec2(a.px), glm::vec2(b.px)});
}

void OutlineSet::addRing(const ScreenMap& map, const glm::dvec3& center, const glm::dvec3& x,
                         const glm::dvec3& y, double radiusPx) {
    const int sides = sidesOf(radiusPx);
    glm::dvec3 from = center + x;
    for (int i = 1; i <= sides; ++i) {
        const double angle = glm::two_pi<double>() * i / sides;
        const glm::dvec3 to = center + std::cos(angle) * x + std::sin(angle) * y;
        addLine(map, from, to);
        from = to;
    }
}

void OutlineSet::addCapsule(glm::dvec2 a, glm::dvec2 b, double radiusPx) {
    const glm::dvec2 along = glm::distance(a, b) > 1e-6 ? glm::normalize(b - a) : glm::dvec2(1.0, 0.0);
    const glm::dvec2 side(-along.y, along.x);
    const int sides = std::max(sidesOf(radiusPx) / 2, 4);
    std::vector<glm::dvec2> points;
    for (int end = 0; end < 2; ++end) {
        for (int i = 0; i <= sides; ++i) {
            const double angle = glm::pi<double>() * i / sides;
            const glm::dvec2 round = std::cos(angle) * side + std::sin(angle) * along;
            points.push_back(end == 0 ? b + radiusPx * round : a - radiusPx * round);
        }
    }
    for (std::size_t i = 0; i < points.size(); ++i)
        segments_.push_back({glm::vec2(points[i]), glm::vec2(points[(i + 1) % points.size()])});
}

// A stem of constant length in the picture, shortened where it points at or away from the viewer.
void OutlineSet::addStem(const ScreenMap& map, const glm::dvec3& center, const glm::dvec3& dir,
                         LightOutline& outline, double lengthPx) {
    const double lengthM = lengthPx / map.pxPerMetre(outline.depthM);
    const std::size_t before = segments_.size();
    addLine(map, center, center + lengthM * dir);
    outline.hasStem = segments_.size() > before;
}

void OutlineSet::addShape(const Scene& scene, const LightNode& light, const ScreenMap& map,
                          LightOutline& outline, double scale) {
    const LightDef& def = scene.lightDefs[std::size_t(light.def)];
    const glm::dmat4& world = scene.nodes[std::size_t(light.node)].worldFromNode;
    const glm::dvec3 center(world[3]);
    const double pxPerM = map.pxPerMetre(outline.depthM);
    const double least = kLeastRadiusPx * scale;
    const double radiusPx = std::max(def.radiusM * pxPerM, least);
    const bool isRound = def.type == LightType::Sphere;
    if (isRound) return addCircle(outline.centerPx, radiusPx);
    const glm::dvec3 x = unitOr(glm::dvec3(world[0]), {1, 0, 0}),
                     dir = -unitOr(glm::dvec3(world[2]), {0, 0, 1});
    const glm::dvec3 y = glm::cross(x, dir);
    switch (def.type) {
    case LightType::Directional:
        addCircle(outline.centerPx, kSunRadiusPx * scale);
        return addStem(map, center, dir, outline, kSunStemPx * scale);
    case LightType::Spot:
        addRing(map, center, x * (radiusPx / pxPerM), y * (radiusPx / pxPerM), radiusPx);
        break;
    case LightType::Disk: {
        const double radiusM = std::max(0.5 * def.widthM, least / pxPerM);
        addRing(map, center, x * radiusM, y * radiusM, radiusM * pxPerM);
        break;
    }
    case LightType::Rect: {
        const double grow = std::max(1.0, 2.0 * least / pxPerM / std::max(def.widthM, def.heightM));
        const glm::dvec3 u = x * (0.5 * grow * def.widthM), v = y * (0.5 * grow * def.heightM);
        addLine(map, center - u - v, center + u - v);
        addLine(map, center + u - v, center + u + v);
        addLine(map, center + u + v, center - u + v);
        addLine(map, center - u + v, center - u - v);
        break;
    }
    case LightType::Tube: {
        const ScreenMap::Point a = map.project(center - 0.5 * def.lengthM * x),
                               b = map.project(center + 0.5 * def.lengthM * x);
        if (a.inFront && b.inFront) addCapsule(a.px, b.px, std::max(def.radiusM * pxPerM, 0.5 * least));
        return; // shines all around
    }
    case LightType::Sphere:
        break;
    }
    addStem(map, center, dir, outline, kStemPx * scale);
}

void OutlineSet::build(const Scene& scene, const Viewport& viewport, double scale) {
    outlines_.clear();
    segments_.clear();
    const ScreenMap map(viewport);
    const ViewportRect& rect = map.rect();
    const auto& nodes = scene.nodes.read();
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const LightNode& light = scene.lights[i];
        const glm::dvec3 center(nodes[std::size_t(light.node)].worldFromNode[3]);
        const ScreenMap::Point point = map.project(center);
        if (!point.inFront) continue;
        LightOutline outline;
        outline.light = int(i);
        outline.centerPx = point.px;
        outline.depthM = point.depthM;
        const LightDef& def = scene.lightDefs[std::size_t(light.def)];
        const double extentPx = shapeOf(def.type).extentM(def) * map.pxPerMetre(point.depthM);
        outline.radiusPx = std::max(extentPx, kSunRadiusPx * scale);
        const double margin = outline.radiusPx + kSunStemPx * scale;
        if (point.px.x < rect.x - margin || point.px.x > rect.x + rect.width + margin ||
            point.px.y < rect.y - margin || point.px.y > rect.y + rect.height + margin)
            continue;
        outline.first = segments_.size();
        addShape(scene, light, map, outline, scale);
        outline.count = segments_.size() - outline.first;
        outlines_.push_back(outline);
    }
}

std::vector<int> OutlineSet::at(glm::dvec2 px, double reachPx) const {
    struct Hit {
        double wholePx, depthM;
        int light;
    };
    std::vector<Hit> hits;
    for (const LightOutline& outline : outlines_) {
        const double fromCenter = glm::distance(px, outline.centerPx);
        if (fromCenter > outline.radiusPx + reachPx + 3.0 * kSunStemPx) continue;
        double nearest = fromCenter;
        for (const Segment& segment : segmentsOf(outline))
            nearest = std::min(nearest, distanceToSegment(px, segment.from, segment.to) + kBehindCenterPx);
        if (nearest <= reachPx) hits.push_back({std::floor(nearest), outline.depthM, outline.light});
    }
    std::stable_sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) {
        return a.wholePx != b.wholePx ? a.wholePx < b.wholePx : a.depthM < b.depthM;
    });
    std::vector<int> lights;
    for (const Hit& hit : hits)
        lights.push_back(hit.light);
    return lights;
}

std::vector<int> OutlineSet::within(glm::dvec2 a, glm::dvec2 b) const {
    const glm::dvec2 low = glm::min(a, b), high = glm::max(a, b);
    std::vector<int> lights;
    for (const LightOutline& outline : outlines_) {
        const glm::dvec2 p = outline.centerPx;
        if (p.x >= low.x && p.y >= low.y && p.x <= high.x && p.y <= high.y) lights.push_back(outline.light);
    }
    return lights;
}

} // namespace kilolux
