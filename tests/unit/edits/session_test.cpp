// Sessions with a journal: what an earlier session that ended without warning leaves, taken up again.
#include "tests/unit/edits/kill_kit.h"

#include <csignal>
#include <sys/resource.h>

namespace kilolux {
namespace {

using namespace test;

class SessionTest : public testing::Test {
  protected:
    void SetUp() override {
        path_ = everyLight().write(folder_);
        original_ = readBytes(path_);
        options_.journal = folder_.path() / "journal";
        session_ = openSession(path_, options_);
        ASSERT_TRUE(session_);
    }
    void set(const char* light, const char* field, EditValue value, const std::string& key = "") {
        auto edits = setField(session_->scene(), EditTarget::Light, lightNamed(session_->scene(), light),
                              field, std::move(value));
        ASSERT_TRUE(edits) << edits.error();
        const auto error = session_->apply("set", edits.value(), key);
        ASSERT_FALSE(error) << error->message;
    }
    // Ends the session as a crash would, and opens the scene again.
    void crash() {
        session_.reset();
        session_ = openSession(path_, options_);
        ASSERT_TRUE(session_);
        const auto warning = session_->takeWarning();
        EXPECT_FALSE(warning) << warning->message;
    }
    // Saves; the bytes of the file.
    std::string text() {
        const auto error = session_->save();
        EXPECT_FALSE(error) << error->message;
        return readBytes(path_);
    }

    TempFolder folder_;
    std::filesystem::path path_;
    std::string original_;
    SessionOptions options_;
    std::unique_ptr<EditSession> session_;
};

TEST_F(SessionTest, UnsavedChangesAreTakenUp) {
    set("Point", "intensity", 2.0, "drag");
    set("Point", "intensity", 3.0, "drag");
    session_->seal();
    set("Spot", "temperatureK", 2700.0);
    ASSERT_FALSE(session_->apply(
        "add", addLight(session_->scene(), session_->ids(), LightDef{}, Trs{{1, 2, 3}}, "new")));
    set("Sun", "muted", true);
    ASSERT_FALSE(session_->undo());
    const std::uint64_t newId = lightNamed(session_->scene(), "new");
    EXPECT_EQ(readBytes(path_), original_);
    session_.reset();
    EXPECT_EQ(EditSession::recoverableChanges(path_, options_.journal), 6u);
    crash();
    EXPECT_EQ(session_->recoveredChanges(), 6u);
    EXPECT_TRUE(session_->hasUnsavedChanges());
    EXPECT_EQ(defOf(session_->scene(), "Point").intensity, 3.0);
    EXPECT_EQ(lightNamed(session_->scene(), "new"), newId);
    EXPECT_TRUE(session_->history().canRedo()) << "the history comes back as well";
    ASSERT_FALSE(session_->redo());
    EXPECT_TRUE(session_->scene().lights[0].muted);
    while (session_->history().canUndo())
        ASSERT_FALSE(session_->undo());
    EXPECT_EQ(defOf(session_->scene(), "Point").intensity, 1.0);
    EXPECT_EQ(text(), original_);
}

TEST_F(SessionTest, GoesOnBehindASave) {
    ASSERT_FALSE(session_->apply(
        "add", addLight(session_->scene(), session_->ids(), LightDef{}, Trs{{1, 2, 3}}, "a")));
    ASSERT_FALSE(
        session_->apply("add", addLight(session_->scene(), session_->ids(), LightDef{}, Trs{}, "b", 0)));
    ASSERT_FALSE(
        session_->apply("delete", deleteLight(session_->scene(), lightNamed(session_->scene(), "a"))));
    set("Spot two", "intensity", 5.0);
    const std::uint64_t b = lightNamed(session_->scene(), "b");
    ASSERT_FALSE(session_->save());
    const std::string saved = readBytes(path_);
    set("b", "intensity", 6.0);
    set("Spot two", "transform", Trs{{3, 2, 1}, glm::normalize(glm::dquat(0.3, 0.5, 0.7, 0.1))});
    ASSERT_FALSE(
        session_->apply("add", addLight(session_->scene(), session_->ids(), LightDef{}, Trs{}, "c")));
    // Past the save and back: undone changes of before it are edits as well.
    for (int i = 0; i < 5; ++i)
        ASSERT_FALSE(session_->undo());
    for (int i = 0; i < 5; ++i)
        ASSERT_FALSE(session_->redo());
    crash();
    EXPECT_EQ(session_->recoveredChanges(), 13u);
    EXPECT_EQ(lightNamed(session_->scene(), "b"), b);
    EXPECT_EQ(defOf(session_->scene(), "b").intensity, 6.0);
    EXPECT_EQ(lightNamed(session_->scene(), "c"), session_->scene().lights.read().back().id);
    const std::string recovered = text();
    const auto reopened = importGltf(path_);
    ASSERT_TRUE(reopened);
    EXPECT_EQ(reopened.value().lights.size(), 9u);
    EXPECT_EQ(defOf(reopened.value(), "Spot two").intensity, 5.0);
    while (session_->history().canUndo())
        ASSERT_FALSE(session_->undo());
    EXPECT_EQ(text(), saved) << "the save is the start of the recovered session";
}

TEST_F(SessionTest, SavedStateHasNothingToRecover) {
    set("Sun", "muted", true);
    ASSERT_FALSE(session_->save());
    crash();
    EXPECT_EQ(session_->recoveredChanges(), 0u);
    EXPECT_FALSE(session_->hasUnsavedChanges());
    EXPECT_TRUE(session_->scene().lights[0].muted);
    session_->discardJournal();
    EXPECT_FALSE(std::filesystem::exists(options_.journal));
}

// The journal knows of a save before the file does.
TEST_F(SessionTest, CrashBetweenJournalAndRename) {
    set("Sun", "intensity", 5.0);
    const std::string before = readBytes(options_.journal);
    ASSERT_FALSE(session_->save());
    const std::string saved = readBytes(path_);
    const auto after = parseJournal(readBytes(options_.journal));
    ASSERT_TRUE(after);
    ASSERT_EQ(after.value().records.size(), 1u) << "the state as saved, and nothing of before";
    const std::string between = before + journalRecord(1, after.value().records[0]);
    for (const std::string& file : {original_, saved}) {
        session_.reset();
        folder_.write("scene.gltf", file);
        folder_.write("journal", between);
        crash();
        EXPECT_EQ(defOf(session_->scene(), "Sun").intensity, 5.0);
        EXPECT_EQ(session_->hasUnsavedChanges(), file == original_);
        EXPECT_EQ(text(), saved);
    }
}

TEST_F(SessionTest, JournalOfAnotherVersionIsKeptAside) {
    set("Sun", "intensity", 5.0);
    session_.reset();
    folder_.write("scene.gltf", original_ + " ");
    EXPECT_EQ(EditSession::recoverableChanges(path_, options_.journal), 0u);
    session_ = openSession(path_, options_);
    ASSERT_TRUE(session_);
    const auto warning = session_->takeWarning();
    ASSERT_TRUE(warning);
    EXPECT_NE(warning->message.find(options_.journal.string() + ".old"), std::string::npos);
    EXPECT_TRUE(std::filesystem::exists(options_.journal.string() + ".old"));
    EXPECT_EQ(defOf(session_->scene(), "Sun").intensity, 1000.0);
}

// Well-formed records that do not fit: nothing of them is taken, nothing crashes.
TEST_F(SessionTest, StrangeRecordsAreRefusedAsAWhole) {
    set("Sun", "intensity", 5.0);
    session_.reset();
    const std::string good = readBytes(options_.journal);
    const std::size_t first = parseJournal(good).value().records.size();
    const char* strange[] = {
        "",
        "{}",
        "[]",
        "null",
        "{\"change\":5}",
        "{\"state\":{}}",
        "{\"change\":{\"edits\":[{}]}}",
        R"({"change":{"edits":[{"on":"light","id":99,"field":"muted","from":false,"to":true}]}})",
        R"({"change":{"edits":[{"on":"node","id":0,"from":null,"to":{"parent":-5}}]}})",
        R"({"undo":{"edits":[{"on":"light","id":1,"from":{"id":1},"to":null}]}})",
        R"({"change":{"edits":[{"on":"light","id":99,"from":null,"to":{"id":99,"node":-1,"def":0}},
            {"on":"light","id":99,"field":"name","from":"","to":"x"}]}})"};
    for (const char* record : strange) {
        std::ofstream(options_.journal, std::ios::binary | std::ios::trunc)
            << good << journalRecord(first, record);
        auto session = openSession(path_, options_);
        ASSERT_TRUE(session) << record;
        const bool isForeignState = std::string(record).starts_with("{\"state");
        EXPECT_EQ(defOf(session->scene(), "Sun").intensity, isForeignState ? 5.0 : 1000.0) << record;
        EXPECT_EQ(session->takeWarning().has_value(), !isForeignState) << record;
    }
}

