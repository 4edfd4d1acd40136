// Pictures written and read back by the image library, and what happens when they cannot be written.
#include "renderer/output/picture_file.h"

#include <OpenImageIO/imageio.h>
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <unistd.h>

namespace kilolux {
namespace {

namespace fs = std::filesystem;

// A folder of its own for each test, removed with everything in it.
class PictureFile : public testing::Test {
  protected:
    void SetUp() override {
        const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
        folder_ = fs::temp_directory_path() / ("kilolux-" + name + "-" + std::to_string(getpid()));
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    std::vector<std::string> filesInFolder() const {
        std::vector<std::string> names;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder_))
            names.push_back(entry.path().filename().string());
        return names;
    }

    fs::path folder_;
};

struct ReadPicture {
    OIIO::ImageSpec spec;
    std::vector<float> pixels;
};

ReadPicture readPicture(const fs::path& file) {
    ReadPicture picture;
    const auto input = OIIO::ImageInput::open(file.string());
    if (!input) {
        ADD_FAILURE() << "cannot open " << file << ": " << OIIO::geterror();
        return picture;
    }
    picture.spec = input->spec();
    picture.pixels.resize(picture.spec.image_pixels() * picture.spec.nchannels);
    EXPECT_TRUE(input->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, picture.pixels.data()));
    return picture;
}

FloatImage rampImage(int width, int height, int channels) {
    FloatImage image{width, height, channels, {}};
    for (int i = 0; i < width * height * channels; ++i)
        image.pixels.push_back(0.001f * static_cast<float>(i * i) - 0.5f);
    return image;
}

TEST_F(PictureFile, ExtensionChoosesTheFormat) {
    EXPECT_EQ(pictureFormat("a/b.png").value(), PictureFormat::Png);
    EXPECT_EQ(pictureFormat("B.EXR").value(), PictureFormat::Exr);
    EXPECT_EQ(pictureFormat("c.v2.hdr").value(), PictureFormat::Hdr);
    for (const char* name : {"a", "a.jpg", ".png", "png", "a.png.txt", ""}) {
        const Result<PictureFormat> format = pictureFormat(name);
        ASSERT_FALSE(format) << name;
        EXPECT_NE(format.error().find(name), std::string::npos);
        EXPECT_NE(format.error().find(".exr"), std::string::npos);
    }
}

TEST_F(PictureFile, PngKeepsEveryByteAndOrder) {
    std::vector<std::uint8_t> bytes;
    for (int i = 0; i < 16 * 17 * 3; ++i)
        bytes.push_back(static_cast<std::uint8_t>(i * 7));
    const fs::path file = folder_ / "a.png";
    ASSERT_FALSE(writePng(file, 16, 17, bytes));
    const ReadPicture picture = readPicture(file);
    EXPECT_EQ(picture.spec.width, 16);
    EXPECT_EQ(picture.spec.height, 17);
    EXPECT_EQ(picture.spec.format, OIIO::TypeDesc::UINT8);
    ASSERT_EQ(picture.pixels.size(), bytes.size());
    for (std::size_t i = 0; i < bytes.size(); ++i)
        ASSERT_EQ(std::lround(picture.pixels[i] * 255.0f), bytes[i]) << i;
    EXPECT_EQ(filesInFolder(), std::vector<std::string>{"a.png"});
}

TEST_F(PictureFile, ExrFloatIsExact) {
    FloatImage image = rampImage(5, 3, 3);
    image.pixels[4] = 1.0e9f;
    image.pixels[5] = std::numeric_limits<float>::quiet_NaN();
    const fs::path file = folder_ / "a.exr";
    ASSERT_FALSE(writeExr(file, image, ExrDepth::Float));
    const ReadPicture picture = readPicture(file);
    EXPECT_EQ(picture.spec.format, OIIO::TypeDesc::FLOAT);
    ASSERT_EQ(picture.pixels.size(), image.pixels.size());
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        if (i == 5)
            EXPECT_TRUE(std::isnan(picture.pixels[i])) << "a wrong pixel must stay visible";
        else
            EXPECT_EQ(picture.pixels[i], image.pixels[i]) << i;
    }
}

