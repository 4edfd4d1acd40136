// Presets of lights: named luminaires with their lumens, colour temperature, size and profile.
#pragma once

#include "renderer/document/edit_build.h"

#include <span>

namespace kilolux {

struct Luminaire {
    const char* name;
    LightType type;
    double lumens;
    double temperatureK;
    double radiusM;         // sphere, spot, tube
    double lengthM;         // tube
    double widthM, heightM; // rectangle; disk: width
    const char* profile;    // file of content/ies; empty: the type's own distribution
};
std::span<const Luminaire> luminaires();

// What makes lights such a luminaire. `profileUri`: of its profile in the scene's folder.
Result<Edits> editsForLuminaire(const Scene& scene, std::span<const std::uint64_t> lights,
                                const Luminaire& luminaire, const std::string& profileUri, Sharing sharing);

} // namespace kilolux
