#include "renderer/shadow_maps.h"

#include "renderer/camera.h"
#include "renderer/gpu/filled_buffer.h"
#include "renderer/lights_cpp/light_tables.h"
#include "renderer/lights_cpp/lights_f32.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/gtc/constants.hpp>
#include <limits>

namespace kilolux {

namespace {

using namespace shared;

constexpr std::uint32_t kDirectionalTiles = 4; // as wide as so many faces
constexpr std::size_t kMostBytes = std::size_t(512) << 20;
constexpr double kFaceRad = 0.9553;      // from the middle of a cube's face to its corner
constexpr double kMarginRad = 0.17;      // about a light's cone: its source has a size
constexpr double kNarrowSpotRad = 0.873; // up to here one face serves: 50 degrees
constexpr double kNearShare = 1e-4;      // of the scene's extent

bool isOfType(const LightHot& hot, std::uint32_t type) {
    return (hot.typeFlags & LIGHT_TYPE_MASK) == type;
}

// The middle of a face, as ShadowMap says.
glm::vec3 faceAxis(const ShadowMap& map, std::uint32_t face) {
    const glm::vec3 axis = face < 2 ? map.forwardWs : face < 4 ? map.axisXWs : map.axisYWs;
    return face % 2 == 0 ? axis : -axis;
}

void setSource(ShadowMap& map, const LightHot& hot, float scale) {
    const bool flat = isOfType(hot, LIGHT_RECT) || isOfType(hot, LIGHT_DISK);
    if (flat) {
        const bool rect = isOfType(hot, LIGHT_RECT);
        map.source = rect ? SHADOW_SOURCE_RECT : SHADOW_SOURCE_DISK;
        map.sourceXWs = map.axisXWs * (hot.sizeM.x * scale);
        map.sourceYWs = map.axisYWs * ((rect ? hot.sizeM.y : hot.sizeM.x) * scale);
    } else if (isOfType(hot, LIGHT_TUBE)) {
        map.source = SHADOW_SOURCE_TUBE;
        map.sourceXWs = map.axisXWs * (hot.sizeM.y * scale);
        map.sourceRadiusM = hot.sizeM.x * scale;
    } else {
        map.source = SHADOW_SOURCE_SPHERE;
        map.sourceRadiusM = hot.sizeM.x * scale;
    }
}

// The faces that look to where the light can reach.
void setFaces(ShadowMap& map, const LightHot& hot) {
    const f32::LightBounds bounds = f32::lightBounds(hot);
    const double half = std::acos(std::clamp(double(bounds.cosHalfAngle), -1.0, 1.0));
    map.tanHalf = 1.0f;
    const bool flat = isOfType(hot, LIGHT_RECT) || isOfType(hot, LIGHT_DISK);
    const bool ahead = glm::dot(bounds.axisWs, map.forwardWs) > 0.999f;
    if (ahead && !flat && half <= kNarrowSpotRad) {
        map.tanHalf = float(std::tan(half + 0.5 * kMarginRad));
        map.faceMask = SHADOW_FORWARD_FACE;
        return;
    }
    for (std::uint32_t face = 0; face < SHADOW_FACES; ++face) {
        const double away =
            std::acos(std::clamp(double(glm::dot(faceAxis(map, face), bounds.axisWs)), -1.0, 1.0));
        const bool reached = bounds.cosHalfAngle <= -1.0f || away < half + kFaceRad + kMarginRad;
        const bool behind = flat && face == 1;
        if (reached && !behind) map.faceMask |= 1u << face;
    }
}

// One map for all that casts shadows, seen along the light.
void fitDirectional(ShadowMap& map, const LightHot& hot, float scale, const glm::dvec3& worldMin,
                    const glm::dvec3& worldMax) {
    glm::dvec3 least(std::numeric_limits<double>::max()), most(-least);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p(corner & 1 ? worldMax.x : worldMin.x, corner & 2 ? worldMax.y : worldMin.y,
                           corner & 4 ? worldMax.z : worldMin.z);
        const glm::dvec3 along(glm::dot(p, glm::dvec3(map.axisXWs)), glm::dot(p, glm::dvec3(map.axisYWs)),
                               glm::dot(p, glm::dvec3(map.forwardWs)));
        least = glm::min(least, along);
        most = glm::max(most, along);
    }
    const glm::dvec3 size = most - least, middle = 0.5 * (least + most);
    const double slackM = 1e-3 * glm::length(size) + 1e-6;
    map.directional = 1;
    map.faceMask = SHADOW_FORWARD_FACE;
    map.tanHalf = float(0.5 * std::max(size.x, size.y) + slackM);
    map.nearM = float(size.z + 2.0 * slackM);
    map.centerWs = glm::vec3(middle.x * glm::dvec3(map.axisXWs) + middle.y * glm::dvec3(map.axisYWs) +
                             (least.z - slackM) * glm::dvec3(map.forwardWs));
    map.source = SHADOW_SOURCE_DISK;
    map.sourceXWs = map.axisXWs * (hot.sizeM.x * scale);
    map.sourceYWs = map.axisYWs * (hot.sizeM.x * scale);
}

ShadowMap mapOf(const LightSlots& slots, std::size_t slot, const glm::dvec3& worldMin,
                const glm::dvec3& worldMax) {
    ShadowMap map{};
    // Muted lights keep their place: they come back.
    LightHot hot = slots.hot()[slot];
    if ((hot.typeFlags & LIGHT_FLAG_DEAD) || isOfType(hot, LIGHT_DOME)) return map;
    hot.typeFlags &= ~LIGHT_FLAG_MUTED;
    const glm::mat3 frame = f32::lightFrame(hot);
    map.axisXWs = frame[0];
    map.axisYWs = frame[1];
    map.forwardWs = hot.dirWs;
    const std::uint32_t shaping = hot.typeFlags >> LIGHT_SHAPING_SHIFT;
    map.shadowChannels = shaping ? slots.shapings()[shaping - 1].shadowChannels : CHANNELS_ALL;
    const float scale = slots.cold()[slot].penumbraScale;
    if (isOfType(hot, LIGHT_DIRECTIONAL)) {
        fitDirectional(map, hot, scale, worldMin, worldMax);
        return map;
    }
    map.centerWs = hot.positionWs;
    map.nearM = float(kNearShare * std::max(glm::length(worldMax - worldMin), 1e-3));
    map.endBiasM = slots.cold()[slot].rayEndBiasM;
    setSource(map, hot, scale);
    setFaces(map, hot);
    return map;
}

std::uint32_t facesOf(const ShadowMap& map) {
    return std::uint32_t(std::popcount(map.faceMask));
}

// Gives every face its tile: directional lights' wide ones in rows above all others. False: they do not fit.
bool place(ShadowLayout& layout, std::size_t mostBytes, std::uint32_t mostPx) {
    const std::uint32_t size = layout.sizePx, wide = size * kDirectionalTiles;
    std::size_t directional = 0, local = 0;
    for (const ShadowMap& map : layout.maps)
        (map.directional ? directional : local) += facesOf(map);
    const std::size_t texels = directional * wide * wide + local * size * size;
    layout.faces = directional + local;
    layout.widthPx = std::min(mostPx / wide * wide,
                              std::max(wide, std::bit_ceil(std::uint32_t(std::ceil(
                                                 std::sqrt(double(std::max<std::size_t>(1, texels))))))));
    if (layout.widthPx == 0) return false;
    const std::size_t wideRow = layout.widthPx / wide, row = layout.widthPx / size;
    const std::size_t wideRows = (directional + wideRow - 1) / wideRow, rows = (local + row - 1) / row;
    const std::size_t heightPx = std::max<std::size_t>(size, wideRows * wide + rows * size);
    if (heightPx > mostPx || heightPx * layout.widthPx * sizeof(float) > mostBytes) return false;
    layout.heightPx = std::uint32_t(heightPx);
    std::uint32_t nextWide = 0, next = std::uint32_t(wideRows * kDirectionalTiles * row);
    for (ShadowMap& map : layout.maps) {
        std::uint32_t& tile = map.directional ? nextWide : next;
        map.tilePx = map.faceMask == 0 ? 0 : map.directional ? wide : size;
        map.firstTile = map.faceMask == 0 ? 0 : tile;
        tile += facesOf(map);
    }
    return true;
}

} // namespace

