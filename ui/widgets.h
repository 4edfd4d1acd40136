// Small controls that several panels share.
#pragma once

#include "ui/desk.h"

#include <string>
#include <string_view>

namespace kilolux {

// Unscaled pixels to those of this screen, on whole ones.
float px(const Desk& desk, double units);

enum class ButtonLook { Plain, Active, Disabled };
// A square button. `name` is its id and its place for tests; `tip` shows after a moment.
bool iconButton(Desk& desk, const char* name, const char* icon, const char* tip,
                ButtonLook look = ButtonLook::Plain);
bool textButton(Desk& desk, const char* name, const char* text, ButtonLook look = ButtonLook::Plain);

// ImGui::BeginCombo in one piece with its arrow.
bool beginCombo(const char* id, const char* preview);

// The last item's help, after the pointer has rested on it.
void tooltip(const char* text);

// Text in at most `widthPx`, with an ellipsis and the whole of it on hover.
void textWithin(std::string_view text, float widthPx);

// Within an open popup: Esc closes it. Without keyboard navigation ImGui leaves that to us.
void closePopupOnEscape();
bool isPopupOpen(); // any: keys are its

// A thin bar across what is left of the row; share: 0 to 1.
void progressBar(Desk& desk, double share);

// Names the last item for tests.
void mark(Desk& desk, const std::string& name);

} // namespace kilolux
