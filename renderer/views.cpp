#include "renderer/views.h"

#include "renderer/view_colors.h"

#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace kilolux {

namespace {

// Where a scale's numbers come from.
enum class Range { Fixed, Exposure, Depth };

struct ViewRow {
    std::string_view name, help;
    ColorMap map = ColorMap::None;
    ViewRange range{0.0, 1.0};
    std::string_view unit;     // empty: a plain number
    std::string_view channels; // what red, green and blue are
    LegendScale scale = LegendScale::Linear;
    Range from = Range::Fixed;
};

constexpr ColorMap kAmount = ColorMap::Amount;
constexpr std::string_view kAxes = "x, y and z: -1 dark, 1 bright";

constexpr std::array<ViewRow, shared::VIEW_COUNT> kViews{{
    {"final", "the picture"},
    {"diffuse", "diffuse light without the material's albedo, nit / pi"},
    {"specular", "specular light, nit"},
    {"normal", "shading normal, world space", ColorMap::None, {-1, 1}, "", kAxes},
    {"geometric-normal",
     "geometric normal, world space, on the viewer's side",
     ColorMap::None,
     {-1, 1},
     "",
     kAxes},
    {"base-color", "base colour"},
    {"roughness", "roughness, 0 to 1", kAmount},
    {"metallic", "metallic, 0 to 1", kAmount},
    {"emissive", "emitted light, nit"},
    {"depth", "linear depth, metres; bright is near", kAmount, {}, "m", "", LegendScale::Depth, Range::Depth},
    {"depth-range",
     "depth pyramid: farthest minus nearest in 8 x 8 pixels",
     kAmount,
     {0, 1},
     "of the depth scale",
     "",
     LegendScale::Linear,
     Range::Depth},
    {"instance", "a colour per instance", ColorMap::Ids},
    {"primitive", "a colour per triangle", ColorMap::Ids},
    {"lights-in-range",
     "lights that may shine on each pixel: within range, cone and side, 0 to 64",
     kAmount,
     {0, 64},
     "lights"},
    {"lights-seen", "lights of which a ray was not blocked, 0 to 64", kAmount, {0, 64}, "lights"},
    {"seen-share", "share of the lights in range that is seen, 0 to 1", kAmount},
    {"chosen-light", "stochastic: a colour per light that the pixel's first ray went to; black: none",
     ColorMap::Ids},
    {"visibility", "stochastic: share of the pixel's rays that met their light; blue: no ray",
     ColorMap::Grey},
    {"hidden-share", "stochastic: share of the pixel's samples that went to lights not on its list", kAmount},
    {"sample-weight",
     "stochastic: perceptual weight of the chosen light, 0 to 4",
     kAmount,
     {0, 4},
     "log2(1 + exposed luminance)"},
    {"list-length",
     "stochastic: lights on the visible list of each 8 x 8 tile, 0 to 32; white: it overflowed",
     kAmount,
     {0, 32},
     "lights"},
    {"list-age",
     "stochastic: mean frames since the listed lights were last seen, 0 to 15",
     kAmount,
     {0, 15},
     "frames"},
    {"reprojection",
     "stochastic: red: not found in the previous frame; green: no neighbour fitted at half "
     "resolution; blue: a light was just edited",
     ColorMap::None,
     {0, 1},
     "",
     "not found, reconstructed, edited"},
    {"history-length",
     "stochastic: frames of diffuse light that the denoiser holds, 0 to 32",
     kAmount,
     {0, 32},
     "frames"},
    {"deviation",
     "stochastic: standard deviation of diffuse light over the frames, of its mean, 0 to 4",
     kAmount,
     {0, 4},
     "of the mean"},
    {"rejected-history",
     "stochastic: history that the denoiser cut: red none was found, green diffuse, blue specular",
     ColorMap::None,
     {0, 1},
     "",
     "not found, diffuse, specular"},
    {"denoised-diffuse", "stochastic: diffuse light after the denoiser, nit / pi"},
    {"denoised-specular", "stochastic: specular light after the denoiser, nit"},
    {"luminance",
     "false colour: luminance of the picture in nit, isolines at 1, 3.16, 10, ...",
     kAmount,
     {},
     "nit",
     "",
     LegendScale::Decades,
     Range::Exposure},
    {"illuminance",
     "false colour: light that falls on each surface in lux, isolines at 1, 3.16, 10, ...",
     kAmount,
     {},
     "lux",
     "",
     LegendScale::Decades,
     Range::Exposure},
    {"stops",
     "false colour: stops below and above middle grey, an isoline at each",
     ColorMap::Signed,
     {-6, 6},
     "stops from middle grey",
     "",
     LegendScale::Stops},
    {"clipping", "red: the display cannot show it brighter; blue: nor darker"},
}};

// The same names for command lines.
constexpr auto kViewChoices = [] {
    std::array<NamedChoice, kViews.size()> choices{};
    for (std::size_t i = 0; i < kViews.size(); ++i)
        choices[i] = {kViews[i].name, kViews[i].help};
    return choices;
}();

constexpr std::array<NamedChoice, 11> kMethods{{
    {"stochastic", "about one ray per pixel to lights that earlier frames saw, then one denoiser for all"},
    {"all-lights", "every light in range of each pixel with one ray each"},
    {"split", "reference: analytic irradiance times mean visibility; converges over --frames"},
    {"true", "reference: the BRDF at sampled points of every light; converges over --frames"},
    {"shadow-maps",
     "baseline: every light in range with a soft shadow from a map of its own (Fernando 2005)"},
    {"uniform", "baseline: one ray per pixel to a light of its cell, each as likely"},
    {"power", "baseline: one ray per pixel to a light of the scene, by power"},
    {"brdf",
     "baseline: one ray per pixel where the BRDF reflects, to a light that it meets, or to one without size"},
    {"hierarchy",
     "baseline: one ray per pixel to a light found by going down a tree of lights (Conty and Kulla 2018)"},
    {"resampling", "baseline: one ray per pixel to one of resampleCandidates lights, by BRDF times light"},
    {"restir", "baseline: the same with reuse in time and space (ReSTIR DI, Bitterli et al. 2020)"},
}};

} // namespace

