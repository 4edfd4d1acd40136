// The desk: everything that the UI thread owns. Panels are free functions drawX(Desk&), one file each, called
// once per UI frame; there are no globals. The document changes only through Desk::session.
#pragma once

#include "renderer/document/edit_session.h"
#include "renderer/settings.h"
#include "ui/render_thread.h"
#include "ui/viewport.h"
#include "ui/viewport_camera.h"

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace kilolux {

struct FileTasks; // file_tasks.h
// What panels remember between frames; each is defined in its panel's files and made by it on first use.
struct LightListState;
struct PropertiesState;
struct HandleState;
struct ProfileBrowserState;
struct GizmoState;
struct CameraMenuState;
struct ViewPanelState;
struct ProbeState;
struct ReferenceState;
struct QualityState;

enum class Tool { Select, Move, Rotate, Scale };
enum class GizmoSpace { World, Local, View };

struct NumberRange {
    double least, most;
    double clamped(double value) const { return std::clamp(value, least, most); }
};
// Unscaled pixels.
inline constexpr NumberRange kLeftWidth{160.0, 720.0}, kRightWidth{200.0, 720.0}, kGizmoSizePx{32.0, 400.0};

struct Snapping {
    bool always = false; // without Ctrl held
    double moveM = 0.1;
    double angleDeg = 5.0;
    double scale = 0.1;
    bool operator==(const Snapping&) const = default;
};

enum class RightTab { None, Light, View, Probe, Cost };

struct PanelVisibility {
    bool all = true; // Tab
    bool lights = true;
    bool properties = true;
    bool outlines = true; // of lights in the viewport
    bool gizmos = true;   // and the dots of numbers
    bool operator==(const PanelVisibility&) const = default;
};

// What the program says to the user; errors stay until closed, others fade.
struct Notice {
    enum class Kind { Info, Warning, Error } kind = Kind::Info;
    std::string text;
    double shownUntilS = 0.0; // of Desk::nowS
};

struct Desk {
    // --- document
    std::unique_ptr<EditSession> session; // null: nothing is open
    std::vector<std::uint64_t> selection; // LightNode::id, sorted; all exist (pruned before panels are drawn)

    // Views of the lights, not edits; both sorted.
    std::vector<std::uint64_t> solo;   // only these are rendered; empty: all
    std::vector<std::uint64_t> locked; // not to be picked or dragged in the viewport

    // --- view
    ViewportCamera camera; // where the next picture looks from
    Viewport viewport;     // where the shown picture stands, and its own camera
    std::string view;      // one of Renderer::views(); empty: the picture
    double exposureEv100 = 0.0;
    std::optional<double> meteredEv100; // of a scene that names no exposure, once the renderer has found it
    Settings settings;
    RenderLimits limits;

    // --- tools
    Tool tool = Tool::Move;
    GizmoSpace space = GizmoSpace::World;
    Snapping snapping;
    double gizmoSizePx = 88.0; // length of a move arrow, unscaled pixels
    bool pointerTaken = false; // a gizmo or marquee holds the pointer: the camera leaves it alone
    int cameraHold = 0;        // of camera_control.cpp
    bool flying = false;       // the right button is held: letters fly and choose no tools
    double flySpeedMs = 2.0;   // metres a second

    // --- window
    PanelVisibility panels;
    bool showsHelp = false;              // every key (F1)
    RightTab wantedTab = RightTab::None; // to be shown, whichever is open
    double uiScale = 1.0;                // of fonts and spacing; 1 on a screen of 1080 lines
    double nowS = 0.0;                   // since the start
    std::function<void()> wake;          // draws the window again; from any thread
    double inputMs = 0.0;                // steadyMs() of the newest event that this frame answers
    std::vector<Notice> notices;
    bool wantsQuit = false; // asked for; unsaved changes are asked about first
    bool quits = false;     // decided
    // For tests: names of what was drawn in this frame, with their place; filled only with a state file.
    bool recordsPlaces = false;
    std::map<std::string, ViewportRect> places;

    // --- rendering
    RenderThread* renderThread = nullptr;    // never null in a running window
    std::shared_ptr<const ShownFrame> shown; // the last finished picture; null: none yet
    std::shared_ptr<const ShownFrame> drawn; // what the window draws of it: comparisons may stand in for it

    // --- panels
    std::shared_ptr<FileTasks> files; // open, save, recover
    std::shared_ptr<LightListState> lightList;
    std::shared_ptr<PropertiesState> properties;
    std::shared_ptr<GizmoState> gizmo;
    std::shared_ptr<HandleState> handles;
    std::shared_ptr<ProfileBrowserState> profileBrowser;
    std::shared_ptr<CameraMenuState> cameraMenu;
    std::shared_ptr<ViewPanelState> viewPanel;
    std::shared_ptr<ProbeState> probe;
    std::shared_ptr<ReferenceState> reference;
    std::shared_ptr<QualityState> quality;

    const Scene* scene() const { return session ? &session->scene() : nullptr; }
    bool isSelected(std::uint64_t light) const;
};

// --- edits. Each tells the user when it fails, and changes nothing then; true: it was done.

// `mergeKey`: edits with one key that follow each other are one step; endDrag() closes it.
bool applyEdits(Desk& desk, const Result<Edits>& edits, std::string name, std::string mergeKey = "");
void endDrag(Desk& desk);
void cancelDrag(Desk& desk);
bool undo(Desk& desk);
bool redo(Desk& desk);

// --- selection

enum class Selecting { Replace, Add, Toggle };
void select(Desk& desk, const std::vector<std::uint64_t>& lights, Selecting how = Selecting::Replace);
void forgetLights(Desk& desk);          // all that names lights of a scene that is closed
void showTab(Desk& desk, RightTab tab); // of the right column, which is unfolded for it
void setSolo(Desk& desk, std::vector<std::uint64_t> lights); // empty: none
// Moves the camera so that the selected lights fill the viewport; without any, the whole scene.
void frameSelection(Desk& desk);

// --- view. These reach the render thread.

void moveCamera(Desk& desk); // after Desk::camera changed
void cutCamera(Desk& desk, const Camera& camera);
void setView(Desk& desk, std::string view);
void setExposure(Desk& desk, double ev100); // also an edit of the document
void setSettings(Desk& desk, const Settings& settings);

void notify(Desk& desk, Notice::Kind kind, std::string text);

} // namespace kilolux
