// Undo and redo, merging of drags.
#include "renderer/document/history.h"
#include "tests/unit/edits/edits_kit.h"

namespace kilolux {
namespace {

using namespace test;

class HistoryTest : public testing::Test {
  protected:
    void drag(double intensity, const std::string& key = "drag") {
        auto edits = setField(scene_, EditTarget::Light, 2, "intensity", intensity);
        ASSERT_TRUE(edits) << edits.error();
        ASSERT_FALSE(history_.apply(scene_, {"Intensity", key, edits.value()}));
    }
    double intensity() const { return defOf(scene_, "Point").intensity; }

    Scene scene_ = everyLight().import();
    History history_;
};

TEST_F(HistoryTest, DragsMergeUntilSealed) {
    const double start = intensity();
    for (const double value : {2.0, 3.0, 4.0})
        drag(value);
    history_.seal();
    drag(5.0);
    drag(6.0, "another");
    drag(7.0, "");
    drag(8.0, "");
    std::vector<double> values;
    while (history_.canUndo()) {
        EXPECT_EQ(history_.undoName(), "Intensity");
        ASSERT_FALSE(history_.undo(scene_));
        values.push_back(intensity());
    }
    EXPECT_EQ(values, (std::vector<double>{7.0, 6.0, 5.0, 4.0, start}));
    EXPECT_TRUE(history_.undo(scene_)) << "nothing left";
    while (history_.canRedo())
        ASSERT_FALSE(history_.redo(scene_));
    EXPECT_EQ(intensity(), 8.0);
    EXPECT_TRUE(history_.redo(scene_));
}

TEST_F(HistoryTest, UndoEndsADrag) {
    drag(2.0);
    drag(3.0);
    ASSERT_FALSE(history_.undo(scene_));
    drag(4.0);
    EXPECT_FALSE(history_.canRedo()) << "a new change forgets what could be redone";
    ASSERT_FALSE(history_.undo(scene_));
    EXPECT_EQ(intensity(), 1.0);
}

TEST_F(HistoryTest, CancelLeavesNothing) {
    drag(2.0, "");
    const std::uint64_t state = history_.state();
    drag(3.0);
    drag(4.0);
    ASSERT_FALSE(history_.cancel(scene_));
    EXPECT_EQ(intensity(), 2.0);
    EXPECT_FALSE(history_.canRedo());
    EXPECT_EQ(history_.state(), state);
    ASSERT_FALSE(history_.cancel(scene_));
    EXPECT_EQ(intensity(), 2.0) << "what was no drag stays";
}

TEST_F(HistoryTest, DragOfASharedDefinitionIsOneStep) {
    const std::uint64_t spot = lightNamed(scene_, "Spot");
    const std::size_t defs = scene_.lightDefs.size();
    for (const double value : {2.0, 3.0}) {
        auto edits = setField(scene_, EditTarget::Light, spot, "intensity", value);
        ASSERT_TRUE(edits);
        ASSERT_FALSE(history_.apply(scene_, {"Intensity", "spot", edits.value()}));
    }
    EXPECT_EQ(scene_.lightDefs.size(), defs + 1);
    ASSERT_FALSE(history_.undo(scene_));
    EXPECT_EQ(scene_.lightDefs.size(), defs);
    EXPECT_FALSE(history_.canUndo());
    ASSERT_FALSE(history_.redo(scene_));
    EXPECT_EQ(defOf(scene_, "Spot").intensity, 3.0);
    EXPECT_EQ(defOf(scene_, "Spot two").intensity, 40.25);
}

} // namespace
} // namespace kilolux
