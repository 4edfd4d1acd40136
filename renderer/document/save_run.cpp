#include "renderer/document/save_run.h"

#include "renderer/document/file_hash.h"
#include "renderer/document/file_replace.h"
#include "renderer/document/task_watch.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace kilolux {

namespace {

// Ends a save that nobody wants any more; never shown.
const Error kStopped{"saving was cancelled"};

std::optional<Error> reach(TaskWatch* watch, const char* doing, double share) {
    if (!watch) return std::nullopt;
    if (watch->isCancelled()) return kStopped;
    watch->reach(doing, share);
    return std::nullopt;
}

} // namespace

void SaveRun::run(TaskWatch* watch) {
    const std::optional<Error> error = write(watch);
    if (journal_) journal_->endSave();
    journal_.reset(); // another session may open the scene once this one's has ended
    if (!error) {
        end_ = SaveEnd::Saved;
    } else if (watch && watch->isCancelled() && error->message == kStopped.message) {
        end_ = SaveEnd::Cancelled;
    } else if (end_ == SaveEnd::Running) {
        end_ = SaveEnd::Failed;
    }
    if (error) error_ = error->message;
}

std::optional<Error> SaveRun::write(TaskWatch* watch) {
    if (auto stopped = reach(watch, "Reading the file", 0.0)) return stopped;
    const Result<std::string> disk = readWholeFile(source_.path);
    if (!disk) return Error{disk.error()};
    const bool sameFile = target_ == source_.path;
    if (sameFile && overwriting_ == Overwriting::OnlyUnchanged &&
        hashBytes(disk.value()) != source_.diskHash) {
        end_ = SaveEnd::ChangedOnDisk;
        return Error{source_.path.string() +
                     ": expected the file as it was opened; another program has changed it on disk"};
    }
    if (auto stopped = reach(watch, "Putting the changes in", 0.2)) return stopped;
    const Result<SavePlan> plan = planSave(source_, opened_, scene_);
    if (!plan) return Error{plan.error()};
    if (!sameFile) {
        if (std::optional<Error> failed = copyResources(source_.path, plan.value().jsonText, target_))
            return failed;
    }
    if (auto stopped = reach(watch, "Putting the changes in", 0.5)) return stopped;
    const Result<std::string> bytes = withJsonText(source_, disk.value(), plan.value().jsonText);
    if (!bytes) return Error{bytes.error()};
    fileHash_ = hashBytes(bytes.value());
    const nlohmann::json state =
        journal_ ? savedStateJson(scene_, opened_, plan.value(), fileHash_) : nlohmann::json();
    if (!sameFile || disk.value() != bytes.value()) {
        if (std::optional<Error> error = replace(watch, bytes.value(), state)) return error;
    }
    if (!journal_) return std::nullopt;
    // The file is saved: what goes wrong from here on is a warning.
    warning_ = sameFile ? journal_->restart(fileHash_, state) : journal_->moveTo(target_, fileHash_, state);
    return std::nullopt;
}

std::optional<Error> SaveRun::replace(TaskWatch* watch, std::string_view bytes, const nlohmann::json& state) {
    ReplaceOptions options;
    options.onWritten = [&](double share) { return reach(watch, "Writing", 0.6 + 0.35 * share); };
    options.beforeRename = [&]() -> std::optional<Error> {
        if (auto stopped = reach(watch, "Writing", 0.97)) return stopped;
        // The journal learns of the new file before it is there, so that a crash in between finds one or the
        // other. A journal that cannot be written is no reason not to save.
        if (journal_ && target_ == source_.path) warning_ = journal_->announce(state);
        return std::nullopt;
    };
    return replaceFile(target_, bytes, options);
}

} // namespace kilolux
