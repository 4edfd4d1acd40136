#include "renderer/document/file_replace.h"

#include "renderer/document/posix_write.h"

#include <fcntl.h>
#include <sys/stat.h>

namespace kilolux {

namespace {

namespace fs = std::filesystem;

class Descriptor {
  public:
    explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
    ~Descriptor() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int get() const { return descriptor_; }

  private:
    int descriptor_;
};

// A new file in the folder of another, without a name while it is written where the system can do that: a
// process that is killed then leaves nothing behind.
class NewFile {
  public:
    explicit NewFile(const fs::path& beside)
        : name_(beside.string() + ".XXXXXX"), file_(openUnnamed(beside)), isNamed_(file_.get() < 0),
          named_(isNamed_ ? ::mkostemp(name_.data(), O_CLOEXEC) : -1) {}

    int get() const { return file_.get() >= 0 ? file_.get() : named_.get(); }
    const std::string& name() const { return name_; }
    bool giveName() {
        if (isNamed_) return true;
        // A link cannot replace a file, so the free name that mkostemp finds is freed for it.
        const Descriptor taken(::mkostemp(name_.data(), O_CLOEXEC));
        if (taken.get() < 0) return false;
        isNamed_ = true;
        const std::string open = fmt::format("/proc/self/fd/{}", file_.get());
        return ::unlink(name_.c_str()) == 0 &&
               ::linkat(AT_FDCWD, open.c_str(), AT_FDCWD, name_.c_str(), AT_SYMLINK_FOLLOW) == 0;
    }
    void remove() const {
        if (isNamed_) ::unlink(name_.c_str());
    }

  private:
    static int openUnnamed(const fs::path& beside) {
        const fs::path folder = beside.parent_path();
        return ::open(folder.empty() ? "." : folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    }

    std::string name_;
    Descriptor file_; // -1: this file system has no files without name
    bool isNamed_;
    Descriptor named_;
};

// The directory entry is durable only once the directory is.
bool syncFolder(const fs::path& folder) {
    const Descriptor descriptor(
        ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    // Some file systems cannot sync a folder; that is not the user's fault.
    return descriptor.get() >= 0 && (::fsync(descriptor.get()) == 0 || errno == EINVAL || errno == ENOTSUP);
}

} // namespace

std::optional<Error> replaceFile(const fs::path& path, std::string_view bytes,
                                 const ReplaceOptions& options) {
    const auto reach = [&](ReplaceStage stage) {
        if (options.onStage) options.onStage(stage);
    };
    std::error_code ignored;
    fs::path target = fs::is_symlink(path, ignored) ? fs::canonical(path, ignored) : path;
    if (target.empty()) return Error{fmt::format("{}: expected a link to a file that exists", path.string())};
    struct stat old {};
    const bool existed = ::stat(target.c_str(), &old) == 0;
    if (existed && !S_ISREG(old.st_mode))
        return Error{fmt::format("{}: expected a regular file to write to", path.string())};
    if (existed && ::access(target.c_str(), W_OK) != 0) return systemError(path, "write");
    NewFile file(target);
    if (file.get() < 0) return systemError(path, "create a file beside it");
    const auto giveUp = [&](const char* what) {
        const Error error = systemError(path, what);
        file.remove();
        return error;
    };
    reach(ReplaceStage::Opened);
    const mode_t mask = ::umask(0);
    ::umask(mask);
    if (::fchmod(file.get(), existed ? old.st_mode & 07777 : 0666 & ~mask) != 0)
        return giveUp("set permissions");
    constexpr std::size_t kPartBytes = 4u << 20;
    for (std::size_t at = 0; at < bytes.size(); at += kPartBytes) {
        if (options.onWritten) {
            const auto stopped = options.onWritten(double(at) / double(bytes.size()));
            if (stopped) return file.remove(), stopped;
        }
        if (!writeAll(file.get(), bytes.substr(at, kPartBytes))) return giveUp("write");
    }
    reach(ReplaceStage::Written);
    if (::fsync(file.get()) != 0) return giveUp("write");
    reach(ReplaceStage::Synced);
    if (options.beforeRename) {
        if (auto stopped = options.beforeRename()) return file.remove(), stopped;
    }
    if (!file.giveName() || ::rename(file.name().c_str(), target.c_str()) != 0) return giveUp("replace it");
    reach(ReplaceStage::Renamed);
    if (!syncFolder(target.parent_path())) return systemError(path, "make it durable");
    return std::nullopt;
}

Result<std::string> readWholeFile(const fs::path& path) {
    struct stat status {};
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (file.get() < 0 || ::fstat(file.get(), &status) != 0) return systemError(path, "read");
    if (!S_ISREG(status.st_mode)) return Error{fmt::format("{}: expected a regular file", path.string())};
    std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
    std::size_t have = 0;
    while (have < bytes.size()) {
        const ssize_t got = ::read(file.get(), bytes.data() + have, bytes.size() - have);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return systemError(path, "read");
        if (got == 0) break;
        have += static_cast<std::size_t>(got);
    }
    bytes.resize(have);
    return bytes;
}

} // namespace kilolux
