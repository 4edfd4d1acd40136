// Shaping records and the pictures that they name, see light_shaping.h.
#include "renderer/light_shaping.h"

#include "renderer/document/ies_profile.h"
#include "renderer/document/light_shapes.h"
#include "renderer/document/light_units.h"
#include "renderer/document/made_once.h"
#include "renderer/source_picture.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace kilolux {

namespace {

// As in lights/light_filter.glsl.
constexpr int kProfileRows = 361, kProfileColumns = 145;
constexpr double kLeastProfileCosine = 0.05;
constexpr int kFunctionImagePx = 256;

double verticalRad(int row) {
    return glm::pi<double>() * row / (kProfileRows - 1);
}

// The part of the sphere that a row stands for, per share of a full turn.
double rowWeightSr(int row) {
    const double step = glm::pi<double>() / (kProfileRows - 1),
                 above = std::max(verticalRad(row) - step, 0.0),
                 below = std::min(verticalRad(row) + step, glm::pi<double>());
    // Integral of a tent of height 1 times the sine.
    const auto rise = [&](double from, double to) {
        return from == to ? 0.0 : (std::sin(to) - std::sin(from)) / (to - from);
    };
    const double at = verticalRad(row);
    return 2.0 * glm::pi<double>() *
           (rise(above, at) - rise(at, below) + (above == at ? std::cos(at) : 0.0) -
            (below == at ? std::cos(at) : 0.0));
}

double square(double x) {
    return x * x;
}

// The bare light's intensity at a vertical angle over that along its axis; tubes apart.
double ownDistribution(const LightDef& def, double cosine) {
    if (shapeOf(def.type).isFlat) return std::max(cosine, 0.0);
    if (def.type != LightType::Spot) return 1.0;
    const double outer = std::cos(def.outerConeRad);
    return square(
        std::clamp((cosine - outer) / std::max(0.001, std::cos(def.innerConeRad) - outer), 0.0, 1.0));
}

// Flux over intensity.
double profileSr(const LightProfile& profile, const LightDef& def) {
    const bool shape = def.iesUse == IesUse::Shape, flat = shapeOf(def.type).isFlat;
    double sum = 0.0;
    for (int row = 0; row < kProfileRows; ++row) {
        const double cosine = std::cos(verticalRad(row));
        double own = ownDistribution(def, cosine);
        if (shape) own = flat ? own / std::max(cosine, kLeastProfileCosine) : 1.0;
        sum += profile.rowSr[std::size_t(row)] * own;
    }
    if (shape || def.type != LightType::Tube) return sum;
    const double side = 2.0 * def.lengthM, end = glm::pi<double>() * std::max(def.radiusM, 1e-4);
    return (side * profile.sidewaysSr + end * sum) / (side + end);
}

template<typename T>
std::uint32_t layerOf(std::vector<std::shared_ptr<const T>>& layers, const std::shared_ptr<const T>& layer) {
    const auto found = std::find(layers.begin(), layers.end(), layer);
    if (found != layers.end()) return std::uint32_t(found - layers.begin());
    layers.push_back(layer);
    return std::uint32_t(layers.size()) - 1;
}

void addDoors(shared::LightShaping& shaping, const LightDef& def) {
    // The record's order is -X, +X, -Y, +Y.
    constexpr BarnDoorSide kSides[] = {BarnDoorSide::Left, BarnDoorSide::Right, BarnDoorSide::Bottom,
                                       BarnDoorSide::Top};
    for (int i = 0; i < 4; ++i) {
        const BarnDoor& door = def.barnDoors[std::size_t(kSides[i])];
        const double angle = std::clamp(door.angleRad, 0.0, glm::half_pi<double>());
        // A flap in the light's own plane hides nothing.
        const double depthM = door.lengthM * std::cos(angle);
        if (!(depthM > 1e-6 * door.lengthM)) continue;
        shaping.doorDepthM[i] = float(depthM);
        shaping.doorReachM[i] = float(door.lengthM * std::sin(angle));
    }
}

void addProfile(shared::LightShaping& shaping, LightTables& tables, const LightDef& def) {
    static MadeOnce<IesProfile, LightProfile> profiles;
    const std::shared_ptr<const LightProfile> profile = profiles.get(def.ies, makeLightProfile);
    shaping.profile = layerOf(tables.profiles, profile->image) + 1;
    shaping.profileIsShape = def.iesUse == IesUse::Shape;
    // Opened by the rounding of directions.
    shaping.profileCosine = float(std::cos(std::min(profile->halfAngleRad + 1e-3, glm::pi<double>())));
    shaping.profileSide = float(profile->side);
    shaping.profileSr = float(profileSr(*profile, def));
}

// Smooth noise, 0 to 1, about as bright as a flame: one value a unit of time, cubic between.
double flickerLevel(double seed, double time) {
    const auto value = [&](double step) {
        return glm::fract(std::sin(step * 12.9898 + seed * 78.233) * 43758.5453);
    };
    const double step = std::floor(time), t = time - step;
    return glm::mix(value(step), value(step + 1.0), t * t * (3.0 - 2.0 * t));
}

void addFunction(shared::LightShaping& shaping, LightTables& tables, const LightDef& def,
                 const glm::dmat4& worldFromNode, const glm::dvec3& anchor, double timeS) {
    static MadeOnce<Image, LightPicture> images;
    const LightFunction& function = def.function;
    switch (function.kind) {
    case LightFunctionKind::None:
        return;
    case LightFunctionKind::Image:
        if (!function.image) return;
        shaping.functionKind = shared::LIGHT_FUNCTION_IMAGE;
        shaping.functionImage = layerOf(tables.functionImages, images.get(function.image, makeFunctionImage));
        break;
    case LightFunctionKind::Grid:
        shaping.functionKind = shared::LIGHT_FUNCTION_GRID;
        break;
    case LightFunctionKind::Blinds:
        shaping.functionKind = shared::LIGHT_FUNCTION_BLINDS;
        break;
    case LightFunctionKind::Caustics:
        shaping.functionKind = shared::LIGHT_FUNCTION_CAUSTICS;
        shaping.functionPhase =
            float(std::fmod(2.4 * function.seed + function.speed * timeS, glm::two_pi<double>()));
        break;
    case LightFunctionKind::Flicker:
        shaping.functionKind = shared::LIGHT_FUNCTION_FLICKER;
        shaping.functionPhase = float(flickerLevel(function.seed, 8.0 * function.speed * timeS));
        break;
    }
    const double scale = std::max(function.scale, 1e-3);
    shaping.functionMap =
        glm::vec4(glm::dvec4(std::cos(function.angleRad) / scale, std::sin(function.angleRad) / scale,
                             function.softness, function.strength));
    if (def.type == LightType::Directional)
        shaping.functionOriginWs = glm::vec3(glm::dvec3(worldFromNode[3]) - anchor);
}

void addPicture(shared::LightShaping& shaping, LightTables& tables, const LightDef& def) {
    constexpr std::size_t kMostPictures = 256; // layers that every device has
    const std::shared_ptr<const SourcePicture> picture = sourcePictureOf(def);
    if (!picture) return;
    const std::uint32_t layer = layerOf(tables.pictures, picture);
    if (layer >= kMostPictures) {
        tables.pictures.resize(kMostPictures);
        return;
    }
    shaping.picture = layer + 1;
    shaping.pictureMean = glm::vec3(picture->mean);
}

} // namespace

