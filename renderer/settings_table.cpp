// The table of settings: names, ranges, units and help, one row per member.
#include "renderer/settings.h"

#include "shaders/shared/light_grid.h"

#include <array>

namespace kilolux {
namespace {

// ---------------------------------------------------------------------------------------------------------
// Words of the choices

template<typename E>
constexpr SettingWord word(E value, std::string_view text, std::string_view help) {
    return {static_cast<int>(value), text, help};
}

constexpr std::array kPixelFilterWords = {
    word(PixelFilter::Box, "box", "one pixel wide, sharp edges"),
    word(PixelFilter::BlackmanHarris, "blackmanHarris", "3 pixels wide, smooth"),
};
constexpr std::array kToneMapWords = {
    word(ToneMap::Neutral, "neutral", "keeps colours up to the shoulder, then fades to white"),
    word(ToneMap::None, "none", "exposure and sRGB only, clipped at 1"),
};
constexpr std::array kTracerWords = {
    word(TracerChoice::Auto, "auto", "ray query on hardware, compute on CPU devices"),
    word(TracerChoice::Compute, "compute", "our BVH in a compute shader"),
    word(TracerChoice::RayQuery, "rayQuery", "VK_KHR_ray_query"),
};
constexpr std::array kGBufferWords = {
    word(GBufferChoice::Auto, "auto", "the faster one on this device"),
    word(GBufferChoice::Raster, "raster", "rasterized triangles"),
    word(GBufferChoice::Compute, "compute", "nearest hit of one ray per pixel"),
};

constexpr std::array kSamplingWords = {
    word(Sampling::Full, "full", "every pixel evaluates its candidate lights"),
    word(Sampling::HalfCheckerboard, "checkerboard", "one pixel of each 2 x 2 chooses for all four"),
    word(Sampling::HalfRooks, "rooks", "the same, every row and column of each 4 x 4 once"),
};
constexpr std::array kNoiseWords = {
    word(Noise::Blue, "blue", "spatio-temporal blue noise, made for the filters that follow"),
    word(Noise::White, "white", "independent numbers: no filter profits, no pattern repeats"),
};
constexpr std::array kDimLightsWords = {
    word(DimLights::Roulette, "roulette", "raised to the threshold or left out by chance: unbiased"),
    word(DimLights::Drop, "drop", "left out: loses their light"),
    word(DimLights::Keep, "keep", "chosen by their weight: fireflies"),
};
constexpr std::array kResampleFromWords = {
    word(ResampleFrom::Cell, "cell", "the lights of the pixel's cell, each as likely"),
    word(ResampleFrom::Power, "power", "all lights of the scene, by power"),
    word(ResampleFrom::Hierarchy, "hierarchy", "all lights of the scene, by a tree of them"),
};
constexpr std::array kReuseWeightsWords = {
    word(ReuseWeights::Counts, "counts",
         "as if each could have drawn all: loses light, and gives rare ones far too much"),
    word(ReuseWeights::Targets, "targets",
         "by what it would give each of them unshadowed: loses light at shadows' edges"),
    word(ReuseWeights::Rays, "rays", "by what each of them sees of it, at a ray each: unbiased"),
};
constexpr std::array kPictureWords = {
    word(PictureChoice::Viewport, "viewport", "denoised, giving way to the mean as that converges"),
    word(PictureChoice::Denoised, "denoised", "denoised and anti-aliased"),
    word(PictureChoice::Mean, "mean", "mean of the raw frames"),
    word(PictureChoice::Raw, "raw", "the last frame without any filter"),
};

template<auto Member, std::size_t N>
constexpr ChoiceMember choice(const std::array<SettingWord, N>& words) {
    using Enum = std::remove_reference_t<decltype(std::declval<Settings&>().*Member)>;
    return {words, [](const Settings& s) { return static_cast<int>(s.*Member); },
            [](Settings& s, int value) { s.*Member = static_cast<Enum>(value); }};
}

// ---------------------------------------------------------------------------------------------------------
// The table

constexpr std::array kRows = {
    SettingRow{.name = "exposureEv100",
               .member = &Settings::exposureEv100,
               .min = -20.0,
               .max = 30.0,
               .unit = "EV100",
               .help = "exposure of the picture; auto takes the scene's, or meters it"},
    SettingRow{.name = "raysPerPixel",
               .member = &Settings::raysPerPixel,
               .min = 0.25,
               .max = 16.0,
               .unit = "rays per pixel and frame",
               .help = "shadow rays of the methods with a fixed budget"},
    SettingRow{.name = "raysPerLight",
               .member = &Settings::raysPerLight,
               .min = 1,
               .max = 16,
               .unit = "rays per light, pixel and frame",
               .help = "shadow rays of all-lights and of the references"},
    SettingRow{.name = "penumbraScale",
               .member = &Settings::penumbraScale,
               .min = 0.0,
               .max = 4.0,
               .unit = "of the sources' size",
               .help =
                   "how large all lights are for shadow rays: below 1 shadows are sharper and less noisy; "
                   "light without shadow stays"},
    SettingRow{.name = "shadowMapSize",
               .member = &Settings::shadowMapSize,
               .min = 32,
               .max = 1024,
               .unit = "texels",
               .help = "shadow-maps: width of a face of a light's map (directional: 4 times as wide); halved "
                       "until all fit into 512 MiB"},
    SettingRow{.name = "shadowSamples",
               .member = &Settings::shadowSamples,
               .min = 1,
               .max = 64,
               .unit = "per light, pixel and frame",
               .help = "shadow-maps: samples of a map that find the penumbra, and as many that fill it"},
    SettingRow{.name = "lightGrid",
               .member = &Settings::lightGrid,
               .help = "cull lights into cells of the view; off walks all lights for the same picture"},
    SettingRow{.name = "gridThreadLights",
               .member = &Settings::gridThreadLights,
               .min = 0,
               .max = shared::GRID_MAX_THREAD_LIGHTS,
               .unit = "lights",
               .help = "coarse cells with at most so many lights fill their fine cells by a thread each, "
                       "others by a group; the same lists"},
    SettingRow{.name = "jitter",
               .member = &Settings::jitter,
               .help = "move the sample inside the pixel from frame to frame"},
    SettingRow{.name = "pixelFilter",
               .member = choice<&Settings::pixelFilter>(kPixelFilterWords),
               .help = "what weights jittered samples"},
    SettingRow{.name = "toneMap",
               .member = choice<&Settings::toneMap>(kToneMapWords),
               .help = "from scene light to display"},
    SettingRow{.name = "fill",
               .member = &Settings::fill,
               .help = "add the scene's plain ambient light, which is not direct light"},
    SettingRow{
        .name = "tracer", .member = choice<&Settings::tracer>(kTracerWords), .help = "who traces rays"},
    SettingRow{.name = "gbuffer",
               .member = choice<&Settings::gbuffer>(kGBufferWords),
               .help = "who finds the visible surfaces"},
    SettingRow{.name = "sampling",
               .member = choice<&Settings::sampling>(kSamplingWords),
               .help = "resolution at which lights are chosen; rays and shading stay at full resolution"},
    SettingRow{.name = "noise",
               .member = choice<&Settings::noise>(kNoiseWords),
               .help = "random numbers of light selection"},
    SettingRow{.name = "compactRays",
               .member = &Settings::compactRays,
               .help = "trace and shade rays in the order of their lights, without those that have none"},
    SettingRow{.name = "guiding",
               .member = &Settings::guiding,
               .help = "use the lists of lights that were visible in earlier frames"},
    SettingRow{.name = "listLength",
               .member = &Settings::listLength,
               .min = 1,
               .max = 32,
               .unit = "lights",
               .help = "longest visible light list of an 8 x 8 tile; the strongest stay"},
    SettingRow{.name = "listMemory",
               .member = &Settings::listMemory,
               .min = 0,
               .max = 14,
               .unit = "frames",
               .help = "how long a light stays on a list without being seen"},
    SettingRow{.name = "areaMasks",
               .member = &Settings::areaMasks,
               .help = "send fewer rays to quarters of a light that were not seen"},
    SettingRow{.name = "maskHiddenShare",
               .member = &Settings::maskHiddenShare,
               .min = 0.01,
               .max = 0.25,
               .unit = "of a light's samples",
               .help = "what a quarter that was not seen still gets"},
    SettingRow{.name = "hiddenShare",
               .member = &Settings::hiddenShare,
               .min = 0.01,
               .max = 0.95,
               .unit = "of the samples",
               .help = "at most so many go to lights that are not on the visible list"},
    SettingRow{.name = "missHiddenShare",
               .member = &Settings::missHiddenShare,
               .min = 0.01,
               .max = 0.95,
               .unit = "of the samples",
               .help = "the same where the previous frame does not show the surface"},
    SettingRow{.name = "hiddenSeenShare",
               .member = &Settings::hiddenSeenShare,
               .min = 0.01,
               .max = 0.95,
               .unit = "of the samples",
               .help = "the same where lists are too short and rays to other lights arrive"},
    SettingRow{.name = "hiddenRelaxedBelow",
               .member = &Settings::hiddenRelaxedBelow,
               .min = 0.0,
               .max = 10.0,
               .unit = "of display white",
               .help = "where the visible lights sum to less, hidden ones get more samples"},
    SettingRow{.name = "directionalShare",
               .member = &Settings::directionalShare,
               .min = 0.01,
               .max = 0.95,
               .unit = "of the samples",
               .help = "at most so many go to directional lights"},
    SettingRow{.name = "directionalFreeBelow",
               .member = &Settings::directionalFreeBelow,
               .min = 0.0,
               .max = 10.0,
               .unit = "of display white",
               .help = "where local lights sum to less, directional ones are not limited"},
    SettingRow{.name = "domeBudget",
               .member = &Settings::domeBudget,
               .min = 0.01,
               .max = 0.95,
               .unit = "of the samples",
               .help =
                   "at most so many go to the dome light, where local lights sum to directionalFreeBelow"},
    SettingRow{.name = "cellCandidates",
               .member = &Settings::cellCandidates,
               .min = 1,
               .max = 1024,
               .unit = "lights",
               .help = "how many lights of its cell a pixel evaluates, beside its lists"},
    SettingRow{.name = "missCandidates",
               .member = &Settings::missCandidates,
               .min = 1,
               .max = 1024,
               .unit = "lights",
               .help = "the same where the previous frame does not show the surface"},
    SettingRow{.name = "dimLights",
               .member = choice<&Settings::dimLights>(kDimLightsWords),
               .help = "what happens to lights under dimThreshold"},
    SettingRow{.name = "dimThreshold",
               .member = &Settings::dimThreshold,
               .min = 0.0,
               .max = 1.0,
               .unit = "of display white",
               .help = "lights that give a pixel less are dim"},
    SettingRow{.name = "resampleCandidates",
               .member = &Settings::resampleCandidates,
               .min = 1,
               .max = 256,
               .unit = "lights",
               .help = "how many the methods resampling and restir draw per pixel"},
    SettingRow{.name = "resampleFrom",
               .member = choice<&Settings::resampleFrom>(kResampleFromWords),
               .help = "where they draw them from"},
    SettingRow{.name = "reuseFrames",
               .member = &Settings::reuseFrames,
               .min = 0.0,
               .max = 1000.0,
               .unit = "frames",
               .help = "restir: candidates of so many frames are what the past may stand for"},
    SettingRow{.name = "reuseNeighbours",
               .member = &Settings::reuseNeighbours,
               .min = 0,
               .max = 32,
               .unit = "pixels",
               .help = "restir: how many a pixel asks for what they chose"},
    SettingRow{.name = "reuseRadius",
               .member = &Settings::reuseRadius,
               .min = 1.0,
               .max = 256.0,
               .unit = "pixels",
               .help = "restir: how far away they are at most"},
    SettingRow{.name = "reuseWeights",
               .member = choice<&Settings::reuseWeights>(kReuseWeightsWords),
               .help = "restir: how what was taken is weighed by who could have drawn it"},
    SettingRow{.name = "picture",
               .member = choice<&Settings::picture>(kPictureWords),
               .help = "which picture of the stochastic method is shown"},
    SettingRow{.name = "settleError",
               .member = &Settings::settleError,
               .min = 0.0,
               .max = 1.0,
               .unit = "of the light, standard error",
               .help = "the viewport shows the mean where its error is smaller, and begins to at four times "
                       "that; also where filtering takes no noise away or is at fault; not in the first 12 "
                       "frames, in full from 48 on; 0: never"},
    SettingRow{.name = "denoise", .member = &Settings::denoise, .help = "filter light over time and space"},
    SettingRow{.name = "diffuseFrames",
               .member = &Settings::diffuseFrames,
               .min = 1.0,
               .max = 255.0,
               .unit = "frames",
               .help = "how many the denoiser averages of diffuse light at most"},
    SettingRow{.name = "specularFrames",
               .member = &Settings::specularFrames,
               .min = 1.0,
               .max = 255.0,
               .unit = "frames",
               .help = "the same of specular light"},
    SettingRow{.name = "leastFrames",
               .member = &Settings::leastFrames,
               .min = 1.0,
               .max = 32.0,
               .unit = "frames",
               .help = "what is left of that where light has changed"},
    SettingRow{.name = "clipWidth",
               .member = &Settings::clipWidth,
               .min = 0.05,
               .max = 10.0,
               .unit = "standard deviations",
               .help = "how far history may be off its 5 x 5 neighbourhood before it is moved"},
    SettingRow{.name = "spatialRadius",
               .member = &Settings::spatialRadius,
               .min = 0.0,
               .max = 64.0,
               .unit = "pixels",
               .help = "of the disk over which noise is filtered"},
    SettingRow{.name = "spatialThreshold",
               .member = &Settings::spatialThreshold,
               .min = 0.0,
               .max = 10.0,
               .unit = "of the light, standard error",
               .help = "noise that the spatial filter lets pass; from twice that on it works in full"},
    SettingRow{.name = "antiAlias",
               .member = &Settings::antiAlias,
               .help = "average jittered frames of the filtered picture"},
    SettingRow{.name = "antiAliasFrames",
               .member = &Settings::antiAliasFrames,
               .min = 1.0,
               .max = 255.0,
               .unit = "frames",
               .help = "how many it averages at most"},
    SettingRow{.name = "antiAliasClip",
               .member = &Settings::antiAliasClip,
               .min = 0.05,
               .max = 10.0,
               .unit = "standard deviations",
               .help = "how far its history may be off its 3 x 3 neighbourhood; six times that where the "
                       "denoiser of a still picture saw no change"},
    SettingRow{.name = "renderScale",
               .member = &Settings::renderScale,
               .min = 0.1,
               .max = 1.0,
               .unit = "of the picture's width and height",
               .help = "internal resolution; history goes on when it changes"},
    SettingRow{.name = "timeS",
               .member = &Settings::timeS,
               .min = -1e6,
               .max = 1e6,
               .unit = "s",
               .help = "time of the first frame, for animations and the motions below"},
    SettingRow{.name = "timeStepS",
               .member = &Settings::timeStepS,
               .min = -10.0,
               .max = 10.0,
               .unit = "s per frame",
               .help = "how much time passes between frames; 0: everything stands still"},
    SettingRow{.name = "cameraTurn",
               .member = &Settings::cameraTurn,
               .min = -3600.0,
               .max = 3600.0,
               .unit = "degrees per s",
               .help = "turns the camera to the left about the vertical"},
    SettingRow{.name = "cameraDolly",
               .member = &Settings::cameraDolly,
               .min = -1000.0,
               .max = 1000.0,
               .unit = "m per s",
               .help = "moves the camera forward"},
    SettingRow{.name = "lightsSway",
               .member = &Settings::lightsSway,
               .min = 0.0,
               .max = 1000.0,
               .unit = "m",
               .help = "every local light swings so far to both sides, in 2 s"},
    SettingRow{.name = "freezeFrame",
               .member = &Settings::freezeFrame,
               .min = 0,
               .max = 1000000,
               .unit = "frame",
               .help = "from this one on the frozen things stand still; 0: from the start"},
    SettingRow{.name = "freezeNoise",
               .member = &Settings::freezeNoise,
               .help = "the same random numbers and jitter every frame"},
    SettingRow{.name = "freezeLists",
               .member = &Settings::freezeLists,
               .help = "visible light lists are read and not written"},
    SettingRow{.name = "freezeHistory",
               .member = &Settings::freezeHistory,
               .help = "the denoiser's history is read and not written"},
};

// Stands for any member while the members of Settings are counted.
struct AnyMember {
    template<typename T>
    operator T() const;
};
template<typename... Args>
constexpr std::size_t memberCount() {
    if constexpr (requires { Settings{Args{}..., AnyMember{}}; })
        return memberCount<Args..., AnyMember>();
    else
        return sizeof...(Args);
}
static_assert(memberCount<>() == kRows.size(), "every member of Settings needs one row in kRows");

} // namespace

std::span<const SettingRow> settingRows() {
    return kRows;
}

} // namespace kilolux
