// Saving beside the work: what is edited, undone or cancelled while the file is written, and what a crash in
// between leaves.
#include "renderer/document/task_watch.h"
#include "tests/unit/edits/edits_kit.h"

#include <csignal>
#include <sys/resource.h>
#include <thread>

namespace kilolux {
namespace {

using namespace test;

class SaveRunTest : public testing::Test {
  protected:
    void SetUp() override {
        path_ = everyLight().writeBinary(folder_);
        original_ = readBytes(path_);
        options_.journal = folder_.path() / "journal";
        session_ = openSession(path_, options_);
        ASSERT_TRUE(session_);
    }
    void setSun(double intensity) {
        auto edits = setField(session_->scene(), EditTarget::Light, 1, "intensity", intensity);
        ASSERT_TRUE(edits);
        ASSERT_FALSE(session_->apply("set", edits.value(), "drag"));
    }
    double sun() const { return defOf(session_->scene(), "Sun").intensity; }
    double savedSun(const std::filesystem::path& path) const {
        const auto scene = importGltf(path);
        EXPECT_TRUE(scene);
        return scene ? defOf(scene.value(), "Sun").intensity : 0.0;
    }
    std::unique_ptr<SaveRun> prepare() {
        auto run = session_->prepareSave();
        EXPECT_TRUE(run);
        return run ? std::move(run.value()) : nullptr;
    }
    void crash() {
        session_.reset();
        session_ = openSession(path_, options_);
        ASSERT_TRUE(session_);
    }

