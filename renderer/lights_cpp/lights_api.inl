// Declares what shaders/math and shaders/lights define, for lights_f32.h and lights_f64.h, which include it in
// their namespaces. The comments are at the definitions.
float saturate(float x);
float angleFromCosSin(float cosine, float sine);
float luminance(vec3 rec709);
uint hashUint(uint value);
uint hashCombine(uint seed, uint value);
float whiteNoise1(uint sampleSeed, uint dimension);
vec2 whiteNoise2(uint sampleSeed, uint dimension);
uint pixelSeed(uvec2 pixel, uint frame, uint seed);
mat3 basisFromNormal(vec3 normal);
mat3 basisFromNormalTangent(vec3 normal, vec3 tangent);
vec2 octFromDirection(vec3 dir);
vec3 directionFromOct(vec2 e);
uint packOct16(vec3 dir);
vec3 unpackOct16(uint word);
vec2 diskFromSquare(vec2 uv);
vec2 squareFromDisk(vec2 p);
vec3 sphereFromSquare(vec2 uv);
vec2 squareFromSphere(vec3 dir);
vec3 cosineHemisphereFromSquare(vec2 uv);
float alphaFromRoughness(float roughness);
float ggxD(float noH, float sin2NoH, float alpha);
float ggxV(float noL, float noV, float alpha);
float schlickWeight(float loH);
vec2 ggxTimesCosine(vec3 normal, vec3 viewDir, float noV, vec3 lightDir, float alpha);

vec2 ltcNodeFromInputs(float noV, float roughness);
vec2 ltcInputsFromNode(vec2 node);
vec2 ltcUv(float noV, float roughness);
LtcLobe ltcLobeFromParameters(mat3 worldFromSurface, float noV, float alpha, vec4 parameters);
float ltcShareAboveHorizon(LtcLobe lobe, vec3 normal);
float ltcDensity(LtcLobe lobe, vec3 dirWs);

ShadingPoint makeShadingPoint(vec3 positionWs, vec3 normalWs, vec3 viewDirWs, float roughness);
LtcLobe makeLtcLobe(ShadingPoint point);
mat3 lightFrame(LightHot light);
bool lightIsOn(LightHot light);
bool lightIsDelta(LightHot light);
LightBounds lightBounds(LightHot light);
vec3 lightEvaluate(LightHot light, vec3 receiverWs);
EmitterOutline lightOutline(LightHot light, vec3 receiverWs, float alpha);
LightIrradiance lightIrradiance(LightHot light, ShadingPoint point, LtcLobe lobe);
float lightWeight(LightHot light, ShadingPoint point, float diffuseAlbedo, float f0);
LightSample lightSample(LightHot light, vec3 receiverWs, vec2 uv);
LightHit lightIntersect(LightHot light, vec3 originWs, vec3 dirWs);
float lightFlux(LightHot light);
