// What files that are written by descriptor share: whole writes, and the system's words for what failed.
#pragma once

#include "renderer/document/result.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <string_view>
#include <unistd.h>

namespace kilolux {

// Of the call that has just set errno; `what` names it: "cannot `what`".
inline Error systemError(const std::filesystem::path& path, const char* what) {
    return Error{fmt::format("{}: cannot {}: {}", path.string(), what, std::strerror(errno))};
}

// Writes all bytes in as many calls as it takes; false with errno where one fails.
inline bool writeAll(int descriptor, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return false;
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
}

} // namespace kilolux
