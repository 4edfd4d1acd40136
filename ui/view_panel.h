// What the view panel remembers; see panels.h.
#pragma once

#include "renderer/legend.h"
#include "ui/picture_export.h"
#include "ui/pixel_probe.h"

#include <optional>
#include <string>

namespace kilolux {

struct ViewPanelState {
    PixelProbe pointer;                  // what is under it
    std::optional<glm::ivec2> pointerPx; // pixel of the picture that was asked about last
    std::uint64_t pointerFrame = 0;      // picture that it was asked of
    std::optional<ViewRange> range;      // typed by the user, for the view of the next line
    std::string rangeView;
    std::string exportPath; // empty: the default one
    std::string exportView; // that the path was made for
    std::shared_ptr<const ExportResult> exported;
};

} // namespace kilolux
