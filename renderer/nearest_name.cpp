// Nearest name by edit distance (Wagner and Fischer 1974), letters compared without case.
#include "renderer/nearest_name.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <vector>

namespace kilolux {
namespace {

std::size_t editDistance(std::string_view a, std::string_view b) {
    const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j)
        row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t substituted = diagonal + (lower(a[i - 1]) == lower(b[j - 1]) ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
        }
    }
    return row[b.size()];
}

} // namespace

std::string_view nearestName(std::string_view typed, std::span<const std::string_view> names) {
    // Longer input cannot be a slip of the hand, and its distance would cost time.
    if (typed.size() > 64) return {};
    std::string_view nearest;
    std::size_t nearestDistance = typed.size() + 1;
    for (const std::string_view name : names) {
        const std::size_t distance = editDistance(typed, name);
        if (distance >= nearestDistance || distance * 3 > std::max(typed.size(), name.size())) continue;
        nearest = name;
        nearestDistance = distance;
    }
    return nearest;
}

std::string nearestNameHint(std::string_view typed, std::span<const std::string_view> names) {
    const std::string_view nearest = nearestName(typed, names);
    return nearest.empty() ? namesHint(names) : fmt::format("did you mean '{}'?", nearest);
}

std::string namesHint(std::span<const std::string_view> names) {
    constexpr std::size_t kMaxNames = 40;
    const std::span<const std::string_view> shown = names.first(std::min(names.size(), kMaxNames));
    const std::string more =
        names.size() > kMaxNames ? fmt::format(" and {} more", names.size() - kMaxNames) : std::string();
    return fmt::format("choose one of: {}{}", fmt::join(shown, ", "), more);
}

} // namespace kilolux
