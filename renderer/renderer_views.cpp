// What a Renderer shows: its view, with the images that only some views need, or what a pass wrote; see
// renderer_impl.h.
#include "renderer/renderer_impl.h"

#include "renderer/views.h"
#include "shaders/shared/features.h"

#include <fmt/format.h>
#include <utility>

namespace kilolux {

std::optional<Error> Renderer::Impl::planView() {
    const std::optional<PassOutputName> output = passOutputName(options.view);
    const std::optional<int> view = output ? shared::VIEW_FINAL : indexOfChoice(viewChoices(), options.view);
    const std::optional<int> method = indexOfChoice(methodChoices(), options.method);
    if (!view) return Error{fmt::format("no view '{}'", options.view)};
    if (!method) return Error{fmt::format("no method '{}'", options.method)};
    if (isStochasticView(*view) && Method(*method) != Method::Stochastic) {
        return Error{fmt::format("view '{}' shows the stochastic method; method '{}' has no such thing",
                                 viewChoices()[std::size_t(*view)].name,
                                 methodChoices()[std::size_t(*method)].name)};
    }
    plan.method = Method(*method);
    plan.view = *view;
    features[shared::CHOICE_VIEW] = std::uint32_t(plan.view);
    outputView = output;
    planFilters(plan, options.settings);
    return std::nullopt;
}

TargetNeeds Renderer::Impl::targetNeeds() const {
    TargetNeeds needs;
    needs.raster = plan.producer == GBufferProducer::Raster;
    needs.debugView = plan.view != shared::VIEW_FINAL;
    needs.history = plan.filtersLight();
    needs.rays = plan.filtersLight() ? constants.sampling.rays : 0;
    needs.reservoirs = plan.resamples();
    needs.halfChoices = plan.halfSampling ? constants.sampling.choices : 0;
    needs.denoised = plan.denoise;
    needs.denoiseTrace = plan.denoise && isDenoiserView(plan.view);
    needs.antiAliased = plan.antiAlias;
    needs.rawColor = plan.keepsRaw();
    needs.mean = plan.mean;
    needs.counted = plan.mean && plan.filtersLight();
    needs.settled = plan.settle;
    return needs;
}

// Most views only need a pass and an image more. One that wants filters which the settings leave out makes
// targets anew, and with them the history.
std::optional<Error> Renderer::Impl::setView(std::string_view view, const std::optional<ViewRange>& range) {
    const std::string before = std::exchange(options.view, std::string(view));
    const bool denoised = plan.denoise;
    if (auto error = planView()) {
        options.view = before;
        planView();
        return error;
    }
    options.viewRange = range;
    if (plan.denoise != denoised) {
        historyReset = "view";
        return preparePlan();
    }
    targets->addForView(device, targetNeeds());
    if (plan.view != shared::VIEW_FINAL && !passes->debugView)
        passes->debugView = std::make_unique<DebugViewPass>(resources);
    return std::nullopt;
}

// Puts what a pass wrote in the place of the picture, where the view asks for it.
void Renderer::Impl::takePassOutput(const gpu::Commands& commands) {
    passOutput.reset();
    viewProblem.reset();
    const glm::ivec2 allocated(options.width, options.height);
    if (!outputView || glm::ivec2(constants.outputSize) != allocated) return;
    Result<PassOutput> made =
        showPassOutput(*outputView, commands.captured(), allocated, glm::ivec2(constants.size), allocated);
    if (!made) {
        viewProblem = Error{made.error()};
        return;
    }
    passOutput = std::move(made.value());
    legend = passOutput->legend;
    std::vector<std::byte> rgba;
    for (std::size_t i = 0; i < passOutput->picture.srgb8.size(); ++i) {
        rgba.push_back(std::byte(passOutput->picture.srgb8[i]));
        if (i % 3 == 2) rgba.push_back(std::byte(255));
    }
    targets->display.upload(rgba);
}

} // namespace kilolux
