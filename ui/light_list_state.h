// What the light list remembers between frames.
#pragma once

#include "ui/desk.h"
#include "ui/light_color.h"
#include "ui/light_list_model.h"

namespace kilolux {

struct LightListState {
    LightListModel model;
    LightListQuery query;
    RowAnchor anchor;
    LightColors colors;
    std::vector<std::uint64_t> seenSelection; // what the list has scrolled to
    std::uint64_t renaming = 0;               // light or group whose name is being typed; 0: none
    LightRow::Kind renamingKind = LightRow::Kind::Light;
    std::string renameText;
    bool renameBegins = false; // the field has yet to take the keyboard
    bool showsHistory = false;
};

LightListState& lightListOf(Desk& desk); // made on first use

// Starts typing a new name in the list.
void beginRename(Desk& desk, LightRow::Kind kind, std::uint64_t id);

// The steps of the document, to go back and forth by a click; below the list.
void drawHistoryPanel(Desk& desk);

} // namespace kilolux
