// Traversal of the BVH of shaders/shared/bvh.h, in the subset that C++ compiles too: the includer supplies the
// fetches below. One loop, one stack: inner nodes, leaves and entries of placed BVHs follow each other in it.
//
// The triangle test is Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection" (JCGT 2013), sections 3.2
// and 3.3: corners are sheared so that the ray becomes the z axis, a corner's projection depends on that corner
// alone, and an edge function is exactly antisymmetric in its ends. A product's rounding is monotone, so a float
// edge function is either 0 or has the right sign: 0 counts as inside, and the paper's double precision fallback
// is not needed to be watertight (a tie may hit both neighbours, never none).
//
// Boxes: the slab test's relative error is met by a factor on the far distance (Ize, "Robust BVH Ray Traversal",
// JCGT 2013, section 3), its error relative to the grid by the sixteenth of a step that boxes keep.
//
// Needs, beside what trace_hit.glsl does: uvec4 fetchNode(uint texel), vec4 fetchPair(uint texel),
// uvec4 fetchEntry(uint texel), BvhEntry worldEntry(), const bool kTraceAlpha and const bool kTraceChannels.
#ifndef KILOLUX_TRACE_CORE_GLSL
#define KILOLUX_TRACE_CORE_GLSL
#include "trace_hit.glsl"

const float TRACE_FAR_SLACK = 1.0000025; // 1 + 21 * 2^-23: bounds the slab test's relative rounding, with room
const float TRACE_MIN_DIRECTION = 1.0e-18; // stands for 0 in reciprocals, relative to the longest component

struct TraceSpace {
    vec3 origin;
    vec3 planeScale; // distance of a plane = q * planeScale + planeBias
    vec3 planeBias;
    vec3 rowX; // shear: projects a corner to 2D along the ray
    vec3 rowY;
    vec3 rowZ; // gives a corner's distance along the ray
    uint rootRef;
    uint firstTriangle;
};

KX_INLINE vec3 bitsToVec3(uint x, uint y, uint z) {
    return vec3(uintBitsToFloat(x), uintBitsToFloat(y), uintBitsToFloat(z));
}

KX_INLINE float awayFromZero(float value, float smallest) {
    return abs(value) < smallest ? (value < 0.0 ? -smallest : smallest) : value;
}

// The ray, given in the space of a BVH whose boxes lie on the grid.
KX_INLINE TraceSpace makeSpace(vec3 origin, vec3 dir, vec3 gridMin, vec3 gridStep) {
    TraceSpace space;
    space.origin = origin;
    vec3 size = abs(dir);
    float longest = max(size.x, max(size.y, size.z));
    float smallest = longest * TRACE_MIN_DIRECTION;
    vec3 inverse = vec3(1.0 / awayFromZero(dir.x, smallest), 1.0 / awayFromZero(dir.y, smallest),
                        1.0 / awayFromZero(dir.z, smallest));
    space.planeScale = gridStep * inverse;
    space.planeBias = (gridMin - origin) * inverse;

    // z is the ray's longest axis; x and y follow it cyclically, exchanged where the ray runs against z, so that
    // the winding survives the projection.
    bool zIsX = size.x >= size.y && size.x >= size.z;
    bool zIsY = !zIsX && size.y >= size.z;
    vec3 axisZ = zIsX ? vec3(1.0, 0.0, 0.0) : zIsY ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0);
    vec3 axisX = vec3(axisZ.z, axisZ.x, axisZ.y);
    vec3 axisY = vec3(axisZ.y, axisZ.z, axisZ.x);
    float invZ = 1.0 / dot(axisZ, dir);
    vec3 shearX = axisX - axisZ * (dot(axisX, dir) * invZ);
    vec3 shearY = axisY - axisZ * (dot(axisY, dir) * invZ);
    space.rowX = invZ < 0.0 ? shearY : shearX;
    space.rowY = invZ < 0.0 ? shearX : shearY;
    space.rowZ = axisZ * invZ;
    return space;
}

