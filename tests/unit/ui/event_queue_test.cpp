// What a UI frame gets of the events that came since the last one: none may hide another.
#include "ui/event_queue.h"

#include <gtest/gtest.h>

namespace kilolux {
namespace {

using Kind = InputEvent::Kind;

InputEvent key(int code, bool down, bool writes = false) {
    InputEvent event;
    event.kind = Kind::Key;
    event.code = code;
    event.down = down;
    event.writes = writes;
    return event;
}

InputEvent modifier(int code, bool down) {
    InputEvent event = key(code, down);
    event.modifier = true;
    return event;
}

InputEvent button(bool down, double x) {
    InputEvent event;
    event.kind = Kind::Button;
    event.down = down;
    event.px = {x, 0.0};
    return event;
}

InputEvent move(double x) {
    InputEvent event;
    event.px = {x, 0.0};
    return event;
}

InputEvent text(char character) {
    InputEvent event;
    event.kind = Kind::Text;
    event.character = std::uint32_t(character);
    return event;
}

// How many events each frame takes.
std::vector<std::size_t> frames(const std::vector<InputEvent>& events) {
    EventQueue queue;
    for (const InputEvent& event : events)
        queue.push(event);
    std::vector<std::size_t> counts;
    while (!queue.empty())
        counts.push_back(queue.takeFrame().size());
    return counts;
}

using Counts = std::vector<std::size_t>;

TEST(EventQueue, AKeyPressedAndReleasedInOnePollIsSeenDown) {
    EXPECT_EQ(frames({key(70, true), key(70, false)}), (Counts{1, 1}));
}

TEST(EventQueue, AClickLandsWhereThePointerWas) {
    // The pointer is there a frame before the press, or what it has just reached would not take it; moves
    // behind the press must not move it.
    EXPECT_EQ(frames({move(1), move(2), button(true, 2), move(9), button(false, 9)}), (Counts{2, 1, 1, 1}));
    EXPECT_EQ(frames({button(true, 2), button(false, 2), button(true, 2), button(false, 2)}),
              (Counts{1, 1, 1, 1}));
}

TEST(EventQueue, ADragSeesItsLastMoveBeforeItEnds) {
    EXPECT_EQ(frames({button(true, 1), move(5), move(9), button(false, 9)}), (Counts{1, 2, 1}));
}

TEST(EventQueue, AModifierReachesNoEarlierKey) {
    EXPECT_EQ(frames({key(87, true), modifier(341, true), key(90, true)}), (Counts{1, 2}));
    EXPECT_EQ(frames({modifier(341, true), key(90, true), key(90, false), modifier(341, false)}),
              (Counts{2, 1, 1}));
    EXPECT_EQ(frames({modifier(340, true), button(true, 0), button(false, 0), modifier(340, false)}),
              (Counts{2, 1, 1}));
}

TEST(EventQueue, TypingKeepsItsOrder) {
    EXPECT_EQ(frames({key(65, true, true), text('a'), key(66, true, true), text('b')}), (Counts{4}));
    // Backspace between letters: ImGui would see letters and key without their order.
    EXPECT_EQ(frames({key(65, true, true), text('a'), key(259, true), key(66, true, true), text('b')}),
              (Counts{2, 2, 1}));
}

TEST(EventQueue, ManyMovesAreOneFrame) {
    EXPECT_EQ(frames({move(1), move(2), move(3), move(4)}), (Counts{4}));
}

} // namespace
} // namespace kilolux
