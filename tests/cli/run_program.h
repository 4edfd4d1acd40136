// Starts build/kilolux as a user would, and keeps what it printed and its exit code.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace kilolux {

struct ProgramRun {
    int exitCode = -1; // -1: did not end by itself
    std::string out;
    std::string err;
};

inline std::string readText(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

// An EXR's bytes but for the time of writing, which OpenImageIO puts in.
inline std::string withoutDate(std::string bytes) {
    const std::string label("capDate\0string\0", 15);
    const std::size_t at = bytes.find(label);
    if (at != std::string::npos) bytes.replace(at + label.size() + 4, 19, 19, '-'); // 4: the text's length
    return bytes;
}

// A test with an empty folder of its own, which is also the program's working folder.
class ProgramTest : public testing::Test {
  protected:
    void SetUp() override {
        const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
        folder_ =
            std::filesystem::temp_directory_path() / ("kilolux-" + std::string(test->test_suite_name()) +
                                                      "-" + test->name() + "-" + std::to_string(getpid()));
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    ProgramRun run(std::vector<std::string> arguments) const {
        const std::filesystem::path out = folder_.string() + ".out";
        const std::filesystem::path err = folder_.string() + ".err";
        arguments.insert(arguments.begin(), KILOLUX_PROGRAM);
        std::vector<char*> argv;
        for (std::string& argument : arguments)
            argv.push_back(argument.data());
        argv.push_back(nullptr);
        const pid_t child = fork();
        if (child == 0) {
            const bool ready = chdir(folder_.c_str()) == 0 && std::freopen("/dev/null", "r", stdin) &&
                               std::freopen(out.c_str(), "w", stdout) &&
                               std::freopen(err.c_str(), "w", stderr);
            if (ready) execv(KILOLUX_PROGRAM, argv.data());
            _exit(127);
        }
        int status = 0;
        waitpid(child, &status, 0);
        ProgramRun result{WIFEXITED(status) ? WEXITSTATUS(status) : -1, readText(out), readText(err)};
        std::filesystem::remove(out);
        std::filesystem::remove(err);
        return result;
    }

    // Runs and expects the code, nothing on stdout, and exactly one error line with every one of `parts` in
    // it.
    void expectRefusal(int code, const std::vector<std::string>& arguments,
                       const std::vector<std::string>& parts) const {
        const ProgramRun result = run(arguments);
        const std::string command = testing::PrintToString(arguments) + "\n" + result.err;
        EXPECT_EQ(result.exitCode, code) << command;
        EXPECT_EQ(result.out, "") << command;
        EXPECT_TRUE(result.err.starts_with("kilolux: error: ")) << command;
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << command;
        for (const std::string& part : parts)
            EXPECT_NE(result.err.find(part), std::string::npos) << "'" << part << "' is not in\n" << command;
    }

    static std::string scene(const std::string& name) {
        return KILOLUX_SOURCE_DIR "/content/scenes/" + name + ".glb";
    }

    std::filesystem::path folder_;
};

} // namespace kilolux
