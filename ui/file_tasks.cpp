// File work of the window, see file_tasks.h.
#include "ui/file_tasks.h"

#include "renderer/camera.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <thread>
#include <utility>

namespace kilolux {

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr double kLookEveryS = 1.0; // at the file's time on disk

// A folder that cannot be written to leaves the scene without a journal, which is said.
Result<OpenedScene> openOnThread(const fs::path& path, SessionOptions::Recovery recovery, bool ask) {
    SessionOptions options;
    options.journal = defaultJournalPath(path);
    options.recovery = recovery;
    OpenedScene opened;
    if (ask) opened.recoverable = EditSession::recoverableChanges(path, options.journal);
    if (opened.recoverable > 0) return opened;
    std::error_code ignored; // opening the journal tells
    fs::create_directories(options.journal.parent_path(), ignored);
    Result<std::unique_ptr<EditSession>> session = EditSession::open(path, options);
    if (!session) return Error{session.error()};
    opened.session = std::move(session.value());
    return opened;
}

std::future<Result<OpenedScene>> inBackground(const fs::path& path, SessionOptions::Recovery recovery,
                                              bool ask) {
    // Not std::async: its future would wait for the thread when it is dropped.
    std::packaged_task<Result<OpenedScene>()> task([=] { return openOnThread(path, recovery, ask); });
    std::future<Result<OpenedScene>> result = task.get_future();
    std::thread(std::move(task)).detach();
    return result;
}

fs::file_time_type writeTime(const fs::path& path) {
    std::error_code failed;
    const fs::file_time_type time = fs::last_write_time(path, failed);
    return failed ? fs::file_time_type::min() : time;
}

void noteFile(Desk& desk) {
    desk.files->seenWriteTime = writeTime(desk.session->path());
    desk.files->changedOnDisk = false;
}

Camera firstCamera(const Desk& desk, const Scene& scene) {
    return scene.cameras.empty() ? derivedCamera(scene, desk.viewport.aspect()) : scene.cameras.front();
}

void takeSession(Desk& desk, std::unique_ptr<EditSession> session) {
    closeScene(desk);
    desk.session = std::move(session);
    const Scene& scene = desk.session->scene();
    const Bounds bounds = worldBounds(scene);
    const double extentM = std::max(glm::length(bounds.max - bounds.min), 1e-3);
    const Camera camera = firstCamera(desk, scene);
    desk.camera.lookThrough(camera, 0.25 * extentM);
    desk.flySpeedMs = std::clamp(0.15 * extentM, 0.1, 8.0);
    desk.viewport.camera = desk.camera.camera();
    RenderOptions options;
    options.settings = desk.settings;
    options.view = desk.view;
    desk.exposureEv100 = scene.exposureEv100;
    desk.renderThread->setInputTime(0.0);
    desk.renderThread->open(scene, options, desk.camera.camera(), desk.session->version());
    rememberScene(desk.files->remembered, desk.session->path());
    noteFile(desk);
    if (const std::size_t changes = desk.session->recoveredChanges())
        notify(desk, Notice::Kind::Info, fmt::format("{} unsaved changes recovered", changes));
    if (const auto warning = desk.session->takeWarning())
        notify(desk, Notice::Kind::Warning, warning->message);
    for (const std::string& warning : scene.warnings)
        notify(desk, Notice::Kind::Warning, warning);
}

// Unsaved changes of the open scene are asked about before `action`.
void afterUnsaved(Desk& desk, std::function<void(Desk&)> action) {
    if (!desk.session || !desk.session->hasUnsavedChanges()) return action(desk);
    desk.files->goOn = std::move(action);
    desk.files->question = Question::UnsavedChanges;
}

} // namespace

void openScene(Desk& desk, const fs::path& path) {
    afterUnsaved(desk, [path](Desk& d) { startOpening(d, path, SessionOptions::Recovery::TakeUp, true); });
}

void reloadScene(Desk& desk) {
    if (!desk.session) return;
    const fs::path path = desk.session->path();
    afterUnsaved(desk, [path](Desk& d) { startOpening(d, path, SessionOptions::Recovery::PutAside, false); });
}

void requestQuit(Desk& desk) {
    afterUnsaved(desk, [](Desk& d) { d.quits = true; });
}

void closeScene(Desk& desk) {
    // Whoever comes here has saved or given the changes up.
    if (desk.session) desk.session->discardJournal();
    desk.session.reset();
    forgetLights(desk);
    desk.meteredEv100.reset();
    desk.shown.reset();
    desk.renderThread->close();
}

