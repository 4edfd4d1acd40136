// File work of the window, see file_tasks.h.
#include "ui/file_tasks.h"

#include "renderer/camera.h"
#include "ui/light_place.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <set>
#include <system_error>
#include <thread>
#include <utility>

namespace kilolux {

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr double kLookEveryS = 1.0; // at the file's time on disk

// A folder that cannot be written to leaves the scene without a journal, which is said.
Result<OpenedScene> openOnThread(const fs::path& path, SessionOptions::Recovery recovery, bool ask,
                                 TaskWatch& watch) {
    SessionOptions options;
    options.import.watch = &watch;
    options.journal = defaultJournalPath(path);
    options.recovery = recovery;
    OpenedScene opened;
    if (ask) opened.recoverable = EditSession::recoverableChanges(path, options.journal);
    if (opened.recoverable > 0) return opened;
    std::error_code ignored; // opening the journal tells
    fs::create_directories(options.journal.parent_path(), ignored);
    Result<std::unique_ptr<EditSession>> session = EditSession::open(path, options);
    if (!session) return Error{session.error()};
    if (watch.isCancelled()) return Error{"cancelled"}; // the journal is free again
    opened.session = std::move(session.value());
    return opened;
}

// Not std::async: its future would wait for the thread when it is dropped.
template<typename Work>
auto inBackground(const Desk& desk, Work work) {
    using T = decltype(work(std::declval<TaskWatch&>()));
    BackgroundTask<T> task;
    task.watch = std::make_shared<TaskWatch>();
    task.sinceS = desk.nowS;
    std::packaged_task<T()> package(
        [watch = task.watch, wake = desk.wake, work = std::move(work)]() mutable { return work(*watch); });
    task.result = package.get_future();
    std::thread([package = std::move(package), wake = desk.wake]() mutable {
        package();
        wake();
    }).detach();
    return task;
}

fs::file_time_type writeTime(const fs::path& path) {
    std::error_code failed;
    const fs::file_time_type time = fs::last_write_time(path, failed);
    return failed ? fs::file_time_type::min() : time;
}

void noteFile(Desk& desk) {
    desk.files->looking = {};
    desk.files->seenWriteTime = writeTime(desk.session->path());
    desk.files->changedOnDisk = false;
}

Camera firstCamera(const Desk& desk, const Scene& scene) {
    return scene.cameras.empty() ? derivedCamera(scene, desk.viewport.aspect()) : scene.cameras.front();
}

// Lights that were locked when the scene was open last, by their names.
void takeLocks(Desk& desk) {
    const auto& all = desk.files->remembered.locked;
    const auto found = all.find(rememberedName(desk.session->path()));
    if (found == all.end()) return;
    const std::set<std::string_view> names(found->second.begin(), found->second.end());
    for (const LightNode& light : desk.session->scene().lights)
        if (names.contains(nodeOf(desk.session->scene(), light.id).name)) desk.locked.push_back(light.id);
}

void takeSession(Desk& desk, std::unique_ptr<EditSession> session) {
    closeScene(desk);
    desk.session = std::move(session);
    desk.files->discardedVersion = 0;
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
    takeLocks(desk);
    noteFile(desk);
    if (const std::size_t changes = desk.session->recoveredChanges())
        notify(desk, Notice::Kind::Info, fmt::format("{} unsaved changes recovered", changes));
    if (const auto warning = desk.session->takeWarning())
        notify(desk, Notice::Kind::Warning, warning->message);
    for (const std::string& warning : scene.warnings)
        notify(desk, Notice::Kind::Warning, warning);
}

// Unsaved changes of the open scene are asked about before `action`; a save that runs comes first.
void afterUnsaved(Desk& desk, std::function<void(Desk&)> action) {
    if (desk.files->isSaving()) {
        desk.files->goOn = [action = std::move(action)](Desk& d) { afterUnsaved(d, action); };
        return;
    }
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

void requestClose(Desk& desk) {
    afterUnsaved(desk, closeScene);
}

void requestQuit(Desk& desk) {
    afterUnsaved(desk, [](Desk& d) { d.quits = true; });
}

void rememberLocks(Desk& desk) {
    if (!desk.session) return;
    std::vector<std::string>& names = desk.files->remembered.locked[rememberedName(desk.session->path())];
    names.clear();
    for (const std::uint64_t light : desk.locked)
        names.push_back(nodeOf(desk.session->scene(), light).name);
}

void closeScene(Desk& desk) {
    rememberLocks(desk);
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
    files.opening =
        inBackground(desk, [=](TaskWatch& watch) { return openOnThread(path, recovery, ask, watch); });
}

void cancelOpening(Desk& desk) {
    FileTasks& files = *desk.files;
    if (files.isOpening()) files.opening.watch->cancel();
    files.opening = {};
}

namespace {

void startSaving(Desk& desk, Result<std::unique_ptr<SaveRun>> prepared) {
    if (!prepared) {
        notify(desk, Notice::Kind::Error, prepared.error());
        return giveUpGoingOn(desk);
    }
    std::shared_ptr<SaveRun> run = std::move(prepared.value());
    desk.files->saving = inBackground(desk, [run](TaskWatch& watch) {
        run->run(&watch);
        return run;
    });
}

void takeSaved(Desk& desk) {
    FileTasks& files = *desk.files;
    const std::shared_ptr<SaveRun> run = files.saving.result.get();
    files.saving = {};
    if (!desk.session) return;
    const fs::path before = desk.session->path();
    desk.session->finishSave(*run);
    switch (run->end()) {
    case SaveEnd::Saved:
        noteFile(desk);
        if (desk.session->path() != before) rememberScene(files.remembered, desk.session->path());
        notify(desk, Notice::Kind::Info, "Saved " + run->target().filename().string());
        if (auto next = std::exchange(files.goOn, nullptr)) next(desk);
        break;
    case SaveEnd::ChangedOnDisk: // asks, and goes on itself
        files.question = Question::ChangedOnDisk;
        break;
    case SaveEnd::Cancelled:
        notify(desk, Notice::Kind::Info, "Saving was cancelled; the file is as it was");
        giveUpGoingOn(desk);
        break;
    case SaveEnd::Failed:
    case SaveEnd::Running:
        notify(desk, Notice::Kind::Error, run->error());
        giveUpGoingOn(desk);
        break;
    }
    if (const auto warning = desk.session ? desk.session->takeWarning() : std::nullopt)
        notify(desk, Notice::Kind::Warning, warning->message);
}

} // namespace

void saveScene(Desk& desk, Overwriting overwriting) {
    if (!desk.session) return;
    if (desk.files->isSaving()) return notify(desk, Notice::Kind::Info, "The scene is being saved");
    startSaving(desk, desk.session->prepareSave(overwriting));
}

void saveSceneAs(Desk& desk, const fs::path& path) {
    if (!desk.session) return;
    if (desk.files->isSaving()) return notify(desk, Notice::Kind::Info, "The scene is being saved");
    startSaving(desk, desk.session->prepareSaveAs(path));
}

void cancelSaving(Desk& desk) {
    if (desk.files->isSaving()) desk.files->saving.watch->cancel();
}

void giveUpGoingOn(Desk& desk) {
    desk.files->goOn = nullptr;
    desk.files->opened.reset();
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
    Result<OpenedScene> opened = files.opening.result.get();
    files.opening = {};
    if (!opened) return notify(desk, Notice::Kind::Error, opened.error());
    if (opened.value().recoverable > 0) {
        files.recoverable = opened.value().recoverable;
        files.question = Question::Recover;
        return;
    }
    // The scene that is open could be edited all the while.
    files.opened = std::move(opened.value().session);
    if (desk.session && desk.session->version() == files.discardedVersion)
        return takeSession(desk, std::move(files.opened));
    afterUnsaved(desk, [](Desk& d) { takeSession(d, std::move(d.files->opened)); });
}

// Now and then, in the background: the whole file has to be read where its time has changed.
bool lookAtFile(Desk& desk) {
    FileTasks& files = *desk.files;
    if (files.looking.isDone()) {
        const bool differs = files.looking.result.get();
        files.looking = {};
        if (!desk.session || differs == files.changedOnDisk) return false;
        files.changedOnDisk = differs;
        return true;
    }
    if (!desk.session || files.isSaving() || files.looking.isRunning() || desk.nowS < files.nextLookS)
        return false;
    files.nextLookS = desk.nowS + kLookEveryS;
    const fs::file_time_type time = writeTime(desk.session->path());
    if (time == files.seenWriteTime) return false;
    files.seenWriteTime = time;
    files.looking =
        inBackground(desk, [look = desk.session->diskLook()](TaskWatch&) { return look.differs(); });
    return false;
}

} // namespace

bool pollFileTasks(Desk& desk) {
    FileTasks& files = *desk.files;
    const bool opened = files.opening.isDone(), saved = files.saving.isDone();
    if (saved) takeSaved(desk);
    if (opened) takeOpened(desk);
    return lookAtFile(desk) || opened || saved;
}

} // namespace kilolux
