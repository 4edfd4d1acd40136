// The views, in the order of shaders/shared/views.h, with what their colours mean; and the methods.
#pragma once

#include "renderer/legend.h"
#include "renderer/renderer.h"
#include "shaders/shared/views.h"

#include <optional>

namespace kilolux {

std::span<const NamedChoice> viewChoices();   // index = VIEW_*
std::span<const NamedChoice> methodChoices(); // index = Method

bool isDenoiserView(int view); // shows what only the denoiser makes

// `exposure`: display value per nit. `depthMiddleM`: in the middle of the scale of depth. `wanted`: another
// range, for views with a scale of their own that it fits.
Legend viewLegend(int view, double exposure, double depthMiddleM, const std::optional<ViewRange>& wanted);

// The same for the shader.
shared::ViewConstants viewConstants(int view, const Legend& legend, double depthMiddleM);

// The last ones are baselines that resample.
enum class Method {
    Stochastic,
    AllLights,
    ReferenceSplit,
    ReferenceTrue,
    ShadowMaps,
    Uniform,
    Power,
    Brdf,
    Hierarchy,
    Resampling,
    Restir
};

// Views of what only the stochastic method makes; their help begins with "stochastic:".
bool isStochasticView(int view);

// Index of a name; empty text gives 0.
std::optional<int> indexOfChoice(std::span<const NamedChoice> choices, std::string_view name);

} // namespace kilolux