void startOpening(Desk& desk, const fs::path& path, SessionOptions::Recovery recovery, bool ask) {
    FileTasks& files = *desk.files;
    cancelOpening(desk);
    // The same file again: its journal is this window's own until it is closed.
    std::error_code ignored;
    if (desk.session && fs::equivalent(path, desk.session->path(), ignored)) closeScene(desk);
    files.openingPath = path;
    files.openingSinceS = desk.nowS;
    files.opening = inBackground(path, recovery, ask);
}

void cancelOpening(Desk& desk) {
    FileTasks& files = *desk.files;
    if (files.opening.valid()) files.abandoned.push_back(std::move(files.opening));
    files.opening = {};
}

bool saveScene(Desk& desk, Overwriting overwriting) {
    if (!desk.session) return false;
    if (overwriting == Overwriting::OnlyUnchanged && desk.session->changedOnDisk()) {
        desk.files->question = Question::ChangedOnDisk;
        return false;
    }
    if (const auto error = desk.session->save(overwriting)) {
        notify(desk, Notice::Kind::Error, error->message);
        return false;
    }
    noteFile(desk);
    notify(desk, Notice::Kind::Info, "Saved " + desk.session->path().filename().string());
    return true;
}

bool saveSceneAs(Desk& desk, const fs::path& path) {
    if (!desk.session) return false;
    if (const auto error = desk.session->saveAs(path)) {
        notify(desk, Notice::Kind::Error, error->message);
        return false;
    }
    noteFile(desk);
    rememberScene(desk.files->remembered, path);
    notify(desk, Notice::Kind::Info, "Saved " + path.filename().string());
    return true;
}

void listFolder(FileTasks& files, const fs::path& folder) {
    std::error_code failed;
    const fs::path whole = fs::weakly_canonical(folder, failed);
    std::vector<FileTasks::Entry> entries;
    for (auto at = fs::directory_iterator(whole, failed); !failed && at != fs::directory_iterator();
         at.increment(failed)) {
        const std::string name = at->path().filename().string();
        const std::string ending = at->path().extension().string();
        std::error_code ignored;
        const bool isFolder = at->is_directory(ignored);
        if (name.starts_with(".") || (!isFolder && ending != ".glb" && ending != ".gltf")) continue;
        entries.push_back({name, isFolder});
    }
    files.folderError = failed ? fmt::format("{}: {}", folder.string(), failed.message()) : "";
    if (failed) return;
    std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
        return a.isFolder != b.isFolder ? a.isFolder : a.name < b.name;
    });
    files.folder = whole;
    files.entries = std::move(entries);
}

void askToOpen(Desk& desk) {
    FileTasks& files = *desk.files;
    const fs::path near = desk.session ? desk.session->path().parent_path()
                          : !files.remembered.recent.empty()
                              ? fs::path(files.remembered.recent[0]).parent_path()
                              : fs::current_path();
    listFolder(files, near.empty() ? fs::current_path() : near);
    if (!files.folderError.empty()) listFolder(files, fs::current_path());
    files.typed.clear();
    files.question = Question::OpenFile;
}

void askToSaveAs(Desk& desk) {
    if (!desk.session) return;
    FileTasks& files = *desk.files;
    const fs::path folder = desk.session->path().parent_path();
    listFolder(files, folder.empty() ? fs::current_path() : folder);
    files.typed = desk.session->path().filename().string();
    files.question = Question::SaveFileAs;
}

namespace {

void takeOpened(Desk& desk) {
    FileTasks& files = *desk.files;
    Result<OpenedScene> opened = files.opening.get();
    files.opening = {};
    if (!opened) return notify(desk, Notice::Kind::Error, opened.error());
    if (opened.value().recoverable > 0) {
        files.recoverable = opened.value().recoverable;
        files.question = Question::Recover;
        return;
    }
    // The scene that is open could be edited all the while.
    files.opened = std::move(opened.value().session);
    afterUnsaved(desk, [](Desk& d) { takeSession(d, std::move(d.files->opened)); });
}

} // namespace

bool pollFileTasks(Desk& desk) {
    FileTasks& files = *desk.files;
    std::erase_if(files.abandoned,
                  [](const auto& task) { return task.wait_for(0s) == std::future_status::ready; });
    const bool opened = files.opening.valid() && files.opening.wait_for(0s) == std::future_status::ready;
    if (opened) takeOpened(desk);
    if (!desk.session || desk.nowS < files.nextLookS) return opened;
    files.nextLookS = desk.nowS + kLookEveryS;
    const fs::file_time_type time = writeTime(desk.session->path());
    if (time == files.seenWriteTime) return opened;
    files.seenWriteTime = time;
    files.changedOnDisk = desk.session->changedOnDisk();
    return true;
}

} // namespace kilolux
