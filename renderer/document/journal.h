// The journal: an append-only file of records that outlives a crash. Layout: "KXJOURN1", the hash of the
// scene file that the records start from (8 bytes), the hash of these 16 bytes (8); then per record the
// payload's length (4), the low half of its hash mixed with the record's number (4), the payload.
// Little-endian. A record that is not whole, and all behind it, counts as never written.
#pragma once

#include "renderer/document/result.h"

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace kilolux {

struct JournalContent {
    std::uint64_t baseHash = 0;
    std::vector<std::string> records;
    std::uint64_t wholeBytes = 0; // up to the end of the last whole record
    bool wasTorn = false;
};

// What a journal's bytes hold; an error where not even the head is whole.
Result<JournalContent> parseJournal(std::string_view bytes);

// The bytes of a journal without records, and of one record.
std::string journalHead(std::uint64_t baseHash);
std::string journalRecord(std::uint64_t number, std::string_view payload);

// A new journal beside an open one, whole and durable, that waits to take its place.
class JournalDraft {
  public:
    ~JournalDraft(); // removes what nobody took
    JournalDraft(const JournalDraft&) = delete;
    JournalDraft& operator=(const JournalDraft&) = delete;

  private:
    friend class Journal;
    JournalDraft(std::filesystem::path path, int descriptor, std::uint64_t bytes, std::uint64_t records)
        : path_(std::move(path)), descriptor_(descriptor), bytes_(bytes), records_(records) {}

    std::filesystem::path path_;
    int descriptor_; // -1: taken
    std::uint64_t bytes_, records_;
};

// A journal that is open for appending, by one process at a time.
class Journal {
  public:
    // Starts a new journal. An error names the file; another process that has it open is one.
    static Result<std::unique_ptr<Journal>> create(const std::filesystem::path& path, std::uint64_t baseHash);
    // Goes on with `content`, which was read from the file; its torn end is cut off.
    static Result<std::unique_ptr<Journal>> resume(const std::filesystem::path& path,
                                                   const JournalContent& content);
    // Only keeps other processes away from a file that is not a usable journal.
    static Result<std::unique_ptr<Journal>> lock(const std::filesystem::path& path);

    ~Journal();
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    // Hands the record to the system at once, so that it outlives this process; a thread makes it durable
    // against loss of power within kSyncDelayMs. A record that could not be written leaves no trace.
    std::optional<Error> append(std::string_view payload);

    // Starts anew with other records: what came before is not needed any more. The file is replaced whole;
    // on failure it goes on as it was. Writing the draft waits for the disk, adopting it, with the records
    // that came meanwhile, does not.
    Result<std::unique_ptr<JournalDraft>> draft(std::uint64_t baseHash,
                                                const std::vector<std::string>& payloads) const;
    std::optional<Error> adopt(JournalDraft& draft, const std::vector<std::string>& since);

    // Waits until everything so far is durable; others can append meanwhile.
    std::optional<Error> sync();

    // Closes and removes the file: nothing is left to recover.
    void discard();

    const std::filesystem::path& path() const { return path_; }

    static constexpr int kSyncDelayMs = 300;

  private:
    Journal(std::filesystem::path path, int descriptor, std::uint64_t bytes, std::uint64_t records);
    static Result<int> openLocked(const std::filesystem::path& path, int flags);
    void syncLoop();
    bool syncUnlocked(std::unique_lock<std::mutex>& lock) const;

    std::filesystem::path path_;
    int descriptor_ = -1;
    std::uint64_t bytes_ = 0;   // whole ones in the file
    std::uint64_t records_ = 0; // number of the next one
    std::mutex mutex_;
    std::condition_variable wake_;
    bool dirty_ = false;
    bool stopping_ = false;
    std::optional<Error> syncError_; // of the thread; told by the next append
    std::thread thread_;
};

// Where the journal of a scene lies: below $XDG_STATE_HOME or ~/.local/state, in kilolux/journals.
std::filesystem::path defaultJournalPath(const std::filesystem::path& scenePath);

} // namespace kilolux