ShadowLayout layShadowMaps(const LightSlots& slots, const glm::dvec3& worldMin, const glm::dvec3& worldMax,
                           std::uint32_t sizePx, std::size_t mostBytes, std::uint32_t mostPx) {
    LightTables tables;
    tables.shapings = slots.shapings();
    const BindLightTables bound(tables);
    ShadowLayout layout;
    for (std::size_t slot = 0; slot < slots.hot().size(); ++slot)
        layout.maps.push_back(mapOf(slots, slot, worldMin, worldMax));
    layout.sizePx = sizePx;
    while (!place(layout, mostBytes, mostPx) && layout.sizePx > 1)
        layout.sizePx /= 2;
    return layout;
}

glm::dmat4 clipOfShadowFace(const ShadowMap& map, std::uint32_t face) {
    const glm::dvec3 ring[3] = {glm::dvec3(map.forwardWs), glm::dvec3(map.axisXWs), glm::dvec3(map.axisYWs)};
    const std::uint32_t axis = face / 2;
    const glm::dvec3 right = ring[(axis + 1) % 3], up = ring[(axis + 2) % 3];
    const glm::dvec3 ahead = glm::dvec3(faceAxis(map, face)), center(map.centerWs);
    const auto row = [&](const glm::dvec3& dir, double scale, double offset) {
        return glm::dvec4(dir * scale, offset - scale * glm::dot(dir, center));
    };
    const double across = 1.0 / double(map.tanHalf);
    const glm::dmat4 rows =
        map.directional ? glm::dmat4(row(right, across, 0.0), row(up, across, 0.0),
                                     row(ahead, -1.0 / double(map.nearM), 1.0), glm::dvec4(0, 0, 0, 1))
                        : glm::dmat4(row(right, across, 0.0), row(up, across, 0.0),
                                     glm::dvec4(0, 0, 0, double(map.nearM)), row(ahead, 1.0, 0.0));
    return glm::transpose(rows);
}

