// Directions drawn by a receiver's BRDF: by the cosine or by the visible normals of its GGX lobe (Heitz, "Sampling
// the GGX Distribution of Visible Normals", JCGT 2018, listing 1), with the density of both together (Veach,
// "Robust Monte Carlo Methods for Light Transport Simulation", 1997, section 9.2.4: one sample, balance heuristic).
#ifndef KILOLUX_LIB_BRDF_SAMPLE_GLSL
#define KILOLUX_LIB_BRDF_SAMPLE_GLSL
#include "receiver.glsl"
#include "../math/brdf.glsl"
#include "../math/color.glsl"
#include "../math/warp.glsl"

const float kLeastSpecularShare = 0.1; // of directions that go to the lobe: at grazing angles all surfaces shine

struct BrdfDirection {
    vec3 dirWs;
    float pdf; // 1/sr; 0 below the horizon
};

BrdfDirection drawByBrdf(Receiver receiver, vec2 number, float whichLobe) {
    float diffuse = luminance(diffuseAlbedo(receiver.surface)), specular = luminance(specularF0(receiver.surface));
    float share = clamp(specular / max(specular + diffuse, 1.0e-6), kLeastSpecularShare, 1.0);
    mat3 frameWs = basisFromNormal(receiver.point.normalWs);
    float alpha = receiver.point.alpha;
    vec3 view = receiver.point.viewDirWs * frameWs; // into the surface's frame
    view = normalize(vec3(view.x, view.y, max(view.z, KX_MIN_NOV)));
    vec3 dir = cosineHemisphereFromSquare(number);
    if (whichLobe < share) {
        vec3 stretched = normalize(vec3(alpha * view.x, alpha * view.y, view.z));
        float across2 = stretched.x * stretched.x + stretched.y * stretched.y;
        vec3 t1 = across2 > 0.0 ? vec3(-stretched.y, stretched.x, 0.0) * inversesqrt(across2) : vec3(1.0, 0.0, 0.0);
        vec2 disk = diskFromSquare(number);
        float s = 0.5 + 0.5 * stretched.z;
        disk.y = mix(sqrt(max(1.0 - disk.x * disk.x, 0.0)), disk.y, s);
        vec3 normal = disk.x * t1 + disk.y * cross(stretched, t1) + sqrt(max(1.0 - dot(disk, disk), 0.0)) * stretched;
        normal = normalize(vec3(alpha * normal.x, alpha * normal.y, max(normal.z, 1.0e-6)));
        dir = reflect(-view, normal);
    }
    BrdfDirection result;
    result.dirWs = frameWs * dir;
    vec3 halfway = normalize(view + dir);
    float sin2 = halfway.x * halfway.x + halfway.y * halfway.y;
    float a2 = alpha * alpha;
    // D * G1 / (4 noV), G1 of Smith: 2 noV / (noV + sqrt(a2 + (1 - a2) noV^2)).
    float lobe = ggxD(halfway.z, sin2, alpha) * 0.5 / (view.z + sqrt(a2 + (1.0 - a2) * view.z * view.z));
    result.pdf = dir.z > 0.0 ? share * lobe + (1.0 - share) * dir.z * KX_INV_PI : 0.0;
    return result;
}

#endif
