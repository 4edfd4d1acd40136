// Messages for people and for scripts that read stderr line by line.
#include "app/messages.h"

#include <cstdio>
#include <fmt/format.h>
#include <string>

namespace kilolux {
namespace {

void printLine(std::string_view kind, std::string_view message) {
    std::string line(message);
    for (char& c : line) {
        if (c == '\n' || c == '\r' || c == '\t') c = ' ';
        if (static_cast<unsigned char>(c) < 32 || c == 127) c = '?';
    }
    fmt::print(stderr, "kilolux: {}: {}\n", kind, line);
}

} // namespace

void printError(std::string_view message) {
    printLine("error", message);
}
void printWarning(std::string_view message) {
    printLine("warning", message);
}

} // namespace kilolux