glm::uvec2 cornerOfShadowTile(const ShadowLayout& layout, const ShadowMap& map, std::uint32_t tile) {
    const std::uint32_t perRow = layout.widthPx / map.tilePx;
    return glm::uvec2(tile % perRow, tile / perRow) * map.tilePx;
}

bool ShadowMaps::mayCast(const Face& face, const glm::dvec3& lower, const glm::dvec3& upper) {
    const glm::dvec3 nearest = glm::clamp(face.centerWs, lower, upper) - face.centerWs;
    return glm::length(nearest) <= face.reachM && boxMayBeSeen(face.clipFromWorld, lower, upper);
}

void ShadowMaps::update(const GpuScene& scene) {
    glm::dvec3 least(std::numeric_limits<double>::max()), most(-least);
    for (const DrawItem& draw : scene.opaqueDraws()) {
        least = glm::min(least, draw.boundsMin - scene.anchor());
        most = glm::max(most, draw.boundsMax - scene.anchor());
    }
    if (scene.opaqueDraws().empty()) least = most = glm::dvec3(0.0);
    const ShadowLayout before = std::exchange(
        layout_,
        layShadowMaps(scene.slots(), least, most, sizePx_, kMostBytes,
                      std::min(device_.limits().maxImageDimension2D, device_.limits().maxFramebufferWidth)));
    forgetMoved(scene);
    forgetChanged(before);
    collectDue(scene);
}

