// The names that the command line accepts: methods, views, settings and cameras, listed and looked up.
#pragma once

#include "renderer/renderer.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace kilolux {

enum class ListFormat { Text, Json };

// What --list prints, with a line break at the end.
std::string listChoices(ListFormat format);

// The error "unknown <kind> '<name>'; did you mean ..." unless `name` is one of `choices` or empty.
std::optional<Error> checkChoice(std::string_view kind, std::string_view name,
                                 std::span<const NamedChoice> choices);

// The same for the cameras of a scene.
std::optional<Error> checkCamera(std::string_view name, const Scene& scene);

// "640x360" to (640, 360). Each side is 1 to 16384 pixels, the picture at most 8K UHD.
struct PictureSize {
    int width = 0;
    int height = 0;
};
Result<PictureSize> parsePictureSize(std::string_view text);

// What all rendering commands take: the size into `options`, the method checked, the preset (empty: none) and
// then "key=value" settings applied.
std::optional<Error> applyPictureArguments(std::string_view size, std::string_view preset,
                                           std::span<const std::string> sets, RenderOptions& options);

} // namespace kilolux
