// A document that is being edited: the scene, its history, its journal and the file it is saved to.
// Everything that changes the document while it is open goes through here. Of one thread; what others need
// they copy, which is cheap (CopyOnWrite).
#pragma once

#include "renderer/document/edit_build.h"
#include "renderer/document/gltf_import.h"
#include "renderer/document/gltf_save.h"
#include "renderer/document/history.h"
#include "renderer/document/save_run.h"

namespace kilolux {

struct SessionOptions {
    ImportOptions import;
    // Where changes are written as they are made; empty: nowhere. A window uses defaultJournalPath().
    std::filesystem::path journal;
    // What to do with changes that an earlier session left in the journal: take them up, or put the journal
    // aside as '<name>.old'.
    enum class Recovery { TakeUp, PutAside } recovery = Recovery::TakeUp;
};

// Whether a file on disk is still the one that was opened or saved last; for any thread, it reads the file.
struct DiskLook {
    std::filesystem::path path;
    std::uint64_t hash = 0;
    bool differs() const;
};

class EditSession {
  public:
    static Result<std::unique_ptr<EditSession>> open(const std::filesystem::path& path,
                                                     const SessionOptions& options = {});

    // How many changes the journal of a scene holds that were never saved; 0 without a journal. For asking
    // the user before open().
    static std::size_t recoverableChanges(const std::filesystem::path& path,
                                          const std::filesystem::path& journal);

    const Scene& scene() const { return scene_; }
    EditIds& ids() { return ids_; }
    const std::filesystem::path& path() const { return source_.path; }

    // Each of these leaves the document as it was when it fails. The number of the document's version rises
    // with every one that succeeds.
    std::optional<Error> apply(Change change, Merging merging = Merging::Allow);
    std::optional<Error> apply(std::string name, Edits edits, std::string mergeKey = "");
    std::optional<Error> undo();
    std::optional<Error> redo();
    void seal();                   // ends a drag
    std::optional<Error> cancel(); // gives the present drag up
    const History& history() const { return history_; }
    std::uint64_t version() const { return version_; }

    bool hasUnsavedChanges() const { return history_.state() != savedState_; }
    DiskLook diskLook() const { return {source_.path, source_.diskHash}; }
    bool changedOnDisk() const { return diskLook().differs(); }

    // Saves to the file that the scene came from, or to another one, which becomes the scene's file. A file
    // that another program has changed is only overwritten when asked to. Without any edit the bytes are
    // those that were opened.
    std::optional<Error> save(Overwriting overwriting = Overwriting::OnlyUnchanged);
    std::optional<Error> saveAs(const std::filesystem::path& path);

    // The same in three steps, of which the middle one, SaveRun::run(), is for another thread. Edits go on
    // meanwhile and are unsaved changes afterwards. One at a time.
    Result<std::unique_ptr<SaveRun>> prepareSave(Overwriting overwriting = Overwriting::OnlyUnchanged);
    Result<std::unique_ptr<SaveRun>> prepareSaveAs(const std::filesystem::path& path);
    void finishSave(const SaveRun& run);

    // Ends the session for good: nothing is left to recover. Without this the journal stays.
    void discardJournal();

    // What went wrong beside the work: a journal that cannot be written. Told once.
    std::optional<Error> takeWarning();
    std::size_t recoveredChanges() const { return recoveredChanges_; }

  private:
    EditSession() = default;
    std::optional<Error> recover(const JournalContent& content);
    std::optional<Error> replay(const nlohmann::json& record);
    std::optional<Error> takeState(const nlohmann::json& state);
    std::optional<Error> openJournal(const std::filesystem::path& path, SessionOptions::Recovery recovery);
    void record(std::string record);
    Result<std::unique_ptr<SaveRun>> prepareRun(const std::filesystem::path& target, Overwriting overwriting);
    std::optional<Error> saveNow(Result<std::unique_ptr<SaveRun>> run);

    Scene scene_;
    Scene opened_; // as imported, with the session's ids
    SourceFile source_;
    History history_;
    EditIds ids_;
    std::shared_ptr<SessionJournal> journal_; // null: none
    bool saving_ = false;
    std::optional<Error> warning_;
    std::uint64_t version_ = 1;
    std::uint64_t savedState_ = 0;
    std::size_t recoveredChanges_ = 0;
};

} // namespace kilolux
