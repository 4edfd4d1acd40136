// The journal of a session as its two writers see it: the session, which records what it changes, and a save
// that runs beside it. Thread-safe; recording never waits for the disk.
#pragma once

#include "renderer/document/journal.h"
#include "renderer/document/result.h"

#include <nlohmann/json_fwd.hpp>

namespace kilolux {

class SessionJournal {
  public:
    explicit SessionJournal(std::unique_ptr<Journal> journal) : journal_(std::move(journal)) {}

    // Of a change, in the order of changes. One that cannot be written waits, so that there is never a gap.
    void record(std::string text);

    // --- a save. What is recorded between the first and the last of these is behind the saved document, and
    // lies behind its state in the journal of the saved file as well.

    void beginSave();
    // The document as it will be on disk, durable before the scene's own file is replaced: a crash finds one
    // file or the other, and the records that lead on from it.
    std::optional<Error> announce(const nlohmann::json& state);
    // The file has been replaced: what led to it is dropped.
    std::optional<Error> restart(std::uint64_t fileHash, const nlohmann::json& state);
    // The scene has another file now: its own journal, the old one has nothing to recover.
    std::optional<Error> moveTo(const std::filesystem::path& scenePath, std::uint64_t fileHash,
                                const nlohmann::json& state);
    void endSave();

    void discard(); // closes and removes the file
    std::optional<Error> takeWarning();

  private:
    void writeWaiting();
    std::vector<std::string> recordsOf(const nlohmann::json& state) const;

    std::mutex mutex_;
    std::shared_ptr<Journal> journal_; // null: discarded, or it could not move
    std::vector<std::string> waiting_; // records that the journal could not take yet
    std::vector<std::string> behind_;  // since beginSave()
    bool saving_ = false;
    std::optional<Error> warning_;
};

} // namespace kilolux
