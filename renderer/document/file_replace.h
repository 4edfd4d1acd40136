// Writes a file so that whatever happens, power included, the old or the new one is there, whole.
#pragma once

#include "renderer/document/result.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>

namespace kilolux {

// Called after each stage of a replacement; for tests, which stop there as a crash would.
enum class ReplaceStage { Opened, Written, Synced, Renamed };

struct ReplaceOptions {
    std::function<void(ReplaceStage)> onStage;
    // Called with the share that is written, 0 to 1; an error gives the replacement up and comes back.
    std::function<std::optional<Error>(double)> onWritten;
    // Called last before the file is replaced, likewise.
    std::function<std::optional<Error>()> beforeRename;
};

// Writes a new file beside `path`, makes it durable, and renames it into place. A link is followed;
// permissions of the old file are kept. On failure the old file is untouched, the new one is gone, and the
// message names the file and the system's reason.
std::optional<Error> replaceFile(const std::filesystem::path& path, std::string_view bytes,
                                 const ReplaceOptions& options = {});

// The whole of a regular file.
Result<std::string> readWholeFile(const std::filesystem::path& path);

} // namespace kilolux
