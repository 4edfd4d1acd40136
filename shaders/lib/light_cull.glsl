// Whether a light may reach a cell, which depths of a cell hold surfaces, and the bitmask in shared memory from which
// a cell's sorted list is counted and copied out. For the passes that fill the light grid.
#ifndef KILOLUX_LIB_LIGHT_CULL_GLSL
#define KILOLUX_LIB_LIGHT_CULL_GLSL
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "light_access.glsl"
#include "light_grid.glsl"

layout(scalar) buffer GridCounters {
    uint gridCounters[];
};
uniform sampler2D pyramid; // nearest and farthest depth of 2 x 2, 4 x 4, ... pixels

// --- A cell ------------------------------------------------------------------------------------------------

const int kPyramidFine = 4;   // one texel per 32 x 32 pixels
const int kPyramidCoarse = 6; // 128 x 128

// The part of a column's depths nearM to farM in which its pixels have surfaces; empty (y < x) without any. Odd sizes
// let a texel of the pyramid's last row or column stand for more pixels than the regular ones. Slices overlap a little:
// a depth on their border belongs to the one that gridSlice() says, whatever log2 and exp2 round to.
vec2 surfaceDepths(uvec2 column, int level, float nearM, float farM) {
    nearM *= 1.0 - 1.0e-5;
    farM *= 1.0 + 1.0e-5;
    if (textureQueryLevels(pyramid) <= level) return vec2(nearM, farM); // a picture smaller than a cell
    ivec2 last = max(ivec2(frame.size >> uint(level + 1)) - 1, ivec2(0));
    vec2 range = texelFetch(pyramid, min(ivec2(column), last), level).xy;
    if (range.x >= DEPTH_SKY) return vec2(1.0, 0.0);
    return vec2(max(nearM, range.x), min(farM, range.y));
}

// A block of the view between two depths: a box that holds it, turned with the block's middle ray. A box along the
// camera's axes would be several times as wide at the edges of the picture.
struct CellBounds {
    vec3 centerWs;
    vec3 right, down, forward; // unit
    vec3 halfM;                // along them
};

CellBounds cellBounds(uvec2 firstPx, uvec2 endPx, vec2 depthsM) {
    CellBounds cell;
    CameraRay middle = cameraRay(0.5 * (vec2(firstPx) + vec2(endPx)));
    cell.forward = normalize(middle.dir);
    vec3 right = frame.dirStepX + frame.originStepX;
    cell.right = normalize(right - cell.forward * dot(cell.forward, right));
    cell.down = cross(cell.forward, cell.right);
    vec3 lower = vec3(KX_INFINITY), upper = vec3(-KX_INFINITY);
    for (int corner = 0; corner < 8; ++corner) {
        // Half a pixel more on every side: jitter moves rays within their pixel.
        vec2 px = vec2((corner & 1) != 0 ? vec2(endPx).x + 0.5 : vec2(firstPx).x - 0.5,
                       (corner & 2) != 0 ? vec2(endPx).y + 0.5 : vec2(firstPx).y - 0.5);
        CameraRay ray = cameraRay(px);
        vec3 offset = ray.originWs - middle.originWs + ray.dir * ((corner & 4) != 0 ? depthsM.y : depthsM.x);
        vec3 p = vec3(dot(offset, cell.right), dot(offset, cell.down), dot(offset, cell.forward));
        lower = min(lower, p);
        upper = max(upper, p);
    }
    vec3 center = 0.5 * (lower + upper);
    cell.centerWs = middle.originWs + cell.right * center.x + cell.down * center.y + cell.forward * center.z;
    // Rounding of positions, relative to their distances from the camera and the anchor.
    float slackM = 1.0e-5 * max(upper.z, 1.0e-3) + 1.0e-6 * length(cell.centerWs);
    cell.halfM = 0.5 * (upper - lower) + slackM;
    return cell;
}

// Whether the cell lies beyond a plane by more than `slackM`: nothing of it is on the inner side. For whatever bounds a
// light by planes: half spaces, the sides of cones and barn doors.
bool cellBeyondPlane(CellBounds cell, vec3 pointToCell, vec3 outward, float slackM) {
    vec3 along = abs(vec3(dot(outward, cell.right), dot(outward, cell.down), dot(outward, cell.forward)));
    return dot(outward, pointToCell) > dot(along, cell.halfM) + slackM;
}

// What culling needs of a light: inside a sphere and a cone (a half space for one-sided lights).
struct LightReach {
    vec3 centerWs;
    float radius2M2; // 0: muted or dead
    vec3 axisWs;
    float cosine; // of the cone's half angle, opened by the tolerance of lightReaches
    uint type;
};

LightReach lightReach(LightHot light) {
    LightBounds bounds = lightBounds(light);
    float radius2M2 = min(bounds.radiusM * bounds.radiusM * 1.00001, KX_INFINITY);
    return LightReach(bounds.centerWs, radius2M2, bounds.axisWs, bounds.cosHalfAngle - 1.0e-6, lightType(light));
}

