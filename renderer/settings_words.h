// The words of the settings that are choices, and the rows' way to reach them; for settings_table.cpp alone.
#pragma once

#include "renderer/settings.h"

#include <array>
#include <type_traits>
#include <utility>

namespace kilolux {

template<typename E>
constexpr SettingWord word(E value, std::string_view text, std::string_view help) {
    return {static_cast<int>(value), text, help};
}

inline constexpr std::array kPixelFilterWords = {
    word(PixelFilter::Box, "box", "one pixel wide, sharp edges"),
    word(PixelFilter::BlackmanHarris, "blackmanHarris", "3 pixels wide, smooth"),
};
inline constexpr std::array kToneMapWords = {
    word(ToneMap::Neutral, "neutral", "keeps colours up to the shoulder, then fades to white"),
    word(ToneMap::None, "none", "exposure and sRGB only, clipped at 1"),
};
inline constexpr std::array kTracerWords = {
    word(TracerChoice::Auto, "auto", "ray query on hardware, compute on CPU devices"),
    word(TracerChoice::Compute, "compute", "our BVH in a compute shader"),
    word(TracerChoice::RayQuery, "rayQuery", "VK_KHR_ray_query"),
};
inline constexpr std::array kGBufferWords = {
    word(GBufferChoice::Auto, "auto", "the faster one on this device"),
    word(GBufferChoice::Raster, "raster", "rasterized triangles"),
    word(GBufferChoice::Compute, "compute", "nearest hit of one ray per pixel"),
};

inline constexpr std::array kSamplingWords = {
    word(Sampling::Full, "full", "every pixel evaluates its candidate lights"),
    word(Sampling::HalfCheckerboard, "checkerboard", "one pixel of each 2 x 2 chooses for all four"),
    word(Sampling::HalfRooks, "rooks", "the same, every row and column of each 4 x 4 once"),
};
inline constexpr std::array kNoiseWords = {
    word(Noise::Blue, "blue", "spatio-temporal blue noise, made for the filters that follow"),
    word(Noise::White, "white", "independent numbers: no filter profits, no pattern repeats"),
};
inline constexpr std::array kDimLightsWords = {
    word(DimLights::Roulette, "roulette", "raised to the threshold or left out by chance: unbiased"),
    word(DimLights::Drop, "drop", "left out: loses their light"),
    word(DimLights::Keep, "keep", "chosen by their weight: fireflies"),
};
inline constexpr std::array kResampleFromWords = {
    word(ResampleFrom::Cell, "cell", "the lights of the pixel's cell, each as likely"),
    word(ResampleFrom::Power, "power", "all lights of the scene, by power"),
    word(ResampleFrom::Hierarchy, "hierarchy", "all lights of the scene, by a tree of them"),
};
inline constexpr std::array kReuseWeightsWords = {
    word(ReuseWeights::Counts, "counts",
         "as if each could have drawn all: loses light, and gives rare ones far too much"),
    word(ReuseWeights::Targets, "targets",
         "by what it would give each of them unshadowed: loses light at shadows' edges"),
    word(ReuseWeights::Rays, "rays", "by what each of them sees of it, at a ray each: unbiased"),
};
inline constexpr std::array kPictureWords = {
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

} // namespace kilolux
