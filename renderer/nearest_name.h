// Help for a mistyped name: the known name nearest to it, and the list of all.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace kilolux {

// The one of `names` nearest to `typed`, when at most a third of its letters are wrong, upper and lower case
// alike; else empty.
std::string_view nearestName(std::string_view typed, std::span<const std::string_view> names);

// "did you mean 'jitter'?" or, when nothing is near, "choose one of: a, b, c".
std::string nearestNameHint(std::string_view typed, std::span<const std::string_view> names);

// "choose one of: a, b, c", cut after 40 names.
std::string namesHint(std::span<const std::string_view> names);

} // namespace kilolux
