// The table of keys: no two rows for one key, and what stands in conventions.md.
#include "ui/keys.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>
#include <set>
#include <tuple>

namespace kilolux {
namespace {

TEST(Keys, EachMeansOneThing) {
    std::set<std::tuple<int, bool, bool>> seen;
    for (const KeyRow& row : keyRows()) {
        if (row.action == KeyAction::None) continue;
        EXPECT_TRUE(seen.insert({row.key, row.ctrl, row.shift}).second) << row.keys;
        EXPECT_EQ(actionOf(row.key, row.ctrl, row.shift), row.action) << row.keys;
    }
    EXPECT_EQ(actionOf(GLFW_KEY_W, false, false), KeyAction::MoveTool);
    EXPECT_EQ(actionOf(GLFW_KEY_S, false, true), KeyAction::Solo);
    EXPECT_EQ(actionOf(GLFW_KEY_D, true, false), KeyAction::Duplicate);
    EXPECT_EQ(actionOf(GLFW_KEY_D, false, false), KeyAction::None); // flies
    EXPECT_EQ(actionOf(GLFW_KEY_S, true, false), KeyAction::None);  // saves
}

} // namespace
} // namespace kilolux
