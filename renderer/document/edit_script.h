// A list of edits as JSON (edits.md), applied to a session: what the window does, without a window.
#pragma once

#include "renderer/document/edit_session.h"

#include <nlohmann/json_fwd.hpp>

namespace kilolux {

// Applies the steps in order, each as one change that can be undone. An error names the place in the list,
// what was expected, and leaves the document as the steps before made it.
std::optional<Error> runEditScript(EditSession& session, const nlohmann::json& script);

} // namespace kilolux
