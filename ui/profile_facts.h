// What a photometric profile is like: its light, symmetry and width, and its shape as lines. Knows no screen.
#pragma once

#include "renderer/document/ies_profile.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace kilolux {

struct ProfileFacts {
    double lumens = 0.0;
    double maxCandela = 0.0;
    std::string symmetry; // "round", "quadrants", "two halves", "none"
    // Full widths about the strongest direction of two planes, X with Z and Y with Z, degrees: beam where the
    // intensity is half of the plane's largest, field where it is a tenth.
    double beamDeg[2] = {0.0, 0.0}, fieldDeg[2] = {0.0, 0.0};
};
ProfileFacts factsOf(const IesProfile& profile);

// Intensity over the largest one in a plane through the light's axis, at `degrees` from straight ahead; the
// plane stands at `planeDeg` from the local X axis.
double relativeAt(const IesProfile& profile, double planeDeg, double degrees);

// The web: closed lines of points in the light's own frame, as far from the middle as the light is strong, 1
// at its maximum.
std::vector<std::vector<glm::dvec3>> webOf(const IesProfile& profile);

// A profile in a folder, or why it cannot be read.
struct ProfileEntry {
    std::filesystem::path path;
    std::string name; // of the file, relative to the folder
    std::string title;
    std::shared_ptr<const IesProfile> profile; // null: `error`
    ProfileFacts facts;
    std::string error;
};
std::vector<ProfileEntry> profilesIn(const std::filesystem::path& folder);

// The URI of a profile for a scene in `sceneFolder`: it is copied into its folder 'profiles' where it lies
// elsewhere, under a free name unless the same file is there.
Result<std::string> bringProfile(const std::filesystem::path& profile,
                                 const std::filesystem::path& sceneFolder);

} // namespace kilolux
