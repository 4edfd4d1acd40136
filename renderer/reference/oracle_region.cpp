// Edges of the directions in which a light is seen. Everything is solved in closed form along a great circle
// from the pole: direction(theta) = pole cos(theta) + azimuth sin(theta).
#include "renderer/reference/oracle_region.h"

#include "renderer/reference/oracle_shape.h"

#include <algorithm>
#include <cmath>

namespace kilolux::oracle {

using glm::dvec3;

std::optional<SourceRegion> SourceRegion::make(const OracleLight& light, const dvec3& receiverWs,
                                               const dvec3& normalWs) {
    const dvec3 toCenter = light.type == LightType::Directional ? -light.dirWs : light.centerWs - receiverWs;
    if (light.isDelta() || !receiverSeesSurface(light, toCenter)) return {};
    const dvec3 support = supportPoint(light, normalWs);
    const double centerHeight = glm::dot(normalWs, toCenter);
    const double halfHeight = glm::dot(normalWs, support);
    if (centerHeight + halfHeight <= 0.0) return {};
    // Middle of the part above the horizon of the chord through the centre: always inside.
    const double lowest = halfHeight > 0.0 ? std::max(-1.0, -centerHeight / halfHeight) : -1.0;
    SourceRegion region;
    region.setPole(glm::normalize(toCenter + support * (0.5 * (lowest + 1.0))));
    switch (light.type) {
    case LightType::Rect:
        region.addRect(light, toCenter);
        break;
    case LightType::Disk:
        region.addDisk(light, toCenter);
        break;
    case LightType::Tube:
        region.addTube(light, toCenter);
        break;
    case LightType::Directional:
        region.circles_.push_back(
            {toCenter, std::cos(light.angularRadiusRad), std::sin(light.angularRadiusRad)});
        break;
    default:
        region.addCircle(toCenter, light.radiusM);
    }
    if (lowest > -1.0) {
        region.addHorizonBreaks(normalWs);
        region.halfSpaces_.push_back(normalWs);
    }
    region.finishBreaks();
    return region;
}

void SourceRegion::setPole(const dvec3& poleWs) {
    pole_ = poleWs;
    const dvec3 other = std::abs(pole_.x) < 0.6 ? dvec3(1.0, 0.0, 0.0) : dvec3(0.0, 1.0, 0.0);
    tangent_ = glm::normalize(glm::cross(other, pole_));
    bitangent_ = glm::cross(pole_, tangent_);
}

void SourceRegion::addRect(const OracleLight& light, const dvec3& toCenter) {
    const dvec3 halfX = light.xWs * light.halfWidthM;
    const dvec3 halfY = light.yWs * light.halfHeightM;
    const dvec3 corners[4] = {toCenter - halfX - halfY, toCenter + halfX - halfY, toCenter + halfX + halfY,
                              toCenter - halfX + halfY};
    for (int i = 0; i < 4; ++i) {
        const dvec3 plane = glm::normalize(glm::cross(corners[i], corners[(i + 1) % 4]));
        halfSpaces_.push_back(glm::dot(plane, toCenter) < 0.0 ? -plane : plane);
        addBreakTowards(corners[i]);
    }
}

void SourceRegion::addDisk(const OracleLight& light, const dvec3& toCenter) {
    isDisk_ = true;
    diskNormal_ = light.dirWs;
    diskCenter_ = toCenter;
    diskRadiusM_ = light.radiusM;
}

void SourceRegion::addCircle(const dvec3& toCenter, double radiusM) {
    const double distanceM = glm::length(toCenter);
    const double sinRadius = radiusM / distanceM;
    circles_.push_back({toCenter / distanceM, std::sqrt((1.0 - sinRadius) * (1.0 + sinRadius)), sinRadius});
}

// A capsule is seen as the convex hull of its two end balls: both circles and, between them, the strip
// bounded by the two planes through the receiver that touch the cylinder.
void SourceRegion::addTube(const OracleLight& light, const dvec3& toCenter) {
    const dvec3 ends[2] = {toCenter - light.xWs * light.halfLengthM,
                           toCenter + light.xWs * light.halfLengthM};
    for (const dvec3& end : ends)
        if (glm::length(end) > light.radiusM) addCircle(end, light.radiusM);
    const dvec3 across = toCenter - light.xWs * glm::dot(toCenter, light.xWs);
    const double axisDistanceM = glm::length(across);
    if (axisDistanceM <= light.radiusM || light.halfLengthM <= 0.0)
        return; // within the endless cylinder: the nearer ball hides the rest
    const dvec3 w = across / axisDistanceM;
    const double sinAngle = light.radiusM / axisDistanceM;
    for (const double side : {-1.0, 1.0}) {
        const dvec3 inward =
            w * sinAngle + glm::cross(light.xWs, w) * (side * std::sqrt(1.0 - sinAngle * sinAngle));
        std::array<dvec3, 3> line = {inward, dvec3(0.0), dvec3(0.0)};
        for (int i = 0; i < 2; ++i) {
            line[i + 1] = glm::normalize(ends[i] - inward * glm::dot(ends[i], inward));
            addBreakTowards(line[i + 1]);
        }
        strip_.push_back(line);
    }
}

// Where the horizon crosses the edge. A break that turns out to lie on no edge only costs time.
void SourceRegion::addHorizonBreaks(const dvec3& normalWs) {
    for (const Circle& circle : circles_) {
        const dvec3 flat = circle.axis - normalWs * glm::dot(circle.axis, normalWs);
        const double flatLength = glm::length(flat);
        if (flatLength <= circle.cosRadius) continue;
        const double half = std::acos(circle.cosRadius / flatLength);
        const dvec3 side = glm::cross(normalWs, flat / flatLength);
        for (const double angle : {-half, half})
            addBreakTowards(flat / flatLength * std::cos(angle) + side * std::sin(angle));
    }
    std::vector<dvec3> planes = halfSpaces_;
    for (const auto& line : strip_)
        planes.push_back(line[0]);
    for (const dvec3& plane : planes)
        for (const double side : {-1.0, 1.0})
            addBreakTowards(glm::cross(normalWs, plane) * side);
    if (!isDisk_) return;
    // The chord in which the horizon cuts the disk.
    const dvec3 inPlane = normalWs - diskNormal_ * glm::dot(normalWs, diskNormal_);
    const double slope = glm::length(inPlane);
    const double offset = -glm::dot(normalWs, diskCenter_) / slope;
    if (!(std::abs(offset) < diskRadiusM_)) return;
    const dvec3 chord = glm::cross(diskNormal_, inPlane / slope);
    const double half = std::sqrt(diskRadiusM_ * diskRadiusM_ - offset * offset);
    for (const double side : {-half, half})
        addBreakTowards(diskCenter_ + inPlane / slope * offset + chord * side);
}

void SourceRegion::addBreakTowards(const dvec3& directionWs) {
    const double y = glm::dot(directionWs, bitangent_);
    const double x = glm::dot(directionWs, tangent_);
    if (x != 0.0 || y != 0.0) breaks_.push_back(std::atan2(y, x));
}

// Halves an interval until thetaMax varies by little more than a factor of two in it: quadrature then sees
// the narrow horns of a region whose edge passes close to the pole. They stand at the ends of intervals.
void SourceRegion::addGraded(double phi0, double theta0, double phi1, double theta1,
                             std::vector<double>& result) const {
    constexpr double kMaxRatio = 2.5;
    constexpr double kSmallestRad = 1e-9;
    const double mid = 0.5 * (phi0 + phi1);
    const double thetaMid = thetaMax(mid);
    const double high = std::max({theta0, theta1, thetaMid});
    const double low = std::min({theta0, theta1, thetaMid});
    if (high > kMaxRatio * low && phi1 - phi0 > kSmallestRad) {
        addGraded(phi0, theta0, mid, thetaMid, result);
        addGraded(mid, thetaMid, phi1, theta1, result);
    } else {
        result.push_back(phi1);
    }
}

void SourceRegion::finishBreaks() {
    constexpr double kTurn = 2.0 * kPi;
    constexpr double kSameAngleRad = 1e-12;
    std::sort(breaks_.begin(), breaks_.end());
    std::vector<double> result = {breaks_.empty() ? -kPi : breaks_.front()};
    const double end = result.front() + kTurn;
    breaks_.push_back(end);
    for (const double next : breaks_) {
        const double from = result.back();
        const double gap = next - from;
        if (gap < kSameAngleRad) continue;
        const int parts = static_cast<int>(std::ceil(gap / (0.5 * kPi) - 1e-9));
        for (int i = 1; i <= parts; ++i) {
            const double phi0 = result.back();
            const double phi1 = i == parts ? next : from + gap * i / parts;
            addGraded(phi0, thetaMax(phi0), phi1, thetaMax(phi1), result);
        }
    }
    result.back() = end;
    breaks_ = std::move(result);
}

double SourceRegion::halfSpaceExit(const dvec3& inwardWs, const dvec3& azimuthWs) const {
    return std::atan2(std::max(glm::dot(inwardWs, pole_), 0.0), -glm::dot(inwardWs, azimuthWs));
}

// Leaving angle from a circle, negative when the great circle misses it ahead of the pole. With A, B, C the
// axis in the frame (pole, azimuth, across): A cos + B sin = cosRadius; written by sines so that circles of
// 1e-6 rad keep their digits.
double SourceRegion::circleExit(const Circle& circle, const dvec3& azimuthWs) const {
    const double across = glm::dot(circle.axis, glm::cross(pole_, azimuthWs));
    const double chord2 = (circle.sinRadius - across) * (circle.sinRadius + across);
    if (chord2 < 0.0) return -1.0;
    return std::atan2(glm::dot(circle.axis, azimuthWs), glm::dot(circle.axis, pole_)) +
           std::atan2(std::sqrt(chord2), circle.cosRadius);
}

double SourceRegion::tubeExit(const dvec3& azimuthWs) const {
    double exit = 0.0;
    for (const Circle& circle : circles_)
        exit = std::max(exit, circleExit(circle, azimuthWs));
    for (const auto& line : strip_) {
        const double theta = halfSpaceExit(line[0], azimuthWs);
        if (theta <= exit || theta >= kPi) continue;
        const dvec3 at = pole_ * std::cos(theta) + azimuthWs * std::sin(theta);
        const dvec3 along = glm::cross(line[1], line[2]);
        if (glm::dot(glm::cross(line[1], at), along) >= 0.0 &&
            glm::dot(glm::cross(at, line[2]), along) >= 0.0)
            exit = theta;
    }
    return exit;
}

// (r (n.l))^2 - |(n.k) l - (n.l) k|^2 as a bilinear form: at least 0 where the ray along l meets the disk
// with centre k, normal n and radius r.
double SourceRegion::diskForm(const dvec3& a, const dvec3& b) const {
    const double na = glm::dot(diskNormal_, a);
    const double nb = glm::dot(diskNormal_, b);
    const double nk = glm::dot(diskNormal_, diskCenter_);
    return diskRadiusM_ * diskRadiusM_ * na * nb -
           glm::dot(a * nk - diskCenter_ * na, b * nk - diskCenter_ * nb);
}

double SourceRegion::diskExit(const dvec3& azimuthWs) const {
    const double cc = diskForm(pole_, pole_);
    const double cu = diskForm(pole_, azimuthWs);
    const double uu = diskForm(azimuthWs, azimuthWs);
    // Largest root of cc y^2 + 2 cu y + uu = 0 with y = cot(theta), i.e. the first edge met.
    const double root = std::sqrt(std::max(cu * cu - cc * uu, 0.0));
    const double y = cu > 0.0 ? -uu / (cu + root) : (root - cu) / cc;
    return cc > 0.0 ? std::atan2(1.0, y) : 0.0;
}

double SourceRegion::thetaMax(double phiRad) const {
    const dvec3 azimuthWs = azimuth(phiRad);
    double theta = kPi;
    if (isDisk_)
        theta = diskExit(azimuthWs);
    else if (!circles_.empty())
        theta = tubeExit(azimuthWs); // one circle is a tube without length
    for (const dvec3& inward : halfSpaces_)
        theta = std::min(theta, halfSpaceExit(inward, azimuthWs));
    return theta;
}

} // namespace kilolux::oracle
