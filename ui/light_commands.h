// What keys, menus and buttons do to the lights of the desk: each is one undoable step with a name, or a
// change of what is seen. They tell the user when there is nothing to do.
#pragma once

#include "ui/desk.h"

namespace kilolux {

// On the surface that is seen at that place of the picture, or in the air before the camera.
void addLightAtPixel(Desk& desk, LightType type, glm::dvec2 px);
void duplicateSelection(Desk& desk);
void deleteSelection(Desk& desk);
void toggleMute(Desk& desk, const std::vector<std::uint64_t>& lights);
void copySelection(Desk& desk);
void cutSelection(Desk& desk);
void pasteLights(Desk& desk);
void groupSelection(Desk& desk);
void ungroupSelection(Desk& desk); // dissolves every group that a selected light belongs to
void dissolveGroup(Desk& desk, std::uint64_t group);
void renameLights(Desk& desk, const std::vector<std::uint64_t>& lights, const std::string& name);
void lookThroughLight(Desk& desk); // and back

// Only these lights are rendered; the same ones again: all are. A view, not an edit.
void toggleSolo(Desk& desk, const std::vector<std::uint64_t>& lights);
// Locked lights cannot be picked or dragged in the viewport.
void toggleLock(Desk& desk, const std::vector<std::uint64_t>& lights);
bool isLocked(const Desk& desk, std::uint64_t light);

} // namespace kilolux
