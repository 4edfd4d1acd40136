// Names of the views and methods, in the order of shaders/shared/views.h.
#pragma once

#include "renderer/renderer.h"

#include <optional>

namespace kilolux {

std::span<const NamedChoice> viewChoices();   // index = VIEW_*
std::span<const NamedChoice> methodChoices(); // index = Method

bool isDenoiserView(int view); // shows what only the denoiser makes

enum class Method { Stochastic, AllLights, ReferenceSplit, ReferenceTrue };

// Views of what only the stochastic method makes; their help begins with "stochastic:".
bool isStochasticView(int view);

// Index of a name; empty text gives 0.
std::optional<int> indexOfChoice(std::span<const NamedChoice> choices, std::string_view name);

} // namespace kilolux
