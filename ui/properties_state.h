// What the properties panel remembers between frames.
#pragma once

#include "ui/desk.h"
#include "ui/light_fields.h"

#include <array>
#include <map>

namespace kilolux {

struct PropertiesState {
    // The selection that the rest is about.
    std::vector<std::uint64_t> selection;
    std::uint64_t version = 0;
    Sharing sharing = Sharing::MakeUnique; // until something else is selected
    int othersSharing = 0;
    std::map<std::string_view, CommonValue> values; // by field
    std::array<CommonValue, 6> coordinates;         // position and angles; without a value: not read yet
    std::vector<bool> applies;                      // lightFields() that all have and that are shown
    bool wantsFlaps = false;                        // four flaps to be shown though they are alike
    std::vector<int> meshNodes;                     // those with a mesh that the search finds
    std::string meshSearch;
    int meshes = 0, reached = 0;          // in the scene; of these by a light of the selection
    std::vector<std::string> fileChoices; // of the open choice of a file
    glm::dvec3 eulerRad{0.0};             // as shown, so that angles do not jump to their twins

    // Typing: the field's id, and what is in it.
    std::string editing, text;
    bool editBegins = false;
    int fieldCount = 0; // of this frame, for Tab
    int editIndex = -1; // field that is being typed in
    int editNext = -1;  // that Tab has asked for

    // Dragging a number.
    std::string dragging;
    std::string givenUp; // whose drag Esc has ended, until the button is released
    double dragPx = 0.0;
    Scene dragStart;
    std::uint64_t drags = 0; // so far, for keys of their own
    bool hasDragged = false; // the newest step is this drag's
};

PropertiesState& propertiesOf(Desk& desk); // made on first use

// Whether edits of shared definitions make the light its own first.
Sharing sharingOf(const Desk& desk);

// Whether these lights' doors are shown as one pair of numbers or flap by flap.
DoorNumbers doorNumbers(Desk& desk, std::span<const std::uint64_t> lights);

// Gives a drag of a number up; false: there is none.
bool cancelPropertyDrag(Desk& desk);

} // namespace kilolux
