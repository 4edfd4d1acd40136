// The double build.
#include "renderer/lights_cpp/lights_f64.h"

#include "renderer/lights_cpp/light_tables.h"
#include "renderer/lights_cpp/ltc_table.h"

#include <glm/gtc/packing.hpp>

static_assert(sizeof(0.5) == sizeof(double), "compile this file without -fsingle-precision-constant");

namespace kilolux::f64 {

using namespace glm;
using namespace shared;

LightHot fromF32(const shared::LightHot& light) {
    return {.positionWs = vec3(light.positionWs),
            .invRange = light.invRange,
            .dirWs = glm::normalize(vec3(light.dirWs)),
            .tangentOct = light.tangentOct,
            .intensity = vec3(light.intensity),
            .typeFlags = light.typeFlags,
            .sizeM = vec2(light.sizeM),
            .shaping = vec2(light.shaping)};
}

LightShaping fromF32(const shared::LightShaping& shaping) {
    return {.doorReachM = vec4(shaping.doorReachM),
            .doorDepthM = vec4(shaping.doorDepthM),
            .profile = shaping.profile,
            .profileIsShape = shaping.profileIsShape,
            .profileCosine = shaping.profileCosine,
            .profileSide = shaping.profileSide,
            .profileSr = shaping.profileSr,
            .functionKind = shaping.functionKind,
            .functionImage = shaping.functionImage,
            .functionPhase = shaping.functionPhase,
            .functionMap = vec4(shaping.functionMap),
            .functionOriginWs = vec3(shaping.functionOriginWs),
            .channels = shaping.channels,
            .shadowChannels = shaping.shadowChannels,
            .picture = shaping.picture,
            .pictureMean = vec3(shaping.pictureMean)};
}

static vec4 ltcLookup0(vec2 uv) {
    return boundLtcTable().sample(uv, LtcLayer::Parameters);
}
static vec4 ltcLookup1(vec2 uv) {
    return boundLtcTable().sample(uv, LtcLayer::Scales);
}
static LightShaping lightShapingLookup(uint place) {
    return fromF32(boundLightTables().shapings.at(place));
}

static double profileLookup(uint layer, vec2 uv) {
    return (boundLightTables().profiles.at(layer)->clamped(uv));
}
static double functionImageLookup(uint layer, vec2 uv) {
    return (boundLightTables().functionImages.at(layer)->repeated(uv));
}
static vec3 lightPictureLookup(uint layer, vec2 uv, double level) {
    return vec3(boundLightTables().pictures.at(layer)->lookup(dvec2(uv), double(level)));
}
static double lightWarpLookup(uint index) {
    const std::size_t floats = boundLightTables().pictures.at(0)->warp.size();
    return boundLightTables().pictures.at(index / floats)->warp.at(index % floats);
}

static vec3 domeRadianceLookup(vec2 uv, double level) {
    return vec3(boundLightTables().dome->radianceAt(dvec2(uv), double(level)));
}
static vec3 domeIrradianceLookup(vec2 uv) {
    return vec3(boundLightTables().dome->irradianceAt(dvec2(uv)));
}
static double domeDistributionLookup(uint place) {
    return double(boundLightTables().dome->distribution.at(place));
}

#define KILOLUX_LIGHTS_LIGHT_TYPES_GLSL // declared by the header
#define KILOLUX_MATH_SELECTION_TYPES_GLSL
#define float double
#include "shaders/lights/light.glsl"
#include "shaders/math/area_mask.glsl"
#include "shaders/math/hash.glsl"
#include "shaders/math/noise_tile.glsl"
#include "shaders/math/selection.glsl"
#undef float

} // namespace kilolux::f64
