// Statistics to JSON, in the order in which a person reads them.
#include "renderer/statistics.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace kilolux {

nlohmann::ordered_json statisticsJson(const FrameStatistics& s, const Settings& settings) {
    using Json = nlohmann::ordered_json;
    Json passes = Json::object();
    for (const PassTiming& pass : s.passes)
        passes[pass.name] = {{"medianMs", pass.medianMs}, {"p95Ms", pass.p95Ms}};
    Json memory = Json::object();
    for (const MemoryCause& cause : s.gpuMemory)
        memory[cause.cause] = cause.peakMiB;
    memory["total"] = s.gpuMemoryPeakMiB;
    Json firstDispatch = Json::object();
    for (const auto& [pass, ms] : s.firstDispatchMs)
        firstDispatch[pass] = ms;

    Json json;
    json["device"] = s.device;
    json["driver"] = s.driver;
    json["timing"] = s.timing;
    json["width"] = s.width;
    json["height"] = s.height;
    json["frames"] = s.frames;
    json["seed"] = s.seed;
    json["settings"] = settingsJson(settings);
    json["settingsHash"] = fmt::format("{:016x}", settingsHash(settings));
    json["lights"] = s.lights;
    json["lightsInRangeMean"] = s.lightsInRangeMean;
    json["lightsTestedMean"] = s.lightsTestedMean;
    json["sampling"] = {{"candidatesMean", s.candidatesMean},
                        {"raysPerPixelMean", s.raysPerPixelMean},
                        {"usefulRaysPerPixelMean", s.usefulRaysPerPixelMean},
                        {"missedShare", s.missedShare},
                        {"droppedLightMean", s.droppedLightMean},
                        {"listLengthMean", s.listLengthMean},
                        {"listOverflowMean", s.listOverflowMean}};
    json["triangles"] = s.triangles;
    json["features"] = {{"on", s.featuresOn}, {"off", s.featuresOff}};
    json["passes"] = std::move(passes);
    json["directLightingMs"] = s.directLightingMs;
    json["frameMs"] = s.frameMs;
    json["wallMs"] = s.wallMs;
    json["rays"] = s.rays;
    json["gpuMemoryMiB"] = std::move(memory);
    json["firstDispatchMs"] = std::move(firstDispatch);
    json["startupMs"] = s.startupMs;
    json["exposureEv100"] = s.exposureEv100;
    if (s.fillNit > 0.0) json["fill"] = {{"nit", s.fillNit}, {"note", "not direct light"}};
    json["rangesDerived"] = s.rangesDerived;
    json["bvh"] = {{"buildMs", s.bvhBuildMs}, {"bytesPerTriangle", s.bvhBytesPerTriangle}};
    json["lightGrid"] = {
        {"indices", s.gridIndices}, {"tests", s.gridTests}, {"coarseCells", s.gridCoarseCells}};
    if (s.shadowMaps.faces > 0) {
        json["shadowMaps"] = {
            {"faces", s.shadowMaps.faces}, {"sizePx", s.shadowMaps.sizePx}, {"drawn", s.shadowMaps.drawn}};
    }
    json["historyReset"] = s.historyReset;
    json["view"] = s.view;
    json["notes"] = s.notes;
    return json;
}

} // namespace kilolux
