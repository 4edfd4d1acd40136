// What the program says on stderr, and the codes it exits with.
#pragma once

#include <string_view>

namespace kilolux {

enum class ExitCode {
    Done = 0,
    LintFindings = 1,
    BadInput = 2,     // arguments, scene files
    CouldNotWork = 3, // device, memory, disk
};

// One line each: "kilolux: error: ..." and "kilolux: warning: ...". Line breaks inside become spaces, other
// control characters '?', so that a file's names cannot steer the terminal.
void printError(std::string_view message);
void printWarning(std::string_view message);

} // namespace kilolux
