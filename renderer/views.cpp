#include "renderer/views.h"

#include "shaders/shared/views.h"

#include <array>

namespace kilolux {

namespace {

constexpr std::array<NamedChoice, shared::VIEW_COUNT> kViews{{
    {"final", "the picture"},
    {"diffuse", "diffuse light without the material's albedo, nit / pi"},
    {"specular", "specular light, nit"},
    {"normal", "shading normal, world space"},
    {"geometric-normal", "geometric normal, world space, on the viewer's side"},
    {"base-color", "base colour"},
    {"roughness", "roughness, 0 to 1"},
    {"metallic", "metallic, 0 to 1"},
    {"emissive", "emitted light, nit"},
    {"depth", "linear depth, metres; bright is near"},
    {"depth-range", "depth pyramid: farthest minus nearest in 8 x 8 pixels"},
    {"instance", "a colour per instance"},
    {"primitive", "a colour per triangle"},
    {"lights-in-range", "lights that may shine on each pixel: within range, cone and side, 0 to 64"},
    {"lights-seen", "lights of which a ray was not blocked, 0 to 64"},
    {"seen-share", "share of the lights in range that is seen, 0 to 1"},
    {"chosen-light", "stochastic: a colour per light that the pixel's first ray went to; black: none"},
    {"visibility", "stochastic: share of the pixel's rays that met their light; blue: no ray"},
    {"hidden-share", "stochastic: share of the pixel's samples that went to lights not on its list"},
    {"sample-weight", "stochastic: perceptual weight of the chosen light, 0 to 4"},
    {"list-length",
     "stochastic: lights on the visible list of each 8 x 8 tile, 0 to 32; white: it overflowed"},
    {"list-age", "stochastic: mean frames since the listed lights were last seen, 0 to 15"},
    {"reprojection", "stochastic: red: not found in the previous frame; green: no neighbour fitted at half "
                     "resolution; blue: a light was just edited"},
    {"history-length", "stochastic: frames of diffuse light that the denoiser holds, 0 to 32"},
    {"deviation", "stochastic: standard deviation of diffuse light over the frames, of its mean, 0 to 4"},
    {"rejected-history",
     "stochastic: history that the denoiser cut: red none was found, green diffuse, blue specular"},
    {"denoised-diffuse", "stochastic: diffuse light after the denoiser, nit / pi"},
    {"denoised-specular", "stochastic: specular light after the denoiser, nit"},
}};

constexpr std::array<NamedChoice, 4> kMethods{{
    {"stochastic", "about one ray per pixel to lights that earlier frames saw, then one denoiser for all"},
    {"all-lights", "every light in range of each pixel with one ray each"},
    {"split", "reference: analytic irradiance times mean visibility; converges over --frames"},
    {"true", "reference: the BRDF at sampled points of every light; converges over --frames"},
}};

} // namespace

std::span<const NamedChoice> viewChoices() {
    return kViews;
}

std::span<const NamedChoice> methodChoices() {
    return kMethods;
}

std::optional<int> indexOfChoice(std::span<const NamedChoice> choices, std::string_view name) {
    if (name.empty()) return 0;
    for (std::size_t i = 0; i < choices.size(); ++i) {
        if (choices[i].name == name) return int(i);
    }
    return std::nullopt;
}

bool isStochasticView(int view) {
    return viewChoices()[std::size_t(view)].help.starts_with("stochastic:");
}

bool isDenoiserView(int view) {
    return view >= shared::VIEW_HISTORY_LENGTH && view <= shared::VIEW_DENOISED_SPECULAR;
}

} // namespace kilolux
