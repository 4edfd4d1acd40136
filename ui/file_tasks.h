// Opening, saving and leaving a scene: what runs beside the window, and what has to be asked first. The
// questions are drawn by file_dialogs.cpp.
#pragma once

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

struct FileTasks {
    Remembered remembered;
    std::filesystem::path rememberedPath;

    Question question = Question::None;
    std::function<void(Desk&)> goOn; // what a question was asked for

    // --- opening, on a thread of its own
    std::future<Result<OpenedScene>> opening;
    std::filesystem::path openingPath;
    double openingSinceS = 0.0;
    // Opened and given up: the import cannot be stopped in the middle, its result is dropped.
    std::vector<std::future<Result<OpenedScene>>> abandoned;
    std::size_t recoverable = 0;
    std::unique_ptr<EditSession> opened; // waits for an answer about unsaved changes
    bool isOpening() const { return opening.valid(); }

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
    bool changedOnDisk = false;
};

// Each asks about unsaved changes first.
void openScene(Desk& desk, const std::filesystem::path& path);
void requestQuit(Desk& desk);
void closeScene(Desk& desk); // without asking
void reloadScene(Desk& desk);

void startOpening(Desk& desk, const std::filesystem::path& path, SessionOptions::Recovery recovery, bool ask);
void cancelOpening(Desk& desk);
bool saveScene(Desk& desk, Overwriting overwriting = Overwriting::OnlyUnchanged);
bool saveSceneAs(Desk& desk, const std::filesystem::path& path);

void askToOpen(Desk& desk);
void askToSaveAs(Desk& desk);
void listFolder(FileTasks& files, const std::filesystem::path& folder);

// Takes what has been opened, looks at the file on disk now and then; true: there is something new to show.
bool pollFileTasks(Desk& desk);

} // namespace kilolux
