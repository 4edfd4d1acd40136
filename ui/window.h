// The window: opens it, feeds events to the panels, keeps the picture and the panels drawn, until it is
// closed.
#pragma once

#include "renderer/document/result.h"

#include <optional>
#include <string>

namespace kilolux {

struct WindowOptions {
    std::string scene;     // empty: the first-run state
    std::string stateFile; // where the state goes (state_file.h); empty: nowhere
    int width = 0;         // pixels; 0: as it was last time
    int height = 0;
    double uiScale = 0.0; // of fonts and spacing; 0: by the screen
    std::string preset;   // of quality (settings_presets.h); empty: as it was last time
};

// Returns when the user has closed the window. Errors: no display, no device that can present.
std::optional<Error> runWindow(const WindowOptions& options);

} // namespace kilolux
