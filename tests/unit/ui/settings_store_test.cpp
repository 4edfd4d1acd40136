// What the window remembers comes back, and a file that others have spoiled does no harm.
#include "renderer/document/file_replace.h"
#include "ui/settings_store.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <unistd.h>

namespace kilolux {
namespace {

std::filesystem::path freshPath(const char* name) {
    const auto path = std::filesystem::temp_directory_path() /
                      (std::string("kilolux-") + name + std::to_string(getpid())) / "kilolux" / "window.json";
    std::filesystem::remove_all(path.parent_path().parent_path());
    return path;
}

// Every member differs from what it is by default: one that is forgotten on either way shows.
Remembered everythingChanged() {
    Remembered r;
    r.windowWidth = 1111;
    r.windowHeight = 666;
    r.uiScale = 1.75;
    r.leftWidth = 301.5;
    r.rightWidth = 402.5;
    r.panels = {false, false, false, false, false};
    r.snapping = {true, 0.25, 7.5, 0.5};
    r.gizmoSizePx = 120.0;
    r.limits = {55.0, 0.45, 12, 123'456, 7.5, 333.0};
    r.preset = "draft";
    r.recent = {"/a.glb", "/b \"quoted\".glb"};
    r.locked = {{"/a.glb", {"Lamp", "L\xC3\xA4mp"}}};
    return r;
}

nlohmann::json jsonOf(const std::filesystem::path& path) {
    const Result<std::string> text = readWholeFile(path);
    EXPECT_TRUE(text);
    return nlohmann::json::parse(text ? text.value() : "null");
}

TEST(Remembered, EveryMemberComesBack) {
    const auto path = freshPath("remembered"), other = freshPath("defaults");
    const Remembered before = everythingChanged();
    ASSERT_FALSE(writeRemembered(path, before));
    EXPECT_TRUE(readRemembered(path) == before);
    ASSERT_FALSE(writeRemembered(other, Remembered()));
    const nlohmann::json changed = jsonOf(path), defaults = jsonOf(other);
    ASSERT_EQ(changed.size(), defaults.size());
    for (const auto& [name, value] : defaults.items())
        EXPECT_NE(changed.at(name), value) << name << ": the test is to change every member";
    EXPECT_TRUE(readRemembered(other) == Remembered());
}

TEST(Remembered, ScenesStandOnceTheNewestFirst) {
    Remembered r;
    for (const char* scene : {"/a.glb", "/b.glb", "/a.glb"})
        rememberScene(r, scene);
    EXPECT_EQ(r.recent, (std::vector<std::string>{"/a.glb", "/b.glb"}));
    r.locked = {{"/a.glb", {"Lamp"}}, {"/gone.glb", {"Lamp"}}, {"/b.glb", {}}};
    const auto path = freshPath("locks");
    ASSERT_FALSE(writeRemembered(path, r));
    EXPECT_EQ(readRemembered(path).locked.size(), 1u) << "of recent scenes alone";
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