bool mayReach(LightReach light, CellBounds cell) {
    if (light.radius2M2 <= 0.0) return false;
    if (light.type == LIGHT_DIRECTIONAL || light.type == LIGHT_DOME) return true;
    vec3 toCell = cell.centerWs - light.centerWs;
    vec3 p = abs(vec3(dot(toCell, cell.right), dot(toCell, cell.down), dot(toCell, cell.forward)));
    vec3 outside = max(p - cell.halfM, vec3(0.0));
    if (dot(outside, outside) > light.radius2M2) return false;
    if (light.cosine < -1.0e-5) return true; // wider cones than a half space are not convex
    float distanceM = length(toCell), slackM = 1.0e-5 * distanceM;
    if (cellBeyondPlane(cell, toCell, -light.axisWs, slackM)) return false; // behind the light
    if (light.cosine <= 0.0) return true;
    // The plane that touches the cone on the side towards the cell.
    float along = dot(toCell, light.axisWs);
    vec3 across = toCell - light.axisWs * along;
    float acrossM = length(across);
    vec3 sideways = acrossM > 0.01 * distanceM ? across / acrossM : vec3(0.0);
    vec3 outward = sideways * light.cosine - light.axisWs * sqrt(max(1.0 - light.cosine * light.cosine, 0.0));
    return !cellBeyondPlane(cell, toCell, outward, slackM);
}

// Whether barn doors hide the whole light from all of the cell. A point sees nothing of it past one flap when it is
// beyond two planes: that of the flap, and that through its tip and the light's opposite edge.
bool doorsHide(LightHot light, CellBounds cell) {
    if (!lightHasShaping(light)) return false;
    LightShaping doors = lightShaping(light);
    mat3 frame = lightFrame(light);
    vec3 toCell = cell.centerWs - light.positionWs;
    float slackM = 1.0e-5 * (length(toCell) + light.sizeM.x + light.sizeM.y);
    for (int side = 0; side < 4; ++side) {
        float depthM = doors.doorDepthM[side], reachM = doors.doorReachM[side];
        if (depthM <= 0.0) continue;
        float edgeM = side < 2 ? light.sizeM.x : light.sizeM.y;
        vec3 aside = (side < 2 ? frame[0] : frame[1]) * ((side & 1) == 0 ? -1.0 : 1.0);
        vec3 flap = normalize(aside * depthM - light.dirWs * reachM);
        vec3 sight = normalize(aside * depthM - light.dirWs * (reachM + 2.0 * edgeM));
        if (cellBeyondPlane(cell, toCell - aside * edgeM, flap, slackM) &&
            cellBeyondPlane(cell, toCell + aside * edgeM, sight, slackM)) return true;
    }
    return false;
}

// Both tests for the light of a slot.
bool mayReach(LightReach light, uint slot, CellBounds cell) {
    if (!mayReach(light, cell)) return false;
    return !kBarnDoors || light.type != LIGHT_RECT || !doorsHide(loadLightHot(slot), cell);
}

// --- The list of a cell ------------------------------------------------------------------------------------

const uint kMaskWords = GRID_MAX_LIGHTS / 32u;
const uint kWordsPerThread = kMaskWords / GRID_GROUP;
shared uint sharedMask[kMaskWords];
shared uint sharedSums[GRID_GROUP]; // of each subgroup
shared uint sharedTypes;
shared uint sharedFirst;

void clearList(uint thread) {
    for (uint i = 0u; i < kWordsPerThread; ++i) sharedMask[i * GRID_GROUP + thread] = 0u;
    if (thread == 0u) sharedTypes = 0u;
    barrier();
}

void markLight(uint position, uint type) {
    atomicOr(sharedMask[position >> 5u], 1u << (position & 31u));
    atomicOr(sharedTypes, 1u << type);
}

// The thread's index in its group, in the order of prefixOf().
uint groupThread() {
    return gl_SubgroupID * gl_SubgroupSize + gl_SubgroupInvocationID;
}

// Exclusive prefix sum of the threads' numbers; `total` of the group. All threads call it.
uint prefixOf(uint number, out uint total) {
    uint beforeLane = subgroupExclusiveAdd(number), ofSubgroup = subgroupAdd(number);
    if (subgroupElect()) sharedSums[gl_SubgroupID] = ofSubgroup;
    barrier();
    uint before = 0u;
    total = 0u;
    for (uint i = 0u; i < gl_NumSubgroups; ++i) {
        before += i < gl_SubgroupID ? sharedSums[i] : 0u;
        total += sharedSums[i];
    }
    return before + beforeLane;
}

// Lights marked in this thread's words of the mask.
uint markedByThread(uint thread) {
    barrier();
    uint sum = 0u;
    for (uint i = 0u; i < kWordsPerThread; ++i) sum += uint(bitCount(sharedMask[thread * kWordsPerThread + i]));
    return sum;
}

// Takes room for `total` indices; the group's first thread asks, all get the answer.
uint takeRoom(uint thread, uint total) {
    if (thread == 0u) sharedFirst = total > 0u ? atomicAdd(gridCounters[GRID_COUNTER_USED], total) : 0u;
    barrier();
    return sharedFirst;
}

#endif