LightProfile makeLightProfile(const IesProfile& profile) {
    const double most = profile.maxCandela();
    LightPicture image{kProfileColumns, kProfileRows, {}};
    LightProfile made;
    int first = kProfileRows, last = -1;
    for (int row = 0; row < kProfileRows; ++row) {
        const double theta = verticalRad(row);
        double mean = 0.0, sideways = 0.0;
        for (int column = 0; column < kProfileColumns; ++column) {
            const double phi =
                2.0 * glm::pi<double>() * (column % (kProfileColumns - 1)) / (kProfileColumns - 1);
            const glm::dvec3 dir(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                 -std::cos(theta));
            const double value = most > 0.0 ? std::clamp(profile.candelaAt(dir) / most, 0.0, 1.0) : 0.0;
            image.texels.push_back(float(value));
            if (value > 0.0) {
                first = std::min(first, row);
                last = row;
            }
            if (column == kProfileColumns - 1) continue;
            mean += value / (kProfileColumns - 1);
            sideways += value * std::sqrt(1.0 - dir.x * dir.x) / (kProfileColumns - 1);
        }
        made.rowSr.push_back(mean * rowWeightSr(row));
        made.sidewaysSr += sideways * rowWeightSr(row);
    }
    // Between two rows light reaches to the dark one.
    const double lowRad = verticalRad(std::max(first - 1, 0)),
                 highRad = verticalRad(std::clamp(last + 1, 0, kProfileRows - 1));
    made.side = glm::pi<double>() - lowRad < highRad ? -1.0 : 1.0;
    made.halfAngleRad = made.side > 0.0 ? highRad : glm::pi<double>() - lowRad;
    made.image = std::make_shared<const LightPicture>(std::move(image));
    return made;
}

