// Light records, see gpu_lights.h.
#include "renderer/gpu_lights.h"

#include "renderer/document/light_shapes.h"
#include "renderer/document/light_units.h"
#include "renderer/dome_maps.h"
#include "renderer/light_shaping.h"
#include "renderer/lights_cpp/lights_f64.h"
#include "renderer/source_picture.h"
#include "shaders/shared/light_types.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace kilolux {

namespace {

shared::uint typeCode(LightType type) {
    switch (type) {
#define KILOLUX_TYPE(UPPER, Name, place)                                                                     \
    case LightType::Name:                                                                                    \
        return shared::LIGHT_##UPPER;
        KX_LIGHT_TYPES(KILOLUX_TYPE)
#undef KILOLUX_TYPE
    }
    return shared::LIGHT_SPHERE;
}

glm::vec2 shapingOf(const LightDef& def) {
    if (def.type != LightType::Spot) return {0.0f, 0.0f};
    if (isShapedByProfile(def)) return {1.0f, 2.0f}; // in place of the cone: open on all sides
    const double outer = std::cos(def.outerConeRad);
    const double scale = 1.0 / std::max(0.001, std::cos(def.innerConeRad) - outer);
    return {float(scale), float(-outer * scale)};
}

// A light of numbers that are none is off: files can hold them, and one would spread over the whole picture.
bool isSound(const shared::LightHot& hot) {
    const auto finite = [](const auto& v) { return !glm::any(glm::isnan(v)) && !glm::any(glm::isinf(v)); };
    const bool negative = glm::any(glm::lessThan(hot.intensity, glm::vec3(0.0f))) ||
                          glm::any(glm::lessThan(hot.sizeM, glm::vec2(0.0f)));
    return finite(hot.positionWs) && finite(hot.dirWs) && finite(hot.intensity) && finite(hot.sizeM) &&
           finite(hot.shaping) && std::isfinite(hot.invRange) && !negative;
}

shared::LightHot makeHot(const LightDef& def, const LightNode& light, const glm::dmat4& worldFromNode,
                         const glm::dvec3& anchor, std::optional<double> rangeM) {
    shared::LightHot hot{};
    const bool directional = def.type == LightType::Directional;
    if (!directional) hot.positionWs = glm::vec3(glm::dvec3(worldFromNode[3]) - anchor);
    hot.invRange = rangeM && *rangeM > 0.0 && !directional ? float(1.0 / *rangeM) : 0.0f;
    const auto axis = [&](int column, const glm::dvec3& otherwise) {
        const glm::dvec3 v(worldFromNode[column]);
        const double length = glm::length(v);
        return length > 0.0 ? v / length : otherwise;
    };
    hot.dirWs = glm::vec3(-axis(2, {0, 0, 1}));
    hot.tangentOct = f64::packOct16(axis(0, {1, 0, 0}));
    hot.intensity = glm::vec3(emittedColor(def) * baseIntensity(def));
    hot.typeFlags = typeCode(def.type) | (light.muted ? shared::LIGHT_FLAG_MUTED : 0u);
    hot.sizeM = glm::vec2(shapeOf(def.type).halfSizes(def));
    hot.shaping = shapingOf(def);
    if (!isSound(hot))
        hot = {.dirWs = {0, 0, -1}, .typeFlags = typeCode(def.type) | shared::LIGHT_FLAG_MUTED};
    return hot;
}

// A double copy of a record, for the functions of f64.
f64::LightHot inDouble(const shared::LightHot& hot) {
    f64::LightHot result{};
    result.positionWs = glm::dvec3(hot.positionWs);
    result.invRange = hot.invRange;
    result.dirWs = glm::dvec3(hot.dirWs);
    result.tangentOct = hot.tangentOct;
    result.intensity = glm::dvec3(hot.intensity);
    result.typeFlags = hot.typeFlags;
    result.sizeM = glm::dvec2(hot.sizeM);
    result.shaping = glm::dvec2(hot.shaping);
    return result;
}

struct SurfacePoint {
    glm::dvec3 position, normal;
};

// Points spread evenly over the area of all visible geometry; the same for the same scene.
std::vector<SurfacePoint> spreadPoints(const Scene& scene, int count) {
    struct Patch {
        double sumArea;
        glm::dvec3 a, ab, ac;
    };
    std::vector<Patch> patches;
    double area = 0.0;
    for (const Node& node : scene.nodes) {
        if (!node.visible || node.mesh < 0) continue;
        for (const Primitive& primitive : scene.meshes[std::size_t(node.mesh)]->primitives) {
            // A share of the triangles of large meshes is enough to place an exposure.
            const std::size_t step = std::max<std::size_t>(1, primitive.indices.size() / 3 / 2000);
            for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3 * step) {
                const auto corner = [&](std::size_t k) {
                    return glm::dvec3(
                        node.worldFromNode *
                        glm::dvec4(glm::dvec3(primitive.positions[primitive.indices[i + k]]), 1.0));
                };
                const glm::dvec3 a = corner(0), ab = corner(1) - a, ac = corner(2) - a;
                const double triangleArea = 0.5 * glm::length(glm::cross(ab, ac)) * double(step);
                if (!(triangleArea > 0.0) || !std::isfinite(triangleArea)) continue;
                area += triangleArea;
                patches.push_back({area, a, ab, ac});
            }
        }
    }
    std::vector<SurfacePoint> points;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (int i = 0; i < count && !patches.empty(); ++i) {
        const double target = uniform(random) * area;
        const auto found =
            std::lower_bound(patches.begin(), patches.end() - 1, target,
                             [](const Patch& patch, double value) { return patch.sumArea < value; });
        const double root = std::sqrt(uniform(random)), v = uniform(random);
        points.push_back({found->a + root * (1.0 - v) * found->ab + root * v * found->ac,
                          glm::normalize(glm::cross(found->ab, found->ac))});
    }
    return points;
}

