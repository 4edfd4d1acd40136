// A save that runs beside the work: EditSession::prepareSave() makes it from the document as it is, run()
// writes it on any thread, EditSession::finishSave() takes the outcome over. The document can be edited all
// the while, and the session may even be gone before it ends.
#pragma once

#include "renderer/document/gltf_save.h"
#include "renderer/document/session_journal.h"

namespace kilolux {

class TaskWatch;

enum class Overwriting { OnlyUnchanged, Anything };

enum class SaveEnd {
    Running, // or not begun
    Saved,
    Cancelled,     // the file is as it was
    ChangedOnDisk, // likewise: another program has written it, and OnlyUnchanged was asked for
    Failed         // likewise, see error()
};

class SaveRun {
  public:
    // Once. `watch` may be null.
    void run(TaskWatch* watch);

    SaveEnd end() const { return end_; }
    const std::string& error() const { return error_; }
    const std::filesystem::path& target() const { return target_; }

  private:
    friend class EditSession;
    SaveRun() = default;
    std::optional<Error> write(TaskWatch* watch);
    std::optional<Error> replace(TaskWatch* watch, std::string_view bytes, const nlohmann::json& state);

    // What is saved, copied from the session.
    SourceFile source_;
    Scene opened_, scene_;
    std::filesystem::path target_;
    Overwriting overwriting_ = Overwriting::OnlyUnchanged;
    std::uint64_t historyState_ = 0;
    std::shared_ptr<SessionJournal> journal_; // null: none

    SaveEnd end_ = SaveEnd::Running;
    std::string error_;
    std::uint64_t fileHash_ = 0; // of the saved file
    std::optional<Error> warning_;
};

// The document as saved, for those who find that file: edit_recovery.cpp.
nlohmann::json savedStateJson(const Scene& scene, const Scene& opened, const SavePlan& plan,
                              std::uint64_t fileHash);

} // namespace kilolux
