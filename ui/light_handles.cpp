#include "ui/light_handles.h"

#include "renderer/document/light_properties.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kilolux {

namespace {

constexpr double kHalfPi = 1.57079632679489661923;

struct Builder {
    const HandleFrame& frame;
    std::vector<LightHandle> handles;

    glm::dvec3 at(const glm::dvec3& local) const { return frame.centerWs + frame.axes * local; }

    // `share`: of the value, how far the dot moves: a half for sizes about the middle.
    void line(const char* field, double value, const glm::dvec3& from, const glm::dvec3& dir, double share) {
        LightHandle handle{field, value, 0};
        handle.originWs = at(from + frame.gapM * dir);
        handle.alongWs = share * (frame.axes * dir);
        handles.push_back(handle);
    }
    void arc(const char* field, double value, const glm::dvec3& center, const glm::dvec3& along,
             const glm::dvec3& across) {
        LightHandle handle{field, value, 0, true};
        handle.originWs = at(center);
        handle.alongWs = frame.axes * along;
        handle.acrossWs = frame.axes * across;
        handle.most = kHalfPi;
        handles.push_back(handle);
    }
};

struct FlapFields {
    const char *angle, *length;
};
constexpr FlapFields kFlapFields[] = {{"barnDoorLeftAngleRad", "barnDoorLeftLengthM"},
                                      {"barnDoorRightAngleRad", "barnDoorRightLengthM"},
                                      {"barnDoorTopAngleRad", "barnDoorTopLengthM"},
                                      {"barnDoorBottomAngleRad", "barnDoorBottomLengthM"}};
constexpr FlapFields kPairFields{"barnDoorAngleRad", "barnDoorLengthM"};

// The angle at the middle of the free edge, the length at a quarter of it.
void addFlap(Builder& builder, const LightDef& def, std::size_t side, const FlapFields& fields) {
    const BarnDoor& door = def.barnDoors[side];
    const auto corners = barnDoorCorners(def, BarnDoorSide(side));
    const glm::dvec3 hinge = 0.5 * (corners[0] + corners[1]), edge = 0.5 * (corners[1] - corners[0]);
    const glm::dvec3 out =
        side < 2 ? glm::dvec3(hinge.x > 0.0 ? 1 : -1, 0, 0) : glm::dvec3(0, hinge.y > 0.0 ? 1 : -1, 0);
    const glm::dvec3 ahead(0, 0, -1);
    const glm::dvec3 flapDir = std::sin(door.angleRad) * out + std::cos(door.angleRad) * ahead;
    builder.line(fields.length, door.lengthM, hinge + 0.5 * edge, flapDir, 1.0);
    if (door.lengthM > 0.0)
        builder.arc(fields.angle, door.angleRad, hinge, (door.lengthM + builder.frame.gapM) * ahead,
                    (door.lengthM + builder.frame.gapM) * out);
}

void addRect(Builder& builder, const LightDef& def, DoorNumbers doors) {
    // At corners, so that flaps and arrows keep the middles.
    const glm::dvec3 left(-1, 0, 0), down(0, -1, 0);
    builder.line("widthM", def.widthM, glm::dvec3(0, 0.5 * def.heightM, 0), left, 0.5);
    builder.line("heightM", def.heightM, glm::dvec3(-0.5 * def.widthM, 0, 0), down, 0.5);
    if (doors == DoorNumbers::OnePair)
        return addFlap(builder, def, std::size_t(BarnDoorSide::Top), kPairFields);
    for (std::size_t side = 0; side < 4; ++side)
        addFlap(builder, def, side, kFlapFields[side]);
}

} // namespace

glm::dvec3 LightHandle::pointAt(double v) const {
    return isArc ? originWs + std::cos(v) * alongWs + std::sin(v) * acrossWs : originWs + v * alongWs;
}

