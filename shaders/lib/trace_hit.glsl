// What a ray finds in terms of the BVH's triangle pairs, and its translation to instances: shared by both tracing
// back ends, in the subset that C++ compiles too.
//
// Needs: uvec2 fetchPairIds(uint pair), uvec2 fetchTraceInstance(uint instance), uint traceInstanceCount(), and
// bool alphaPasses(uint instance, uint primitive, vec2 barycentrics).
#ifndef KILOLUX_TRACE_HIT_GLSL
#define KILOLUX_TRACE_HIT_GLSL

// A hit of one triangle of a pair. `weights` belong to the corners in the pair's order.
struct PairHit {
    float tM;
    vec3 weights;
    bool backFace;
    uint pair;
    uint second; // 0: triangle (a, b, c), 1: (c, b, d)
    uint firstTriangle;
};

// The plane of a triangle is known to about this much of the distance of its farthest corner from the ray's
// origin: rounding of the corners, of their difference to the origin and of the shear (10 to 12 units of 2^-24).
// An origin nearer than that lies in the plane, and the triangle cannot stop its ray.
const float TRACE_PLANE_SLACK = 9.6e-7;
// The distance along the ray comes from the edge functions, which lose this much more on slivers (1 : 100).
const float TRACE_SLIVER_SLACK = 16.0;

// True when the ray starts in the plane of the triangle or, as far as the better conditioned normal used here can
// tell, has left it behind. `facing` is positive when the ray meets the front.
KX_INLINE bool startsInPlane(vec3 a, vec3 b, vec3 c, float facing) {
    // The normal is taken at the corner between the two shorter edges: at the others of a sliver, products of two
    // long edges would cancel and leave mostly rounding.
    vec3 ab = b - a, bc = c - b, ca = a - c;
    float lengthAb = dot(ab, ab), lengthBc = dot(bc, bc), lengthCa = dot(ca, ca);
    bool atC = lengthAb >= lengthBc && lengthAb >= lengthCa;
    bool atA = !atC && lengthBc >= lengthCa;
    vec3 normal = cross(atC ? bc : atA ? ca : ab, atC ? ca : atA ? ab : bc);
    float ahead = dot(normal, atC ? c : atA ? a : b);
    ahead = facing > 0.0 ? -ahead : ahead;
    vec3 far = max(abs(a), max(abs(b), abs(c)));
    float size = abs(normal.x) + abs(normal.y) + abs(normal.z);
    float slack = TRACE_PLANE_SLACK * size * max(far.x, max(far.y, far.z));
    return ahead <= slack && ahead >= -TRACE_SLIVER_SLACK * slack;
}

// ---------------------------------------------------------------------------------------------------------
// Ids

// Weights of a pair's corners to barycentrics (b1, b2) in the primitive's own corner order.
KX_INLINE vec2 turnedBarycentrics(vec3 weights, uint packedId) {
    uint turn = packedId & BVH_ID_TURN_MASK;
    bool swapped = turn >= 3u;
    uint rotation = swapped ? turn - 3u : turn;
    vec2 b = rotation == 0u   ? vec2(weights.y, weights.z)
             : rotation == 1u ? vec2(weights.x, weights.y)
                              : vec2(weights.z, weights.x);
    return swapped ? vec2(b.y, b.x) : b;
}

// Instance and index within its primitive of a triangle, from its id over all instances. Instances without
// triangles share their first id with the next one; the last of those is the right one.
KX_INLINE uvec2 findTriangle(uint triangle) {
    uint low = 0u;
    uint high = traceInstanceCount();
    while (high - low > 1u) {
        uint middle = (low + high) / 2u;
        if (fetchTraceInstance(middle).x <= triangle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return uvec2(low, triangle - fetchTraceInstance(low).x);
}

KX_INLINE Hit resolveHit(PairHit found) {
    uvec2 ids = fetchPairIds(found.pair);
    uint packedId = found.second == 0u ? ids.x : ids.y;
    uint triangle = ((packedId & BVH_ID_NONE) >> BVH_ID_TURN_BITS) + found.firstTriangle;
    uvec2 place = findTriangle(triangle);
    Hit hit;
    hit.tM = found.tM;
    hit.instance = place.x;
    hit.primitive = place.y;
    hit.barycentrics = turnedBarycentrics(found.weights, packedId);
    hit.backFace = found.backFace;
    return hit;
}

KX_INLINE bool isAlphaTested(uint pair, uint second) {
    uvec2 ids = fetchPairIds(pair);
    return ((second == 0u ? ids.x : ids.y) & BVH_ID_ALPHA) != 0u;
}

KX_INLINE bool passesAlpha(PairHit found) {
    Hit hit = resolveHit(found);
    return alphaPasses(hit.instance, hit.primitive, hit.barycentrics);
}

// Whether a mesh of the hit's lighting channels stops a ray of those.
KX_INLINE bool stopsChannels(PairHit found, uint channels) {
    uint ofMesh = fetchTraceInstance(resolveHit(found).instance).y >> TRACE_CHANNELS_SHIFT;
    return (ofMesh & channels) != 0u;
}

#endif
