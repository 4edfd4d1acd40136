// Files of what the viewport shows, written by the render thread between frames.
#pragma once

#include "ui/render_thread.h"

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>

namespace kilolux {

// A free name beside the scene: "<scene>-<view>.png", numbered where that is taken.
std::string exportPathFor(const std::filesystem::path& scene, const std::string& view);

struct ExportResult {
    std::atomic<bool> done = false;
    std::string text; // what to tell the user, once it is done
    bool failed = false;
};

// PNG: as on the display. EXR and HDR: linear light, or the raw values of a view.
std::shared_ptr<const ExportResult> exportPicture(RenderThread& thread, const std::string& path);

// Writes a picture by the name's extension.
std::optional<Error> writePictureFile(const std::string& path, const Picture& picture);

} // namespace kilolux