LightPicture makeFunctionImage(const Image& image) {
    LightPicture made{kFunctionImagePx, kFunctionImagePx, {}};
    const auto linear = [](std::uint8_t srgb) {
        const double v = srgb / 255.0;
        return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    };
    const auto luminanceAt = [&](int x, int y) {
        const std::size_t at = 4 * (std::size_t(y) * std::size_t(image.width) + std::size_t(x));
        const glm::dvec3 rgb =
            image.rgba8.empty() ? glm::dvec3(image.rgbaF32[at], image.rgbaF32[at + 1], image.rgbaF32[at + 2])
                                : glm::dvec3(linear(image.rgba8[at]), linear(image.rgba8[at + 1]),
                                             linear(image.rgba8[at + 2]));
        const double luminance = luminanceOf(rgb);
        return luminance > 0.0 ? std::min(luminance, 1.0) : 0.0; // NaN too
    };
    for (int y = 0; y < kFunctionImagePx; ++y) {
        const int y0 = y * image.height / kFunctionImagePx,
                  y1 = std::max((y + 1) * image.height / kFunctionImagePx, y0 + 1);
        for (int x = 0; x < kFunctionImagePx; ++x) {
            const int x0 = x * image.width / kFunctionImagePx,
                      x1 = std::max((x + 1) * image.width / kFunctionImagePx, x0 + 1);
            double sum = 0.0;
            for (int sy = y0; sy < y1; ++sy) {
                for (int sx = x0; sx < x1; ++sx)
                    sum += luminanceAt(sx, sy);
            }
            made.texels.push_back(float(sum / ((y1 - y0) * (x1 - x0))));
        }
    }
    return made;
}

MeshChannels meshChannelsOf(const Scene& scene) {
    std::set<std::uint8_t> found;
    for (const Node& node : scene.nodes) {
        if (node.visible && node.mesh >= 0) found.insert(node.meshChannels);
    }
    return {found.begin(), found.end()};
}

std::uint32_t addShaping(LightTables& tables, const LightDef& def, const glm::dmat4& worldFromNode,
                         const glm::dvec3& anchor, double timeS, const MeshChannels& meshes) {
    shared::LightShaping shaping{};
    const bool leavesOut = std::any_of(meshes.begin(), meshes.end(),
                                       [&](std::uint8_t mesh) { return (mesh & def.channels) == 0; });
    const std::uint32_t limited = leavesOut ? shared::CHANNELS_LIMITED + def.channels : shared::CHANNELS_ALL;
    shaping.channels = limited;
    shaping.shadowChannels = def.channelsCast ? shared::CHANNELS_ALL : limited;
    if (def.type == LightType::Rect) addDoors(shaping, def);
    if (usesProfile(def)) addProfile(shaping, tables, def);
    addFunction(shaping, tables, def, worldFromNode, anchor, timeS);
    addPicture(shaping, tables, def);
    const bool any = shaping.doorDepthM != glm::vec4(0.0f) || shaping.profile != 0 ||
                     shaping.functionKind != shared::LIGHT_FUNCTION_NONE || shaping.picture != 0 || leavesOut;
    if (!any || tables.shapings.size() >= shared::LIGHT_MAX_SHAPINGS) return 0;
    tables.shapings.push_back(shaping);
    return std::uint32_t(tables.shapings.size());
}

} // namespace kilolux
