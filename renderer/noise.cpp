#include "renderer/noise.h"

#include <bit>
#include <cassert>
#include <fstream>
#include <string>

namespace kilolux {

static_assert(std::endian::native == std::endian::little,
              "the mask is read and written as it lies in memory");

namespace {

constexpr std::array<char, 8> kMagic = {'K', 'X', 'N', 'O', 'I', '0', '1', '\n'};
constexpr std::array<std::uint32_t, 4> kSize = {NoiseMask::kWidth, NoiseMask::kHeight, NoiseMask::kLayers, 4};
constexpr std::size_t kTexels = std::size_t{kSize[0]} * kSize[1] * kSize[2];
constexpr std::size_t kHeaderBytes = sizeof(kMagic) + sizeof(kSize);

std::string sizeText(const std::array<std::uint32_t, 4>& size) {
    return std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " + std::to_string(size[2]) +
           " with " + std::to_string(size[3]) + " channels";
}

} // namespace

Result<NoiseMask> loadNoiseMask(const std::filesystem::path& path) {
    const auto error = [&](const std::string& what) { return Error{"'" + path.string() + "': " + what}; };
    std::ifstream file(path, std::ios::binary);
    if (!file) return error("cannot be opened");
    std::array<char, 8> magic{};
    std::array<std::uint32_t, 4> size{};
    file.read(magic.data(), magic.size());
    if (!file || magic != kMagic) return error("byte 0: expected masks made by make_noise ('KXNOI01')");
    file.read(reinterpret_cast<char*>(size.data()), sizeof(size));
    if (!file || size != kSize)
        return error("byte 8: expected " + sizeText(kSize) +
                     (file ? ", found " + sizeText(size) : ", file ends"));
    NoiseMask mask{.texels = std::vector<NoiseMask::Texel>(kTexels)};
    const std::size_t bytes = kTexels * sizeof(NoiseMask::Texel);
    file.read(reinterpret_cast<char*>(mask.texels.data()), static_cast<std::streamsize>(bytes));
    if (!file)
        return error("byte " + std::to_string(kHeaderBytes + file.gcount()) + ": expected " +
                     std::to_string(bytes) + " bytes of values, the file ends after " +
                     std::to_string(file.gcount()));
    if (file.peek() != std::ifstream::traits_type::eof())
        return error("byte " + std::to_string(kHeaderBytes + bytes) + ": expected the end of the file");
    return mask;
}

Result<std::filesystem::path> saveNoiseMask(const NoiseMask& mask, const std::filesystem::path& path) {
    assert(mask.texels.size() == kTexels);
    std::ofstream file(path, std::ios::binary);
    file.write(kMagic.data(), kMagic.size());
    file.write(reinterpret_cast<const char*>(kSize.data()), sizeof(kSize));
    file.write(reinterpret_cast<const char*>(mask.texels.data()),
               static_cast<std::streamsize>(kTexels * sizeof(NoiseMask::Texel)));
    file.flush();
    if (!file) return Error{"'" + path.string() + "': cannot be written"};
    return path;
}

} // namespace kilolux
