// Every panel and overlay, each in a file of its own. The layout (layout.cpp) has opened the region that a
// panel draws into; overlays draw onto the picture, clipped to the viewport.
#pragma once

#include "ui/desk.h"

#include <nlohmann/json_fwd.hpp>

struct ImDrawList;

namespace kilolux {

// --- bars
void drawTopBar(Desk& desk);
void drawCameraMenu(Desk& desk); // of the top bar: cameras and bookmarks
void drawStatusLine(Desk& desk);

// --- left column
void drawLightList(Desk& desk);

// --- on top of everything
void drawKeysHelp(Desk& desk); // every key (F1)
void drawProfileBrowser(Desk& desk);
void drawNotices(Desk& desk, const ViewportRect& rect);    // what the program says
void drawActivities(Desk& desk, const ViewportRect& rect); // what takes long, with the way out of it

// --- right column, one tab each
void drawProperties(Desk& desk);
void drawViewPanel(Desk& desk);       // view selector, legend, exposure, reference image
void drawProbePanel(Desk& desk);      // lights at a pixel, light meter
void drawStatisticsPanel(Desk& desk); // passes, memory, features

// --- on the picture, in this order. They set Desk::pointerTaken while they hold the pointer.
void drawLightOutlines(Desk& desk, ImDrawList& canvas);
void drawGizmos(Desk& desk, ImDrawList& canvas);
void drawLightHandles(Desk& desk, ImDrawList& canvas); // sizes, cones, range, doors of one light
void drawProbeOverlay(Desk& desk, ImDrawList& canvas);
void drawReferenceOverlay(Desk& desk, ImDrawList& canvas); // stored image, split view
void pickLights(Desk& desk, ImDrawList& canvas); // click and marquee; after all who may take the pointer

// Keys of conventions.md, once per frame; called only while no text is being typed.
void handleViewKeys(Desk& desk);  // 1 to 9
void handleLightKeys(Desk& desk); // Q W E R X H Shift+S L Ctrl+D Ctrl+C Ctrl+V Del Esc

// --- for tests: what a panel adds to the state that is written for them
nlohmann::json lightListState(const Desk& desk);
nlohmann::json propertiesState(const Desk& desk);
nlohmann::json gizmoState(const Desk& desk);
nlohmann::json viewPanelState(const Desk& desk);

} // namespace kilolux
