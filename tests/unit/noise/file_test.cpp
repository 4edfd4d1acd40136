// The file of masks: read back as written, and refused with a message that tells the place when it is
// damaged.
#include "renderer/noise.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

namespace kilolux::test {
namespace {

const std::filesystem::path kCommitted = KILOLUX_SOURCE_DIR "/content/blue_noise.bin";
constexpr std::size_t kHeaderBytes = 24;

std::string committedBytes() {
    std::ostringstream bytes;
    bytes << std::ifstream(kCommitted, std::ios::binary).rdbuf();
    return bytes.str();
}

class NoiseFile : public testing::Test {
  protected:
    void SetUp() override {
        path_ =
            std::filesystem::path(testing::TempDir()) /
            (std::string("noise-") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".bin");
    }
    void TearDown() override { std::filesystem::remove(path_); }

    // The message that loading these bytes gives; empty when they load.
    std::string messageFor(const std::string& bytes) {
        std::ofstream(path_, std::ios::binary) << bytes;
        const auto loaded = loadNoiseMask(path_);
        return loaded ? "" : loaded.error();
    }

    std::filesystem::path path_;
};

TEST_F(NoiseFile, LoadsAndComesBack) {
    const auto loaded = loadNoiseMask(kCommitted);
    ASSERT_TRUE(loaded) << loaded.error();
    EXPECT_EQ(loaded.value().texels.size(), 64u * 64u * 32u);
    ASSERT_TRUE(saveNoiseMask(loaded.value(), path_));
    const auto again = loadNoiseMask(path_);
    ASSERT_TRUE(again) << again.error();
    EXPECT_EQ(again.value().texels, loaded.value().texels);
    EXPECT_EQ(messageFor(committedBytes()), "");
    // The layout that the head comment states: layer, row, column, channel, little-endian.
    const std::string bytes = committedBytes();
    const std::size_t at = kHeaderBytes + (((5 * 64 + 7) * 64 + 9) * 4 + 2) * 2;
    const int value = static_cast<unsigned char>(bytes[at]) | static_cast<unsigned char>(bytes[at + 1]) << 8;
    EXPECT_EQ(loaded.value().at(9, 7, 5)[2], value);
}

TEST_F(NoiseFile, DamagedFilesAreRefusedWithTheirPlace) {
    const std::string good = committedBytes();
    std::string bad = good;
    bad[3] = 'X';
    EXPECT_NE(messageFor(bad).find("byte 0: expected masks made by make_noise"), std::string::npos)
        << messageFor(bad);
    bad = good;
    bad[16] = 16; // layers
    EXPECT_NE(messageFor(bad).find("byte 8: expected 64 x 64 x 32 with 4 channels, found 64 x 64 x 16"),
              std::string::npos)
        << messageFor(bad);
    EXPECT_NE(messageFor(good.substr(0, 1000)).find("byte 1000: expected 1048576 bytes"), std::string::npos)
        << messageFor(good.substr(0, 1000));
    EXPECT_NE(messageFor(good + "x").find("byte 1048600: expected the end"), std::string::npos);
    EXPECT_NE(messageFor(good.substr(0, 12)).find("byte 8"), std::string::npos);
    EXPECT_NE(messageFor("").find("byte 0"), std::string::npos);
    EXPECT_NE(messageFor("").find(path_.string()), std::string::npos);
    const auto missing = loadNoiseMask(path_.string() + ".none");
    ASSERT_FALSE(missing);
    EXPECT_NE(missing.error().find("cannot be opened"), std::string::npos);
}

TEST_F(NoiseFile, UnwritablePlaceIsAnError) {
    const auto loaded = loadNoiseMask(kCommitted);
    ASSERT_TRUE(loaded);
    const auto saved = saveNoiseMask(loaded.value(), path_.string() + "/no/such/folder.bin");
    ASSERT_FALSE(saved);
    EXPECT_NE(saved.error().find("cannot be written"), std::string::npos);
}

} // namespace
} // namespace kilolux::test
