// Dome light: radiance from all directions by a latitude-longitude picture, the middle towards local -Z, local +Y up.
// uv: rows of the picture by v and places in the row by u, both stretched so that equal parts of the square hold equal
// luminance (marginal and conditional distribution: Pharr, Jakob and Humphreys, "Physically Based Rendering", section
// 14.2.4); within a cell of the distribution solid angle is even, so that its density is exact. Continuous in u, and in
// v within a row. intensity: nit of a texel of 1. The includer declares domeDistributionLookup(place),
// domeRadianceLookup(uv, level) and domeIrradianceLookup(uv), which renderer/dome_maps.h describes.
#ifndef KILOLUX_LIGHTS_DOME_GLSL
#define KILOLUX_LIGHTS_DOME_GLSL
#include "../math/ltc.glsl"
#include "../math/panorama.glsl"
#include "shaping.glsl"

// The distribution begins with its columns and rows and the picture's width and levels, then the rows' cumulated
// shares and each row's cumulated cells', one more than there are, from 0 to 1.
const uint KX_DOME_HEAD = 4u;
const int KX_DOME_TAPS = 24; // of the specular lobe
const float KX_DOME_BELOW_ONE = 0.99999994;

struct DomeSize {
    uint columns;
    uint rows;
    float widthPx;
    float levels;
};

KX_INLINE DomeSize domeSize() {
    DomeSize size;
    size.columns = uint(domeDistributionLookup(0u));
    size.rows = uint(domeDistributionLookup(1u));
    size.widthPx = domeDistributionLookup(2u);
    size.levels = domeDistributionLookup(3u);
    return size;
}

KX_INLINE LightBounds domeBounds(LightHot light) {
    LightBounds bounds = rangeBounds(light);
    bounds.radiusM = KX_INFINITY;
    return bounds;
}

// The cell of a cumulated list of `count` that a number falls into; never an empty one.
KX_INLINE uint domeFind(uint first, uint count, float number) {
    uint low = 0u, high = count;
    while (high - low > 1u) {
        uint middle = (low + high) / 2u;
        if (domeDistributionLookup(first + middle) <= number)
            low = middle;
        else
            high = middle;
    }
    return low;
}

// x: where a cumulated cell begins, y: how much it holds.
KX_INLINE vec2 domeCell(uint first, uint place) {
    float begin = domeDistributionLookup(first + place);
    return vec2(begin, domeDistributionLookup(first + place + 1u) - begin);
}

KX_INLINE vec3 domeLocal(LightHot light, vec3 dirWs) {
    return transpose(lightFrame(light)) * dirWs;
}

// Texels of the picture about a direction; every level is as blurred as its texels are wide.
KX_INLINE vec3 domeTexel(vec3 dirLs, float level) {
    vec2 uv = panoramaUv(dirLs);
    float halfTexel = exp2(ceil(level)) / domeSize().widthPx; // the picture is half as high as wide
    return domeRadianceLookup(vec2(uv.x, clamp(uv.y, halfTexel, 1.0 - halfTexel)), level);
}

// Nit from a direction.
KX_INLINE vec3 domeRadiance(LightHot light, vec3 dirWs) {
    return light.intensity * domeTexel(domeLocal(light, dirWs), 0.0);
}

// Lux on a surface, unshadowed. The map has its first and last rows at the poles.
KX_INLINE vec3 domeIlluminance(LightHot light, vec3 normalWs) {
    return light.intensity * domeIrradianceLookup(panoramaUv(domeLocal(light, normalWs)));
}

// The level whose blur has this standard deviation, rad.
KX_INLINE float domeLevel(float deviationRad, DomeSize size) {
    float texels = deviationRad * size.widthPx * (1.0 / KX_TWO_PI);
    return clamp(log2(max(texels, 1.0e-6)), 0.0, size.levels - 1.0);
}

KX_INLINE LightSample domeSample(LightHot light, vec3 receiverWs, vec2 uv) {
    DomeSize size = domeSize();
    uint row = domeFind(KX_DOME_HEAD, size.rows, min(uv.y, KX_DOME_BELOW_ONE));
    uint first = KX_DOME_HEAD + size.rows + 1u + row * (size.columns + 1u);
    uint column = domeFind(first, size.columns, min(uv.x, KX_DOME_BELOW_ONE));
    vec2 inRow = domeCell(KX_DOME_HEAD, row), inColumn = domeCell(first, column);
    float upper = cos(float(row) / float(size.rows) * KX_PI);
    float lower = cos(float(row + 1u) / float(size.rows) * KX_PI);
    float across = saturate((uv.x - inColumn.x) / max(inColumn.y, 1.0e-30));
    float down = saturate((uv.y - inRow.x) / max(inRow.y, 1.0e-30));
    LightSample s = invalidSample(uv);
    s.valid = true;
    s.distanceM = KX_INFINITY;
    s.dirWs = lightFrame(light) * panoramaDirection((float(column) + across) / float(size.columns), mix(upper, lower, down));
    s.positionWs = receiverWs + s.dirWs;
    s.emitterNormalWs = -s.dirWs;
    s.geometry = (upper - lower) * KX_TWO_PI / (float(size.columns) * max(inRow.y * inColumn.y, 1.0e-30));
    s.pdfSolidAngle = 1.0 / s.geometry;
    s.pdfArea = s.pdfSolidAngle;
    return s;
}

