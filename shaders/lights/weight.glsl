// The cheap weight by which candidate lights are chosen: about the luminance of unshadowed BRDF x light, without
// tables and edges. Never 0 for a light that contributes.
#ifndef KILOLUX_LIGHTS_WEIGHT_GLSL
#define KILOLUX_LIGHTS_WEIGHT_GLSL
#include "irradiance.glsl"

// What a weight needs of a light's geometry.
struct LightProxy {
    vec3 dirWs;       // unit, towards where most light comes from
    float solidAngle; // about; 1/m^2 for points, 1 for delta directions; 0 only where the light does not reach
    float sinRadius;  // of a cone about dirWs that holds the light
};

KX_INLINE LightProxy lightProxy(LightHot light, vec3 receiverWs) {
    LightProxy proxy;
    uint type = lightType(light);
    vec3 toCenter = light.positionWs - receiverWs;
    float distance2 = max(dot(toCenter, toCenter), 1.0e-12);
    float extent = light.sizeM.x;
    if (type == LIGHT_DIRECTIONAL) {
        proxy.dirWs = -light.dirWs;
        proxy.sinRadius = directionalIsDelta(light) ? 0.0 : sqrt(directionalSin2(light));
        proxy.solidAngle = directionalIsDelta(light) ? 1.0 : KX_PI * directionalSin2(light);
        return proxy;
    }
    float area = KX_PI * extent * extent;
    float facing = 1.0;
    if (type == LIGHT_RECT || type == LIGHT_DISK) {
        float height = -dot(light.dirWs, toCenter);
        extent = type == LIGHT_RECT ? length(light.sizeM) : extent;
        area = type == LIGHT_RECT ? rectAreaM2(light) : diskAreaM2(light);
        facing = height > 0.0 ? max(height * inversesqrt(distance2), 1.0e-4) : 0.0;
    } else if (type == LIGHT_TUBE) {
        extent = light.sizeM.y + tubeRadiusM(light);
        vec3 axis = lightFrame(light)[0];
        float along = dot(toCenter, axis);
        float slant2 = max(1.0 - along * along / distance2, 0.0);
        area = tubeRadiusM(light) * (4.0 * light.sizeM.y * sqrt(slant2) + KX_PI * tubeRadiusM(light));
        // Half way to the axis point nearest the receiver, which is where most of the light comes from.
        toCenter = toCenter + axis * (0.5 * clamp(-along, -light.sizeM.y, light.sizeM.y));
    }
    proxy.dirWs = toCenter * inversesqrt(max(dot(toCenter, toCenter), 1.0e-12));
    bool isPoint = (type == LIGHT_SPHERE || type == LIGHT_SPOT) && sphereIsPoint(light);
    float perDistance2 = area * facing / (distance2 + area * KX_INV_PI);
    proxy.solidAngle = isPoint ? 1.0 / distance2 : perDistance2;
    proxy.sinRadius = isPoint ? 0.0 : min(extent * inversesqrt(distance2) * (type == LIGHT_TUBE ? 2.0 : 1.0), 1.0);
    return proxy;
}

// `emission` is lightEvaluate() at the point; `diffuseAlbedo` and `f0` are the surface's luminances.
KX_INLINE float proxyWeight(LightProxy proxy, ShadingPoint point, vec3 emission, float diffuseAlbedo, float f0) {
    float cosine = dot(point.normalWs, proxy.dirWs);
    if (cosine + proxy.sinRadius <= 0.0 || proxy.solidAngle <= 0.0)
        return 0.0;
    float clipped = max(horizonCosine(cosine, proxy.sinRadius), 1.0e-5);
    // The lobe sees the light's point nearest to the mirror direction, and is as wide as both together.
    vec3 mirrorDir = point.normalWs * (2.0 * dot(point.normalWs, point.viewDirWs)) - point.viewDirWs;
    vec3 aside = mirrorDir - proxy.dirWs * dot(mirrorDir, proxy.dirWs);
    float asideLength = length(aside);
    float reach = min(proxy.sinRadius, asideLength);
    vec3 lightDir = proxy.dirWs + (asideLength > 1.0e-6 ? aside * (reach / asideLength) : vec3(0.0));
    lightDir = normalize(lightDir + point.normalWs * max(1.0e-3 - dot(point.normalWs, lightDir), 0.0));
    float wide = min(point.alpha + 0.5 * proxy.sinRadius, 1.0);
    vec2 lobe = ggxTimesCosine(point.normalWs, point.viewDirWs, point.noV, lightDir, wide);
    float specular = lobe.x * mix(f0, 1.0, lobe.y);
    return luminance(emission) * proxy.solidAngle * (diffuseAlbedo * KX_INV_PI * clipped + specular);
}

#endif
