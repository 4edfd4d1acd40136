// The files beside a scene that its lights can use, as URIs relative to its folder.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace kilolux {

inline constexpr std::string_view kProfileEndings[] = {".ies"};
inline constexpr std::string_view kPictureEndings[] = {".png", ".jpg", ".jpeg", ".exr", ".hdr"};

// Sorted; folders of folders to a depth of four, at most 500 files. Errors of single folders are passed over.
std::vector<std::filesystem::path> pathsBelow(const std::filesystem::path& folder,
                                              std::span<const std::string_view> endings);
// The same as URIs relative to the folder.
std::vector<std::string> filesBelow(const std::filesystem::path& folder,
                                    std::span<const std::string_view> endings);

// A path below the folder as a URI, and the last part of a URI as people read it.
std::string uriOf(const std::filesystem::path& relative);
std::string readableUri(const std::string& uri);

} // namespace kilolux
