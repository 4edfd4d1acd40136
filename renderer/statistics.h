// What a rendered frame cost and what it was made of, and its JSON form (kilolux render --stats).
#pragma once

#include "renderer/legend.h"
#include "renderer/settings.h"

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

namespace kilolux {

struct PassTiming {
    std::string name;
    double medianMs = 0.0; // over the rendered frames
    double p95Ms = 0.0;
    double perFrameMs = 0.0; // the median times the share of the frames in which it ran
};

struct MemoryCause {
    std::string cause; // "targets", "bvh", "textures", ...
    double peakMiB = 0.0;
};

// Of the method 'shadow-maps'.
struct ShadowMapUse {
    std::size_t faces = 0; // that all lights have
    std::uint32_t sizePx = 0;
    std::size_t drawn = 0; // in all frames
};

struct FrameStatistics {
    std::string device;
    std::string driver;
    std::string timing; // "timestamps" where the GPU's clock is good, else "wall"
    int width = 0;      // pixels
    int height = 0;
    int frames = 0;
    std::uint32_t seed = 0;
    std::size_t lights = 0;
    double lightsInRangeMean = 0.0; // within range, cone and side; per pixel that shows a surface
    double lightsTestedMean = 0.0;  // length of the list that a pixel walks: over-inclusion shows against it
    // Of the stochastic method; 0 for the others.
    double candidatesMean = 0.0;         // lights that a pixel evaluates in a frame
    double raysPerPixelMean = 0.0;       // traced, per pixel that shows a surface and may sample
    double usefulRaysPerPixelMean = 0.0; // those that met their light
    double missedShare = 0.0;            // pixels whose reprojection failed
    double droppedLightMean = 0.0; // share of the unshadowed light a pixel weighed that dimLights=drop lost
    double listLengthMean = 0.0;   // lights on a tile's visible list
    double listOverflowMean = 0.0; // lights for which it had no room
    std::size_t triangles = 0;     // instances counted each
    std::vector<std::string> featuresOn;
    std::vector<std::string> featuresOff; // "Name: why"
    std::vector<PassTiming> passes;       // in frame order
    double directLightingMs = 0.0;        // per frame: culling to denoising, or the method's own lighting
    double frameMs = 0.0;                 // per frame, all passes
    double wallMs = 0.0;                  // all frames, from the first submit to the picture
    std::uint64_t rays = 0;               // all frames
    std::vector<MemoryCause> gpuMemory;
    double gpuMemoryPeakMiB = 0.0; // of everything at once; at most the sum of the causes
    std::vector<std::pair<std::string, double>>
        firstDispatchMs;    // pass and its first dispatch, compiler included
    double startupMs = 0.0; // process start to the first picture
    double exposureEv100 = 0.0;
    double fillNit = 0.0;              // plain ambient light in the picture, which is not direct light
    int rangesDerived = 0;             // lights without a range of their own
    std::uint32_t gridIndices = 0;     // light indices in the lists of the last frame's light grid
    std::uint32_t gridTests = 0;       // light-cell tests that made them
    std::uint32_t gridCoarseCells = 0; // cells that took their coarse cell's list for want of room
    ShadowMapUse shadowMaps;
    double bvhBuildMs = 0.0;              // flattening, pairing, building
    double bvhBytesPerTriangle = 0.0;     // nodes and triangles together
    std::string historyReset;             // why history last began anew
    std::string view;                     // that the last frame shows
    Legend legend;                        // of that view
    std::string viewProblem;              // why the picture is shown instead of a pass's output
    std::vector<std::string> viewOutputs; // of a view of a pass: the images that it writes, by GLSL name
    std::vector<std::string> notes;       // what the renderer decided for the user, one line each
};

// The object that --stats writes: field names as above, `passes` by name, `gpuMemoryMiB` by cause and
// "total", `features` { on, off }, `settings` and `settingsHash` (16 hexadecimal digits).
nlohmann::ordered_json statisticsJson(const FrameStatistics& statistics, const Settings& settings);

} // namespace kilolux
