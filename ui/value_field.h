// The field that all numbers of the properties panel have: a click types, dragging sideways offsets.
#pragma once

#include "ui/properties_state.h"

namespace kilolux {

struct FieldText {
    std::string shown;                                         // digits, or 'mixed'
    std::string unit;                                          // dim, behind it
    std::string typed;                                         // what editing begins with
    enum class Tone { Bright, Dim, Name } tone = Tone::Bright; // names stand to the left
};

struct FieldEvent {
    enum class Kind { None, Typed, Dragged } kind = Kind::None;
    std::string text;    // Typed
    double pixels = 0.0; // Dragged: since the press
};

enum class FieldDrag { Sideways, Never };

// `id` names it for tests as well. `widthPx`: of the field.
FieldEvent valueField(Desk& desk, const std::string& id, const FieldText& text, float widthPx,
                      const char* help, FieldDrag drag = FieldDrag::Sideways);

// The key of the present drag's undo step, and that a step of it has been made.
std::string dragKey(const PropertiesState& state);
void noteDragged(Desk& desk);

} // namespace kilolux