constexpr double kMiddleGrey = 0.18;
constexpr double kRangeShare = 1e-3;

} // namespace

double exposureFromEv100(double ev100) {
    return 1.0 / (1.2 * std::exp2(ev100));
}

DerivedRange deriveRange(const LightDef& def, double exposureEv100) {
    // A middle grey surface (reflectance 0.18) shown as middle grey has luminance 0.18 / exposure.
    const double greyLux = glm::pi<double>() * kMiddleGrey / (0.18 * exposureFromEv100(exposureEv100));
    const double limitLux = kRangeShare * greyLux;
    const double candela = luminanceOf(emittedColor(def) * pictureMean(def)) * baseIntensity(def);
    DerivedRange range;
    range.rangeM =
        std::max(std::sqrt(std::max(candela, 0.0) / limitLux) + shapeOf(def.type).extentM(def), 1e-3);
    range.lostLux = limitLux;
    return range;
}

double deriveExposureEv100(const Scene& scene) {
    std::vector<f64::LightHot> lights;
    LightTables tables;
    for (const LightNode& light : scene.lights) {
        if (light.muted) continue;
        const LightDef& def = scene.lightDefs[std::size_t(light.def)];
        const glm::dmat4& world = scene.nodes[std::size_t(light.node)].worldFromNode;
        shared::LightHot hot = makeHot(def, light, world, glm::dvec3(0.0), def.rangeM);
        hot.intensity *= glm::vec3(groupFactor(scene, light));
        hot.typeFlags |= addShaping(tables, def, world, glm::dvec3(0.0), 0.0, {})
                         << shared::LIGHT_SHAPING_SHIFT;
        lights.push_back(inDouble(hot));
    }
    if (domeShines(scene.dome)) {
        tables.dome = domeMapsOf(scene.dome.image);
        lights.push_back(inDouble(domeRecord(scene.dome, *tables.dome)));
    }
    const BindLightTables bound(tables);
    if (lights.empty()) return 0.0;
    // A thousand points times the lights, bounded for scenes of ten thousand lights.
    const int count = int(std::clamp<std::size_t>(200000 / lights.size(), 64, 1024));
    std::vector<double> lux;
    for (const SurfacePoint& point : spreadPoints(scene, count)) {
        // Either side may be the one that is seen.
        double best = 0.0;
        for (const double side : {1.0, -1.0}) {
            const f64::ShadingPoint shading =
                f64::makeShadingPoint(point.position, side * point.normal, side * point.normal, 1.0);
            double sum = 0.0;
            for (const f64::LightHot& light : lights) {
                const f64::LightIrradiance lit =
                    f64::lightIrradiance(light, shading, f64::makeLtcLobe(shading));
                sum += f64::luminance(lit.emission) * lit.diffuse;
            }
            best = std::max(best, sum);
        }
        if (best > 0.0 && std::isfinite(best)) lux.push_back(best);
    }
    if (lux.empty()) return 0.0;
    // The upper third of what is lit: unshadowed light overstates, and subjects are lit better than the rest.
    const auto place = lux.begin() + std::ptrdiff_t(lux.size() * 7 / 10);
    std::nth_element(lux.begin(), place, lux.end());
    // That illuminance on a reflectance of 0.4 shall be shown at 0.25.
    const double luminanceNit = *place * 0.4 / glm::pi<double>();
    return std::log2(luminanceNit / (1.2 * 0.25));
}

GpuLights makeGpuLights(const Scene& scene, const glm::dvec3& anchor, double exposureEv100, double timeS) {
    GpuLights result;
    const MeshChannels meshes = meshChannelsOf(scene);
    for (std::size_t slot = 0; slot < scene.lights.size(); ++slot) {
        const LightNode& light = scene.lights[slot];
        const LightDef& def = scene.lightDefs[std::size_t(light.def)];
        std::optional<double> rangeM = def.rangeM;
        const bool derives = !rangeM && def.type != LightType::Directional;
        if (derives) rangeM = deriveRange(def, exposureEv100).rangeM;
        result.derivedRanges += derives;
        result.rangeDerived.push_back(derives);
        const glm::dmat4& world = scene.nodes[std::size_t(light.node)].worldFromNode;
        result.hot.push_back(makeHot(def, light, world, anchor, rangeM));
        result.hot.back().intensity *= glm::vec3(groupFactor(scene, light));
        result.hot.back().typeFlags |= addShaping(result.tables, def, world, anchor, timeS, meshes)
                                       << shared::LIGHT_SHAPING_SHIFT;
        shared::LightCold cold{};
        cold.penumbraScale = float(def.penumbraScale);
        cold.rayEndBiasM = float(def.rayEndBiasM);
        cold.node = std::uint32_t(slot);
        cold.fluxLm = float(fluxLumen(def) * luminanceOf(emittedColor(def) * pictureMean(def)));
        result.cold.push_back(cold);
    }
    if (domeShines(scene.dome)) {
        result.tables.dome = domeMapsOf(scene.dome.image);
        result.hot.push_back(domeRecord(scene.dome, *result.tables.dome));
        result.cold.push_back({.penumbraScale = 1.0f, .node = std::uint32_t(scene.lights.size())});
        result.rangeDerived.push_back(false);
    }
    return result;
}

} // namespace kilolux
