// Letters in lower case, of ASCII alone: whatever the locale, searches and words of steps come out alike.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace kilolux {

constexpr char lowered(char c) {
    return c >= 'A' && c <= 'Z' ? char(c + ('a' - 'A')) : c;
}

inline std::string lowered(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(), [](char c) { return lowered(c); });
    return result;
}

// 'Sphere light' as it stands within a sentence: 'Add sphere light'.
inline std::string withinSentence(std::string_view text) {
    std::string result(text);
    if (!result.empty()) result[0] = lowered(result[0]);
    return result;
}

} // namespace kilolux
