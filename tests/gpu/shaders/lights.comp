#version 460
// The light functions at given receivers, for lights_test.cpp: one row of kLightTestOutputs floats per case.
#include "lib/light_access.glsl"

struct LightTestCase {
    vec3 positionWs;
    float roughness;
    vec3 normalWs;
    vec3 viewDirWs;
    vec2 uv;
    uint slot;
};

layout(local_size_x = 64) in;
layout(push_constant) uniform Push {
    uint caseCount;
};
layout(scalar) readonly buffer Cases {
    LightTestCase cases[];
};
layout(scalar) writeonly buffer Outputs {
    float outputs[];
};

const uint kLightTestOutputs = 42u; // as in lights_test.cpp
uint next;

void put(float x) { outputs[next++] = x; }
void put(vec2 v) { put(v.x); put(v.y); }
void put(vec3 v) { put(v.x); put(v.y); put(v.z); }

void main() {
    if (gl_GlobalInvocationID.x >= caseCount) return;
    LightTestCase c = cases[gl_GlobalInvocationID.x];
    next = gl_GlobalInvocationID.x * kLightTestOutputs;
    LightHot light = loadLightHot(c.slot);
    ShadingPoint point = makeShadingPoint(c.positionWs, c.normalWs, c.viewDirWs, c.roughness);
    put(lightEvaluate(light, c.positionWs));
    LightIrradiance irradiance = lightIrradiance(light, point, makeLtcLobe(point));
    put(irradiance.emission);
    put(irradiance.diffuse);
    put(irradiance.specular);
    LightSample s = lightSample(light, c.positionWs, c.uv);
    put(s.valid ? 1.0 : 0.0);
    put(s.positionWs);
    put(s.dirWs);
    put(s.distanceM);
    put(s.emitterNormalWs);
    put(s.uv);
    put(s.pdfArea);
    put(s.pdfSolidAngle);
    put(s.geometry);
    put(lightWeight(light, point, 0.4, 0.06));
    LightBounds bounds = lightBounds(light);
    put(bounds.centerWs);
    put(bounds.radiusM);
    put(bounds.axisWs);
    put(bounds.cosHalfAngle);
    put(irradiance.specularEmission);
    put(s.tint);
    put(loadLightCold(c.slot).rayEndBiasM);
}
