// What shapes a light beyond its hot record, in a file of its own and without an include guard, because
// renderer/lights_cpp reads it a second time with every float a double. Include gpu_light.h, not this.
struct LightShaping {
    // rect: barn doors at local -X, +X, -Y, +Y. How far a flap's tip stands out beyond its edge, >= 0, and ahead of
    // the light's plane, >= 0; 0 without a flap.
    vec4 doorReachM;
    vec4 doorDepthM;
};
