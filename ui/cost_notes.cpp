#include "ui/cost_notes.h"

#include <algorithm>
#include <fmt/format.h>

namespace kilolux {

namespace {

constexpr double kMuchOfAFrame = 0.5;    // one pass
constexpr double kLongListTest = 3.0;    // lights walked for each that may shine
constexpr double kOftenOverflowed = 0.5; // lights without room on a tile's list
constexpr double kFewUsefulRays = 0.2;

} // namespace

std::vector<CostNote> costNotes(const FrameStatistics& s) {
    std::vector<CostNote> notes;
    if (!s.viewProblem.empty()) notes.push_back({s.viewProblem, true});
    if (s.fillNit > 0.0) notes.push_back({fmt::format("Fill of {:.3g} nit: not direct light", s.fillNit)});
    if (s.gridCoarseCells > 0)
        notes.push_back({fmt::format("The light grid lacks room in {} cells", s.gridCoarseCells), true});
    if (s.listOverflowMean > kOftenOverflowed)
        notes.push_back(
            {fmt::format("Visible lists overflow: {:.1f} lights a tile find no room", s.listOverflowMean),
             true});
    if (s.raysPerPixelMean > 0.0 && s.usefulRaysPerPixelMean < kFewUsefulRays * s.raysPerPixelMean)
        notes.push_back({fmt::format("Only {:.0f} % of the rays meet their light",
                                     100.0 * s.usefulRaysPerPixelMean / s.raysPerPixelMean)});
    if (s.lightsInRangeMean > 1.0 && s.lightsTestedMean > kLongListTest * s.lightsInRangeMean)
        notes.push_back({fmt::format("Cells list {:.0f} lights where {:.0f} can shine", s.lightsTestedMean,
                                     s.lightsInRangeMean)});
    const auto slowest = std::max_element(s.passes.begin(), s.passes.end(), [](const auto& a, const auto& b) {
        return a.medianMs < b.medianMs;
    });
    if (slowest != s.passes.end() && s.passes.size() > 1 && slowest->medianMs > kMuchOfAFrame * s.frameMs)
        notes.push_back({fmt::format("'{}' takes {:.0f} % of the frame", slowest->name,
                                     100.0 * slowest->medianMs / s.frameMs)});
    return notes;
}

} // namespace kilolux