TEST_F(PictureFile, ExrHalfRoundsAndClamps) {
    FloatImage image = rampImage(4, 4, 4);
    image.pixels[0] = 1.0e9f;
    image.pixels[1] = -1.0e9f;
    const fs::path file = folder_ / "a.exr";
    ASSERT_FALSE(writeExr(file, image, ExrDepth::Half));
    const ReadPicture picture = readPicture(file);
    EXPECT_EQ(picture.spec.format, OIIO::TypeDesc::HALF);
    ASSERT_EQ(picture.pixels.size(), image.pixels.size());
    EXPECT_EQ(picture.pixels[0], 65504.0f);
    EXPECT_EQ(picture.pixels[1], -65504.0f);
    for (std::size_t i = 2; i < image.pixels.size(); ++i)
        EXPECT_NEAR(picture.pixels[i], image.pixels[i], std::abs(image.pixels[i]) / 2048 + 1e-7) << i;
}

TEST_F(PictureFile, ExrChannelCounts) {
    for (const int channels : {1, 2, 3, 4, 6}) {
        const FloatImage image = rampImage(3, 2, channels);
        const fs::path file = folder_ / "a.exr";
        ASSERT_FALSE(writeExr(file, image, ExrDepth::Float));
        const ReadPicture picture = readPicture(file);
        EXPECT_EQ(picture.spec.nchannels, channels);
        EXPECT_EQ(picture.pixels, image.pixels) << channels << " channels";
    }
}

TEST_F(PictureFile, HdrKeepsLightWithinItsPrecision) {
    FloatImage image = rampImage(9, 5, 3);
    const fs::path file = folder_ / "a.hdr";
    ASSERT_FALSE(writeHdr(file, image));
    const ReadPicture picture = readPicture(file);
    ASSERT_EQ(picture.pixels.size(), image.pixels.size());
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
        const float* wanted = &image.pixels[i];
        // One exponent for three channels: 8 bits relative to the largest of them.
        const float step = std::max({wanted[0], wanted[1], wanted[2], 0.0f}) / 128 + 1e-6f;
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(picture.pixels[i + c], std::max(wanted[c], 0.0f), step) << i;
    }
    EXPECT_TRUE(writeHdr(folder_ / "b.hdr", rampImage(2, 2, 4)));
}

TEST_F(PictureFile, ExistingFileIsReplacedWhole) {
    const fs::path file = folder_ / "a.png";
    std::ofstream(file) << "not a picture";
    ASSERT_FALSE(writePng(file, 2, 1, std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(readPicture(file).pixels.size(), 6u);
    EXPECT_EQ(filesInFolder().size(), 1u);
}

TEST_F(PictureFile, FailuresNameTheFileAndLeaveNothing) {
    std::ofstream(folder_ / "plain") << "x";
    fs::create_directory(folder_ / "folder.png");
    const std::vector<std::uint8_t> pixel{1, 2, 3};
    for (const char* name : {"missing/a.png", "plain/a.png", "folder.png"}) {
        const fs::path file = folder_ / name;
        EXPECT_TRUE(checkWritable(file)) << name;
        const std::optional<Error> error = writePng(file, 1, 1, pixel);
        ASSERT_TRUE(error) << name;
        EXPECT_NE(error->message.find(file.string()), std::string::npos) << error->message;
        EXPECT_EQ(error->message.find('\n'), std::string::npos) << error->message;
    }
    EXPECT_EQ(filesInFolder().size(), 2u);
}

TEST_F(PictureFile, WrongAmountOfDataIsRefused) {
    EXPECT_TRUE(writePng(folder_ / "a.png", 2, 2, std::vector<std::uint8_t>(11)));
    EXPECT_TRUE(writePng(folder_ / "a.png", 0, 0, {}));
    FloatImage image = rampImage(2, 2, 3);
    image.pixels.pop_back();
    EXPECT_TRUE(writeExr(folder_ / "a.exr", image, ExrDepth::Float));
    EXPECT_TRUE(writeHdr(folder_ / "a.hdr", image));
    EXPECT_TRUE(filesInFolder().empty());
}

TEST_F(PictureFile, TextIsWrittenWhole) {
    const fs::path file = folder_ / "a.json";
    ASSERT_FALSE(writeText(file, "{}\n"));
    std::ifstream stream(file);
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(stream), {}), "{}\n");
    EXPECT_EQ(filesInFolder().size(), 1u);
}

} // namespace
} // namespace kilolux
