// The structs that every light type's functions share. Only declarations, so that C++ code compiled with
// double literals can read them in float too.
#ifndef KILOLUX_LIGHTS_LIGHT_TYPES_GLSL
#define KILOLUX_LIGHTS_LIGHT_TYPES_GLSL

// What is lit and from where it is seen. Make it with makeShadingPoint.
struct ShadingPoint {
    vec3 positionWs;
    vec3 normalWs;   // shading normal, unit, on the viewer's side
    vec3 viewDirWs;  // unit, towards the viewer
    float noV;       // >= KX_MIN_NOV
    float roughness; // >= KX_MIN_ROUGHNESS
    float alpha;     // roughness^2
    uint channels;   // lighting channels of the mesh, 8 bits
};

// The GGX lobe of a shading point as a linearly transformed cosine. Make it with makeLtcLobe, once per pixel.
struct LtcLobe {
    mat3 ltcFromWorld;
    mat3 worldFromLtc;
    float density;   // determinant of ltcFromWorld over pi: scales the density in directions
    float amplitude; // integral of D * V * cosine over the hemisphere, over that of the LTC above the horizon
    vec2 albedo;     // pre-integrated environment BRDF: F0 * x + F90 * y
};

// Where a light can reach: inside the sphere and inside the cone about axisWs with its apex at the centre
// (cosHalfAngle 0 is a half space, -1 everywhere). Exact for the shaping of LightHot.
struct LightBounds {
    vec3 centerWs;
    float radiusM; // KX_INFINITY without a range
    vec3 axisWs;
    float cosHalfAngle;
};

// A point on a light (a direction for the directional one) as seen by a receiver.
struct LightSample {
    vec3 positionWs;      // the receiver's position + dirWs for directional lights
    vec3 dirWs;           // unit, receiver to point
    float distanceM;      // KX_INFINITY for directional lights
    vec3 emitterNormalWs; // unit; -dirWs for points and directional lights
    vec2 uv;              // of the point in the light's own frame: what masks and lists store
    float pdfArea;        // 1/m^2 for uniform uv; directional: 1/sr; 0 for a point or a delta direction
    float pdfSolidAngle;  // 1/sr, 0 for a point or a delta direction
    // Radiance estimate of one sample: brdf * cosine * lightEvaluate() * tint * geometry. Sr for area lights (1 over
    // pdfSolidAngle), 1/m^2 for points, 1 for delta directions; 0 when invalid.
    float geometry;
    vec3 tint;  // of the light's picture at the point; 1 without
    bool valid; // the point emits towards the receiver; says nothing about the receiver's horizon
};

// A ray's meeting with a light, for multiple importance sampling.
struct LightHit {
    bool hit;
    float distanceM; // KX_INFINITY for directional lights
    vec2 uv;
    float pdfArea;       // as in LightSample
    float pdfSolidAngle; // of lightSample() at this direction
};

// Unshadowed light at a shading point; multiply by the emissions for the coloured, photometric values.
struct LightIrradiance {
    vec3 emission;         // lightEvaluate(), tinted by what the diffuse lobe sees of the light's picture: nit, cd for
                           // points, lux for a delta direction
    vec3 specularEmission; // the same for the specular lobe
    float diffuse;         // times emission: irradiance in lux
    vec2 specular;         // times specularEmission: radiance towards the viewer = F0 * x + F90 * y
};

// A light's silhouette from a receiver: one or two elliptic arcs whose vertices form a convex polygon,
// counter- clockwise as seen along +centre. Lengths are relative to the distance of the light's centre.
struct EmitterOutline {
    vec3 centerA;
    vec3
        axisXA; // vertex = centre + (cos(angle) * axisX + sin(angle) * axisY) * (an inner vertex ? bulge : 1)
    vec3 axisYA;
    vec3 centerB;
    vec3 axisXB;
    vec3 axisYB;
    vec2 arcA; // start and step, rad
    vec2 arcB;
    vec2 bulge;          // A, B: moves inner vertices out until the polygon has the arc's area
    int endVertices;     // how many at each end of an arc stay unmoved
    int countA;          // vertices of A
    int count;           // vertices of both
    int sectors;         // parts that the fit is corrected in; divides count
    float correction;    // exact over polygonal diffuse irradiance where nothing is below the horizon
    vec3 dirWs;          // unit, towards the centre
    float angularRadius; // sine of the half angle of a cone that holds the light; 0 for points
    float solidAngle; // as if small: exact in the limit; 1/m^2 for points, 1 for delta directions; 0: unlit
};

#endif