KX_INLINE LightHit domeIntersect(LightHot light, vec3 originWs, vec3 dirWs) {
    DomeSize size = domeSize();
    vec3 dirLs = domeLocal(light, dirWs);
    vec2 place = panoramaUv(dirLs);
    uint row = min(uint(place.y * float(size.rows)), size.rows - 1u);
    float column = place.x * float(size.columns);
    uint inside = min(uint(column), size.columns - 1u);
    uint first = KX_DOME_HEAD + size.rows + 1u + row * (size.columns + 1u);
    vec2 inRow = domeCell(KX_DOME_HEAD, row), inColumn = domeCell(first, inside);
    float upper = cos(float(row) / float(size.rows) * KX_PI);
    float lower = cos(float(row + 1u) / float(size.rows) * KX_PI);
    LightHit hit = noLightHit();
    hit.uv = vec2(inColumn.x + inColumn.y * saturate(column - float(inside)),
                  inRow.x + inRow.y * saturate((upper - dirLs.y) / (upper - lower)));
    hit.pdfSolidAngle = inRow.y * inColumn.y * float(size.columns) / (KX_TWO_PI * (upper - lower));
    hit.pdfArea = hit.pdfSolidAngle;
    hit.hit = hit.pdfSolidAngle > 0.0;
    return hit;
}

// The mean radiance that the specular lobe sees, of texels: directions spread evenly over the fitted lobe, each blurred
// over its share of it (filtered importance sampling, Krivanek and Colbert, "Real-time Shading with Filtered Importance
// Sampling", 2008) and weighted by the true lobe over the fit.
KX_INLINE vec3 domeSpecularTexel(LightHot light, ShadingPoint point, LtcLobe lobe) {
    DomeSize size = domeSize();
    mat3 localFromWorld = transpose(lightFrame(light));
    vec3 sum = vec3(0.0);
    float weights = 1.0e-20;
    // Turned anyhow at every place: the directions of one pattern would show as rays around the highlight of a sun.
    float turn = fract(sin(dot(point.positionWs, vec3(12.9898, 78.233, 37.719))) * 43758.5453) * KX_TWO_PI;
    for (int i = 0; i < KX_DOME_TAPS; ++i) {
        float radius2 = (float(i) + 0.5) / float(KX_DOME_TAPS), phi = turn + float(i) * 2.39996323;
        float radius = sqrt(radius2);
        vec3 dir = lobe.worldFromLtc * vec3(radius * cos(phi), radius * sin(phi), sqrt(1.0 - radius2));
        dir = dir * inversesqrt(max(dot(dir, dir), 1.0e-30));
        float density = ltcDensity(lobe, dir);
        float weight = ggxTimesCosine(point.normalWs, point.viewDirWs, point.noV, dir, point.alpha).x / max(density, 1.0e-20);
        // A blur of this deviation covers three shares: with less a small sun shows where the directions are.
        float deviation = sqrt(3.0 / (4.0 * KX_PI * float(KX_DOME_TAPS) * max(density, 1.0e-6)));
        sum += domeTexel(localFromWorld * dir, domeLevel(deviation, size)) * weight;
        weights += weight;
    }
    return sum / weights;
}

KX_INLINE LightIrradiance domeIrradiance(LightHot light, ShadingPoint point, LtcLobe lobe) {
    LightIrradiance lit;
    lit.emission = domeIlluminance(light, point.normalWs);
    bool lit_ = luminance(lit.emission) > 0.0;
    lit.diffuse = lit_ ? 1.0 : 0.0;
    lit.specularEmission = lit_ ? light.intensity * domeSpecularTexel(light, point, lobe) : vec3(0.0);
    lit.specular = lit_ ? lobe.albedo : vec2(0.0);
    return lit;
}

// As lightWeight(): the mirror direction stands for the lobe, Schlick's term in the view for its reflectance, and a part
// of the illuminance for its tails.
KX_INLINE float domeWeight(LightHot light, ShadingPoint point, float diffuseAlbedo, float f0) {
    float lux = luminance(domeIlluminance(light, point.normalWs));
    vec3 mirrorDir = point.normalWs * (2.0 * point.noV) - point.viewDirWs;
    float level = domeLevel(point.alpha, domeSize());
    float nit = luminance(light.intensity * domeTexel(domeLocal(light, mirrorDir), level));
    float grazing = square(square(1.0 - point.noV)) * (1.0 - point.noV) * square(1.0 - point.roughness);
    return lux <= 0.0 ? 0.0 : (diffuseAlbedo + 0.1 * f0) * KX_INV_PI * lux + mix(f0, 1.0, grazing) * nit;
}

#endif
