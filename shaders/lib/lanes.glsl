// What the lanes of a subgroup know together, for passes whose workgroup is one; all of its lanes have to call. Up to 8
// lanes are a CPU's vector, which goes in step: each tells its value in turn, as the driver makes of a reduction a loop
// with a branch per lane, and of a barrier a switch of coroutines (lavapipe: visible_list takes 3.5 ms without its
// barriers and 4.5 with them).
#ifndef KILOLUX_LIB_LANES_GLSL
#define KILOLUX_LIB_LANES_GLSL
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "../shared/features.h"

layout(constant_id = CHOICE_LANES) const int kLanes = 8;
const bool kFewLanes = kLanes <= 8;

// What lanes wrote to shared memory before it the others can read after it.
void shareAcrossLanes() {
    subgroupMemoryBarrierShared();
    if (!kFewLanes) subgroupBarrier();
}

uint minOfLanes(uint mine) {
    if (!kFewLanes) return subgroupMin(mine);
    uint least = mine;
    for (int lane = 0; lane < kLanes; ++lane)
        least = min(least, subgroupBroadcast(mine, lane));
    return least;
}

uint orOfLanes(uint mine) {
    if (!kFewLanes) return subgroupOr(mine);
    uint bits = 0u;
    for (int lane = 0; lane < kLanes; ++lane)
        bits |= subgroupBroadcast(mine, lane);
    return bits;
}

uint sumOfLanes(uint mine) {
    if (!kFewLanes) return subgroupAdd(mine);
    uint sum = 0u;
    for (int lane = 0; lane < kLanes; ++lane)
        sum += subgroupBroadcast(mine, lane);
    return sum;
}

// Of those before this one.
uint sumOfLanesBefore(uint mine) {
    if (!kFewLanes) return subgroupExclusiveAdd(mine);
    uint sum = 0u;
    for (int lane = 0; lane < kLanes; ++lane)
        sum += lane < int(gl_SubgroupInvocationID) ? subgroupBroadcast(mine, lane) : 0u;
    return sum;
}

#endif