TEST_F(SessionTest, TornAtEveryByteStillOpens) {
    set("Sun", "intensity", 5.0);
    set("Point", "muted", true);
    session_.reset();
    const std::string whole = readBytes(options_.journal);
    for (std::size_t length = 0; length < whole.size(); length += 7) {
        std::ofstream(options_.journal, std::ios::binary | std::ios::trunc) << whole.substr(0, length);
        auto session = openSession(path_, options_);
        ASSERT_TRUE(session) << length;
        EXPECT_LE(session->recoveredChanges(), 1u);
    }
}

TEST_F(SessionTest, RecordsWaitForAFullDisk) {
    set("Sun", "intensity", 5.0);
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit old{};
    getrlimit(RLIMIT_FSIZE, &old);
    const rlimit full{std::filesystem::file_size(options_.journal) + 10, old.rlim_max};
    setrlimit(RLIMIT_FSIZE, &full);
    set("Sun", "intensity", 6.0);
    EXPECT_TRUE(session_->takeWarning());
    set("Sun", "intensity", 7.0);
    const auto failed = session_->save();
    setrlimit(RLIMIT_FSIZE, &old);
    EXPECT_TRUE(failed) << "the scene is larger than the disk";
    EXPECT_EQ(readBytes(path_), original_);
    EXPECT_TRUE(session_->hasUnsavedChanges());
    set("Sun", "intensity", 8.0);
    crash();
    EXPECT_EQ(defOf(session_->scene(), "Sun").intensity, 8.0);
    EXPECT_EQ(session_->recoveredChanges(), 4u);
}

TEST(Kills, LoseNothingThatWasAcknowledged) {
    killRounds(12, 1);
}

// 200 rounds; for a night, not for every test run: --gtest_also_run_disabled_tests --gtest_filter='*Soak*'
TEST(Kills, DISABLED_Soak) {
    killRounds(200, 2);
}

} // namespace
} // namespace kilolux