    TempFolder folder_;
    std::filesystem::path path_;
    std::string original_;
    SessionOptions options_;
    std::unique_ptr<EditSession> session_;
};

TEST_F(SaveRunTest, WhatIsEditedMeanwhileIsUnsavedAndRecovered) {
    setSun(5.0);
    const auto run = prepare();
    setSun(6.0); // the same drag goes on
    run->run(nullptr);
    setSun(7.0);
    session_->finishSave(*run);
    EXPECT_EQ(run->end(), SaveEnd::Saved);
    EXPECT_EQ(savedSun(path_), 5.0);
    EXPECT_TRUE(session_->hasUnsavedChanges());
    ASSERT_FALSE(session_->undo());
    EXPECT_EQ(sun(), 5.0) << "what was saved is a step";
    EXPECT_FALSE(session_->hasUnsavedChanges());
    ASSERT_FALSE(session_->redo());
    crash();
    EXPECT_FALSE(session_->takeWarning());
    EXPECT_EQ(sun(), 7.0);
    EXPECT_TRUE(session_->hasUnsavedChanges());
    ASSERT_FALSE(session_->save());
    EXPECT_EQ(savedSun(path_), 7.0);
}

TEST_F(SaveRunTest, WhatIsUndoneMeanwhileComesBackFromTheFile) {
    setSun(5.0);
    const auto run = prepare();
    ASSERT_FALSE(session_->undo());
    run->run(nullptr);
    session_->finishSave(*run);
    EXPECT_TRUE(session_->hasUnsavedChanges());
    crash();
    EXPECT_EQ(sun(), 1000.0);
    ASSERT_FALSE(session_->save());
    EXPECT_EQ(savedSun(path_), 1000.0);
}

// The journal could not be begun anew, as after a crash right behind the replacement: the state in it counts
// the changes before it that are not part of the file.
TEST_F(SaveRunTest, CrashBeforeTheJournalBeginsAnew) {
    setSun(5.0);
    const auto run = prepare();
    setSun(6.0);
    std::filesystem::create_directories(options_.journal.string() + ".new");
    run->run(nullptr);
    session_->finishSave(*run);
    EXPECT_EQ(run->end(), SaveEnd::Saved);
    EXPECT_TRUE(session_->takeWarning()) << "that the journal stays long";
    setSun(7.0);
    std::filesystem::remove(options_.journal.string() + ".new");
    crash();
    EXPECT_FALSE(session_->takeWarning());
    EXPECT_EQ(sun(), 7.0);
    EXPECT_EQ(session_->recoveredChanges(), 2u) << "the one before the save is in the file";
    // And where the replacement did not happen, the whole way leads from the old file.
    session_.reset();
    folder_.write(path_.filename().string(), original_);
    crash();
    EXPECT_EQ(sun(), 7.0);
    EXPECT_EQ(session_->recoveredChanges(), 3u);
}

TEST_F(SaveRunTest, CancelledItLeavesTheFileAndTheChanges) {
    setSun(5.0);
    const auto run = prepare();
    TaskWatch watch;
    watch.cancel();
    run->run(&watch);
    session_->finishSave(*run);
    EXPECT_EQ(run->end(), SaveEnd::Cancelled);
    EXPECT_EQ(readBytes(path_), original_);
    EXPECT_TRUE(session_->hasUnsavedChanges());
    ASSERT_FALSE(session_->save());
    EXPECT_EQ(savedSun(path_), 5.0);
}

TEST_F(SaveRunTest, AFullDiskLeavesTheFileAndTheChanges) {
    setSun(5.0);
    const auto run = prepare();
    setSun(6.0);
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit old{};
    getrlimit(RLIMIT_FSIZE, &old);
    const rlimit full{original_.size() / 2, old.rlim_max};
    setrlimit(RLIMIT_FSIZE, &full);
    run->run(nullptr);
    setrlimit(RLIMIT_FSIZE, &old);
    session_->finishSave(*run);
    EXPECT_EQ(run->end(), SaveEnd::Failed);
    EXPECT_NE(run->error().find(path_.string()), std::string::npos);
    EXPECT_EQ(readBytes(path_), original_);
    EXPECT_TRUE(session_->hasUnsavedChanges());
    crash();
    EXPECT_EQ(sun(), 6.0);
}

TEST_F(SaveRunTest, AnotherProgramsFileIsToldAndLeft) {
    setSun(5.0);
    const auto run = prepare();
    folder_.write(path_.filename().string(), original_ + " ");
    run->run(nullptr);
    session_->finishSave(*run);
    EXPECT_EQ(run->end(), SaveEnd::ChangedOnDisk);
    EXPECT_EQ(readBytes(path_), original_ + " ");
    EXPECT_TRUE(session_->hasUnsavedChanges());
}

TEST_F(SaveRunTest, UnderAnotherNameTheJournalMovesWithWhatIsUnsaved) {
    setSun(5.0);
    const std::filesystem::path other = folder_.path() / "other.glb";
    auto run = session_->prepareSaveAs(other);
    ASSERT_TRUE(run);
    EXPECT_FALSE(session_->prepareSave()) << "one at a time";
    setSun(6.0);
    run.value()->run(nullptr);
    session_->finishSave(*run.value());
    EXPECT_EQ(session_->path(), other);
    EXPECT_EQ(savedSun(other), 5.0);
    EXPECT_EQ(readBytes(path_), original_);
    EXPECT_FALSE(std::filesystem::exists(options_.journal));
    options_.journal = folder_.path() / defaultJournalPath(other).filename();
    path_ = other;
    crash();
    EXPECT_EQ(sun(), 6.0);
}

TEST_F(SaveRunTest, TheSessionMayEndBeforeItsSave) {
    setSun(5.0);
    const auto run = prepare();
    session_->discardJournal();
    session_.reset();
    run->run(nullptr);
    EXPECT_EQ(run->end(), SaveEnd::Saved);
    EXPECT_EQ(savedSun(path_), 5.0);
    EXPECT_FALSE(std::filesystem::exists(options_.journal));
}

// For the sanitizers too: one thread edits, another saves.
TEST_F(SaveRunTest, EditingWhileManySavesRun) {
    for (int round = 0; round < 20; ++round) {
        setSun(10.0 + round);
        const auto run = prepare();
        std::thread thread([&] { run->run(nullptr); });
        for (int i = 0; i < 20; ++i)
            setSun(100.0 + i);
        thread.join();
        session_->finishSave(*run);
        ASSERT_EQ(run->end(), SaveEnd::Saved) << run->error();
        EXPECT_EQ(savedSun(path_), 10.0 + round);
    }
    crash();
    EXPECT_EQ(sun(), 119.0);
}

TEST(ImportWatch, ACancelledImportEndsAndOneThatIsWatchedTellsHowFarItIs) {
    const TempFolder folder;
    const std::filesystem::path path = everyLight().writeBinary(folder);
    TaskWatch watch;
    ImportOptions options;
    options.watch = &watch;
    ASSERT_TRUE(importGltf(path, options));
    EXPECT_GT(watch.share(), 0.9);
    watch.cancel();
    const auto cancelled = importGltf(path, options);
    ASSERT_FALSE(cancelled);
    EXPECT_NE(cancelled.error().find("cancelled"), std::string::npos);
}

} // namespace
} // namespace kilolux
