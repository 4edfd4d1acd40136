// Images: channels, encodings, limits, and files that lie about themselves.
#include "renderer/document/image_import.h"
#include "tests/unit/document/gltf_builder.h"

#include <OpenImageIO/imageio.h>
#include <limits>

namespace kilolux::test {
namespace {

template<typename T>
std::filesystem::path writeImage(const TempFolder& folder, const std::string& name, OIIO::ImageSpec spec,
                                 const std::vector<T>& pixels) {
    spec.attribute("oiio:UnassociatedAlpha", 1);
    auto output = OIIO::ImageOutput::create(name);
    const auto path = folder.path() / name;
    EXPECT_TRUE(output && output->open(path.string(), spec)) << OIIO::geterror();
    EXPECT_TRUE(output->write_image(OIIO::BaseTypeFromC<T>::value, pixels.data())) << output->geterror();
    output->close();
    return path;
}

Image import(const std::filesystem::path& path, const ImageImportOptions& options = {}) {
    auto image = importImage(path, options);
    if (!image) ADD_FAILURE() << image.error();
    return image ? image.value() : Image{};
}

using Bytes = std::vector<std::uint8_t>;
using Floats = std::vector<float>;

TEST(ImageImport, ChannelsBecomeRgba) {
    const TempFolder folder;
    const auto u8 = OIIO::TypeDesc::UINT8;
    EXPECT_EQ(import(writeImage(folder, "1.png", {2, 1, 1, u8}, Bytes{7, 9})).rgba8,
              (Bytes{7, 7, 7, 255, 9, 9, 9, 255}));
    EXPECT_EQ(import(writeImage(folder, "2.png", {1, 1, 2, u8}, Bytes{7, 9})).rgba8, (Bytes{7, 7, 7, 9}));
    EXPECT_EQ(import(writeImage(folder, "3.png", {1, 1, 3, u8}, Bytes{1, 2, 3})).rgba8,
              (Bytes{1, 2, 3, 255}));
    EXPECT_EQ(import(writeImage(folder, "4.png", {1, 1, 4, u8}, Bytes{100, 2, 3, 0})).rgba8,
              (Bytes{100, 2, 3, 0}))
        << "colour under alpha 0 is kept";
    const auto deep = writeImage(folder, "16.png", {1, 1, 3, OIIO::TypeDesc::UINT16},
                                 std::vector<std::uint16_t>{65535, 0, 32896});
    EXPECT_EQ(import(deep).rgba8, (Bytes{255, 0, 128, 255}));
}

TEST(ImageImport, FloatPicturesStayFinite) {
    const TempFolder folder;
    const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    const auto path =
        writeImage(folder, "a.exr", {2, 1, 3, OIIO::TypeDesc::FLOAT}, Floats{nan, inf, -inf, 1e9f, -2, 0.5f});
    EXPECT_EQ(import(path).rgbaF32, (Floats{0, 65504, -65504, 1, 65504, -2, 0.5f, 1}));
    EXPECT_TRUE(import(path).rgba8.empty());
}

TEST(ImageImport, TiledFilesAndOddSizesReadWhole) {
    const TempFolder folder;
    OIIO::ImageSpec spec(37, 21, 3, OIIO::TypeDesc::FLOAT);
    spec.tile_width = spec.tile_height = 16;
    Floats pixels;
    for (int i = 0; i < 37 * 21; ++i)
        pixels.insert(pixels.end(), {static_cast<float>(i), 0, 0});
    const Image image = import(writeImage(folder, "tiled.exr", spec, pixels));
    ASSERT_EQ(image.rgbaF32.size(), 37u * 21u * 4u);
    for (int i = 0; i < 37 * 21; ++i)
        EXPECT_EQ(image.rgbaF32[i * 4], static_cast<float>(i));
}

TEST(ImageImport, PicturesOverBudgetAreHalved) {
    const TempFolder folder;
    Bytes pixels;
    for (int y = 0; y < 5; ++y) {
        for (int x = 0; x < 6; ++x)
            pixels.push_back(static_cast<std::uint8_t>(x / 2 * 10 + y / 2 * 100));
    }
    const auto path = writeImage(folder, "a.png", {6, 5, 1, OIIO::TypeDesc::UINT8}, pixels);
    ImageImportOptions options;
    options.maxDecodedBytes = 40;
    const Image image = import(path, options);
    EXPECT_EQ(image.width, 3);
    EXPECT_EQ(image.height, 3);
    const Bytes red = {image.rgba8[0], image.rgba8[4], image.rgba8[8], image.rgba8[12], image.rgba8[24]};
    EXPECT_EQ(red, (Bytes{0, 10, 20, 100, 200}));
}

TEST(ImageImport, TooLargePicturesAreRefusedBeforeDecoding) {
    const TempFolder folder;
    const auto path = writeImage(folder, "a.png", {20, 1, 1, OIIO::TypeDesc::UINT8}, Bytes(20, 0));
    ImageImportOptions options;
    options.maxSizePx = 16;
    const auto image = importImage(path, options);
    ASSERT_FALSE(image);
    EXPECT_NE(image.error().find("a.png: expected 1 to 16 pixels a side, found 20 x 1"), std::string::npos)
        << image.error();
}

TEST(ImageImport, ProgressiveJpegsCannotClaimMemory) {
    // A frame header alone: SOF2, 8 bits, 60000 x 60000, 3 components.
    const Bytes file = {0xFF, 0xD8, 0xFF, 0xC2, 0x00, 0x11, 8, 0xEA, 0x60, 0xEA, 0x60,
                        3,    1,    0x11, 0,    2,    0x11, 0, 3,    0x11, 0};
    const auto image = importImage(file, "huge.jpg");
    ASSERT_FALSE(image);
    EXPECT_NE(image.error().find("progressive image of at most 64 MiB"), std::string::npos) << image.error();
}

TEST(ImageImport, ExrTilesCannotClaimMemory) {
    const TempFolder folder;
    OIIO::ImageSpec spec(16, 16, 3, OIIO::TypeDesc::FLOAT);
    spec.tile_width = spec.tile_height = 16;
    const auto path = writeImage(folder, "a.exr", spec, Floats(16 * 16 * 3, 0.5f));
    std::ifstream stream(path, std::ios::binary);
    std::string file((std::istreambuf_iterator<char>(stream)), {});
    const std::size_t tiles = file.find(std::string("tiledesc\0", 9)) + 9 + 4;
    const std::uint32_t height = 10878993;
    std::memcpy(file.data() + tiles + 4, &height, sizeof(height));
    const auto image = importImage(folder.write("b.exr", file));
    ASSERT_FALSE(image);
    EXPECT_NE(image.error().find("b.exr: expected tiles of at most 4096 pixels a side, found 16 x 10878993"),
              std::string::npos)
        << image.error();
}

TEST(ImageImport, CutFilesAreOneLineEach) {
    const TempFolder folder;
    for (const char* name : {"a.png", "a.exr", "a.hdr", "a.jpg"}) {
        Floats pixels(64 * 64 * 3);
        for (std::size_t i = 0; i < pixels.size(); ++i)
            pixels[i] = static_cast<float>(i % 97) / 97.0f;
        const bool isHdr = name[2] == 'e' || name[2] == 'h';
        const auto path = writeImage(
            folder, name, {64, 64, 3, isHdr ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8}, pixels);
        import(path);
        std::ifstream stream(path, std::ios::binary);
        const std::string whole((std::istreambuf_iterator<char>(stream)), {});
        for (std::size_t length = 0; length < whole.size(); length += 1 + whole.size() / 40) {
            const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
            const auto image = importImage(cut, "cut");
            if (image) continue; // a JPEG or HDR may end early and still show something
            EXPECT_EQ(image.error().find('\n'), std::string::npos);
            EXPECT_EQ(image.error().find("cut: expected "), 0u) << image.error();
        }
    }
}

TEST(ImageImport, OtherFilesAreNamedAsSuch) {
    const TempFolder folder;
    EXPECT_NE(importImage(folder.write("a.png", "hello")).error().find("expected a PNG, JPEG"),
              std::string::npos);
    EXPECT_NE(importImage(folder.path() / "missing.png").error().find("not found"), std::string::npos);
    EXPECT_FALSE(importImage(folder.path()));
    EXPECT_FALSE(importImage(Bytes{}, "empty"));
}

} // namespace
} // namespace kilolux::test
