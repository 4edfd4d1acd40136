#include "renderer/document/edit_session.h"

#include "renderer/document/edit_json.h"
#include "renderer/document/file_hash.h"
#include "renderer/document/file_replace.h"
#include "renderer/document/scene_files.h"

#include <fmt/format.h>

namespace kilolux {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

Error at(const fs::path& path, const std::string& message) {
    return Error{path.string() + ": " + message};
}

} // namespace

Result<std::unique_ptr<EditSession>> EditSession::open(const fs::path& path, const SessionOptions& options) {
    Result<SourceFile> source = readSource(path);
    if (!source) return Error{source.error()};
    Result<Scene> scene = importGltf(path, options.import);
    if (!scene) return Error{scene.error()};
    std::unique_ptr<EditSession> session(new EditSession());
    session->source_ = std::move(source.value());
    session->scene_ = scene.value();
    session->opened_ = std::move(scene.value());
    session->ids_.avoid(session->scene_);
    if (!options.journal.empty()) {
        if (std::optional<Error> error = session->openJournal(options.journal, options.recovery))
            return *error;
    }
    return session;
}

std::optional<Error> EditSession::apply(Change change, Merging merging) {
    if (change.edits.empty()) return std::nullopt;
    const bool merges = merging == Merging::Allow && history_.wouldMerge(change.mergeKey);
    Json json = {{"change", toJson(change)}, {"merged", merges}};
    for (const Edit& edit : change.edits)
        ids_.avoid(edit);
    if (std::optional<Error> error = history_.apply(scene_, std::move(change), merging)) return error;
    ++version_;
    record(json.dump());
    return std::nullopt;
}

std::optional<Error> EditSession::apply(std::string name, Edits edits, std::string mergeKey) {
    return apply(Change{std::move(name), std::move(mergeKey), std::move(edits)});
}

std::optional<Error> EditSession::undo() {
    const Change change = history_.nextUndo();
    if (std::optional<Error> error = history_.undo(scene_)) return error;
    ++version_;
    record(Json{{"undo", toJson(change)}}.dump());
    return std::nullopt;
}

std::optional<Error> EditSession::redo() {
    const Change change = history_.nextRedo();
    if (std::optional<Error> error = history_.redo(scene_)) return error;
    ++version_;
    record(Json{{"redo", toJson(change)}}.dump());
    return std::nullopt;
}

void EditSession::seal() {
    history_.seal(); // not in the journal: each change there says whether it merged
}

std::optional<Error> EditSession::cancel() {
    const std::uint64_t before = history_.state();
    const Change change = history_.nextUndo();
    if (std::optional<Error> error = history_.cancel(scene_)) return error;
    if (history_.state() == before) return std::nullopt;
    ++version_;
    record(Json{{"undo", toJson(change)}}.dump());
    return std::nullopt;
}

bool DiskLook::differs() const {
    const Result<std::string> bytes = readWholeFile(path);
    return !bytes || hashBytes(bytes.value()) != hash;
}

std::optional<Error> EditSession::save(Overwriting overwriting) {
    return saveNow(prepareSave(overwriting));
}

std::optional<Error> EditSession::saveAs(const fs::path& path) {
    return saveNow(prepareSaveAs(path));
}

std::optional<Error> EditSession::saveNow(Result<std::unique_ptr<SaveRun>> run) {
    if (!run) return Error{run.error()};
    run.value()->run(nullptr);
    finishSave(*run.value());
    if (run.value()->end() == SaveEnd::Saved) return std::nullopt;
    return Error{run.value()->error()};
}

Result<std::unique_ptr<SaveRun>> EditSession::prepareSave(Overwriting overwriting) {
    return prepareRun(source_.path, overwriting);
}

Result<std::unique_ptr<SaveRun>> EditSession::prepareSaveAs(const fs::path& path) {
    std::error_code error;
    if (fs::equivalent(path, source_.path, error)) return prepareSave();
    const char* ending = source_.isBinary ? ".glb" : ".gltf";
    if (path.extension() != ending)
        return at(path, fmt::format("expected a name that ends in {}, as that of the scene", ending));
    return prepareRun(path, Overwriting::Anything);
}

Result<std::unique_ptr<SaveRun>> EditSession::prepareRun(const fs::path& target, Overwriting overwriting) {
    if (saving_) return at(source_.path, "expected the end of the save that is running");
    history_.seal(); // what is saved is a state that undo leads back to
    std::unique_ptr<SaveRun> run(new SaveRun());
    run->source_ = source_;
    run->opened_ = opened_;
    run->scene_ = scene_;
    run->target_ = target;
    run->overwriting_ = overwriting;
    run->historyState_ = history_.state();
    run->journal_ = journal_;
    if (journal_) journal_->beginSave();
    saving_ = true;
    return run;
}

void EditSession::finishSave(const SaveRun& run) {
    saving_ = false;
    if (run.warning_) warning_ = run.warning_;
    if (run.end() != SaveEnd::Saved) return;
    source_.path = run.target_;
    source_.diskHash = run.fileHash_;
    scene_.sourcePath = run.target_;
    opened_.sourcePath = run.target_;
    scene_.files->moveTo(run.target_.parent_path());
    savedState_ = run.historyState_;
    ++version_;
}

void EditSession::discardJournal() {
    if (journal_) journal_->discard();
    journal_.reset();
}

std::optional<Error> EditSession::takeWarning() {
    if (!warning_ && journal_) warning_ = journal_->takeWarning();
    return std::exchange(warning_, std::nullopt);
}

void EditSession::record(std::string record) {
    if (journal_) journal_->record(std::move(record));
}

} // namespace kilolux
