// The window's state as JSON, see state_file.h.
#include "ui/state_file.h"

#include "ui/file_tasks.h"
#include "ui/handle_overlay.h"
#include "ui/panels.h"

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

namespace kilolux {

namespace {

using Json = nlohmann::json;

Json rectJson(const ViewportRect& rect) {
    return Json::array({rect.x, rect.y, rect.width, rect.height});
}

const char* questionWord(Question question) {
    constexpr const char* kWords[] = {"", "open", "saveAs", "unsaved", "recover", "changedOnDisk", "replace"};
    return kWords[int(question)];
}

Json documentJson(const Desk& desk) {
    if (!desk.session) return nullptr;
    const History& history = desk.session->history();
    Json selection = Json::array();
    for (const std::uint64_t id : desk.selection)
        selection.push_back(id);
    return {{"path", desk.session->path().string()},
            {"version", desk.session->version()},
            {"lights", desk.session->scene().lights.size()},
            {"bookmarks", desk.session->scene().bookmarks.size()},
            {"unsaved", desk.session->hasUnsavedChanges()},
            {"undo", history.undoName()},
            {"redo", history.redoName()},
            {"selection", std::move(selection)}};
}

Json pictureJson(const Desk& desk) {
    if (!desk.shown) return nullptr;
    const ShownFrame& frame = *desk.shown;
    return {{"number", frame.number},         {"width", frame.width},     {"height", frame.height},
            {"scale", frame.renderScale},     {"ms", frame.frameMs},      {"version", frame.documentVersion},
            {"meanFrames", frame.meanFrames}, {"settled", frame.settled}, {"view", frame.view}};
}

} // namespace

std::string stateText(const Desk& desk, const WindowTimes& times) {
    const glm::dvec3 eye = desk.camera.eyeWs();
    Json places = Json::object();
    for (const auto& [name, rect] : desk.places)
        places[name] = rectJson(rect);
    Json notices = Json::array();
    for (const Notice& notice : desk.notices)
        notices.push_back(notice.text);
    const Json state = {
        {"document", documentJson(desk)},
        {"picture", pictureJson(desk)},
        {"viewport", rectJson(desk.viewport.rect)},
        {"camera", {{"eye", {eye.x, eye.y, eye.z}}, {"pivotM", desk.camera.pivotDistanceM()}}},
        {"exposure", desk.exposureEv100},
        {"tool", int(desk.tool)},
        {"space", int(desk.space)},
        {"view", desk.view},
        {"question", questionWord(desk.files->question)},
        {"opening", desk.files->isOpening()},
        {"changedOnDisk", desk.files->changedOnDisk},
        {"activity", desk.renderThread->activity().words},
        {"saving", desk.files->isSaving()},
        {"notices", std::move(notices)},
        {"panels", desk.panels.all},
        {"help", desk.showsHelp},
        {"uiScale", desk.uiScale},
        {"places", std::move(places)},
        {"frames", times.frames},
        {"events", times.eventsTaken},
        {"framesDue", times.framesDue},
        {"slowFrames", times.slowFrames},
        {"longestFrameMs", times.longestFrameMs},
        {"frameMs", times.frameMs},
        {"responseMs", times.responseMs},
        {"lightList", lightListState(desk)},
        {"properties", propertiesState(desk)},
        {"gizmo", gizmoState(desk)},
        {"handles", handleOverlayState(desk)},
        {"viewPanel", viewPanelState(desk)},
    };
    return state.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

void StateFile::write(std::string text) {
    if (text == written_) return;
    const std::string partial = path_ + ".part";
    std::ofstream(partial, std::ios::binary) << text;
    std::rename(partial.c_str(), path_.c_str());
    written_ = std::move(text);
}

} // namespace kilolux
