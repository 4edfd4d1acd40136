// The statistics file: every promised field, with its value in its place.
#include "renderer/statistics.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace kilolux {
namespace {

TEST(Statistics, JsonHoldsEveryField) {
    const FrameStatistics statistics{.device = "d",
                                     .driver = "v",
                                     .timing = "wall",
                                     .width = 11,
                                     .height = 12,
                                     .frames = 13,
                                     .seed = 4000000000u,
                                     .lights = 14,
                                     .lightsInRangeMean = 1.5,
                                     .lightsTestedMean = 2.5,
                                     .candidatesMean = 3.5,
                                     .raysPerPixelMean = 4.5,
                                     .usefulRaysPerPixelMean = 5.25,
                                     .missedShare = 6.5,
                                     .droppedLightMean = 0.75,
                                     .listLengthMean = 7.5,
                                     .listOverflowMean = 8.5,
                                     .triangles = 15,
                                     .featuresOn = {"A"},
                                     .featuresOff = {"B: none in the scene"},
                                     .passes = {{"z_first", 1.0, 2.0}, {"a_second", 3.0, 4.0}},
                                     .directLightingMs = 16.5,
                                     .frameMs = 17.5,
                                     .wallMs = 18.5,
                                     .rays = 5'000'000'000ull,
                                     .gpuMemory = {{"targets", 19.0}, {"bvh", 20.0}},
                                     .gpuMemoryPeakMiB = 38.0,
                                     .firstDispatchMs = {{"z_first", 21.0}},
                                     .startupMs = 22.0,
                                     .exposureEv100 = 5.5,
                                     .rangesDerived = 23,
                                     .gridIndices = 25,
                                     .gridTests = 26,
                                     .bvhBuildMs = 24.5,
                                     .bvhBytesPerTriangle = 41.0,
                                     .historyReset = "cut",
                                     .view = "depth",
                                     .notes = {"n"}};
    const Settings settings{.jitter = false};
    const nlohmann::ordered_json json =
        nlohmann::ordered_json::parse(statisticsJson(statistics, settings).dump());
    EXPECT_EQ(json["device"], "d");
    EXPECT_EQ(json["driver"], "v");
    EXPECT_EQ(json["timing"], "wall");
    EXPECT_EQ(json["width"], 11);
    EXPECT_EQ(json["height"], 12);
    EXPECT_EQ(json["frames"], 13);
    EXPECT_EQ(json["seed"], 4000000000u);
    EXPECT_EQ(json["settings"]["jitter"], false);
    EXPECT_EQ(json["settings"].size(), settingRows().size());
    EXPECT_EQ(std::stoull(json["settingsHash"].get<std::string>(), nullptr, 16), settingsHash(settings));
    EXPECT_EQ(json["settingsHash"].get<std::string>().size(), 16u);
    EXPECT_EQ(json["lights"], 14);
    EXPECT_EQ(json["historyReset"], "cut");
    EXPECT_EQ(json["view"], "depth");
    EXPECT_EQ(json["sampling"]["candidatesMean"], 3.5);
    EXPECT_EQ(json["sampling"]["raysPerPixelMean"], 4.5);
    EXPECT_EQ(json["sampling"]["usefulRaysPerPixelMean"], 5.25);
    EXPECT_EQ(json["sampling"]["missedShare"], 6.5);
    EXPECT_EQ(json["sampling"]["droppedLightMean"], 0.75);
    EXPECT_EQ(json["sampling"]["listLengthMean"], 7.5);
    EXPECT_EQ(json["sampling"]["listOverflowMean"], 8.5);
    EXPECT_EQ(json["exposureEv100"], 5.5);
    EXPECT_EQ(json["rangesDerived"], 23);
    EXPECT_EQ(json["bvh"]["buildMs"], 24.5);
    EXPECT_EQ(json["bvh"]["bytesPerTriangle"], 41.0);
    EXPECT_EQ(json["lightGrid"]["indices"], 25);
    EXPECT_EQ(json["lightGrid"]["tests"], 26);
    EXPECT_EQ(json["notes"], nlohmann::ordered_json({"n"}));
    EXPECT_EQ(json["lightsInRangeMean"], 1.5);
    EXPECT_EQ(json["lightsTestedMean"], 2.5);
    EXPECT_EQ(json["triangles"], 15);
    EXPECT_EQ(json["features"]["on"], nlohmann::ordered_json({"A"}));
    EXPECT_EQ(json["features"]["off"], nlohmann::ordered_json({"B: none in the scene"}));
    EXPECT_EQ(json["passes"].begin().key(), "z_first") << "passes stay in frame order";
    EXPECT_EQ(json["passes"]["a_second"]["medianMs"], 3.0);
    EXPECT_EQ(json["passes"]["a_second"]["p95Ms"], 4.0);
    EXPECT_EQ(json["directLightingMs"], 16.5);
    EXPECT_EQ(json["frameMs"], 17.5);
    EXPECT_EQ(json["wallMs"], 18.5);
    EXPECT_EQ(json["rays"], 5'000'000'000ull);
    EXPECT_EQ(json["gpuMemoryMiB"]["bvh"], 20.0);
    EXPECT_EQ(json["gpuMemoryMiB"]["total"], 38.0);
    EXPECT_EQ(json["firstDispatchMs"]["z_first"], 21.0);
    EXPECT_EQ(json["startupMs"], 22.0);
    EXPECT_EQ(json.size(), 30u) << "a field was added or lost: say so in the README";
}

} // namespace
} // namespace kilolux
