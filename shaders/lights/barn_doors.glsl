// Barn doors of a rectangle light: up to four flat black flaps, each hinged to one edge and endless along it, so that
// the corners between them are closed. Of the light a receiver then sees a rectangle along the same axes: beside each
// edge what the line from the receiver over the flap's tip leaves. Irradiance, samples and weight of that part are
// exact, and edges are as soft as the source is large. Flaps take light away: the light's lumens are those of the
// bare source.
#ifndef KILOLUX_LIGHTS_BARN_DOORS_GLSL
#define KILOLUX_LIGHTS_BARN_DOORS_GLSL
#include "shaping.glsl"

// What a receiver sees of a rectangle light, in the light's own plane.
struct RectPart {
    vec2 centerM;
    vec2 halfM;
    float share; // of the area; 0: hidden
};

// How far from the middle the light is seen on one flap's side, -edgeM .. edgeM. `besideM` is the receiver's place
// along the axis that points out over this edge.
KX_INLINE float doorLimitM(float edgeM, float reachM, float depthM, float besideM, float aheadM) {
    float beyondM = aheadM - depthM;
    // Not as far ahead as the tip, the flap hides all or nothing.
    if (beyondM <= 0.0) return besideM * depthM <= edgeM * depthM + reachM * aheadM ? edgeM : -edgeM;
    return clamp(((edgeM + reachM) * aheadM - besideM * depthM) / beyondM, -edgeM, edgeM);
}

// The receiver's place in the light's frame: along local X and Y, and ahead of its plane.
KX_INLINE RectPart rectPart(LightHot light, vec2 besideM, float aheadM) {
    RectPart part;
    part.centerM = vec2(0.0);
    part.halfM = light.sizeM;
    part.share = 1.0;
    if (!KX_HAS_BARN_DOORS || !lightHasShaping(light)) return part;
    LightShaping doors = lightShaping(light);
    vec2 edgeM = max(light.sizeM, vec2(1.0e-9));
    vec4 out_ = vec4(doorLimitM(edgeM.x, doors.doorReachM.x, doors.doorDepthM.x, -besideM.x, aheadM),
                     doorLimitM(edgeM.x, doors.doorReachM.y, doors.doorDepthM.y, besideM.x, aheadM),
                     doorLimitM(edgeM.y, doors.doorReachM.z, doors.doorDepthM.z, -besideM.y, aheadM),
                     doorLimitM(edgeM.y, doors.doorReachM.w, doors.doorDepthM.w, besideM.y, aheadM));
    vec2 widthM = max(vec2(out_.x + out_.y, out_.z + out_.w), vec2(0.0));
    part.centerM = 0.5 * vec2(out_.y - out_.x, out_.w - out_.z);
    part.halfM = 0.5 * widthM;
    part.share = widthM.x * widthM.y / (4.0 * edgeM.x * edgeM.y);
    part.share = part.share < 1.0e-6 ? 0.0 : part.share;
    return part;
}

KX_INLINE RectPart rectPartFrom(LightHot light, mat3 frame, vec3 receiverWs) {
    vec3 fromCenter = receiverWs - light.positionWs;
    return rectPart(light, vec2(dot(fromCenter, frame[0]), dot(fromCenter, frame[1])), dot(fromCenter, light.dirWs));
}

#endif
