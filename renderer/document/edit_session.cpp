#include "renderer/document/edit_session.h"

#include "renderer/document/edit_json.h"
#include "renderer/document/file_hash.h"
#include "renderer/document/file_replace.h"

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

bool EditSession::changedOnDisk() const {
    const Result<std::string> bytes = readWholeFile(source_.path);
    return !bytes || hashBytes(bytes.value()) != source_.diskHash;
}

std::optional<Error> EditSession::save(Overwriting overwriting) {
    const Result<std::string> disk = readWholeFile(source_.path);
    if (!disk) return Error{disk.error()};
    if (overwriting == Overwriting::OnlyUnchanged && hashBytes(disk.value()) != source_.diskHash)
        return at(source_.path, "expected the file as it was opened; another program has changed it on disk");
    return writeFile(source_.path, disk.value());
}

std::optional<Error> EditSession::saveAs(const fs::path& path) {
    std::error_code error;
    if (fs::equivalent(path, source_.path, error)) return save();
    const char* ending = source_.isBinary ? ".glb" : ".gltf";
    if (path.extension() != ending)
        return at(path, fmt::format("expected a name that ends in {}, as that of the scene", ending));
    const Result<std::string> disk = readWholeFile(source_.path);
    if (!disk) return Error{disk.error()};
    if (std::optional<Error> failed = copyResources(source_, path)) return failed;
    return writeFile(path, disk.value());
}

// The journal learns of the new file before it is there, so that a crash in between finds one or the other.
std::optional<Error> EditSession::writeFile(const fs::path& target, std::string_view diskBytes) {
    const Result<SavePlan> plan = planSave(source_, opened_, scene_);
    if (!plan) return Error{plan.error()};
    const Result<std::string> bytes = withJsonText(source_, diskBytes, plan.value().jsonText);
    if (!bytes) return Error{bytes.error()};
    const std::uint64_t hash = hashBytes(bytes.value());
    const bool sameFile = target == source_.path;
    const std::string state =
        journal_ ? Json{{"state", stateJson(plan.value(), hash)}}.dump() : std::string();
    if (journal_ && sameFile) {
        record(state);
        if (std::optional<Error> error = journal_->sync()) warning_ = error;
    }
    if (!sameFile || diskBytes != bytes.value()) {
        if (std::optional<Error> error = replaceFile(target, bytes.value())) return error;
    }
    source_.path = target;
    source_.diskHash = hash;
    scene_.sourcePath = target;
    opened_.sourcePath = target;
    history_.seal();
    savedState_ = history_.state();
    ++version_;
    if (journal_ && sameFile && unwritten_.empty()) {
        // Keeps the journal short; its old form would do as well.
        if (std::optional<Error> error = journal_->restart(hash, state)) warning_ = error;
    }
    if (journal_ && !sameFile) {
        const fs::path place = journal_->path().parent_path() / defaultJournalPath(target).filename();
        Result<std::unique_ptr<Journal>> moved = Journal::create(place, hash);
        journal_->discard(); // the old scene's file has nothing to recover
        journal_ = moved ? std::move(moved.value()) : nullptr;
        if (!moved) warning_ = Error{moved.error()};
        unwritten_.clear();
        record(state);
    }
    return std::nullopt;
}

void EditSession::discardJournal() {
    if (journal_) journal_->discard();
    journal_.reset();
}

// A record that cannot be written waits, so that the journal never has a gap.
void EditSession::record(std::string record) {
    if (!journal_) return;
    unwritten_.push_back(std::move(record));
    while (!unwritten_.empty()) {
        if (std::optional<Error> error = journal_->append(unwritten_.front())) {
            warning_ = error;
            return;
        }
        unwritten_.erase(unwritten_.begin());
    }
}

} // namespace kilolux
