// Every file of the public corpora either opens or gives one clear message; none crashes, hangs or takes more
// memory than 256 MiB plus 20 times the file. Each is imported by a process of its own
// (tests/fuzz/kilolux_import.cpp), whose peak the kernel reports. The corpora lie beside the project; without
// them the tests are skipped.
#include <algorithm>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace kilolux {
namespace {

namespace fs = std::filesystem;

constexpr unsigned kMaxSeconds = 20;
constexpr long kFreeKiB = 256 * 1024;
constexpr long kTimesFile = 20;
#if defined(__SANITIZE_ADDRESS__)
constexpr bool kMeasuresMemory = false; // its shadow memory and quarantine are not the import's
#else
constexpr bool kMeasuresMemory = true;
#endif

struct Outcome {
    int exitCode = -1; // -1: ended by a signal
    int signal = 0;
    long peakKiB = 0;
    std::string output; // of both streams
};

Outcome importInChild(const fs::path& file, bool isImage, const fs::path& outputFile) {
    const pid_t child = fork();
    if (child == 0) {
        const int output = open(outputFile.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
        dup2(output, STDOUT_FILENO);
        dup2(output, STDERR_FILENO);
        // Of computing, so that a busy machine fails nothing; the wall clock only ends what blocks. Both
        // outlive exec.
        const rlimit computing{kMaxSeconds, kMaxSeconds};
        setrlimit(RLIMIT_CPU, &computing);
        alarm(kMaxSeconds * 20);
        if (isImage) execl(KILOLUX_IMPORT_PROGRAM, "kilolux_import", "--image", file.c_str(), nullptr);
        execl(KILOLUX_IMPORT_PROGRAM, "kilolux_import", file.c_str(), nullptr);
        _exit(127);
    }
    Outcome outcome;
    int status = 0;
    rusage usage{};
    wait4(child, &status, 0, &usage);
    if (WIFEXITED(status)) outcome.exitCode = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
    outcome.peakKiB = usage.ru_maxrss;
    std::ifstream stream(outputFile);
    outcome.output.assign(std::istreambuf_iterator<char>(stream), {});
    return outcome;
}

// Files that the Khronos validator passes and the import refuses all the same, each with its reason.
const std::map<std::string, std::string> kJustifiedRefusals = {};

void checkOutcome(const fs::path& file, const Outcome& outcome) {
    SCOPED_TRACE(file.string() + "\n" + outcome.output);
    EXPECT_EQ(outcome.signal, 0) << (outcome.signal == SIGALRM || outcome.signal == SIGXCPU ||
                                             outcome.signal == SIGKILL
                                         ? "takes too long"
                                         : "crashes");
    EXPECT_TRUE(outcome.exitCode == 0 || outcome.exitCode == 2) << outcome.exitCode;
    const long limitKiB = kFreeKiB + kTimesFile * static_cast<long>(fs::file_size(file)) / 1024;
    EXPECT_TRUE(!kMeasuresMemory || outcome.peakKiB <= limitKiB) << outcome.peakKiB << " KiB";
    if (outcome.exitCode == 2) {
        EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1) << "one line";
        EXPECT_EQ(outcome.output.find(file.string() + ": "), 0u) << "names the file";
        EXPECT_NE(outcome.output.find("expected"), std::string::npos) << "says what was expected";
    }
    const fs::path report = file.string() + ".report.json";
    if (outcome.exitCode == 0 || !fs::exists(report)) return;
    std::ifstream stream(report);
    const auto verdict = nlohmann::json::parse(stream);
    if (verdict["issues"]["numErrors"] == 0) {
        EXPECT_TRUE(kJustifiedRefusals.contains(file.filename().string())) << "valid by Khronos' validator";
    }
}

void checkCorpus(const char* folder) {
    const fs::path root = fs::path(KILOLUX_SOURCE_DIR) / "../shared/content" / folder;
    if (!fs::exists(root)) GTEST_SKIP() << "no corpus beside the project";
    const bool isImageCorpus = std::string_view(folder).starts_with("textures");
    static const std::set<std::string> kSceneEndings = {".gltf", ".glb"};
    static const std::set<std::string> kTextEndings = {".rst", ".md", ".txt"};
    std::string pattern = (fs::temp_directory_path() / "kilolux-corpus-XXXXXX").string();
    close(mkstemp(pattern.data()));
    int count = 0;
    long worstKiB = 0;
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
        const std::string ending = entry.path().extension().string();
        const bool isScene = kSceneEndings.contains(ending);
        const bool isImage = isImageCorpus && !kTextEndings.contains(ending);
        if (!entry.is_regular_file() || !(isScene || isImage)) continue;
        const Outcome outcome = importInChild(entry.path().lexically_normal(), isImage, pattern);
        checkOutcome(entry.path().lexically_normal(), outcome);
        worstKiB = std::max(worstKiB, outcome.peakKiB);
        ++count;
    }
    fs::remove(pattern);
    EXPECT_GT(count, 0);
    std::printf("%d files, largest peak %ld MiB\n", count, worstKiB / 1024);
}

TEST(Corpus, GltfValid) {
    checkCorpus("gltf");
}
TEST(Corpus, GltfGenerator) {
    checkCorpus("gltf_generator");
}
TEST(Corpus, GltfInvalid) {
    checkCorpus("gltf_invalid");
}
TEST(Corpus, TexturesValid) {
    checkCorpus("textures");
}
TEST(Corpus, TexturesInvalid) {
    checkCorpus("textures_invalid");
}

} // namespace
} // namespace kilolux