// Every ray starts here; the world's entry has no linear part and is read once for all rays.
KX_INLINE TraceSpace worldSpace(Ray ray) {
    BvhEntry world = worldEntry();
    TraceSpace space = makeSpace(ray.origin - world.pivotWs, ray.dir, world.gridMin, world.gridStep);
    space.rootRef = world.rootRef;
    space.firstTriangle = world.firstTriangle;
    return space;
}

// Moves the ray into the space of an entry. The parameter along the ray stays the same.
KX_INLINE TraceSpace enterSpace(uint entry, Ray ray) {
    uint texel = entry * BVH_ENTRY_TEXELS;
    uvec4 e0 = fetchEntry(texel);
    uvec4 e1 = fetchEntry(texel + 1u);
    uvec4 e2 = fetchEntry(texel + 2u);
    uvec4 e3 = fetchEntry(texel + 3u);
    uvec4 e4 = fetchEntry(texel + 4u);
    uvec4 e5 = fetchEntry(texel + 5u);
    vec3 linear0 = bitsToVec3(e0.x, e0.y, e0.z);
    vec3 linear1 = bitsToVec3(e0.w, e1.x, e1.y);
    vec3 linear2 = bitsToVec3(e1.z, e1.w, e2.x);
    vec3 fromPivot = ray.origin - bitsToVec3(e2.y, e2.z, e2.w);
    vec3 pivotLs = bitsToVec3(e3.x, e3.y, e3.z);
    vec3 origin = vec3(dot(linear0, fromPivot), dot(linear1, fromPivot), dot(linear2, fromPivot)) + pivotLs;
    vec3 dir = vec3(dot(linear0, ray.dir), dot(linear1, ray.dir), dot(linear2, ray.dir));
    TraceSpace space = makeSpace(origin, dir, bitsToVec3(e3.w, e4.x, e4.y), bitsToVec3(e4.z, e4.w, e5.x));
    space.rootRef = e5.y;
    space.firstTriangle = e5.z;
    return space;
}

struct BoxSpan {
    bool hit;
    float near;
};

// Interval of the ray in a quantized box. Comparisons are made on the bits: of positive floats they order the
// same way, a negative far distance stays below the near one, which is never negative. Integer minima cost one
// instruction everywhere; float ones also handle NaN on some drivers.
KX_INLINE BoxSpan intersectBox(uint x, uint y, uint z, TraceSpace space, float tMin, float tMax) {
    vec3 low = vec3(float(int(x & 0xFFFFu)), float(int(y & 0xFFFFu)), float(int(z & 0xFFFFu)));
    vec3 high = vec3(float(int(x >> 16u)), float(int(y >> 16u)), float(int(z >> 16u)));
    low = low * space.planeScale + space.planeBias;
    high = high * space.planeScale + space.planeBias;
    int lx = floatBitsToInt(low.x), ly = floatBitsToInt(low.y), lz = floatBitsToInt(low.z);
    int hx = floatBitsToInt(high.x), hy = floatBitsToInt(high.y), hz = floatBitsToInt(high.z);
    int near = max(max(max(min(lx, hx), min(ly, hy)), min(lz, hz)), floatBitsToInt(tMin));
    int far = min(min(min(max(lx, hx), max(ly, hy)), max(lz, hz)), floatBitsToInt(tMax));
    BoxSpan span;
    span.near = intBitsToFloat(near);
    span.hit = span.near <= intBitsToFloat(far) * TRACE_FAR_SLACK;
    return span;
}

// ---------------------------------------------------------------------------------------------------------
// Triangles

#ifdef __cplusplus
#define KX_PRECISE
#else
#define KX_PRECISE precise // no contraction: an edge function must be exactly antisymmetric
#endif

KX_INLINE float edgeFunction(vec2 p, vec2 q) {
    KX_PRECISE float pq = p.x * q.y;
    KX_PRECISE float qp = p.y * q.x;
    KX_PRECISE float e = pq - qp;
    return e;
}

