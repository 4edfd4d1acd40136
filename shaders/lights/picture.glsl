// The picture on a rectangle light's face: its radiance is the plain light's times the picture. Samples follow the
// picture's luminance; analytic light takes a colour for each of its two lobes, summed over the prefiltered picture as
// the lobe sees it. uv is the light's (rect.glsl); the picture's top is at +Y and its left at +X, so that it reads right
// from the front. The includer declares lightPictureLookup(layer, uv, level), linear in all three, and
// lightWarpLookup(index).
#ifndef KILOLUX_LIGHTS_PICTURE_GLSL
#define KILOLUX_LIGHTS_PICTURE_GLSL
#include "../math/brdf.glsl"
#include "barn_doors.glsl"

const float KX_PICTURE_PX = 256.0; // of all pictures along each axis
const float KX_PICTURE_LEVELS = 8.0;
// The density of samples is a grid over uv: constant in u within a cell, linear in v between its rows of cell borders,
// so that the warp is continuous. Of a layer: its integral over v up to each row, then the rows, each its integral over
// u up to each border.
const int KX_WARP_CELLS = 64;
const uint KX_WARP_ROW = uint(KX_WARP_CELLS) + 1u;
const uint KX_WARP_FLOATS = KX_WARP_ROW * (KX_WARP_ROW + 1u);
// Cells along each axis in which a lobe looks up the picture. Against quadrature (tests/unit/agreement/picture_test.cpp).
const int KX_PICTURE_CELLS = 4;

KX_INLINE bool lightHasPicture(LightHot light) {
    return KX_HAS_PICTURES && lightType(light) == LIGHT_RECT && lightHasShaping(light) &&
           lightShaping(light).picture != 0u;
}

KX_INLINE vec3 pictureAt(LightShaping shaping, vec2 uv, float level) {
    return lightPictureLookup(shaping.picture - 1u, vec2(1.0) - uv, clamp(level, 0.0, KX_PICTURE_LEVELS));
}

// ---------------------------------------------------------------------------------------------------------
// Samples

// A line of integrals: `share` of the way from one row of the table to the next.
struct WarpLine {
    uint first;
    float share;
};

KX_INLINE float warpValue(WarpLine line, int k) {
    uint at = line.first + uint(k);
    float low = lightWarpLookup(at);
    return line.share > 0.0 ? mix(low, lightWarpLookup(at + KX_WARP_ROW), line.share) : low;
}

// The last border whose integral is not above `target`, but the very last.
KX_INLINE int warpCell(WarpLine line, float target) {
    int cell = 0;
    for (int size = KX_WARP_CELLS / 2; size > 0; size /= 2)
        cell = warpValue(line, cell + size) <= target ? cell + size : cell;
    return cell;
}

KX_INLINE WarpLine warpColumn(LightShaping shaping) {
    WarpLine line;
    line.first = (shaping.picture - 1u) * KX_WARP_FLOATS;
    line.share = 0.0;
    return line;
}

KX_INLINE WarpLine warpRow(LightShaping shaping, float v) {
    float at = v * float(KX_WARP_CELLS);
    float row = clamp(floor(at), 0.0, float(KX_WARP_CELLS) - 1.0);
    WarpLine line;
    line.first = (shaping.picture - 1u) * KX_WARP_FLOATS + KX_WARP_ROW * (uint(row) + 1u);
    line.share = saturate(at - row);
    return line;
}

// Integral of the density over all u and up to v.
KX_INLINE float warpedV(LightShaping shaping, float v) {
    WarpLine row = warpRow(shaping, v);
    WarpLine start = row;
    start.share = 0.0;
    float here = warpValue(row, KX_WARP_CELLS), before = warpValue(start, KX_WARP_CELLS);
    int cell = int(clamp(floor(v * float(KX_WARP_CELLS)), 0.0, float(KX_WARP_CELLS) - 1.0));
    return warpValue(warpColumn(shaping), cell) + row.share * 0.5 * (before + here) / float(KX_WARP_CELLS);
}

// Integral up to u along a line.
KX_INLINE float warpedU(WarpLine row, float u) {
    float at = u * float(KX_WARP_CELLS);
    float cell = clamp(floor(at), 0.0, float(KX_WARP_CELLS) - 1.0);
    return mix(warpValue(row, int(cell)), warpValue(row, int(cell) + 1), saturate(at - cell));
}

// Where the square's point of equal share is.
struct PicturePoint {
    vec2 uv;
    vec2 squareUv; // of the point in the square of the whole light: what masks and lists store
    float density; // over the light's uv
};

