// Help for a mistyped name: the known name nearest to it, or the list of all.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace kilolux {

// "did you mean 'jitter'?" when a name is near `typed` (a third of its letters wrong at most, upper and lower
// case alike), else "choose one of: a, b, c". `names` must not be empty.
std::string nearestNameHint(std::string_view typed, std::span<const std::string_view> names);

} // namespace kilolux
