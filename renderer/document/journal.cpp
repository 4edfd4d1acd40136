#include "renderer/document/journal.h"

#include "renderer/document/file_hash.h"
#include "renderer/document/posix_write.h"

#include <chrono>
#include <cstdlib>
#include <fcntl.h>
#include <sys/file.h>

namespace kilolux {

namespace {

constexpr std::string_view kMagic = "KXJOURN1"; // the last character is the format's version
constexpr std::size_t kHeadBytes = 24;
constexpr std::size_t kRecordHeadBytes = 8;
constexpr std::uint32_t kMaxRecordBytes = 1u << 30;

template<typename T>
void put(std::string& bytes, T value) {
    for (std::size_t i = 0; i < sizeof(T); ++i)
        bytes += static_cast<char>(value >> (8 * i));
}
template<typename T>
T get(std::string_view bytes, std::size_t at) {
    T value = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i)
        value |= static_cast<T>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
    return value;
}

// The number keeps a record from passing at another one's place.
std::uint32_t checksum(std::uint64_t number, std::string_view payload) {
    return static_cast<std::uint32_t>(hashBytes(payload) ^ (number + 1) * 0x9E3779B97F4A7C15ull);
}

} // namespace

std::string journalHead(std::uint64_t baseHash) {
    std::string head(kMagic);
    put(head, baseHash);
    put(head, hashBytes(head));
    return head;
}

std::string journalRecord(std::uint64_t number, std::string_view payload) {
    std::string record;
    put(record, static_cast<std::uint32_t>(payload.size()));
    put(record, checksum(number, payload));
    record += payload;
    return record;
}

Result<JournalContent> parseJournal(std::string_view bytes) {
    if (bytes.size() < kHeadBytes || !bytes.starts_with(kMagic) ||
        get<std::uint64_t>(bytes, 16) != hashBytes(bytes.substr(0, 16)))
        return Error{"expected a journal of version 1"};
    JournalContent content;
    content.baseHash = get<std::uint64_t>(bytes, 8);
    std::size_t at = kHeadBytes;
    while (bytes.size() - at >= kRecordHeadBytes) {
        const std::uint32_t length = get<std::uint32_t>(bytes, at), sum = get<std::uint32_t>(bytes, at + 4);
        if (length > kMaxRecordBytes || length > bytes.size() - at - kRecordHeadBytes) break;
        const std::string_view payload = bytes.substr(at + kRecordHeadBytes, length);
        if (checksum(content.records.size(), payload) != sum) break;
        content.records.emplace_back(payload);
        at += kRecordHeadBytes + length;
    }
    content.wholeBytes = at;
    content.wasTorn = at != bytes.size();
    return content;
}

Journal::Journal(std::filesystem::path path, int descriptor, std::uint64_t bytes, std::uint64_t records)
    : path_(std::move(path)), descriptor_(descriptor), bytes_(bytes), records_(records),
      thread_([this] { syncLoop(); }) {}

Journal::~Journal() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    wake_.notify_all();
    thread_.join();
    if (descriptor_ >= 0) ::close(descriptor_);
}

Result<int> Journal::openLocked(const std::filesystem::path& path, int flags) {
    std::error_code error;
    if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), error);
    const int descriptor = ::open(path.c_str(), flags | O_RDWR | O_CLOEXEC, 0600);
    if (descriptor < 0) return systemError(path, "open the journal");
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
        ::close(descriptor);
        return Error{
            fmt::format("{}: the journal is in use: the scene is open in another window", path.string())};
    }
    return descriptor;
}

Result<std::unique_ptr<Journal>> Journal::create(const std::filesystem::path& path, std::uint64_t baseHash) {
    const Result<int> opened = openLocked(path, O_CREAT);
    if (!opened) return Error{opened.error()};
    const std::string head = journalHead(baseHash);
    // Emptied only now that it is known to be nobody else's.
    const bool good = ::ftruncate(opened.value(), 0) == 0 && writeAll(opened.value(), head);
    if (!good) {
        const Error error = systemError(path, "write the journal");
        ::close(opened.value());
        return error;
    }
    return std::unique_ptr<Journal>(new Journal(path, opened.value(), head.size(), 0));
}

Result<std::unique_ptr<Journal>> Journal::resume(const std::filesystem::path& path,
                                                 const JournalContent& content) {
    const Result<int> opened = openLocked(path, 0);
    if (!opened) return Error{opened.error()};
    const auto end = static_cast<off_t>(content.wholeBytes);
    if (::ftruncate(opened.value(), end) != 0 || ::lseek(opened.value(), end, SEEK_SET) != end) {
        const Error error = systemError(path, "write the journal");
        ::close(opened.value());
        return error;
    }
    return std::unique_ptr<Journal>(
        new Journal(path, opened.value(), content.wholeBytes, content.records.size()));
}

Result<std::unique_ptr<Journal>> Journal::lock(const std::filesystem::path& path) {
    const Result<int> opened = openLocked(path, 0);
    if (!opened) return Error{opened.error()};
    return std::unique_ptr<Journal>(new Journal(path, opened.value(), 0, 0));
}

