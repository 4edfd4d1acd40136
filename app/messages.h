// What the program says on stderr, and the codes it exits with.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace kilolux {

enum class ExitCode {
    Done = 0,
    LintFindings = 1,
    BadInput = 2,     // arguments, scene files
    CouldNotWork = 3, // device, memory, disk
};

// An error on a command's way out, with the code that belongs to it.
struct Failure {
    ExitCode code;
    std::string message;
};
using Problem = std::optional<Failure>;

// One line each: "kilolux: error: ..." and "kilolux: warning: ...". Line breaks inside become spaces, other
// control characters '?', so that a file's names cannot steer the terminal.
void printError(std::string_view message);
void printWarning(std::string_view message);

} // namespace kilolux
