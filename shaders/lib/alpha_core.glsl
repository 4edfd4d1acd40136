// The alpha test of rays and of raster, one for both: factor * texture alpha * vertex alpha against the
// cutoff, the texture read from one R8 texel buffer without mip levels. In the subset that C++ compiles too.
//
// Needs: float fetchAlphaTexel(uint texel), uvec4 fetchAlphaRecord(uint texel), uvec4 fetchAlphaTriangle(uint
// texel), uvec2 fetchTraceInstance(uint instance).
#ifndef KILOLUX_ALPHA_CORE_GLSL
#define KILOLUX_ALPHA_CORE_GLSL

KX_INLINE int wrapTexel(int texel, int size, uint mode) {
    if (mode == ALPHA_WRAP_CLAMP) {
        return clamp(texel, 0, size - 1);
    }
    int period = mode == ALPHA_WRAP_MIRROR ? 2 * size : size;
    int inPeriod = texel - period * int(floor(float(texel) / float(period)));
    // The float quotient may round across a whole number of periods.
    inPeriod = inPeriod < 0 ? inPeriod + period : inPeriod >= period ? inPeriod - period : inPeriod;
    return inPeriod < size ? inPeriod : period - 1 - inPeriod;
}

KX_INLINE float alphaAt(uvec4 image, int x, int y) {
    int width = int(image.y), height = int(image.z);
    uint modeS = image.w & 3u;
    uint modeT = (image.w >> ALPHA_WRAP_T_SHIFT) & 3u;
    int texel = wrapTexel(y, height, modeT) * width + wrapTexel(x, width, modeS);
    return fetchAlphaTexel(image.x + uint(texel));
}

// `image`: first texel, width, height, flags of an AlphaRecord. Bilinear as samplers do it, or nearest.
KX_INLINE float sampleAlpha(uvec4 image, vec2 uv) {
    // Far outside, floats no longer resolve texels anyway; the bound keeps the conversion to int defined.
    vec2 px = clamp(uv, vec2(-8192.0, -8192.0), vec2(8192.0, 8192.0)) * vec2(float(image.y), float(image.z));
    if ((image.w & ALPHA_FLAG_NEAREST) != 0u) {
        return alphaAt(image, int(floor(px.x)), int(floor(px.y)));
    }
    px -= vec2(0.5, 0.5);
    vec2 corner = floor(px);
    vec2 f = px - corner;
    int x = int(corner.x), y = int(corner.y);
    float upper = mix(alphaAt(image, x, y), alphaAt(image, x + 1, y), f.x);
    float lower = mix(alphaAt(image, x, y + 1), alphaAt(image, x + 1, y + 1), f.x);
    return mix(upper, lower, f.y);
}

// True where the surface is there: it stops rays and is drawn. Instances without an alpha record always are.
KX_INLINE bool alphaPasses(uint instance, uint primitive, vec2 barycentrics) {
    uint record = fetchTraceInstance(instance).y & ALPHA_RECORD_NONE;
    if (record == ALPHA_RECORD_NONE) {
        return true;
    }
    uvec4 r0 = fetchAlphaRecord(record * ALPHA_RECORD_TEXELS);
    uvec4 r1 = fetchAlphaRecord(record * ALPHA_RECORD_TEXELS + 1u);
    uvec4 r2 = fetchAlphaRecord(record * ALPHA_RECORD_TEXELS + 2u);
    uvec4 r3 = fetchAlphaRecord(record * ALPHA_RECORD_TEXELS + 3u);
    uint triangle = (r3.x + primitive) * ALPHA_TRIANGLE_TEXELS;
    uvec4 t0 = fetchAlphaTriangle(triangle);
    uvec4 t1 = fetchAlphaTriangle(triangle + 1u);
    vec3 weights = vec3(1.0 - barycentrics.x - barycentrics.y, barycentrics.x, barycentrics.y);
    uint alphas = t1.z;
    vec3 vertexAlpha = vec3(float(int(alphas & 255u)), float(int((alphas >> 8u) & 255u)),
                            float(int((alphas >> 16u) & 255u)));
    float alpha = uintBitsToFloat(r1.w) * dot(weights, vertexAlpha) * (1.0 / 255.0);
    if (r0.y != 0u) {
        vec3 us = vec3(uintBitsToFloat(t0.x), uintBitsToFloat(t0.z), uintBitsToFloat(t1.x));
        vec3 vs = vec3(uintBitsToFloat(t0.y), uintBitsToFloat(t0.w), uintBitsToFloat(t1.y));
        vec3 uv1 = vec3(dot(weights, us), dot(weights, vs), 1.0);
        vec3 uvRow0 = vec3(uintBitsToFloat(r1.x), uintBitsToFloat(r1.y), uintBitsToFloat(r1.z));
        vec3 uvRow1 = vec3(uintBitsToFloat(r2.x), uintBitsToFloat(r2.y), uintBitsToFloat(r2.z));
        alpha *= sampleAlpha(r0, vec2(dot(uvRow0, uv1), dot(uvRow1, uv1)));
    }
    return alpha >= uintBitsToFloat(r2.w);
}

#endif
