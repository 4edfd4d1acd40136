// The cheap weight by which candidate lights are chosen: about the luminance of unshadowed BRDF x light,
// without tables and edges. Never 0 for a light that contributes.
#ifndef KILOLUX_LIGHTS_WEIGHT_GLSL
#define KILOLUX_LIGHTS_WEIGHT_GLSL
#include "irradiance.glsl"

// What a weight needs of a light's geometry.
struct LightProxy {
    vec3 dirWs;       // unit, towards the middle of the light as it is seen
    float solidAngle; // about; 1/m^2 for points, 1 for delta directions
    float sinRadius;  // of a cone about dirWs that holds the light
    vec3 longDirWs;   // unit, square to dirWs: the way the light extends to sinRadius
    float sinShort;   // how far it extends across
    vec3 boundDirWs;  // axis and radius of a cone that surely holds the light
    float boundSin;
};

KX_INLINE LightProxy roundProxy(vec3 dirWs, float solidAngle, float sinRadius) {
    LightProxy proxy;
    proxy.dirWs = dirWs;
    proxy.solidAngle = solidAngle;
    proxy.sinRadius = sinRadius;
    proxy.longDirWs = vec3(0.0);
    proxy.sinShort = sinRadius;
    proxy.boundDirWs = dirWs;
    proxy.boundSin = sinRadius;
    return proxy;
}

// A tube's light is about even over the angle that its axis fills, so its middle is the bisector.
KX_INLINE LightProxy tubeProxy(LightHot light, vec3 toCenter) {
    vec3 axis = lightFrame(light)[0];
    float radius = tubeRadiusM(light);
    vec3 toA = toCenter - axis * light.sizeM.y;
    vec3 toB = toCenter + axis * light.sizeM.y;
    vec3 dirA = toA * inversesqrt(max(dot(toA, toA), 1.0e-12));
    vec3 dirB = toB * inversesqrt(max(dot(toB, toB), 1.0e-12));
    vec3 foot = toCenter - axis * dot(toCenter, axis);
    float fromAxis = max(length(foot), radius);
    float nearest = clamp(-dot(toCenter, axis), -light.sizeM.y, light.sizeM.y);
    vec3 toNearest = toCenter + axis * nearest;
    float nearest2 = max(dot(toNearest, toNearest), radius * radius);
    float halfAngle = 0.5 * angleFromCosSin(dot(dirA, dirB), length(cross(dirA, dirB)));
    vec3 middle = dirA + dirB;
    middle = dot(middle, middle) > 1.0e-6 ? normalize(middle) : foot / fromAxis;
    LightProxy proxy;
    proxy.dirWs = middle;
    proxy.solidAngle = 4.0 * radius * halfAngle / fromAxis + KX_PI * radius * radius / nearest2;
    proxy.sinRadius = min(sin(min(halfAngle, KX_HALF_PI)) + 1.1 * radius * inversesqrt(nearest2), 1.0);
    vec3 along = axis - middle * dot(axis, middle);
    proxy.longDirWs = along * inversesqrt(max(dot(along, along), 1.0e-12));
    proxy.sinShort = radius * inversesqrt(nearest2);
    float invDistance = inversesqrt(max(dot(toCenter, toCenter), 1.0e-12));
    proxy.boundDirWs = toCenter * invDistance;
    proxy.boundSin = min((light.sizeM.y + radius) * invDistance, 1.0);
    return proxy;
}

KX_INLINE LightProxy lightProxy(LightHot light, vec3 receiverWs) {
    uint type = lightType(light);
    if (type == LIGHT_DIRECTIONAL) {
        float sin2 = directionalSin2(light);
        bool delta = directionalIsDelta(light);
        return roundProxy(-light.dirWs, delta ? 1.0 : KX_PI * sin2, delta ? 0.0 : sqrt(sin2));
    }
    vec3 toCenter = light.positionWs - receiverWs;
    if (type == LIGHT_TUBE) return tubeProxy(light, toCenter);
    float distance2 = max(dot(toCenter, toCenter), 1.0e-12);
    float invDistance = inversesqrt(distance2);
    vec3 dir = toCenter * invDistance;
    if (type == LIGHT_SPHERE || type == LIGHT_SPOT) {
        float sine = min(light.sizeM.x * invDistance, 1.0);
        bool point = sphereIsPoint(light);
        return roundProxy(dir, point ? 1.0 / distance2 : KX_PI * sine * sine, point ? 0.0 : sine);
    }
    bool rect = type == LIGHT_RECT;
    float area = rect ? rectAreaM2(light) : diskAreaM2(light);
    float extent = rect ? length(light.sizeM) : light.sizeM.x;
    float facing = max(-dot(light.dirWs, dir), 1.0e-4); // lightEvaluate has sorted out the side behind
    float solidAngle = area * facing / (distance2 + area * KX_INV_PI);
    LightProxy proxy = roundProxy(dir, solidAngle, min(extent * invDistance, 1.0));
    if (rect) {
        mat3 frame = lightFrame(light);
        bool wide = light.sizeM.x > light.sizeM.y;
        vec3 along = wide ? frame[0] : frame[1];
        along = along - dir * dot(along, dir);
        proxy.longDirWs = along * inversesqrt(max(dot(along, along), 1.0e-12));
        proxy.sinShort = min(min(light.sizeM.x, light.sizeM.y) * invDistance, 1.0);
    }
    return proxy;
}

// `emission` is lightEvaluate() at the point; `diffuseAlbedo` and `f0` are the surface's luminances.
KX_INLINE float proxyWeight(LightProxy proxy, ShadingPoint point, vec3 emission, float diffuseAlbedo,
                            float f0) {
    float cosine = dot(point.normalWs, proxy.dirWs);
    if (dot(point.normalWs, proxy.boundDirWs) + proxy.boundSin <= 0.0) return 0.0;
    vec2 cut = horizonCut(cosine, proxy.sinRadius);
    float visible = proxy.solidAngle * max(cut.x, 1.0e-4);
    float diffuse = max(cut.y, 1.0e-5);
    // The lobe sees the light's point nearest to the mirror direction, and is as wide as both together.
    vec3 mirrorDir = point.normalWs * (2.0 * dot(point.normalWs, point.viewDirWs)) - point.viewDirWs;
    vec3 aside = mirrorDir - proxy.dirWs * dot(mirrorDir, proxy.dirWs);
    float along = dot(aside, proxy.longDirWs);
    vec3 across = aside - proxy.longDirWs * along;
    float acrossLength = max(length(across), 1.0e-6);
    vec3 lightDir = proxy.dirWs + proxy.longDirWs * clamp(along, -proxy.sinRadius, proxy.sinRadius) +
                    across * (min(proxy.sinShort, acrossLength) / acrossLength);
    lightDir = normalize(lightDir + point.normalWs * max(1.0e-3 - dot(point.normalWs, lightDir), 0.0));
    float wide = min(point.alpha + 0.25 * (proxy.sinRadius + proxy.sinShort), 1.0);
    vec2 lobe = ggxTimesCosine(point.normalWs, point.viewDirWs, point.noV, lightDir, wide);
    float specular = lobe.x * mix(f0, 1.0, lobe.y);
    return luminance(emission) * visible * (diffuseAlbedo * KX_INV_PI * diffuse + specular);
}

#endif
