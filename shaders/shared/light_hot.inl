// The hot light record, in a file of its own and without an include guard, because renderer/lights_cpp reads it
// a second time with every float a double. Include gpu_light.h, not this.
struct LightHot {
    vec3 positionWs;   // centre, metres, relative to the frame's anchor; directional: unused, 0
    float invRange;    // 1 / range in 1/m; 0 means no window
    vec3 dirWs;        // unit, the way the light looks (its local -Z)
    uint tangentOct;   // unit local +X, octahedral 2 x snorm16; re-orthogonalized against dirWs
    vec3 intensity;    // local lights: candela along dirWs (sphere, spot: on the axis of the cone; tube: square to its
                       // axis); directional: lux at a surface that faces it; dome: nit of a
                       // texel of 1; linear Rec. 709
    uint typeFlags;    // LIGHT_* above
    vec2 sizeM;        // sphere, spot: radius, 0; tube: radius, half length; rect: half width, half height;
                       // disk: radius, 0; directional: tangent of the angular radius, 0; dome: mean luminance of its
                       // picture, number of that picture
    vec2 shaping;      // spot: cone scale and offset, so that factor = saturate(cos * scale + offset)^2
};
