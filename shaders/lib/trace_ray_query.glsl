// VK_KHR_ray_query as tracing back end, see trace.glsl. The driver tests triangles its own way, so rays along shared
// edges may meet the other one.
#ifndef KILOLUX_TRACE_RAY_QUERY_GLSL
#define KILOLUX_TRACE_RAY_QUERY_GLSL
#extension GL_EXT_ray_query : require

uniform accelerationStructureEXT rayQueryScene; // geometry 0 of each bottom level is opaque, 1 alpha-tested
// R32_UINT: per entry the place of its two-word header, which holds the places of the lists of its geometries,
// which name each triangle as pair * 2 + which of the two.
uniform usamplerBuffer rayQueryTriangles;

PairHit rayQueryHit(uint entry, uint geometry, uint primitive, vec2 barycentrics, float tM) {
    uint header = texelFetch(rayQueryTriangles, int(entry)).x;
    uint list = texelFetch(rayQueryTriangles, int(header + geometry)).x;
    uint triangle = texelFetch(rayQueryTriangles, int(list + primitive)).x;
    PairHit hit;
    hit.tM = tM;
    hit.weights = vec3(1.0 - barycentrics.x - barycentrics.y, barycentrics);
    hit.backFace = false; // set by judgePlane
    hit.pair = triangle >> 1u;
    hit.second = triangle & 1u;
    hit.firstTriangle = fetchEntry(entry * BVH_ENTRY_TEXELS + 5u).z;
    return hit;
}

// The last argument of the queries has to be a literal.
#define KX_RAY_QUERY_HIT(query, committed)                                                                         \
    rayQueryHit(uint(rayQueryGetIntersectionInstanceCustomIndexEXT(query, committed)),                             \
                uint(rayQueryGetIntersectionGeometryIndexEXT(query, committed)),                                   \
                uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, committed)),                                  \
                rayQueryGetIntersectionBarycentricsEXT(query, committed), rayQueryGetIntersectionTEXT(query, committed))

// Sets the facing, from the corners because drivers disagree about windings, and returns whether the ray, given in
// the BVH's space, starts in the triangle's plane: such a triangle does not stop it, as in the compute back end.
bool judgePlane(inout PairHit hit, vec3 origin, vec3 dir) {
    uint texel = hit.pair * BVH_PAIR_TEXELS;
    vec4 p0 = fetchPair(texel), p1 = fetchPair(texel + 1u), p2 = fetchPair(texel + 2u);
    vec3 b = vec3(p0.w, p1.xy) - origin, c = vec3(p1.zw, p2.x) - origin;
    vec3 corner0 = hit.second == 0u ? p0.xyz - origin : c;
    vec3 corner2 = hit.second == 0u ? c : p2.yzw - origin;
    hit.backFace = dot(cross(b - corner0, corner2 - corner0), dir) > 0.0;
    return startsInPlane(corner0, b, corner2, hit.backFace ? -1.0 : 1.0);
}

// One query; true when something was met. `own`: it is the plane that the ray starts in.
bool queryOnce(Ray ray, float tMinM, uint flags, out PairHit hit, out bool own) {
    rayQueryEXT query;
    // Static geometry is one instance, whose triangles have channels of their own: each is asked.
    bool limited = kTraceChannels && ray.channels != CHANNELS_ALL;
    if (limited) flags |= gl_RayFlagsNoOpaqueEXT;
    if (!limited && !kTraceAlpha) flags |= gl_RayFlagsOpaqueEXT;
    rayQueryInitializeEXT(query, rayQueryScene, flags, 0xFFu, ray.origin, tMinM, ray.dir, ray.tMaxM);
    while (rayQueryProceedEXT(query)) {
        if (!kTraceAlpha && !kTraceChannels) continue;
        PairHit found = KX_RAY_QUERY_HIT(query, false);
        if ((!kTraceAlpha || passesAlpha(found)) && (!limited || stopsChannels(found, ray.channels))) {
            rayQueryConfirmIntersectionEXT(query);
        }
    }
    own = false;
    if (rayQueryGetIntersectionTypeEXT(query, true) == gl_RayQueryCommittedIntersectionNoneEXT) return false;
    hit = KX_RAY_QUERY_HIT(query, true);
    own = judgePlane(hit, rayQueryGetIntersectionObjectRayOriginEXT(query, true),
                     rayQueryGetIntersectionObjectRayDirectionEXT(query, true));
    return true;
}

// Nearest hit from tMinM on, past the planes that the ray starts in; there are few of those, and as many tries.
bool nearestForeign(Ray ray, out PairHit hit) {
    float tMinM = ray.tMinM;
    for (int tries = 0; tries < 8; ++tries) {
        bool own;
        if (!queryOnce(ray, tMinM, gl_RayFlagsNoneEXT, hit, own)) return false;
        if (!own) return true;
        tMinM = hit.tM * 1.000001 + 1.0e-9;
    }
    return false;
}

bool occluded(Ray ray) {
    PairHit hit;
    bool own;
    if (!queryOnce(ray, ray.tMinM, gl_RayFlagsTerminateOnFirstHitEXT, hit, own)) return false;
    // Any hit will do, but if it was the ray's own plane the nearest foreign one has to be looked for.
    return !own || nearestForeign(ray, hit);
}

Hit nearest(Ray ray) {
    PairHit hit;
    return nearestForeign(ray, hit) ? resolveHit(hit) : noHit();
}

#endif