std::span<const NamedChoice> viewChoices() {
    return kViewChoices;
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

namespace {

std::vector<LegendKey> keysOf(int view) {
    if (view == shared::VIEW_CLIPPING)
        return {{clippedColor(), "as bright as the display can"}, {crushedColor(), "black on the display"}};
    if (view == shared::VIEW_VISIBILITY) return {{noRayColor(), "no ray"}};
    if (view == shared::VIEW_LIST_LENGTH) return {{overflowColor(), "overflowed"}};
    return {};
}

// Four decades about what a matt grey surface shows as middle grey.
ViewRange aboutMiddleGrey(int view, double exposure) {
    const double greyNit = 0.18 / exposure;
    const double middle = view == shared::VIEW_ILLUMINANCE ? greyNit * glm::pi<double>() / 0.18 : greyNit;
    const double decade = std::round(std::log10(middle));
    return {std::pow(10.0, decade - 2.0), std::pow(10.0, decade + 2.0)};
}

} // namespace

Legend viewLegend(int view, double exposure, double depthMiddleM, const std::optional<ViewRange>& wanted) {
    const ViewRow& row = kViews[std::size_t(view)];
    Legend legend{row.map, row.scale, row.range, row.unit, row.channels, keysOf(view)};
    if (row.from == Range::Exposure) legend.range = aboutMiddleGrey(view, exposure);
    if (row.scale == LegendScale::Depth) legend.range = {depthMiddleM, depthMiddleM};
    const bool fits = wanted && wanted->high > wanted->low &&
                      (row.scale != LegendScale::Decades || wanted->low > 0.0) && row.from != Range::Depth;
    if (fits) legend.range = *wanted;
    return legend;
}

shared::ViewConstants viewConstants(int view, const Legend& legend, double depthMiddleM) {
    shared::ViewConstants constants{};
    const auto& [low, high] = legend.range;
    const bool decades = legend.scale == LegendScale::Decades;
    constants.low = float(decades ? std::log10(low) : low);
    constants.high = float(decades ? std::log10(high) : high);
    if (kViews[std::size_t(view)].from == Range::Depth) constants.low = float(depthMiddleM);
    return constants;
}

bool isStochasticView(int view) {
    return viewChoices()[std::size_t(view)].help.starts_with("stochastic:");
}

bool isDenoiserView(int view) {
    return view >= shared::VIEW_HISTORY_LENGTH && view <= shared::VIEW_DENOISED_SPECULAR;
}

} // namespace kilolux