KX_INLINE vec2 projectCorner(vec3 corner, TraceSpace space) {
    KX_PRECISE vec2 p = vec2(dot(space.rowX, corner), dot(space.rowY, corner));
    return p;
}

KX_INLINE bool sameSign(float u, float v, float w) {
    return (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
}

// Opaque triangles stop a ray; alpha-tested ones are left out (TRACE_OPAQUE) or asked (TRACE_ALPHA).
const uint TRACE_OPAQUE = 0u;
const uint TRACE_ALPHA = 1u;

// ---------------------------------------------------------------------------------------------------------
// Traversal

// Tests both triangles of a pair. Returns true when `found` has become a hit nearer than it was; `sawAlpha` is
// set where alpha-tested geometry was crossed and left out.
KX_INLINE bool intersectPair(uint pair, TraceSpace space, float tMin, uint channels, uint alphaMode,
                             INOUT(PairHit) found, INOUT(bool) sawAlpha) {
    uint texel = pair * BVH_PAIR_TEXELS;
    vec4 p0 = fetchPair(texel);
    vec4 p1 = fetchPair(texel + 1u);
    vec4 p2 = fetchPair(texel + 2u);
    vec3 a = vec3(p0.x, p0.y, p0.z) - space.origin;
    vec3 b = vec3(p0.w, p1.x, p1.y) - space.origin;
    vec3 c = vec3(p1.z, p1.w, p2.x) - space.origin;
    vec3 d = vec3(p2.y, p2.z, p2.w) - space.origin;
    vec2 pa = projectCorner(a, space);
    vec2 pb = projectCorner(b, space);
    vec2 pc = projectCorner(c, space);
    vec2 pd = projectCorner(d, space);
    float cb = edgeFunction(pc, pb);
    float ac = edgeFunction(pa, pc);
    float ba = edgeFunction(pb, pa);
    float db = edgeFunction(pd, pb);
    float cd = edgeFunction(pc, pd);
    uint pending = (sameSign(cb, ac, ba) ? 1u : 0u) | (sameSign(db, cd, -cb) ? 2u : 0u);
    bool nearer = false;
    // A loop, not an if: drivers that run both sides of an if leave a loop when no lane wants it.
    while (pending != 0u) {
        bool second = (pending & 1u) == 0u;
        pending = second ? 0u : pending & 2u;
        vec3 weights = second ? vec3(db, cd, -cb) : vec3(cb, ac, ba);
        vec3 corner0 = second ? c : a;
        vec3 corner2 = second ? d : c;
        float determinant = weights.x + weights.y + weights.z;
        float inverse = 1.0 / determinant;
        float t = dot(weights, vec3(dot(space.rowZ, corner0), dot(space.rowZ, b), dot(space.rowZ, corner2))) *
                  inverse;
        // A determinant of 0 gives NaN or infinity, which fail here.
        if (t >= tMin && t < found.tM && !startsInPlane(corner0, b, corner2, determinant)) {
            PairHit candidate;
            candidate.tM = t;
            candidate.weights = weights * inverse;
            candidate.backFace = determinant < 0.0;
            candidate.pair = pair;
            candidate.second = second ? 1u : 0u;
            candidate.firstTriangle = space.firstTriangle;
            bool accepted = true;
            if (kTraceChannels) {
                if (channels != CHANNELS_ALL) {
                    accepted = stopsChannels(candidate, channels);
                }
            }
            if (kTraceAlpha && accepted) {
                if (isAlphaTested(pair, candidate.second)) {
                    accepted = alphaMode == TRACE_ALPHA;
                    sawAlpha = sawAlpha || !accepted;
                    if (accepted) {
                        accepted = passesAlpha(candidate);
                    }
                }
            }
            if (accepted) {
                found = candidate;
                nearer = true;
            }
        }
    }
    return nearer;
}

// Finds a hit in (tMin, tMax): any one, or the nearest. True when there is one.
KX_INLINE bool traverse(Ray ray, bool anyHit, uint alphaMode, INOUT(PairHit) found, INOUT(bool) sawAlpha) {
    uint stack[BVH_STACK_SIZE];
    stack[0] = BVH_REF_DONE;
    uint top = 1u;
    uint entry = 0u;
    TraceSpace space = worldSpace(ray);
    uint ref = space.rootRef;
    bool hit = false;
    while (ref != BVH_REF_DONE) {
        while (ref < BVH_REF_LEAF) {
            uvec4 n0 = fetchNode(ref * BVH_NODE_TEXELS);
            uvec4 n1 = fetchNode(ref * BVH_NODE_TEXELS + 1u);
            BoxSpan s0 = intersectBox(n0.x, n0.y, n0.z, space, ray.tMinM, found.tM);
            BoxSpan s1 = intersectBox(n1.x, n1.y, n1.z, space, ray.tMinM, found.tM);
            bool both = s0.hit && s1.hit;
            bool swap = s1.hit && (!s0.hit || s1.near < s0.near);
            stack[top] = swap ? n0.w : n1.w;
            uint popped = stack[top - 1u];
            ref = s0.hit || s1.hit ? (swap ? n1.w : n0.w) : popped;
            top += both ? 1u : (s0.hit || s1.hit ? 0u : 0xFFFFFFFFu);
        }
        while (ref >= BVH_REF_LEAF && ref < BVH_REF_ENTER) {
            bool nearer = intersectPair(ref & BVH_LEAF_FIRST_MASK, space, ray.tMinM, ray.channels, alphaMode, found,
                                        sawAlpha);
            hit = hit || nearer;
            bool more = (ref & ~BVH_REF_LEAF) > BVH_LEAF_FIRST_MASK;
            if (anyHit && nearer) {
                ref = BVH_REF_DONE;
            } else if (more) {
                ref = ref + 1u - (1u << BVH_LEAF_COUNT_SHIFT);
            } else {
                top -= 1u;
                ref = stack[top];
            }
        }
        while (ref >= BVH_REF_ENTER && ref != BVH_REF_DONE) {
            bool returning = ref >= BVH_REF_RETURN;
            if (!returning) {
                stack[top] = BVH_REF_RETURN | entry;
                top += 1u;
            }
            entry = ref & BVH_ENTRY_MASK;
            space = enterSpace(entry, ray);
            if (returning) {
                top -= 1u;
                ref = stack[top];
            } else {
                ref = space.rootRef;
            }
        }
    }
    return hit;
}

KX_INLINE PairHit noPairHit(float tMaxM) {
    PairHit none;
    none.tM = tMaxM;
    none.weights = vec3(0.0, 0.0, 0.0);
    none.backFace = false;
    none.pair = 0u;
    none.second = 0u;
    none.firstTriangle = 0u;
    return none;
}

// True when something stops the ray. Opaque geometry is asked first, for most rays end there or cross none
// that is alpha-tested; only the rest walk again with the mask.
KX_INLINE bool occludedByBvh(Ray ray) {
    bool hit = false;
    bool again = true;
    uint alphaMode = TRACE_OPAQUE;
    while (again) {
        PairHit found = noPairHit(ray.tMaxM);
        bool sawAlpha = false;
        hit = traverse(ray, true, alphaMode, found, sawAlpha);
        again = kTraceAlpha && sawAlpha && !hit && alphaMode == TRACE_OPAQUE;
        alphaMode = TRACE_ALPHA;
    }
    return hit;
}

KX_INLINE Hit nearestInBvh(Ray ray) {
    PairHit found = noPairHit(ray.tMaxM);
    bool sawAlpha = false;
    if (traverse(ray, false, TRACE_ALPHA, found, sawAlpha)) {
        return resolveHit(found);
    }
    return noHit();
}

#endif
