#include "renderer/lights_cpp/ltc_table.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>

namespace kilolux {

static_assert(std::endian::native == std::endian::little,
              "the table is read and written as it lies in memory");

namespace {

constexpr std::array<char, 8> kMagic = {'K', 'X', 'L', 'T', 'C', '0', '1', '\n'};
constexpr std::uint32_t kMaxNodes = 1024;

LtcTable& table() {
    static LtcTable bound;
    return bound;
}

} // namespace

glm::dvec4 LtcTable::sample(glm::dvec2 uv, LtcLayer layer) const {
    const std::vector<glm::vec4>& nodes = layer == LtcLayer::Parameters ? parameters : scales;
    const double x = std::clamp(uv.x * width - 0.5, 0.0, width - 1.0);
    const double y = std::clamp(uv.y * height - 0.5, 0.0, height - 1.0);
    const int x0 = static_cast<int>(x);
    const int y0 = static_cast<int>(y);
    const int x1 = std::min(x0 + 1, width - 1);
    const int y1 = std::min(y0 + 1, height - 1);
    const auto node = [&](int column, int row) {
        return glm::dvec4(nodes[static_cast<std::size_t>(row) * width + column]);
    };
    const double fx = x - x0;
    return glm::mix(glm::mix(node(x0, y0), node(x1, y0), fx), glm::mix(node(x0, y1), node(x1, y1), fx),
                    y - y0);
}

Result<LtcTable> loadLtcTable(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) return Error{"'" + path.string() + "': cannot be opened"};
    std::array<char, 8> magic{};
    std::array<std::uint32_t, 2> size{};
    file.read(magic.data(), magic.size());
    file.read(reinterpret_cast<char*>(size.data()), sizeof(size));
    if (!file || magic != kMagic)
        return Error{"'" + path.string() + "': byte 0: expected a table made by ltc_fit ('KXLTC01')"};
    if (size[0] < 2 || size[1] < 2 || size[0] > kMaxNodes || size[1] > kMaxNodes)
        return Error{"'" + path.string() + "': byte 8: expected 2 to 1024 nodes a side, found " +
                     std::to_string(size[0]) + " x " + std::to_string(size[1])};
    LtcTable loaded{.width = static_cast<int>(size[0]), .height = static_cast<int>(size[1])};
    const std::size_t count = static_cast<std::size_t>(size[0]) * size[1];
    std::vector<glm::vec4> pairs(count * 2);
    file.read(reinterpret_cast<char*>(pairs.data()),
              static_cast<std::streamsize>(pairs.size() * sizeof(glm::vec4)));
    if (!file)
        return Error{"'" + path.string() + "': ends after " + std::to_string(file.gcount()) + " of " +
                     std::to_string(pairs.size() * sizeof(glm::vec4)) + " bytes of nodes"};
    for (std::size_t i = 0; i < count; ++i) {
        loaded.parameters.push_back(pairs[2 * i]);
        loaded.scales.push_back(pairs[2 * i + 1]);
        for (int c = 0; c < 4; ++c)
            if (!std::isfinite(pairs[2 * i][c]) || !std::isfinite(pairs[2 * i + 1][c]))
                return Error{"'" + path.string() + "': node " + std::to_string(i) +
                             ": expected finite numbers"};
    }
    return loaded;
}

Result<std::filesystem::path> saveLtcTable(const LtcTable& saved, const std::filesystem::path& path) {
    std::ofstream file(path, std::ios::binary);
    const std::array<std::uint32_t, 2> size = {static_cast<std::uint32_t>(saved.width),
                                               static_cast<std::uint32_t>(saved.height)};
    file.write(kMagic.data(), kMagic.size());
    file.write(reinterpret_cast<const char*>(size.data()), sizeof(size));
    for (std::size_t i = 0; i < saved.parameters.size(); ++i) {
        file.write(reinterpret_cast<const char*>(&saved.parameters[i]), sizeof(glm::vec4));
        file.write(reinterpret_cast<const char*>(&saved.scales[i]), sizeof(glm::vec4));
    }
    file.flush();
    if (!file) return Error{"'" + path.string() + "': cannot be written"};
    return path;
}

void useLtcTable(LtcTable bound) {
    assert(bound.width >= 2 && bound.height >= 2);
    table() = std::move(bound);
}

const LtcTable& boundLtcTable() {
    assert(table().width > 0 && "call useLtcTable first");
    return table();
}

} // namespace kilolux
