// Going down the tree of lights (renderer/light_tree.h): at every node one of the two children by about what it
// gives the receiver (Conty Estevez and Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting",
// HPG 2018, section 5.1, equation 3, without the splitting of section 5.4: there is one ray per pixel).
#ifndef KILOLUX_LIB_LIGHT_TREE_GLSL
#define KILOLUX_LIB_LIGHT_TREE_GLSL
#include "receiver.glsl"
#include "../shared/resampling.h"

layout(scalar) readonly buffer LightTree {
    LightTreeNode lightTree[];
};

// Rounding must not leave a light out that shines: what is just behind an edge still has this share.
const float kEdge = 1.0e-3;

// Cosine of the angle of cosine a less that of b, at least 0.
float cosineLess(float a, float b) {
    float sines = sqrt(max((1.0 - a * a) * (1.0 - b * b), 0.0));
    return a >= b ? 1.0 : a * b + sines;
}

float treeImportance(uint at, Receiver receiver) {
    LightTreeNode node = lightTree[at];
    vec3 p = receiver.point.positionWs;
    vec3 toMiddle = -node.axisWs;
    float cosBox = node.cosSpread, falloff = 1.0;
    if (node.distant == 0u) {
        vec3 toNearest = clamp(p, node.leastWs, node.mostWs) - p;
        if (dot(toNearest, toNearest) >= square(node.reachM)) return 0.0;
        toMiddle = 0.5 * (node.leastWs + node.mostWs) - p;
        float distance2 = max(dot(toMiddle, toMiddle), 1.0e-12);
        float radius2 = 0.25 * dot(node.mostWs - node.leastWs, node.mostWs - node.leastWs);
        toMiddle *= inversesqrt(distance2);
        cosBox = radius2 < distance2 ? sqrt(1.0 - radius2 / distance2) : -1.0;
        float cosEmitted = cosineLess(cosineLess(-dot(node.axisWs, toMiddle), node.cosSpread), cosBox);
        if (cosEmitted < node.cosEmission - kEdge) return 0.0;
        falloff = max(cosEmitted, kEdge) / max(distance2, radius2);
    }
    float cosReceived = cosineLess(dot(receiver.point.normalWs, toMiddle), cosBox);
    return cosReceived < -kEdge ? 0.0 : node.intensity * falloff * max(cosReceived, kEdge);
}

// The slot that `number` in 0..1 leads to, NO_RESERVOIR where all children that are left give nothing; and the
// probability of it.
uint drawFromTree(Receiver receiver, float number, out float probability) {
    uint at = 0u;
    probability = 1.0;
    while (lightTree[at].slot == NO_RESERVOIR) {
        uint second = lightTree[at].second;
        if (second == 0u) return NO_RESERVOIR; // a tree without lights
        float first = treeImportance(at + 1u, receiver), sum = first + treeImportance(second, receiver);
        if (sum <= 0.0) return NO_RESERVOIR;
        float share = first / sum;
        bool takeFirst = number < share;
        number = takeFirst ? number / share : (number - share) / (1.0 - share);
        number = clamp(number, 0.0, 0.99999994);
        probability *= takeFirst ? share : 1.0 - share;
        at = takeFirst ? at + 1u : second;
    }
    return lightTree[at].slot;
}

#endif
