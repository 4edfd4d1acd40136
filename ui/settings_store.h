// What the window remembers from one start to the next, as JSON in $XDG_CONFIG_HOME/kilolux/window.json.
#pragma once

#include "ui/desk.h"

#include <filesystem>
#include <map>

namespace kilolux {

struct Remembered {
    int windowWidth = 1280; // pixels
    int windowHeight = 720;
    double uiScale = 0.0;     // 0: by the screen
    double leftWidth = 264.0; // unscaled pixels
    double rightWidth = 304.0;
    PanelVisibility panels;
    Snapping snapping;
    double gizmoSizePx = 88.0;
    RenderLimits limits;
    std::string preset;              // of quality; empty: the default, or settings of one's own
    std::vector<std::string> recent; // scenes, the newest first
    // Names of the lights that are not to be picked, by recent scene. They are no part of the file: who locks
    // lights keeps their own hands off them.
    std::map<std::string, std::vector<std::string>> locked;
    bool operator==(const Remembered&) const = default;
};

// Where it lies: below $XDG_CONFIG_HOME or ~/.config; empty when neither is set.
std::filesystem::path rememberedPath();

// What is missing or of the wrong kind keeps its default.
Remembered readRemembered(const std::filesystem::path& path);
std::optional<Error> writeRemembered(const std::filesystem::path& path, const Remembered& remembered);

// Puts a scene first on the list of recent ones.
void rememberScene(Remembered& remembered, const std::filesystem::path& scene);
std::string rememberedName(const std::filesystem::path& scene); // as it stands there

} // namespace kilolux
