// The look of the window: colours, fonts and spacing (a neutral grey, one accent, a grid of 4 pixels).
#pragma once

#include "renderer/document/result.h"

#include <imgui.h>
#include <optional>

namespace kilolux::theme {

// Colours in sRGB.
inline constexpr ImU32 kBackground = IM_COL32(36, 36, 36, 255); // of panels, 0.14
inline constexpr ImU32 kBars = IM_COL32(33, 33, 33, 255);       // top bar and status line, 0.13
inline constexpr ImU32 kField = IM_COL32(48, 48, 48, 255);      // of controls
inline constexpr ImU32 kEmpty = IM_COL32(26, 26, 26, 255);      // where a picture will be
inline constexpr ImU32 kText = IM_COL32(219, 219, 219, 255);    // 0.86
inline constexpr ImU32 kDim = IM_COL32(150, 150, 150, 255);     // units, hints: contrast 5.3 on panels
inline constexpr ImU32 kAccent = IM_COL32(240, 170, 60, 255);   // selection everywhere
inline constexpr ImU32 kAccentDim = IM_COL32(240, 170, 60, 60); // behind text
inline constexpr ImU32 kError = IM_COL32(235, 95, 85, 255);
inline constexpr ImU32 kWarning = IM_COL32(230, 205, 90, 255);

// Icons of Font Awesome 4.7, merged into the text font.
inline constexpr const char* kOpen = "\uf07c";
inline constexpr const char* kSave = "\uf0c7";
inline constexpr const char* kUndo = "\uf0e2";
inline constexpr const char* kRedo = "\uf01e";
inline constexpr const char* kSelect = "\uf245";
inline constexpr const char* kMove = "\uf047";
inline constexpr const char* kRotate = "\uf021";
inline constexpr const char* kScale = "\uf065";
inline constexpr const char* kGizmos = "\uf05b";
inline constexpr const char* kSnap = "\uf076";
inline constexpr const char* kEye = "\uf06e";
inline constexpr const char* kEyeOff = "\uf070";
inline constexpr const char* kLight = "\uf0eb";
inline constexpr const char* kAdd = "\uf067";
inline constexpr const char* kDelete = "\uf1f8";
inline constexpr const char* kClose = "\uf00d";
inline constexpr const char* kWarn = "\uf071";
inline constexpr const char* kInfo = "\uf05a";
inline constexpr const char* kSolo = "\uf005";
inline constexpr const char* kGroup = "\uf247";
inline constexpr const char* kFilter = "\uf0b0";
inline constexpr const char* kCamera = "\uf03d";
inline constexpr const char* kSliders = "\uf1de";
inline constexpr const char* kFolder = "\uf07b";
inline constexpr const char* kFile = "\uf016";
inline constexpr const char* kUp = "\uf062";
inline constexpr const char* kLock = "\uf023";
inline constexpr const char* kUnlock = "\uf09c";
inline constexpr const char* kSort = "\uf0dc";
inline constexpr const char* kFolded = "\uf0da";
inline constexpr const char* kUnfolded = "\uf0d7";

// Sets ImGui's style for a scale of 1 at 1080 lines.
void apply(double scale);

// Fills the atlas: Inter for text and a smaller size of it, icons in both. Digits are made equally wide. An
// error names the font that is missing; ImGui's own stands in.
std::optional<Error> loadFonts(double scale);
ImFont* smallFont();

} // namespace kilolux::theme
