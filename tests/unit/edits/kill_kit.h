// Kills editing processes with SIGKILL at random moments and opens what they leave.
#pragma once

#include "tests/unit/edits/edits_kit.h"

#include <csignal>
#include <sys/wait.h>

namespace kilolux::test {

// Edits without end: the child's n-th change sets the sun's intensity to n; after each one it says so through
// the pipe. Every few changes it undoes, redoes or saves.
[[noreturn]] inline void editForever(const std::filesystem::path& path, const SessionOptions& options,
                                     int pipe, std::uint32_t start, std::uint32_t seed) {
    auto session = EditSession::open(path, options);
    if (!session) _exit(1);
    EditSession& s = *session.value();
    std::mt19937 random(seed);
    EditIds& ids = s.ids();
    for (std::uint32_t n = start + 1;; ++n) {
        auto edits = setField(s.scene(), EditTarget::Light, 1, "intensity", double(n));
        if (!edits) _exit(2);
        if (random() % 4 == 0) {
            const Edits added =
                addLight(s.scene(), ids, LightDef{}, Trs{{double(n), 0, 0}}, std::to_string(n));
            edits.value().insert(edits.value().end(), added.begin(), added.end());
        } else if (random() % 3 == 0 && s.scene().lights.size() > 7) {
            const Edits gone = deleteLight(s.scene(), s.scene().lights.read().back().id);
            edits.value().insert(edits.value().end(), gone.begin(), gone.end());
        }
        if (s.apply("set", edits.value(), random() % 2 ? "drag" : "")) _exit(3);
        if (random() % 8 == 0 && (s.undo() || s.redo())) _exit(4);
        if (random() % 5 == 0 && s.save()) _exit(5);
        if (::write(pipe, &n, sizeof(n)) != sizeof(n)) _exit(6);
    }
}

// Each round starts from what the last one left. The file must open at any moment, and every change that was
// acknowledged must be there.
inline void killRounds(int rounds, std::uint32_t seed) {
    const TempFolder folder;
    const std::filesystem::path path = everyLight().writeBinary(folder);
    SessionOptions options;
    options.journal = folder.path() / "journal";
    std::mt19937 random(seed);
    std::uint32_t reached = 1000; // the intensity in the file
    for (int round = 0; round < rounds; ++round) {
        int ends[2];
        ASSERT_EQ(pipe(ends), 0);
        const pid_t child = fork();
        if (child == 0) {
            close(ends[0]);
            editForever(path, options, ends[1], reached, random());
        }
        close(ends[1]);
        // Until some changes are acknowledged, and then a random moment longer.
        std::uint32_t acknowledged = reached;
        for (unsigned left = 1 + random() % 40; left > 0; --left)
            ASSERT_EQ(read(ends[0], &acknowledged, sizeof(acknowledged)), ssize_t(sizeof(acknowledged)));
        usleep(random() % 3000);
        kill(child, SIGKILL);
        while (read(ends[0], &acknowledged, sizeof(acknowledged)) == ssize_t(sizeof(acknowledged))) {
        }
        close(ends[0]);
        int status = 0;
        waitpid(child, &status, 0);
        ASSERT_TRUE(WIFSIGNALED(status))
            << "round " << round << ": ended by itself with " << WEXITSTATUS(status);
        ASSERT_TRUE(importGltf(path)) << "round " << round;
        auto session = openSession(path, options);
        ASSERT_TRUE(session);
        const auto warning = session->takeWarning();
        ASSERT_FALSE(warning) << "round " << round << ": " << warning->message;
        // Killed between undoing and redoing.
        if (session->history().canRedo()) {
            ASSERT_FALSE(session->redo());
        }
        const double intensity = defOf(session->scene(), "Sun").intensity;
        EXPECT_GE(intensity, acknowledged) << "round " << round;
        EXPECT_LE(intensity, acknowledged + 1.0) << "round " << round;
        reached = static_cast<std::uint32_t>(intensity);
        if (round % 3 == 0) {
            ASSERT_FALSE(session->save());
        }
    }
}

} // namespace kilolux::test
