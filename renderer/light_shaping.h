// What shapes a light beyond its hot record, from the document to LightTables: barn doors, photometric
// profiles, light functions and pictures.
#pragma once

#include "renderer/document/scene.h"
#include "renderer/lights_cpp/light_tables.h"

namespace kilolux {

// A photometric profile as shaders look it up, resampled to half a degree by 2.5 degrees
// (lights/light_filter.glsl): exact for profiles of type C whose angles are multiples of that, and at steps
// off by at most half a degree.
struct LightProfile {
    std::shared_ptr<const LightPicture> image; // 1 at the profile's maximum
    double halfAngleRad = 0.0;                 // of the narrower cone, about -Z or +Z, that holds all of it
    double side = 1.0;                         // 1: about -Z, the way the light looks
    std::vector<double> rowSr;                 // integral of each row over the sphere, as trapezoids
    double sidewaysSr = 0.0;                   // of the profile times the sine from local X
};
LightProfile makeLightProfile(const IesProfile& profile);

// The luminance of a picture, 0 to 1, resampled to 256 x 256.
LightPicture makeFunctionImage(const Image& image);

// Which lighting channels the meshes of a scene have: an element per value that occurs.
using MeshChannels = std::vector<std::uint8_t>;
MeshChannels meshChannelsOf(const Scene& scene);

// Adds what the light has to `tables`; the number that LIGHT_SHAPING_SHIFT wants, 0 for a light that has
// nothing. Pictures are made once for as long as the document's profile or image lives. `timeS` moves
// caustics and flicker. `meshes`: only a light that leaves some of them out has channels.
std::uint32_t addShaping(LightTables& tables, const LightDef& def, const glm::dmat4& worldFromNode,
                         const glm::dvec3& anchor, double timeS, const MeshChannels& meshes);

} // namespace kilolux
