// Whether a light may reach a cell, and the sorted list of a cell's lights: gathered by all threads of a group as
// a bitmask in shared memory, counted by prefix sum, copied out once.
#ifndef KILOLUX_LIB_LIGHT_CULL_GLSL
#define KILOLUX_LIB_LIGHT_CULL_GLSL
#include "light_access.glsl"
#include "light_grid.glsl"

layout(scalar) buffer GridCounters {
    uint gridCounters[];
};

// A block of the view between two depths: a box along the camera's axes and a sphere around it, both conservative.
struct CellBounds {
    vec3 originWs; // the axes' origin
    vec3 right, down, forward;
    vec3 lower, upper; // along them
    vec3 centerWs;
    float radiusM;
};

CellBounds cellBounds(uvec2 firstPx, uvec2 endPx, float nearM, float farM) {
    CellBounds cell;
    cell.originWs = frame.originBase;
    cell.right = normalize(frame.dirStepX + frame.originStepX);
    cell.down = normalize(frame.dirStepY + frame.originStepY);
    cell.forward = cross(cell.right, cell.down);
    cell.lower = vec3(KX_INFINITY);
    cell.upper = vec3(-KX_INFINITY);
    vec3 sum = vec3(0.0);
    for (int corner = 0; corner < 8; ++corner) {
        // Half a pixel more on every side: jitter moves rays within their pixel.
        vec2 px = vec2((corner & 1) != 0 ? vec2(endPx).x + 0.5 : vec2(firstPx).x - 0.5,
                       (corner & 2) != 0 ? vec2(endPx).y + 0.5 : vec2(firstPx).y - 0.5);
        CameraRay ray = cameraRay(px);
        vec3 offset = ray.originWs - cell.originWs + ray.dir * ((corner & 4) != 0 ? farM : nearM);
        vec3 p = vec3(dot(offset, cell.right), dot(offset, cell.down), dot(offset, cell.forward));
        cell.lower = min(cell.lower, p);
        cell.upper = max(cell.upper, p);
    }
    vec3 center = 0.5 * (cell.lower + cell.upper);
    cell.centerWs = cell.originWs + cell.right * center.x + cell.down * center.y + cell.forward * center.z;
    // Rounding of positions, relative to the distance from the camera.
    vec3 slack = vec3(1.0e-5 * max(abs(cell.upper.z), 1.0e-3));
    cell.lower -= slack;
    cell.upper += slack;
    cell.radiusM = 0.5 * length(cell.upper - cell.lower);
    return cell;
}

bool lightMayReach(LightHot light, CellBounds cell) {
    LightBounds bounds = lightBounds(light);
    if (bounds.radiusM <= 0.0) return false;
    vec3 offset = bounds.centerWs - cell.originWs;
    vec3 p = vec3(dot(offset, cell.right), dot(offset, cell.down), dot(offset, cell.forward));
    vec3 outside = max(max(cell.lower - p, p - cell.upper), vec3(0.0));
    bool directional = lightType(light) == LIGHT_DIRECTIONAL;
    if (!directional && dot(outside, outside) > bounds.radiusM * bounds.radiusM * 1.00001) return false;
    if (directional || bounds.cosHalfAngle <= -1.0) return true;
    // Cone against the sphere around the cell, by the distance to the cone's side.
    vec3 toCell = cell.centerWs - bounds.centerWs;
    float along = dot(toCell, bounds.axisWs);
    float across = sqrt(max(dot(toCell, toCell) - along * along, 0.0));
    float sine = sqrt(max(1.0 - bounds.cosHalfAngle * bounds.cosHalfAngle, 0.0));
    return bounds.cosHalfAngle * across - along * sine <= cell.radiusM * 1.0001;
}

// --- The list of a cell ------------------------------------------------------------------------------------

const uint kMaskWords = GRID_MAX_LIGHTS / 32u;
const uint kWordsPerThread = kMaskWords / GRID_GROUP;
shared uint sharedMask[kMaskWords];
shared uint sharedSums[GRID_GROUP];
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

// Exclusive prefix of this thread's words; `total` of the group. All threads call it.
uint prefixOfThread(uint thread, out uint total) {
    barrier();
    uint sum = 0u;
    for (uint i = 0u; i < kWordsPerThread; ++i) sum += uint(bitCount(sharedMask[thread * kWordsPerThread + i]));
    sharedSums[thread] = sum;
    barrier();
    for (uint step = 1u; step < GRID_GROUP; step <<= 1u) {
        uint left = thread >= step ? sharedSums[thread - step] : 0u;
        barrier();
        sharedSums[thread] += left;
        barrier();
    }
    total = sharedSums[GRID_GROUP - 1u];
    return sharedSums[thread] - sum;
}

// Takes room for `total` indices; the group's first thread asks, all get the answer.
uint takeRoom(uint thread, uint total) {
    if (thread == 0u) sharedFirst = total > 0u ? atomicAdd(gridCounters[GRID_COUNTER_USED], total) : 0u;
    barrier();
    return sharedFirst;
}

#endif