// `number` is even over the square, the points follow the luminance within low .. high.
KX_INLINE PicturePoint pictureWarp(LightShaping shaping, vec2 number, vec2 low, vec2 high) {
    WarpLine column = warpColumn(shaping);
    bool whole = low.x <= 0.0 && low.y <= 0.0 && high.x >= 1.0 && high.y >= 1.0;
    float lowV = 0.0, highV = 1.0;
    if (!whole) {
        lowV = warpedV(shaping, low.y);
        highV = warpedV(shaping, high.y);
    }
    PicturePoint point;
    point.squareUv.y = mix(lowV, highV, number.y);
    int row = warpCell(column, point.squareUv.y);
    // Of a density that is linear over the row: the root of its integral.
    WarpLine line = warpRow(shaping, float(row) / float(KX_WARP_CELLS));
    line.share = 0.0;
    float first = warpValue(line, KX_WARP_CELLS);
    line.first += KX_WARP_ROW;
    float rise = warpValue(line, KX_WARP_CELLS) - first;
    float rest = max(point.squareUv.y - warpValue(column, row), 0.0) * float(KX_WARP_CELLS);
    float t = 2.0 * rest / max(first + sqrt(max(first * first + 2.0 * rise * rest, 0.0)), 1.0e-20);
    point.uv.y = clamp((float(row) + saturate(t)) / float(KX_WARP_CELLS), low.y, high.y);
    line = warpRow(shaping, point.uv.y);
    float sum = warpValue(line, KX_WARP_CELLS);
    float lowU = whole ? 0.0 : warpedU(line, low.x), highU = whole ? sum : warpedU(line, high.x);
    float target = mix(lowU, highU, number.x);
    int cell = warpCell(line, target);
    float before = warpValue(line, cell), inCell = warpValue(line, cell + 1) - before;
    float along = saturate((target - before) / max(inCell, 1.0e-20));
    point.uv.x = clamp((float(cell) + along) / float(KX_WARP_CELLS), low.x, high.x);
    point.squareUv.x = saturate(target / max(sum, 1.0e-20));
    point.density = inCell * float(KX_WARP_CELLS);
    if (!whole) point.density *= sum / max((highV - lowV) * (highU - lowU), 1.0e-20);
    return point;
}

// The same from the point on the light.
KX_INLINE PicturePoint pictureUnwarp(LightShaping shaping, vec2 uv, vec2 low, vec2 high) {
    WarpLine line = warpRow(shaping, uv.y);
    float sum = warpValue(line, KX_WARP_CELLS);
    int cell = int(clamp(floor(uv.x * float(KX_WARP_CELLS)), 0.0, float(KX_WARP_CELLS) - 1.0));
    PicturePoint point;
    point.uv = uv;
    point.squareUv = vec2(saturate(warpedU(line, uv.x) / max(sum, 1.0e-20)), warpedV(shaping, uv.y));
    point.density = (warpValue(line, cell + 1) - warpValue(line, cell)) * float(KX_WARP_CELLS);
    float partV = warpedV(shaping, high.y) - warpedV(shaping, low.y);
    float partU = warpedU(line, high.x) - warpedU(line, low.x);
    point.density *= sum / max(partV * partU, 1.0e-20);
    return point;
}

// ---------------------------------------------------------------------------------------------------------
// Lobes

// The light's plane as a receiver has it before itself, in units of their distance and size, so that no product of
// lengths overflows. x along local X, y along local Y.
struct PictureView {
    mat3 frame;
    vec2 foot;    // of the receiver's perpendicular on the plane
    float height; // of the receiver over it
    vec2 low;     // corners of what is seen of the light
    vec2 high;
    vec2 half_; // of the whole light
};

KX_INLINE PictureView pictureView(LightHot light, vec3 receiverWs) {
    PictureView view;
    view.frame = lightFrame(light);
    RectPart part = rectPartFrom(light, view.frame, receiverWs);
    vec3 from = receiverWs - light.positionWs;
    float unit = 1.0 / max(length(from) + light.sizeM.x + light.sizeM.y, 1.0e-18);
    view.foot = vec2(dot(from, view.frame[0]), dot(from, view.frame[1])) * unit;
    view.height = max(dot(from, light.dirWs) * unit, 1.0e-9);
    view.low = (part.centerM - part.halfM) * unit;
    view.high = (part.centerM + part.halfM) * unit;
    view.half_ = max(light.sizeM * unit, vec2(1.0e-12));
    return view;
}

// Where a lobe meets the plane, and how wide it is there.
struct PictureLobe {
    vec2 middle;
    float reach;
};

// `width` is the tangent of half the lobe's width.
KX_INLINE PictureLobe lobeOnPicture(PictureView view, vec3 dirWs, float width) {
    float along = view.height / max(dot(dirWs, view.frame[2]), 0.05);
    PictureLobe lobe;
    lobe.middle = view.foot + vec2(dot(dirWs, view.frame[0]), dot(dirWs, view.frame[1])) * along;
    // Beside the light it falls off slowly.
    vec2 nearest = clamp(lobe.middle, view.low, view.high);
    lobe.reach = max(max(width * along, 0.5 * length(lobe.middle - nearest)), 1.0e-3 * (view.half_.x + view.half_.y));
    return lobe;
}

// About the middle of the diffuse lobe as the light's plane cuts it.
KX_INLINE vec3 diffuseLobeDir(PictureView view, vec3 normalWs) {
    vec3 sum = normalWs + view.frame[2];
    return sum * inversesqrt(max(dot(sum, sum), 1.0e-6));
}