std::optional<Error> Journal::append(std::string_view payload) {
    const std::lock_guard lock(mutex_);
    if (descriptor_ < 0) return Error{fmt::format("{}: the journal is closed", path_.string())};
    if (payload.size() > kMaxRecordBytes)
        return Error{fmt::format("{}: expected records up to 1 GiB", path_.string())};
    const std::string record = journalRecord(records_, payload);
    if (!writeAll(descriptor_, record)) {
        const Error error = systemError(path_, "write the journal");
        const auto end = static_cast<off_t>(bytes_);
        // A torn record would hide those that follow it.
        if (::ftruncate(descriptor_, end) != 0 || ::lseek(descriptor_, end, SEEK_SET) != end) {
            ::close(descriptor_);
            descriptor_ = -1;
        }
        return error;
    }
    bytes_ += record.size();
    ++records_;
    dirty_ = true;
    wake_.notify_all();
    return std::exchange(syncError_, std::nullopt);
}

JournalDraft::~JournalDraft() {
    if (descriptor_ < 0) return;
    ::unlink(path_.c_str());
    ::close(descriptor_);
}

Result<std::unique_ptr<JournalDraft>> Journal::draft(std::uint64_t baseHash,
                                                     const std::vector<std::string>& payloads) const {
    const std::filesystem::path next = path_.string() + ".new";
    const Result<int> opened = openLocked(next, O_CREAT | O_TRUNC);
    if (!opened) return Error{opened.error()};
    std::string bytes = journalHead(baseHash);
    for (std::size_t i = 0; i < payloads.size(); ++i)
        bytes += journalRecord(i, payloads[i]);
    std::unique_ptr<JournalDraft> draft(
        new JournalDraft(next, opened.value(), bytes.size(), payloads.size()));
    if (!writeAll(opened.value(), bytes) || ::fdatasync(opened.value()) != 0)
        return systemError(path_, "write the journal");
    return draft;
}

std::optional<Error> Journal::adopt(JournalDraft& draft, const std::vector<std::string>& since) {
    std::string bytes;
    for (std::size_t i = 0; i < since.size(); ++i)
        bytes += journalRecord(draft.records_ + i, since[i]);
    const std::lock_guard lock(mutex_);
    if (!writeAll(draft.descriptor_, bytes) || ::rename(draft.path_.c_str(), path_.c_str()) != 0)
        return systemError(path_, "write the journal");
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = std::exchange(draft.descriptor_, -1);
    bytes_ = draft.bytes_ + bytes.size();
    records_ = draft.records_ + since.size();
    dirty_ = !since.empty();
    wake_.notify_all();
    return std::nullopt;
}

std::optional<Error> Journal::sync() {
    std::unique_lock lock(mutex_);
    dirty_ = false;
    return syncUnlocked(lock) ? std::nullopt : std::optional(systemError(path_, "make the journal durable"));
}

// The disk may take long: appending does not wait for it.
bool Journal::syncUnlocked(std::unique_lock<std::mutex>& lock) const {
    if (descriptor_ < 0) return true;
    const int descriptor = ::dup(descriptor_);
    lock.unlock();
    const bool good = descriptor >= 0 && ::fdatasync(descriptor) == 0;
    const int reason = errno;
    if (descriptor >= 0) ::close(descriptor);
    lock.lock();
    errno = reason;
    return good;
}

void Journal::syncLoop() {
    std::unique_lock lock(mutex_);
    while (!stopping_) {
        wake_.wait(lock, [this] { return dirty_ || stopping_; });
        // Records that follow soon share one sync.
        wake_.wait_for(lock, std::chrono::milliseconds(kSyncDelayMs), [this] { return stopping_; });
        if (!dirty_ || descriptor_ < 0) continue;
        dirty_ = false;
        if (!syncUnlocked(lock)) syncError_ = systemError(path_, "make the journal durable");
    }
}

void Journal::discard() {
    const std::lock_guard lock(mutex_);
    if (descriptor_ < 0) return;
    ::unlink(path_.c_str());
    ::close(descriptor_);
    descriptor_ = -1;
}

std::filesystem::path defaultJournalPath(const std::filesystem::path& scenePath) {
    namespace fs = std::filesystem;
    std::error_code error;
    fs::path absolute = fs::weakly_canonical(scenePath, error);
    if (error) absolute = fs::absolute(scenePath, error);
    const char* state = std::getenv("XDG_STATE_HOME");
    const char* home = std::getenv("HOME");
    const fs::path root = state && *state ? fs::path(state)
                          : home && *home ? fs::path(home) / ".local" / "state"
                                          : fs::temp_directory_path(error);
    return root / "kilolux" / "journals" /
           (scenePath.filename().string().substr(0, 100) + "-" + hashText(hashBytes(absolute.string())) +
            ".journal");
}

} // namespace kilolux
