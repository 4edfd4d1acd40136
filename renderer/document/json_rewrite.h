// Changes values in a JSON text and leaves everything else as it stands: order of members, whitespace, the
// digits of numbers, parts that nobody here knows.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace kilolux {

// The text `source`, whose parsed form is `before`, changed so that it parses as `after`. What is equal in
// both is taken over byte for byte; new members follow the old ones, laid out like their neighbours. `source`
// must be valid JSON.
std::string rewriteJson(std::string_view source, const nlohmann::json& before, const nlohmann::json& after);

} // namespace kilolux
