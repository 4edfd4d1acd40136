// Photometric profiles: luminous intensity by direction, as measured of a luminaire, and the reader of their
// files (ANSI/IES LM-63-1986, -1991, -1995, -2002 and -2019).
#pragma once

#include "renderer/document/result.h"

#include <glm/glm.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kilolux {

// How the two angles of a direction are laid. C: vertical from straight ahead (0) to behind (180), horizontal
// about the axis ahead. B and A: horizontal turns a half plane about the local X axis, vertical moves in it
// from -90 to 90; for a light they differ only in how its luminaire hung when it was measured.
enum class IesPhotometry { C = 1, B = 2, A = 3 };

struct IesProfile {
    std::string standard; // the first line where it names one, "IESNA:LM-63-2002"; "LM-63-1986" else
    std::string name;     // keyword LUMINAIRE or LUMCAT, or the first label line; may be empty
    IesPhotometry photometry = IesPhotometry::C;
    std::vector<double> verticalDeg;   // ascending; C: 0 .. 180, B and A: -90 .. 90
    std::vector<double> horizontalDeg; // ascending, at least one
    std::vector<double> candela; // a row per horizontal angle; multiplier, ballast and tilt are in it, once
    std::optional<double> lampLumens; // of all lamps; absent where photometry is absolute
    double inputWatts = 0.0;          // 0 where the file says nothing
    // Of the luminous opening, along the light's local Y (width), X (length) and Z (height). Negative numbers
    // are what the file gives round shapes: a diameter.
    glm::dvec3 widthLengthHeightM{0.0};

    // Intensity towards a unit direction in the light's own frame, where it looks along -Z and the plane of
    // horizontal angle 0 is that of X and Z (EXT_lights_ies, "Coordinate System Mapping"). Bilinear in both
    // angles; symmetric parts that the file leaves out are mirrored; 0 outside the measured range.
    double candelaAt(const glm::dvec3& direction) const;
    double maxCandela() const;
    // The exact integral of candelaAt over all directions.
    double fluxLm() const;
    // Flux over the lamps' lumens for relative photometry.
    std::optional<double> efficiency() const;
};

// `text` is a file's contents and `path` what messages call it. Errors name file, line and expectation: what
// is not a number, counts that are not met, angles that do not ascend or belong to no symmetry, negative
// intensity, tilt in another file, and of relative photometry light that exceeds that of its lamps by more
// than 5 %.
Result<IesProfile> parseIes(std::string_view text, const std::string& path);

// Errors as above, and files that cannot be read or are larger than 16 MiB.
Result<IesProfile> readIes(const std::filesystem::path& path);

} // namespace kilolux
