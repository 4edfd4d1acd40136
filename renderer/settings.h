// The settings of a frame: one struct that code reads as plain, typed members, and one table that drives the
// command line, JSON, presets and the window. A new setting is a member with its default here and its row in
// settings_table.cpp; a member without a row does not compile.
#pragma once

#include "renderer/document/result.h"

#include <cstdint>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace kilolux {

enum class PixelFilter { Box, BlackmanHarris };
enum class ToneMap { Neutral, None };
enum class TracerChoice { Auto, Compute, RayQuery };
enum class GBufferChoice { Auto, Raster, Compute };
enum class Noise { Blue, White };
enum class Sampling { Full, HalfCheckerboard, HalfRooks };
enum class DimLights { Roulette, Drop, Keep };
enum class ResampleFrom { Cell, Power, Hierarchy };
enum class ReuseWeights { Counts, Targets, Rays };
enum class PictureChoice { Viewport, Denoised, Mean, Raw };

// A number that the program finds by itself unless the user gives one.
struct AutoNumber {
    bool automatic = true;
    double value = 0.0; // read only when `automatic` is false

    bool operator==(const AutoNumber&) const = default;
    double valueOr(double found) const { return automatic ? found : value; }
};

struct Settings {
    AutoNumber exposureEv100;
    double raysPerPixel = 1.0;
    int raysPerLight = 1;
    double penumbraScale = 1.0;
    int shadowMapSize = 256;
    int shadowSamples = 16;
    bool lightGrid = true;
    int gridThreadLights = 256;
    bool jitter = true;
    PixelFilter pixelFilter = PixelFilter::BlackmanHarris;
    ToneMap toneMap = ToneMap::Neutral;
    bool fill = true;
    TracerChoice tracer = TracerChoice::Auto;
    GBufferChoice gbuffer = GBufferChoice::Auto;
    Sampling sampling = Sampling::Full;
    double upsampleDepth = 50.0;
    double upsampleNormal = 8.0;
    double upsampleLeast = 0.01;
    double upsampleReach = 0.125;
    Noise noise = Noise::Blue;
    bool compactRays = true;
    bool guiding = true;
    int listLength = 12;
    int listMemory = 8;
    bool areaMasks = true;
    double maskHiddenShare = 0.1;
    double maskSize = 1.0;
    double maskSamples = 4.0;
    double hiddenShare = 0.2;
    double missHiddenShare = 0.5;
    double hiddenSeenShare = 0.8;
    double hiddenRelaxedBelow = 0.02;
    double directionalShare = 0.5;
    double directionalFreeBelow = 0.002;
    double domeBudget = 0.5;
    int cellCandidates = 12;
    int missCandidates = 32;
    int editFrames = 8;
    int editFirstFrames = 3;
    double editHistory = 3.5;
    int freshLights = 8;
    DimLights dimLights = DimLights::Roulette;
    double dimThreshold = 0.001;
    int resampleCandidates = 16;
    ResampleFrom resampleFrom = ResampleFrom::Cell;
    double reuseFrames = 4.0;
    int reuseNeighbours = 3;
    double reuseRadius = 8.0;
    ReuseWeights reuseWeights = ReuseWeights::Counts;
    PictureChoice picture = PictureChoice::Viewport;
    double settleError = 0.5;
    double settleBegin = 4.0;
    int settleFirstFrames = 12;
    int settleFullFrames = 48;
    double settleFaultBegin = 1.5;
    double settleFaultSure = 3.0;
    bool denoise = true;
    double diffuseFrames = 24.0;
    double specularFrames = 16.0;
    double leastFrames = 4.0;
    double clipWidth = 0.6;
    double clipExtent = 0.1;
    double momentFrames = 12.0;
    double depthTolerance = 0.02;
    double normalTolerance = 0.8;
    double spatialRadius = 8.0;
    double spatialThreshold = 0.05;
    int spatialTaps = 6;
    int spatialTapsNew = 12;
    double spatialNewFrames = 4.0;
    double spatialDeviations = 1.0;
    double spatialPlane = 1.5;
    double spatialNormal = 6.0;
    bool antiAlias = true;
    double antiAliasFrames = 64.0;
    double antiAliasClip = 1.25;
    double antiAliasSureClip = 6.0;
    double antiAliasExtent = 0.02;
    double antiAliasLeastFrames = 4.0;
    double antiAliasMovingFrames = 16.0;
    double antiAliasMomentFrames = 16.0;
    double renderScale = 1.0;
    double timeS = 0.0;
    double timeStepS = 0.0;
    double cameraTurn = 0.0;
    double cameraDolly = 0.0;
    double lightsSway = 0.0;
    int freezeFrame = 0;
    bool freezeNoise = false;
    bool freezeLists = false;
    bool freezeHistory = false;

    bool operator==(const Settings&) const = default;
};

// ---------------------------------------------------------------------------------------------------------
// The table

// One word that a choice accepts, with what it means.
struct SettingWord {
    int value; // of the enum
    std::string_view word;
    std::string_view help;
};

// A choice of words. The two functions reach the typed enum member that the row was made for.
struct ChoiceMember {
    std::span<const SettingWord> words;
    int (*get)(const Settings&);
    void (*set)(Settings&, int);
};

struct SettingRow {
    std::string_view name;
    std::variant<bool Settings::*, int Settings::*, double Settings::*, AutoNumber Settings::*, ChoiceMember>
        member;
    double min = -std::numeric_limits<double>::infinity(); // numbers only, inclusive, in `unit`
    double max = std::numeric_limits<double>::infinity();
    std::string_view unit; // empty: a plain number
    std::string_view help; // one line
    bool expert = false;   // listed apart: what defaults and presets leave alone
};

// Every setting, in the order in which people should read them.
std::span<const SettingRow> settingRows();

// The row named `name`, or null.
const SettingRow* findSetting(std::string_view name);

// ---------------------------------------------------------------------------------------------------------
// Text and JSON

// Applies one "key=value"; "preset=NAME" is the preset of that name. The message of the error names the key,
// the value, and what was expected: the nearest known key, the range with its unit, or the words of the
// choice. On error `settings` is untouched.
std::optional<Error> applySetting(Settings& settings, std::string_view keyValue);

// Applies an object { name: value, ... }, all or nothing. Words and "auto" are strings.
std::optional<Error> applySettings(Settings& settings, const nlohmann::json& object);

std::string settingTypeText(const SettingRow& row); // "true|false", "0.25 to 16", "auto|compute|rayQuery"
std::string settingValueText(const SettingRow& row, const Settings& settings); // as applySetting reads it

// All settings with their values; keys sorted, so that equal settings give equal text.
nlohmann::json settingsJson(const Settings& settings);

// FNV-1a, 64 bits, of the text of settingsJson: the same on every machine and in every run.
std::uint64_t settingsHash(const Settings& settings);

} // namespace kilolux
