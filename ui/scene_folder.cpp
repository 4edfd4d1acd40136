#include "ui/scene_folder.h"

#include <algorithm>
#include <fmt/format.h>

namespace kilolux {

namespace {

namespace fs = std::filesystem;

constexpr int kMostDepth = 4;
constexpr std::size_t kMostFiles = 500;

std::string lowered(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = char(c + 32);
    return text;
}

} // namespace

std::vector<fs::path> pathsBelow(const fs::path& folder, std::span<const std::string_view> endings) {
    std::vector<fs::path> paths;
    std::error_code error;
    fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, error), end;
    for (; !error && at != end && paths.size() < kMostFiles; at.increment(error)) {
        if (at.depth() >= kMostDepth || at->path().filename().string().starts_with('.'))
            at.disable_recursion_pending();
        std::error_code ignored;
        const std::string ending = lowered(at->path().extension().string());
        if (std::find(endings.begin(), endings.end(), ending) == endings.end() ||
            !at->is_regular_file(ignored))
            continue;
        paths.push_back(at->path());
    }
    std::sort(paths.begin(), paths.end());
    return paths;
}

std::vector<std::string> filesBelow(const fs::path& folder, std::span<const std::string_view> endings) {
    std::vector<std::string> uris;
    for (const fs::path& path : pathsBelow(folder, endings))
        uris.push_back(uriOf(path.lexically_relative(folder)));
    return uris;
}

std::string uriOf(const fs::path& relative) {
    std::string uri;
    for (const char c : relative.generic_string()) {
        const bool escapes = c == ' ' || c == '%' || c == '#' || c == '?' || c == '\\' || c == ':';
        uri += escapes ? fmt::format("%{:02X}", static_cast<unsigned char>(c)) : std::string(1, c);
    }
    return uri;
}

std::string readableUri(const std::string& uri) {
    if (uri.starts_with("data:")) return "in the scene's file";
    if (uri.starts_with('#')) return "in the scene's file (" + uri.substr(uri.rfind('/') + 1) + ")";
    std::string name;
    const std::string last = uri.substr(uri.rfind('/') + 1);
    for (std::size_t i = 0; i < last.size(); ++i) {
        unsigned code = 0;
        if (last[i] == '%' && i + 2 < last.size() && std::sscanf(last.c_str() + i + 1, "%2x", &code) == 1) {
            name += char(code);
            i += 2;
        } else {
            name += last[i];
        }
    }
    return name;
}

} // namespace kilolux
