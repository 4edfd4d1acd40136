#include "renderer/document/session_journal.h"

#include <nlohmann/json.hpp>
#include <utility>

namespace kilolux {

using Json = nlohmann::json;

void SessionJournal::writeWaiting() {
    std::size_t written = 0;
    for (; journal_ && written < waiting_.size(); ++written) {
        if (std::optional<Error> error = journal_->append(waiting_[written])) {
            warning_ = error;
            break;
        }
    }
    waiting_.erase(waiting_.begin(), waiting_.begin() + std::ptrdiff_t(written));
}

void SessionJournal::record(std::string text) {
    const std::lock_guard lock(mutex_);
    if (!journal_) return;
    if (saving_) behind_.push_back(text);
    waiting_.push_back(std::move(text));
    writeWaiting();
}

void SessionJournal::beginSave() {
    const std::lock_guard lock(mutex_);
    saving_ = true;
    behind_.clear();
}

void SessionJournal::endSave() {
    const std::lock_guard lock(mutex_);
    saving_ = false;
    behind_.clear();
}

std::optional<Error> SessionJournal::announce(const Json& state) {
    std::shared_ptr<Journal> journal;
    {
        const std::lock_guard lock(mutex_);
        if (!journal_) return std::nullopt;
        Json announced = state;
        announced["behind"] = behind_.size(); // records before this one that are not part of it
        waiting_.push_back(Json{{"state", std::move(announced)}}.dump());
        writeWaiting();
        journal = journal_;
    }
    return journal->sync(); // without the lock: the disk may take long
}

std::vector<std::string> SessionJournal::recordsOf(const Json& state) const {
    std::vector<std::string> records = {Json{{"state", state}}.dump()};
    records.insert(records.end(), behind_.begin(), behind_.end());
    return records;
}

std::optional<Error> SessionJournal::restart(std::uint64_t fileHash, const Json& state) {
    std::vector<std::string> records;
    std::shared_ptr<Journal> journal;
    {
        const std::lock_guard lock(mutex_);
        if (!journal_) return std::nullopt;
        records = recordsOf(state);
        journal = journal_;
    }
    Result<std::unique_ptr<JournalDraft>> draft = journal->draft(fileHash, records);
    if (!draft) return Error{draft.error()};
    const std::lock_guard lock(mutex_);
    const std::size_t have = records.size() - 1;
    const std::vector<std::string> since(behind_.begin() + std::ptrdiff_t(have), behind_.end());
    if (!journal_) return std::nullopt;
    if (std::optional<Error> error = journal_->adopt(*draft.value(), since)) return error;
    waiting_.clear();
    return std::nullopt;
}

std::optional<Error> SessionJournal::moveTo(const std::filesystem::path& scenePath, std::uint64_t fileHash,
                                            const Json& state) {
    const std::lock_guard lock(mutex_);
    if (!journal_) return std::nullopt;
    const std::filesystem::path place =
        journal_->path().parent_path() / defaultJournalPath(scenePath).filename();
    Result<std::unique_ptr<Journal>> moved = Journal::create(place, fileHash);
    journal_->discard();
    journal_ = moved ? std::move(moved.value()) : nullptr;
    waiting_ = recordsOf(state);
    writeWaiting();
    return moved ? std::nullopt : std::optional(Error{moved.error()});
}

void SessionJournal::discard() {
    const std::lock_guard lock(mutex_);
    if (journal_) journal_->discard();
    journal_.reset();
}

std::optional<Error> SessionJournal::takeWarning() {
    const std::lock_guard lock(mutex_);
    return std::exchange(warning_, std::nullopt);
}

} // namespace kilolux
