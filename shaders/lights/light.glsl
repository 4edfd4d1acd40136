// One set of functions for every light type; each evaluation has a single call site, the type only chooses
// what goes in. The includer declares ltcLookup0 and ltcLookup1 (math/ltc.glsl) and lightShapingLookup(place),
// profileLookup and functionImageLookup (light_filter.glsl), lightPictureLookup and lightWarpLookup (picture.glsl), what
// dome.glsl names. It may define KX_HAS_DOME, KX_HAS_BARN_DOORS, KX_HAS_IES, KX_HAS_LIGHT_FUNCTIONS, KX_HAS_LIGHT_CHANNELS
// and KX_HAS_PICTURES as constant expressions that are false where the scene has no such light; with KX_HAS_LIGHT_TYPES
// defined it declares KX_HAS_SPHERE and so on for every type itself.
#ifndef KILOLUX_LIGHTS_LIGHT_GLSL
#define KILOLUX_LIGHTS_LIGHT_GLSL

#ifndef KX_HAS_BARN_DOORS
#define KX_HAS_BARN_DOORS true
#endif
#ifndef KX_HAS_IES
#define KX_HAS_IES true
#endif
#ifndef KX_HAS_LIGHT_FUNCTIONS
#define KX_HAS_LIGHT_FUNCTIONS true
#endif
#ifndef KX_HAS_LIGHT_CHANNELS
#define KX_HAS_LIGHT_CHANNELS true
#endif
#ifndef KX_HAS_PICTURES
#define KX_HAS_PICTURES true
#endif
#include "../shared/light_types.h"
#include "directional.glsl"
#include "disk.glsl"
#include "dome.glsl"
#include "irradiance.glsl"
#include "light_filter.glsl"
#include "picture.glsl"
#include "rect.glsl"
#include "shading_point.glsl"
#include "sphere.glsl"
#include "spot.glsl"
#include "tube.glsl"

#ifndef KX_HAS_LIGHT_TYPES
#define KX_HAS_LIGHT(UPPER, Name, place) const bool KX_HAS_##UPPER = true;
KX_LIGHT_TYPES(KX_HAS_LIGHT)
#undef KX_HAS_LIGHT
#endif
#ifndef KX_HAS_DOME
#define KX_HAS_DOME true
#endif
#include "weight.glsl"

// Whether the light has no extent: only lightSample can meet it.
KX_INLINE bool lightIsDelta(LightHot light) {
    uint type = lightType(light);
    bool point = (type == LIGHT_SPHERE || type == LIGHT_SPOT) && sphereIsPoint(light);
    return point || (type == LIGHT_DIRECTIONAL && directionalIsDelta(light));
}

// Where the light can reach. Dead and muted lights have radius 0.
KX_INLINE LightBounds lightBounds(LightHot light) {
    uint type = lightType(light);
    LightBounds bounds = rangeBounds(light);
    if (KX_HAS_DIRECTIONAL && type == LIGHT_DIRECTIONAL)
        bounds = directionalBounds(light);
    else if (KX_HAS_SPOT && type == LIGHT_SPOT)
        bounds = spotBounds(light);
    else if (KX_HAS_RECT && type == LIGHT_RECT)
        bounds = rectBounds(light);
    else if (KX_HAS_DISK && type == LIGHT_DISK)
        bounds = diskBounds(light);
    else if (KX_HAS_TUBE && type == LIGHT_TUBE)
        bounds = tubeBounds(light);
    else if (KX_HAS_DOME && type == LIGHT_DOME)
        bounds = domeBounds(light);
    bounds = profileBounds(light, bounds);
    bounds.radiusM = lightIsOn(light) ? bounds.radiusM : 0.0;
    return bounds;
}

// The light's shaped emission towards the receiver, without its picture: radiance in nit, intensity in cd for points, illuminance
// in lux for a delta direction. 0 behind one-sided lights, out of range and for dead and muted ones.
KX_INLINE vec3 lightEvaluate(LightHot light, vec3 receiverWs) {
    uint type = lightType(light);
    vec3 emission = vec3(0.0);
    if (!lightIsOn(light)) return emission;
    if (KX_HAS_SPHERE && type == LIGHT_SPHERE)
        emission = sphereEvaluate(light, receiverWs);
    else if (KX_HAS_SPOT && type == LIGHT_SPOT)
        emission = spotEvaluate(light, receiverWs);
    else if (KX_HAS_TUBE && type == LIGHT_TUBE)
        emission = tubeEvaluate(light, receiverWs);
    else if (KX_HAS_RECT && type == LIGHT_RECT)
        emission = rectEvaluate(light, receiverWs);
    else if (KX_HAS_DISK && type == LIGHT_DISK)
        emission = diskEvaluate(light, receiverWs);
    else if (KX_HAS_DIRECTIONAL && type == LIGHT_DIRECTIONAL)
        emission = directionalEvaluate(light, receiverWs);
    else if (KX_HAS_DOME && type == LIGHT_DOME)
        emission = light.intensity;
    return emission * lightFilter(light, receiverWs);
}

// What a point of the light multiplies lightEvaluate() with: 1 but for lights that are not the same all over.
KX_INLINE vec3 lightTint(LightHot light, LightSample s) {
    if (KX_HAS_DOME && lightType(light) == LIGHT_DOME) return domeTexel(domeLocal(light, s.dirWs), 0.0);
    return s.tint;
}

