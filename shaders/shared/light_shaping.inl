// What shapes a light beyond its hot record, in a file of its own and without an include guard, because
// renderer/lights_cpp reads it a second time with every float a double. Include gpu_light.h, not this.
struct LightShaping {
    // rect: barn doors at local -X, +X, -Y, +Y. How far a flap's tip stands out beyond its edge, >= 0, and ahead of
    // the light's plane, >= 0; 0 without a flap.
    vec4 doorReachM;
    vec4 doorDepthM;
    // Photometric profile: layer of the profile images plus 1, 0 without. As the light's shape it stands in place of
    // the type's own distribution, else it masks that one; 1 at its maximum either way.
    uint profile;
    uint profileIsShape;
    float profileCosine; // all of the profile's light is in a cone of this half angle
    float profileSide;   // about dirWs (1) or about the opposite direction (-1)
    float profileSr;     // flux over intensity
    // Light function: LIGHT_FUNCTION_*, layer of the function images, and what stands still in space: the level of a
    // flicker, 0 to 1, or the phase of caustics, rad.
    uint functionKind;
    uint functionImage;
    float functionPhase;
    vec4 functionMap;      // cos / scale, sin / scale of the pattern's turn; softness; strength
    vec3 functionOriginWs; // directional: the pattern's origin, m, relative to the anchor
    uint channels;       // CHANNELS_LIMITED + those of the meshes that the light reaches, or CHANNELS_ALL
    uint shadowChannels; // the same of the meshes that cast its shadow
    // rect: layer of the light's picture plus 1, 0 without; and the mean of that picture, linear Rec. 709.
    uint picture;
    vec3 pictureMean;
};
