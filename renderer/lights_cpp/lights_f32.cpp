// The float build. Compiled with -fsingle-precision-constant, because the shaders' literals have no suffix.
#include "renderer/lights_cpp/lights_f32.h"

#include "renderer/lights_cpp/light_tables.h"
#include "renderer/lights_cpp/ltc_table.h"

#include <glm/gtc/packing.hpp>

static_assert(sizeof(0.5) == sizeof(float), "compile this file with -fsingle-precision-constant");

namespace kilolux::f32 {

using namespace glm;
using namespace shared;

static vec4 ltcLookup0(vec2 uv) {
    return vec4(boundLtcTable().sample(uv, LtcLayer::Parameters));
}
static vec4 ltcLookup1(vec2 uv) {
    return vec4(boundLtcTable().sample(uv, LtcLayer::Scales));
}
static LightShaping lightShapingLookup(uint place) {
    return boundLightTables().shapings.at(place);
}

static float profileLookup(uint layer, vec2 uv) {
    return float(boundLightTables().profiles.at(layer)->clamped(dvec2(uv)));
}
static float functionImageLookup(uint layer, vec2 uv) {
    return float(boundLightTables().functionImages.at(layer)->repeated(dvec2(uv)));
}
static vec3 lightPictureLookup(uint layer, vec2 uv, float level) {
    return vec3(boundLightTables().pictures.at(layer)->lookup(dvec2(uv), double(level)));
}
static float lightWarpLookup(uint index) {
    const std::size_t floats = boundLightTables().pictures.at(0)->warp.size();
    return boundLightTables().pictures.at(index / floats)->warp.at(index % floats);
}

static vec3 domeRadianceLookup(vec2 uv, float level) {
    return vec3(boundLightTables().dome->radianceAt(dvec2(uv), double(level)));
}
static vec3 domeIrradianceLookup(vec2 uv) {
    return vec3(boundLightTables().dome->irradianceAt(dvec2(uv)));
}
static float domeDistributionLookup(uint place) {
    return float(boundLightTables().dome->distribution.at(place));
}

#define KILOLUX_LIGHTS_LIGHT_TYPES_GLSL // declared by the header
#define KILOLUX_MATH_SELECTION_TYPES_GLSL
#include "shaders/lights/light.glsl"
#include "shaders/math/area_mask.glsl"
#include "shaders/math/hash.glsl"
#include "shaders/math/noise_tile.glsl"
#include "shaders/math/selection.glsl"

} // namespace kilolux::f32
