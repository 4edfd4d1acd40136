// Which events share a UI frame, see event_queue.h.
#include "ui/event_queue.h"

#include <set>
#include <utility>

namespace kilolux {

namespace {

// What the frame has already been given.
struct FrameSoFar {
    std::set<std::pair<InputEvent::Kind, int>> flipped; // keys and buttons
    bool pressedAny = false;                            // a key, button or wheel step
    bool pointerActed = false;                          // a button or wheel step: the pointer must not move
    // A drag must see this before it ends. And an item that others may overlap, as a tab, takes no press in
    // the first frame in which the pointer is over it.
    bool pointerMoved = false;
    bool text = false;
    bool commandKey = false; // one that writes nothing, as Backspace

    bool takes(const InputEvent& event) const {
        using Kind = InputEvent::Kind;
        switch (event.kind) {
        case Kind::Move:
            return !pointerActed;
        case Kind::Wheel:
            return flipped.empty() || !pointerActed;
        case Kind::Button:
            return !flipped.contains({event.kind, event.code}) && !pointerActed && !pointerMoved;
        case Kind::Key:
            // A modifier is a state of the frame: it must not reach what came before it.
            if (event.modifier && pressedAny) return false;
            if (event.down && !event.writes && !event.modifier && text) return false;
            return !flipped.contains({event.kind, event.code});
        case Kind::Text:
            return !commandKey;
        }
        return false;
    }

    void note(const InputEvent& event) {
        using Kind = InputEvent::Kind;
        const bool flips = event.kind == Kind::Key || event.kind == Kind::Button;
        if (flips) flipped.insert({event.kind, event.code});
        pressedAny |= (flips && !event.modifier) || event.kind == Kind::Wheel;
        pointerActed |= event.kind == Kind::Button || event.kind == Kind::Wheel;
        pointerMoved |= event.kind == Kind::Move;
        text |= event.kind == Kind::Text;
        commandKey |= event.kind == Kind::Key && event.down && !event.writes && !event.modifier;
    }
};

} // namespace

std::vector<InputEvent> EventQueue::takeFrame() {
    std::vector<InputEvent> frame;
    FrameSoFar soFar;
    while (!events_.empty() && soFar.takes(events_.front())) {
        soFar.note(events_.front());
        frame.push_back(events_.front());
        events_.pop_front();
    }
    return frame;
}

} // namespace kilolux
