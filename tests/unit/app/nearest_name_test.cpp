// What a mistyped name is answered with.
#include "renderer/nearest_name.h"

#include <gtest/gtest.h>
#include <vector>

namespace kilolux {
namespace {

constexpr std::string_view kNames[] = {"jitter", "toneMap", "tracer", "raysPerPixel"};

TEST(NearestName, FindsSlipsOfTheHand) {
    EXPECT_EQ(nearestName("jiter", kNames), "jitter");   // dropped
    EXPECT_EQ(nearestName("jittter", kNames), "jitter"); // doubled
    EXPECT_EQ(nearestName("jutter", kNames), "jitter");  // replaced
    EXPECT_EQ(nearestName("JITTER", kNames), "jitter");  // case is no mistake
    EXPECT_EQ(nearestName("raysPerPixl", kNames), "raysPerPixel");
    EXPECT_EQ(nearestName("tone", kNames), "") << "three of seven letters missing is too far";
}

TEST(NearestName, IsEmptyWhenNothingIsNear) {
    EXPECT_EQ(nearestName("exposure", kNames), "");
    EXPECT_EQ(nearestName("", kNames), "");
    EXPECT_EQ(nearestName(std::string(100000, 'j'), kNames), "");
    EXPECT_EQ(nearestName("jitter", {}), "");
}

TEST(NearestName, HintsNameOneOrAll) {
    EXPECT_EQ(nearestNameHint("tracr", kNames), "did you mean 'tracer'?");
    EXPECT_EQ(nearestNameHint("xyz", kNames), "choose one of: jitter, toneMap, tracer, raysPerPixel");
}

TEST(NearestName, LongListsAreCut) {
    const std::vector<std::string_view> many(45, "light");
    const std::string hint = namesHint(many);
    EXPECT_TRUE(hint.ends_with(", light and 5 more")) << hint;
}

} // namespace
} // namespace kilolux
