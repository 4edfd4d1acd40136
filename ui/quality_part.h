// Quality presets in the view panel, each with its cost and error in this view, and the plot of error against
// time.
#pragma once

#include "ui/desk.h"
#include "ui/speed_error.h"

#include <nlohmann/json_fwd.hpp>
#include <optional>

namespace kilolux {

struct QualityState {
    SpeedError curves;
    std::uint64_t view = 0;       // ReferenceState::wantedKey that the curves are of
    std::string preset;           // of the picture that was shown last
    std::uint32_t frames = 0;     // in it
    const void* report = nullptr; // that was taken last
    // Measuring all presets one after the other.
    struct Run {
        Settings before; // to come back to
        std::size_t next = 0;
        bool begun = false; // the picture of the newest preset, anew
    };
    std::optional<Run> run;
};

std::string presetName(const Settings& settings); // empty: they are nobody's

void followQuality(Desk& desk); // takes what was measured; once a frame, after the reference was followed

void drawQualityPart(Desk& desk); // the choice of a preset
void drawErrorPlot(Desk& desk);   // with the choice below; while the error is measured

// For tests: preset, and of each curve the frames, seconds and errors of its points.
nlohmann::json qualityState(const Desk& desk);

} // namespace kilolux