std::vector<LightHandle> handlesOf(const LightDef& def, const HandleFrame& frame, DoorNumbers doors) {
    Builder builder{frame, {}};
    const glm::dvec3 left(-1, 0, 0), down(0, -1, 0), ahead(0, 0, -1);
    switch (def.type) {
    case LightType::Directional:
        return {};
    case LightType::Sphere:
        builder.line("radiusM", def.radiusM, {}, left, 1.0);
        break;
    case LightType::Spot:
        builder.line("radiusM", def.radiusM, {}, left, 1.0);
        builder.arc("outerConeRad", def.outerConeRad, {}, frame.coneM * ahead, frame.coneM * left);
        builder.arc("innerConeRad", def.innerConeRad, {}, frame.coneM * ahead, frame.coneM * down);
        break;
    case LightType::Tube:
        builder.line("lengthM", def.lengthM, def.radiusM * left, left, 0.5);
        builder.line("radiusM", def.radiusM, {}, down, 1.0);
        break;
    case LightType::Rect:
        addRect(builder, def, doors);
        break;
    case LightType::Disk:
        builder.line("widthM", def.widthM, {}, left, 0.5);
        break;
    }
    if (def.rangeM) builder.line("rangeM", *def.rangeM, {}, ahead, 1.0);
    return builder.handles;
}

int handleAt(std::span<const LightHandle> handles, const Viewport& viewport, glm::dvec2 px, double reachPx) {
    int best = -1;
    double bestPx = reachPx;
    for (std::size_t i = 0; i < handles.size(); ++i) {
        const auto dot = viewport.project(handles[i].pointWs());
        if (!dot || glm::distance(*dot, px) > bestPx) continue;
        bestPx = glm::distance(*dot, px);
        best = int(i);
    }
    return best;
}

HandleDrag::HandleDrag(const LightHandle& handle, const Viewport& viewport, glm::dvec2 startPx)
    : handle_(handle) {
    if (const auto dot = viewport.project(handle.pointWs())) offsetPx_ = *dot - startPx;
}

namespace {

// Where a line passes nearest to what the pointer sees, in units of the value.
double onLine(const LightHandle& handle, const ViewRay& ray, double otherwise) {
    const double unitM = glm::length(handle.alongWs);
    const glm::dvec3 dir = handle.alongWs / unitM, between = ray.originWs - handle.originWs;
    const double cosine = glm::dot(dir, ray.dirWs), sine2 = 1.0 - cosine * cosine;
    if (sine2 < 1e-4) return otherwise; // it points at the viewer
    return (glm::dot(between, dir) - cosine * glm::dot(between, ray.dirWs)) / sine2 / unitM;
}

// The angle whose place in the picture is nearest: also right where the arc is seen from its edge.
double onArc(const LightHandle& handle, const Viewport& viewport, glm::dvec2 px) {
    constexpr int kSteps = 180;
    double bestPx = std::numeric_limits<double>::max(), best = handle.value;
    for (int i = 0; i < kSteps; ++i) {
        const double from = handle.most * i / kSteps, to = handle.most * (i + 1) / kSteps;
        const auto a = viewport.project(handle.pointAt(from)), b = viewport.project(handle.pointAt(to));
        if (!a || !b) continue;
        const glm::dvec2 along = *b - *a;
        const double length2 = glm::dot(along, along);
        const double share = length2 > 0.0 ? std::clamp(glm::dot(px - *a, along) / length2, 0.0, 1.0) : 0.0;
        const double distancePx = glm::distance(px, *a + share * along);
        if (distancePx >= bestPx) continue;
        bestPx = distancePx;
        best = from + share * (to - from);
    }
    return best;
}

} // namespace

double HandleDrag::to(const Viewport& viewport, glm::dvec2 px, double step) const {
    const glm::dvec2 dot = px + offsetPx_;
    const double raw =
        handle_.isArc ? onArc(handle_, viewport, dot) : onLine(handle_, viewport.ray(dot), handle_.value);
    const double snapped = step > 0.0 ? std::round(raw / step) * step : raw;
    return std::clamp(snapped, handle_.least, handle_.most);
}

const LightField& rowOf(std::string_view field, LightType type) {
    const auto rows = lightFields();
    return *std::find_if(rows.begin(), rows.end(), [&](const LightField& row) {
        return row.field == field && (row.types & typeBit(type));
    });
}

} // namespace kilolux