// The silhouette from a receiver; `alpha` of its surface decides how finely it is drawn.
KX_INLINE EmitterOutline lightOutline(LightHot light, vec3 receiverWs, float alpha) {
    uint type = lightType(light);
    if (KX_HAS_TUBE && type == LIGHT_TUBE) return tubeOutline(light, receiverWs, alpha);
    if (KX_HAS_RECT && type == LIGHT_RECT) return rectOutline(light, receiverWs, alpha);
    if (KX_HAS_DISK && type == LIGHT_DISK) return diskOutline(light, receiverWs, alpha);
    if (KX_HAS_DIRECTIONAL && type == LIGHT_DIRECTIONAL) return directionalOutline(light, receiverWs, alpha);
    if ((KX_HAS_SPHERE && type == LIGHT_SPHERE) || (KX_HAS_SPOT && type == LIGHT_SPOT))
        return sphereOutline(light, receiverWs, alpha);
    return unlitOutline();
}

// Analytic, unshadowed.
KX_INLINE LightIrradiance lightIrradiance(LightHot light, ShadingPoint point, LtcLobe lobe) {
    vec3 emission = lightEvaluate(light, point.positionWs);
    if (luminance(emission) <= 0.0 || !lightIncludes(light, point.channels)) {
        LightIrradiance none;
        none.emission = vec3(0.0);
        none.specularEmission = vec3(0.0);
        none.diffuse = 0.0;
        none.specular = vec2(0.0);
        return none;
    }
    if (KX_HAS_DOME && lightType(light) == LIGHT_DOME) return domeIrradiance(light, point, lobe);
    EmitterOutline outline = lightOutline(light, point.positionWs, point.alpha);
    LightIrradiance lit = outlineIrradiance(outline, point, lobe, emission);
    if (lightHasPicture(light)) {
        PictureColors colors = pictureColors(light, point);
        lit.emission = emission * colors.diffuse;
        lit.specularEmission = emission * colors.specular;
    }
    return lit;
}

// A point on the light for a uv in the unit square: even in area over what faces the receiver (on a picture in its
// luminance), continuous, fixed to the light's frame up to the mirroring that each type states. Invalid for dead and muted lights,
// from behind and from inside.
KX_INLINE LightSample lightSample(LightHot light, vec3 receiverWs, vec2 uv) {
    uint type = lightType(light);
    LightSample s = invalidSample(uv);
    if (!lightIsOn(light)) return s;
    if ((KX_HAS_SPHERE && type == LIGHT_SPHERE) || (KX_HAS_SPOT && type == LIGHT_SPOT))
        s = sphereSample(light, receiverWs, uv);
    else if (KX_HAS_TUBE && type == LIGHT_TUBE)
        s = tubeSample(light, receiverWs, uv);
    else if (KX_HAS_RECT && type == LIGHT_RECT)
        s = rectSample(light, receiverWs, uv);
    else if (KX_HAS_DISK && type == LIGHT_DISK)
        s = diskSample(light, receiverWs, uv);
    else if (KX_HAS_DIRECTIONAL && type == LIGHT_DIRECTIONAL)
        s = directionalSample(light, receiverWs, uv);
    else if (KX_HAS_DOME && type == LIGHT_DOME)
        s = domeSample(light, receiverWs, uv);
    return s;
}

// Where a ray with unit direction meets the emitting side of the light. Points and delta directions are never
// met.
KX_INLINE LightHit lightIntersect(LightHot light, vec3 originWs, vec3 dirWs) {
    uint type = lightType(light);
    LightHit hit = noLightHit();
    if (!lightIsOn(light)) return hit;
    if ((KX_HAS_SPHERE && type == LIGHT_SPHERE) || (KX_HAS_SPOT && type == LIGHT_SPOT))
        hit = sphereIntersect(light, originWs, dirWs);
    else if (KX_HAS_TUBE && type == LIGHT_TUBE)
        hit = tubeIntersect(light, originWs, dirWs);
    else if (KX_HAS_RECT && type == LIGHT_RECT)
        hit = rectIntersect(light, originWs, dirWs);
    else if (KX_HAS_DISK && type == LIGHT_DISK)
        hit = diskIntersect(light, originWs, dirWs);
    else if (KX_HAS_DIRECTIONAL && type == LIGHT_DIRECTIONAL)
        hit = directionalIntersect(light, originWs, dirWs);
    else if (KX_HAS_DOME && type == LIGHT_DOME)
        hit = domeIntersect(light, originWs, dirWs);
    return hit;
}

// Emitted lumens without range window, barn doors and light function, luminance-weighted, muted or not. 0 for
// directional lights and the dome.
KX_INLINE float lightFlux(LightHot light) {
    uint type = lightType(light);
    if (lightHasPicture(light)) light.intensity = light.intensity * lightShaping(light).pictureMean;
    if (KX_HAS_IES && lightHasShaping(light) && lightShaping(light).profile != 0u)
        return luminance(light.intensity) * lightShaping(light).profileSr;
    float fluxLm = 0.0;
    if (type == LIGHT_SPHERE)
        fluxLm = sphereFlux(light);
    else if (type == LIGHT_SPOT)
        fluxLm = spotFlux(light);
    else if (type == LIGHT_TUBE)
        fluxLm = tubeFlux(light);
    else if (type == LIGHT_RECT)
        fluxLm = rectFlux(light);
    else if (type == LIGHT_DISK)
        fluxLm = diskFlux(light);
    return fluxLm;
}

#endif