KX_INLINE vec3 mirrorDir(ShadingPoint point) {
    vec3 dir = point.normalWs * (2.0 * dot(point.normalWs, point.viewDirWs)) - point.viewDirWs;
    return mix(dir, point.normalWs, 0.5 * point.alpha * point.alpha);
}

KX_INLINE float specularLobeWidth(float alpha) {
    return 2.0 * alpha;
}

// What a lobe sees of the picture, by one lookup.
KX_INLINE vec3 pictureUnder(LightShaping shaping, PictureView view, PictureLobe lobe) {
    vec2 at = clamp(lobe.middle, view.low, view.high);
    vec2 wide = min(vec2(2.0 * lobe.reach), view.high - view.low) / view.half_;
    return pictureAt(shaping, at / view.half_ * 0.5 + vec2(0.5),
                     0.5 * log2(max(wide.x * wide.y * (0.25 * KX_PICTURE_PX * KX_PICTURE_PX), 1.0)));
}

KX_INLINE vec2 projected(vec2 x) {
    return x / sqrt(vec2(1.0) + x * x);
}

struct PictureColors {
    vec3 diffuse;
    vec3 specular;
};

// Averages over the picture under each lobe. The cells of a lobe are narrow at its middle and wide apart from it, each
// with the level that it is as wide as: x = middle + reach * t / sqrt(1 - t^2), even in t, is how a cosine lobe falls off.
KX_INLINE PictureColors pictureColors(LightHot light, ShadingPoint point) {
    LightShaping shaping = lightShaping(light);
    PictureView view = pictureView(light, point.positionWs);
    PictureColors colors;
    colors.diffuse = shaping.pictureMean;
    colors.specular = shaping.pictureMean;
    for (int turn = 0; turn < 2; ++turn) {
        bool specular = turn == 1;
        vec3 toLobe = specular ? mirrorDir(point) : diffuseLobeDir(view, point.normalWs);
        PictureLobe lobe = lobeOnPicture(view, toLobe, specular ? specularLobeWidth(point.alpha) : 1.0);
        vec2 low = projected((view.low - lobe.middle) / lobe.reach);
        vec2 stride = (projected((view.high - lobe.middle) / lobe.reach) - low) / float(KX_PICTURE_CELLS);
        vec3 sum = vec3(0.0);
        float weights = 0.0;
        for (int i = 0; i < KX_PICTURE_CELLS * KX_PICTURE_CELLS; ++i) {
            vec2 t = low + stride * (vec2(float(i % KX_PICTURE_CELLS), float(i / KX_PICTURE_CELLS)) + vec2(0.5));
            vec2 stretch = vec2(1.0) / sqrt(max(vec2(1.0) - t * t, vec2(1.0e-7)));
            vec2 at = clamp(lobe.middle + t * stretch * lobe.reach, view.low, view.high);
            vec2 wide = min(stretch * stretch * stretch * stride * lobe.reach, view.high - view.low);
            vec2 aside = at - view.foot;
            float distance2 = view.height * view.height + dot(aside, aside);
            vec3 dir = (view.frame[2] * view.height + view.frame[0] * aside.x + view.frame[1] * aside.y) *
                       inversesqrt(distance2);
            float seen = specular ? ggxTimesCosine(point.normalWs, point.viewDirWs, point.noV, dir, point.alpha).x
                                  : max(dot(point.normalWs, dir), 0.0);
            float weight = seen * wide.x * wide.y / (distance2 * sqrt(distance2));
            float px2 = wide.x * wide.y / (view.half_.x * view.half_.y) * (0.25 * KX_PICTURE_PX * KX_PICTURE_PX);
            sum += pictureAt(shaping, at / view.half_ * 0.5 + vec2(0.5), 0.5 * log2(max(px2, 1.0))) * weight;
            weights += weight;
        }
        if (weights > 1.0e-30 && specular) colors.specular = sum / weights;
        if (weights > 1.0e-30 && !specular) colors.diffuse = sum / weights;
    }
    return colors;
}

// For candidate weights: luminance of the light over that of the plain one, under the diffuse lobe and under the
// specular one. Never 0 where the picture has any light.
KX_INLINE vec2 pictureWeights(LightHot light, ShadingPoint point) {
    LightShaping shaping = lightShaping(light);
    PictureView view = pictureView(light, point.positionWs);
    PictureLobe diffuse = lobeOnPicture(view, diffuseLobeDir(view, point.normalWs), 1.0);
    PictureLobe specular = lobeOnPicture(view, mirrorDir(point), specularLobeWidth(point.alpha));
    vec3 least = shaping.pictureMean * 0.05;
    return vec2(luminance(light.intensity * max(pictureUnder(shaping, view, diffuse), least)),
                luminance(light.intensity * max(pictureUnder(shaping, view, specular), least))) /
           max(luminance(light.intensity), 1.0e-30);
}

#endif