// What moved was drawn where it had been, and must be drawn where it is.
void ShadowMaps::forgetMoved(const GpuScene& scene) {
    if (!scene.hasMovingInstances()) return;
    const std::vector<DrawItem>& draws = scene.opaqueDraws();
    const bool known = posed_.size() == draws.size();
    posed_.resize(draws.size());
    for (std::size_t i = 0; i < draws.size(); ++i) {
        const Posed now{scene.instances()[draws[i].instance].worldFromLocal,
                        draws[i].boundsMin - scene.anchor(), draws[i].boundsMax - scene.anchor()};
        const Posed was = std::exchange(posed_[i], now);
        if (!known || was.worldFromLocal == now.worldFromLocal) continue;
        for (std::size_t place = 0; place < stands_.size(); ++place) {
            const std::size_t slot = place / SHADOW_FACES;
            if (!stands_[place] || slot >= layout_.maps.size()) continue;
            const Face face = faceOf(scene, slot, std::uint32_t(place % SHADOW_FACES));
            if (mayCast(face, was.boundsMin, was.boundsMax) || mayCast(face, now.boundsMin, now.boundsMax))
                stands_[place] = 0;
        }
    }
}

void ShadowMaps::forgetChanged(const ShadowLayout& before) {
    const bool sameImage =
        depths_ && before.widthPx == layout_.widthPx && before.heightPx == layout_.heightPx;
    if (!sameImage) {
        makeImage();
        stands_.clear();
    }
    stands_.resize(layout_.maps.size() * SHADOW_FACES);
    bool changed = layout_.maps.size() != before.maps.size();
    for (std::size_t slot = 0; slot < layout_.maps.size(); ++slot) {
        const bool same = slot < before.maps.size() &&
                          std::memcmp(&layout_.maps[slot], &before.maps[slot], sizeof(ShadowMap)) == 0;
        if (same) continue;
        changed = true;
        std::fill_n(stands_.begin() + std::ptrdiff_t(slot * SHADOW_FACES), SHADOW_FACES, char(0));
    }
    if (maps_ && !changed) return;
    maps_ = gpu::storageBuffer(device_, "shadowMaps", layout_.maps, "shadow maps");
}

void ShadowMaps::makeImage() {
    depths_ = gpu::Image(); // the old one goes first
    depths_ = gpu::Image(device_,
                         {.name = "shadowDepths",
                          .format = VK_FORMAT_D32_SFLOAT,
                          .width = layout_.widthPx,
                          .height = layout_.heightPx,
                          .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                          .cause = "shadow maps"});
}

ShadowMaps::Face ShadowMaps::faceOf(const GpuScene& scene, std::size_t slot, std::uint32_t face) const {
    const ShadowMap& map = layout_.maps[slot];
    const float invRange = map.directional ? 0.0f : scene.slots().hot()[slot].invRange;
    const std::uint32_t tile =
        map.firstTile + std::uint32_t(std::popcount(map.faceMask & ((1u << face) - 1u)));
    Face result;
    result.map = std::uint32_t(slot);
    result.clipFromWorld = clipOfShadowFace(map, face);
    result.cornerPx = cornerOfShadowTile(layout_, map, tile);
    result.sizePx = map.tilePx;
    result.centerWs = glm::dvec3(map.centerWs);
    result.reachM = invRange > 0.0f ? 1.0 / double(invRange) : std::numeric_limits<double>::max();
    result.place = slot * SHADOW_FACES + face;
    return result;
}

void ShadowMaps::collectDue(const GpuScene& scene) {
    due_.clear();
    for (std::size_t place = 0; place < stands_.size(); ++place) {
        const std::size_t slot = place / SHADOW_FACES;
        const std::uint32_t face = std::uint32_t(place % SHADOW_FACES);
        const bool has = layout_.maps[slot].faceMask >> face & 1u;
        const bool muted = scene.slots().hot()[slot].typeFlags & LIGHT_FLAG_MUTED;
        if (!has || muted || stands_[place] || due_.size() == mostFaces_) continue;
        due_.push_back(faceOf(scene, slot, face));
    }
}

void ShadowMaps::finishFrame() {
    drawn_ += due_.size();
    for (const Face& face : due_)
        stands_[face.place] = 1;
    due_.clear();
}

} // namespace kilolux
