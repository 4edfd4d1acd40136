// The oracle judges the shaders, so nothing of theirs may reach it: not by link (CMake) and not by include.
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>

namespace {

TEST(Independence, OracleIncludesOnlyTheDocument) {
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(KILOLUX_SOURCE_DIR "/renderer/reference")) {
        if (!entry.path().filename().string().starts_with("oracle")) continue;
        ++files;
        std::ifstream in(entry.path());
        for (std::string line; std::getline(in, line);) {
            if (!line.starts_with("#include \"")) continue;
            const bool allowed = line.starts_with("#include \"renderer/reference/oracle") ||
                                 line.starts_with("#include \"renderer/document/");
            EXPECT_TRUE(allowed) << entry.path().filename() << ": " << line;
        }
    }
    EXPECT_GT(files, 10);
}

} // namespace
