// What the window remembers comes back, and a file that others have spoiled does no harm.
#include "renderer/document/file_replace.h"
#include "ui/settings_store.h"

#include <gtest/gtest.h>

#include <unistd.h>

namespace kilolux {
namespace {

std::filesystem::path freshPath(const char* name) {
    const auto path = std::filesystem::temp_directory_path() /
                      (std::string("kilolux-") + name + std::to_string(getpid())) / "kilolux" / "window.json";
    std::filesystem::remove_all(path.parent_path().parent_path());
    return path;
}

TEST(Remembered, ComesBack) {
    const auto path = freshPath("remembered");
    Remembered before;
    before.windowWidth = 1111;
    before.leftWidth = 301.5;
    before.panels.outlines = false;
    before.snapping.angleDeg = 7.5;
    before.limits.meanFrames = 12;
    rememberScene(before, "/a.glb");
    rememberScene(before, "/b.glb");
    rememberScene(before, "/a.glb");
    ASSERT_FALSE(writeRemembered(path, before));
    const Remembered after = readRemembered(path);
    EXPECT_EQ(after.windowWidth, 1111);
    EXPECT_EQ(after.leftWidth, 301.5);
    EXPECT_FALSE(after.panels.outlines);
    EXPECT_EQ(after.snapping.angleDeg, 7.5);
    EXPECT_EQ(after.limits.meanFrames, 12u);
    EXPECT_EQ(after.recent, (std::vector<std::string>{"/a.glb", "/b.glb"}));
}

TEST(Remembered, WrongContentKeepsTheDefaults) {
    const auto path = freshPath("spoiled");
    std::filesystem::create_directories(path.parent_path());
    const Remembered defaults;
    for (const char* text : {"", "{", "[1]", R"({"windowWidth": "wide", "panels": 3, "recent": {"a": 1}})",
                             R"({"windowWidth": 1e300, "leftWidth": -5, "recent": [1, null]})"}) {
        ASSERT_FALSE(replaceFile(path, text));
        const Remembered read = readRemembered(path);
        EXPECT_GE(read.windowWidth, 320) << text;
        EXPECT_LE(read.windowWidth, 16384) << text;
        EXPECT_GE(read.leftWidth, 160.0) << text;
        EXPECT_EQ(read.panels.all, defaults.panels.all) << text;
        EXPECT_TRUE(read.recent.empty()) << text;
    }
}

} // namespace
} // namespace kilolux
