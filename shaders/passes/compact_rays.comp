#version 460
// Lists the pixels whose sample has a light, tile by tile and within a tile by light: rays of a SIMD group that go to
// one light trace alike and evaluate one kind of light, and pixels without a ray cost nothing. A counting sort by the
// low bits of the slot; a workgroup is one subgroup, so that no barriers are needed. What is not listed is written
// here. The order of the list depends on threads, what its rays find does not.
#include "shared/features.h"
#include "lib/frame.glsl"
#include "lib/lanes.glsl"
#include "lib/sample.glsl"
#include "lib/tile_order.glsl"

layout(local_size_x_id = CHOICE_LANES) in;
layout(push_constant) uniform Push {
    uint layer;      // the pixels' how many-th rays
    uint writeUnlit; // pixels without a light are shaded here: black
};
uniform usampler2DArray samples;
layout(scalar) buffer RayListHeads {
    RayListHead rayListHeads[];
};
layout(scalar) writeonly buffer RayListOut {
    uint rayListOut[];
};
layout(r32ui) writeonly uniform uimage2DArray rayResultsOut;
layout(rgba32f) writeonly uniform image2D litDiffuseOut;
layout(rgba32f) writeonly uniform image2D litSpecularOut;

const uint kPixels = RAY_TILE_PX * RAY_TILE_PX;
const uint kBuckets = 256u;
const uint kNoBucket = 0xffffffffu;

shared uint buckets[kPixels];
shared uint places[kBuckets]; // rays of a bucket, then where the next one of it goes

// So that rays of one light keep near ones together.
uvec2 pixelInTile(uint at) {
    return blockedPixel(at, RAY_TILE_PX / 4u);
}

// The bucket of a pixel's ray, kNoBucket without one.
uint bucketOf(uvec2 pixel) {
    if (any(greaterThanEqual(pixel, frame.size))) return kNoBucket;
    uvec4 texel = texelFetch(samples, ivec3(pixel, layer), 0);
    if (uintBitsToFloat(texel.z) > 0.0) return texel.x & (kBuckets - 1u);
    imageStore(rayResultsOut, ivec3(pixel, layer), uvec4(RAY_NONE));
    if (writeUnlit != 0u) {
        vec2 state = sampledState(texel);
        imageStore(litDiffuseOut, ivec2(pixel), vec4(0.0, 0.0, 0.0, state.x));
        imageStore(litSpecularOut, ivec2(pixel), vec4(0.0, 0.0, 0.0, state.y));
    }
    return kNoBucket;
}

void main() {
    uint lane = gl_LocalInvocationID.x, lanes = uint(kLanes);
    uvec2 tiles = (frame.size + RAY_TILE_PX - 1u) / RAY_TILE_PX;
    uvec2 corner = dispatchedTile(tiles, frame.tileChunks) * RAY_TILE_PX;
    for (uint i = lane; i < kBuckets; i += lanes)
        places[i] = 0u;
    shareAcrossLanes();
    for (uint i = lane; i < kPixels; i += lanes) {
        uint bucket = bucketOf(corner + pixelInTile(i));
        buckets[i] = bucket;
        if (bucket != kNoBucket) atomicAdd(places[bucket], 1u);
    }
    shareAcrossLanes();
    uint count = 0u;
    for (uint i = lane; i < kBuckets; i += lanes) {
        uint here = places[i];
        places[i] = count + sumOfLanesBefore(here);
        count += sumOfLanes(here);
    }
    shareAcrossLanes();
    uint first = 0u;
    if (subgroupElect()) {
        first = atomicAdd(rayListHeads[layer].count, count);
        uint groups = (first + count + RAY_GROUP - 1u) / RAY_GROUP;
        if (count > 0u) {
            atomicMax(rayListHeads[layer].groupsX, min(groups, RAY_GROUPS_ROW));
            atomicMax(rayListHeads[layer].groupsY, (groups + RAY_GROUPS_ROW - 1u) / RAY_GROUPS_ROW);
        }
        if (dispatchedGroup(tiles) == 0u) rayListHeads[layer].groupsZ = 1u;
    }
    first = subgroupBroadcastFirst(first);
    for (uint i = lane; i < kPixels; i += lanes) {
        if (buckets[i] == kNoBucket) continue;
        uvec2 pixel = corner + pixelInTile(i);
        rayListOut[first + atomicAdd(places[buckets[i]], 1u)] = pixel.x | pixel.y << 16u;
    }
}
