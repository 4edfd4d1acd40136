// Counting without a queue at one address: lanes of a subgroup add up first, one of them adds to the counter.
#ifndef KILOLUX_LIB_COUNT_GLSL
#define KILOLUX_LIB_COUNT_GLSL
#extension GL_KHR_shader_subgroup_arithmetic : require

layout(scalar) buffer Counters {
    uint counters[];
};

// May be called in divergent control flow: the lanes that are there count together.
void countAll(uint counter, uint amount) {
    uint sum = subgroupAdd(amount);
    if (subgroupElect()) atomicAdd(counters[counter], sum);
}

#endif
