// The journal's bytes: torn and damaged at every place, appended to, locked, on a full disk.
#include "renderer/document/file_hash.h"
#include "renderer/document/file_replace.h"
#include "renderer/document/journal.h"
#include "tests/unit/edits/edits_kit.h"

#include <csignal>
#include <set>
#include <sys/resource.h>

namespace kilolux {
namespace {

using namespace test;

const std::vector<std::string> kRecords = {"first", "", std::string(300, 'x'), "last\n{}"};

std::string wholeJournal() {
    std::string bytes = journalHead(77);
    for (std::size_t i = 0; i < kRecords.size(); ++i)
        bytes += journalRecord(i, kRecords[i]);
    return bytes;
}

// Lets this process write no file beyond a size: as on a full disk, a part is written, the rest fails.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(rlim_t bytes) {
        std::signal(SIGXFSZ, SIG_IGN);
        getrlimit(RLIMIT_FSIZE, &old_);
        const rlimit limit{bytes, old_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() { setrlimit(RLIMIT_FSIZE, &old_); }

  private:
    rlimit old_{};
};

TEST(JournalBytes, TornAtEveryByte) {
    const std::string whole = wholeJournal();
    std::vector<std::size_t> ends{journalHead(77).size()};
    for (std::size_t i = 0; i < kRecords.size(); ++i)
        ends.push_back(ends.back() + journalRecord(i, kRecords[i]).size());
    for (std::size_t length = 0; length <= whole.size(); ++length) {
        const auto content = parseJournal(std::string_view(whole).substr(0, length));
        if (length < ends[0]) {
            EXPECT_FALSE(content) << length;
            continue;
        }
        ASSERT_TRUE(content) << length;
        std::size_t expected = 0;
        while (expected < kRecords.size() && ends[expected + 1] <= length)
            ++expected;
        ASSERT_EQ(content.value().records.size(), expected) << length;
        for (std::size_t i = 0; i < expected; ++i)
            EXPECT_EQ(content.value().records[i], kRecords[i]);
        EXPECT_EQ(content.value().wholeBytes, ends[expected]);
        EXPECT_EQ(content.value().wasTorn, length != ends[expected]);
        EXPECT_EQ(content.value().baseHash, 77u);
    }
}

TEST(JournalBytes, AnyChangedByteEndsIt) {
    const std::string whole = wholeJournal();
    for (std::size_t i = 0; i < whole.size(); ++i) {
        std::string damaged = whole;
        damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
        const auto content = parseJournal(damaged);
        if (!content) continue; // in the head
        ASSERT_LT(content.value().records.size(), kRecords.size()) << i;
        for (std::size_t r = 0; r < content.value().records.size(); ++r)
            EXPECT_EQ(content.value().records[r], kRecords[r]) << i;
    }
}

TEST(JournalBytes, RecordsDoNotPassForEachOther) {
    std::string swapped = journalHead(1) + journalRecord(1, "b") + journalRecord(0, "a");
    EXPECT_TRUE(parseJournal(swapped).value().records.empty());
}

TEST(JournalFile, GoesOnBehindATornEnd) {
    const TempFolder folder;
    const std::filesystem::path path = folder.path() / "deep" / "j";
    {
        auto journal = Journal::create(path, 5);
        ASSERT_TRUE(journal) << journal.error();
        EXPECT_FALSE(journal.value()->append("one"));
        EXPECT_FALSE(journal.value()->append("two"));
        const auto second = Journal::create(path, 5);
        ASSERT_FALSE(second) << "locked";
        EXPECT_NE(second.error().find("another window"), std::string::npos);
    }
    std::ofstream(path, std::ios::binary | std::ios::app) << "torn";
    const auto content = parseJournal(readBytes(path));
    ASSERT_TRUE(content);
    EXPECT_TRUE(content.value().wasTorn);
    {
        auto journal = Journal::resume(path, content.value());
        ASSERT_TRUE(journal);
        EXPECT_FALSE(journal.value()->append("three"));
        EXPECT_FALSE(journal.value()->sync());
    }
    EXPECT_EQ(parseJournal(readBytes(path)).value().records,
              (std::vector<std::string>{"one", "two", "three"}));
}

TEST(JournalFile, FullDiskLeavesNoTornRecord) {
    const TempFolder folder;
    const std::filesystem::path path = folder.path() / "j";
    auto journal = Journal::create(path, 5);
    ASSERT_TRUE(journal);
    EXPECT_FALSE(journal.value()->append("before"));
    {
        const FileSizeLimit limit(60);
        const auto error = journal.value()->append(std::string(100, 'x'));
        ASSERT_TRUE(error);
        EXPECT_NE(error->message.find(path.string()), std::string::npos);
    }
    EXPECT_FALSE(journal.value()->append("after"));
    EXPECT_EQ(parseJournal(readBytes(path)).value().records, (std::vector<std::string>{"before", "after"}));
}

TEST(ReplaceFile, OldOrNewWhateverHappens) {
    const TempFolder folder;
    const std::filesystem::path path = folder.write("f", "old");
    struct Crash {};
    for (const ReplaceStage stage :
         {ReplaceStage::Opened, ReplaceStage::Written, ReplaceStage::Synced, ReplaceStage::Renamed}) {
        folder.write("f", "old");
        ReplaceOptions options;
        options.onStage = [&](ReplaceStage reached) {
            EXPECT_EQ(readBytes(path), reached == ReplaceStage::Renamed ? "new" : "old");
            if (reached == stage) throw Crash{};
        };
        EXPECT_THROW(static_cast<void>(replaceFile(path, "new", options)), Crash);
        EXPECT_EQ(readBytes(path), stage == ReplaceStage::Renamed ? "new" : "old");
    }
}

TEST(ReplaceFile, FullDiskKeepsTheOldFileAndLeavesNoOther) {
    const TempFolder folder;
    const std::filesystem::path path = folder.write("f", "old");
    {
        const FileSizeLimit limit(50);
        const auto error = replaceFile(path, std::string(100, 'n'));
        ASSERT_TRUE(error);
        EXPECT_NE(error->message.find(path.string()), std::string::npos);
    }
    EXPECT_EQ(readBytes(path), "old");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(ReplaceFile, KeepsPermissionsAndFollowsLinks) {
    namespace fs = std::filesystem;
    const TempFolder folder;
    const fs::path path = folder.write("f", "old");
    fs::permissions(path, fs::perms(0640));
    fs::create_symlink("f", folder.path() / "link");
    EXPECT_FALSE(replaceFile(folder.path() / "link", "new"));
    EXPECT_TRUE(fs::is_symlink(folder.path() / "link"));
    EXPECT_EQ(readBytes(path), "new");
    EXPECT_EQ(fs::status(path).permissions(), fs::perms(0640));
    EXPECT_TRUE(replaceFile(folder.path(), "x")) << "a folder";
    EXPECT_TRUE(replaceFile(folder.path() / "no" / "such", "x"));
}

TEST(FileHash, TellsEveryBitAndLength) {
    const std::string text = "0123456789abcdefghij";
    std::set<std::uint64_t> hashes{hashBytes(text), hashBytes(text + '\0'), hashBytes("")};
    for (std::size_t bit = 0; bit < text.size() * 8; ++bit) {
        std::string changed = text;
        changed[bit / 8] = static_cast<char>(changed[bit / 8] ^ (1 << bit % 8));
        hashes.insert(hashBytes(changed));
    }
    EXPECT_EQ(hashes.size(), text.size() * 8 + 3);
    std::uint64_t back = 0;
    EXPECT_TRUE(parseHash(hashText(0xAB), back));
    EXPECT_EQ(back, 0xABu);
    EXPECT_FALSE(parseHash("xyz", back));
}

} // namespace
} // namespace kilolux
