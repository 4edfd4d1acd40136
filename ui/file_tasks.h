// Opening, saving and leaving a scene: what runs beside the window, and what has to be asked first. The
// questions are drawn by file_dialogs.cpp.
#pragma once

#include "renderer/document/task_watch.h"
#include "ui/desk.h"
#include "ui/settings_store.h"

#include <filesystem>
#include <functional>
#include <future>

namespace kilolux {

enum class Question {
    None,
    OpenFile,       // the folder list
    SaveFileAs,     // the same for a new name
    UnsavedChanges, // before `goOn`
    Recover,        // the journal holds changes of a session that did not end
    ChangedOnDisk,  // before saving over it
    ReplaceFile,    // before saving as another file that is there
};

struct OpenedScene {
    std::unique_ptr<EditSession> session;
    std::size_t recoverable = 0; // > 0: nothing was opened yet, the user is to be asked
};

// Work on a thread of its own, which nobody waits for: given up, it ends by itself.
template<typename T>
struct BackgroundTask {
    std::shared_ptr<TaskWatch> watch;
    std::future<T> result; // invalid: nothing runs
    double sinceS = 0.0;
    bool isRunning() const { return result.valid(); }
    bool isDone() const {
        return result.valid() && result.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    }
};

struct FileTasks {
    Remembered remembered;
    std::filesystem::path rememberedPath;

    Question question = Question::None;
    std::function<void(Desk&)> goOn; // what a question was asked for

    // --- opening
    BackgroundTask<Result<OpenedScene>> opening;
    std::filesystem::path openingPath;
    std::size_t recoverable = 0;
    std::unique_ptr<EditSession> opened; // waits for an answer about unsaved changes
    std::uint64_t discardedVersion =
        0; // of the open document, whose changes the user gave up to open another
    bool isOpening() const { return opening.isRunning(); }

    // --- saving; goOn follows a save that was a step towards something else
    BackgroundTask<std::shared_ptr<SaveRun>> saving;
    bool isSaving() const { return saving.isRunning(); }

    // --- the folder list
    std::filesystem::path folder;
    std::string typed;              // name or path
    std::filesystem::path replaced; // by SaveFileAs, once it is allowed
    struct Entry {
        std::string name;
        bool isFolder = false;
    };
    std::vector<Entry> entries;
    std::string folderError;

    // --- the file on disk
    std::filesystem::file_time_type seenWriteTime{};
    double nextLookS = 0.0;
    BackgroundTask<bool> looking; // whether it differs
    bool changedOnDisk = false;
};

// Each asks about unsaved changes first.
void openScene(Desk& desk, const std::filesystem::path& path);
void requestQuit(Desk& desk);
void rememberLocks(Desk& desk); // of the open scene, in FileTasks::remembered
void requestClose(Desk& desk);  // the scene
void closeScene(Desk& desk);    // without asking
void reloadScene(Desk& desk);

void startOpening(Desk& desk, const std::filesystem::path& path, SessionOptions::Recovery recovery, bool ask);
void cancelOpening(Desk& desk);
// Begin to save; pollFileTasks() takes the end, tells it, and goes on with FileTasks::goOn or gives that up.
void saveScene(Desk& desk, Overwriting overwriting = Overwriting::OnlyUnchanged);
void saveSceneAs(Desk& desk, const std::filesystem::path& path);
void cancelSaving(Desk& desk);
void giveUpGoingOn(Desk& desk); // what a question or a save was asked for

void askToOpen(Desk& desk);
void askToSaveAs(Desk& desk);
void listFolder(FileTasks& files, const std::filesystem::path& folder);

// Takes what has been opened, looks at the file on disk now and then; true: there is something new to show.
bool pollFileTasks(Desk& desk);

} // namespace kilolux
