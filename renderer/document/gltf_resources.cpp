// Where bytes come from: files below the scene's folder, data URIs (RFC 2397, base64 of RFC 4648), the binary
// chunk. tinygltf is not given this work: its loader reads whole files without a bound and follows any path.
#include "renderer/document/gltf_context.h"

#include <array>
#include <map>

namespace kilolux::gltf {

namespace {

int hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

// A '%' that starts no escape stands for itself: such URIs are wrong, but exporters write them.
std::string percentDecode(std::string_view text) {
    std::string decoded;
    decoded.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '%' && i + 2 < text.size()) {
            const int high = hexDigit(text[i + 1]), low = hexDigit(text[i + 2]);
            if (high >= 0 && low >= 0) {
                decoded += static_cast<char>(high * 16 + low);
                i += 2;
                continue;
            }
        }
        decoded += text[i];
    }
    return decoded;
}

constexpr std::array<std::int8_t, 256> base64Table() {
    std::array<std::int8_t, 256> table{};
    table.fill(-1);
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < kDigits.size(); ++i) {
        table[static_cast<unsigned char>(kDigits[i])] = static_cast<std::int8_t>(i);
    }
    return table;
}

Bytes decodeBase64(std::string_view text, std::string_view place) {
    static constexpr auto kTable = base64Table();
    while (!text.empty() && text.back() == '=')
        text.remove_suffix(1);
    Bytes bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    std::uint32_t bits = 0;
    int bitCount = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const int digit = kTable[static_cast<unsigned char>(text[i])];
        if (digit < 0) fail(place, "expected base64, found a foreign character at {} of the data", i);
        bits = bits << 6 | static_cast<std::uint32_t>(digit);
        bitCount += 6;
        if (bitCount < 8) continue;
        bitCount -= 8;
        bytes.push_back(static_cast<std::uint8_t>(bits >> bitCount & 0xFF));
    }
    return bytes;
}

bool hasScheme(std::string_view uri) {
    const std::size_t colon = uri.find(':');
    return colon != uri.npos && colon > 0 && uri.substr(0, colon).find_first_of("/\\") == uri.npos;
}

} // namespace

bool isDataUri(std::string_view uri) {
    return uri.starts_with("data:");
}

Bytes decodeDataUri(std::string_view uri, std::string_view place) {
    const std::size_t comma = uri.find(',');
    if (comma == uri.npos) fail(place, "expected a data URI with a comma before its data");
    const std::string_view header = uri.substr(0, comma), data = uri.substr(comma + 1);
    if (header.ends_with(";base64")) return decodeBase64(data, place);
    const std::string text = percentDecode(data);
    return Bytes(text.begin(), text.end());
}

std::filesystem::path resolveUri(const std::filesystem::path& folder, std::string_view uri,
                                 std::string_view place) {
    const std::string decoded = percentDecode(uri);
    const auto refuse = [&] {
        fail(place, "expected a path within the folder of the file, found '{}'", printable(uri));
    };
    if (decoded.empty() || hasScheme(uri) || hasScheme(decoded)) refuse();
    if (decoded.find('\0') != decoded.npos || decoded.size() > 4000) refuse();
    // A backslash separates folders for some exporters, and must not hide a '..' from this check.
    std::string slashes = decoded;
    std::replace(slashes.begin(), slashes.end(), '\\', '/');
    const std::filesystem::path relative = std::filesystem::path(slashes).lexically_normal();
    if (relative.is_absolute() || relative.empty() || *relative.begin() == "..") refuse();
    return folder / relative;
}

void loadBuffers(ImportContext& context) {
    const auto buffers = context.json.find("buffers");
    if (buffers == context.json.end()) return;
    std::map<std::filesystem::path, std::shared_ptr<const Bytes>> files;
    for (std::size_t i = 0; i < buffers->size(); ++i) {
        context.reach("Reading buffers", 0.3, 0.35, i, buffers->size());
        Json& json = (*buffers)[i];
        const std::string place = fmt::format("/buffers/{}", i);
        const auto byteLength = json["byteLength"].get<std::uint64_t>();
        Buffer buffer;
        if (const auto uri = json.find("uri"); uri == json.end()) {
            // Only the first buffer may live in the binary chunk; others without URI are placeholders for
            // data that an extension fills, and using them fails at the buffer view.
            if (i == 0) buffer.bytes = context.binaryChunk;
        } else {
            const std::string uriPlace = place + "/uri";
            const auto& text = uri->get_ref<const std::string&>();
            if (isDataUri(text)) {
                buffer.storage = std::make_shared<const Bytes>(decodeDataUri(text, uriPlace));
                *uri = ""; // it may be most of the file, and is not needed again
            } else {
                const auto path = resolveUri(context.path.parent_path(), text, uriPlace);
                auto& file = files[path];
                if (!file) {
                    file = std::make_shared<const Bytes>(readFile(path, UINT64_MAX, uriPlace, &context));
                    context.fileBytes += file->size();
                }
                buffer.storage = file;
            }
            buffer.bytes = *buffer.storage;
        }
        const bool isPlaceholder = !buffer.storage && !(i == 0 && context.binaryChunk.data());
        if (!isPlaceholder && buffer.bytes.size() < byteLength) {
            fail(place + "/byteLength", "expected at most the {} bytes that are there, found {}",
                 buffer.bytes.size(), byteLength);
        }
        if (!isPlaceholder) buffer.bytes = buffer.bytes.first(byteLength);
        context.buffers.push_back(std::move(buffer));
    }
}

std::span<const std::uint8_t> bufferViewBytes(const ImportContext& context, int bufferView,
                                              std::string_view place) {
    if (const auto it = context.decodedViews.find(bufferView); it != context.decodedViews.end())
        return it->second;
    const Json& view = context.json["bufferViews"][bufferView];
    const auto& buffer = context.buffers[view["buffer"].get<std::size_t>()];
    const auto offset = view.value("byteOffset", std::uint64_t{0});
    const auto length = view["byteLength"].get<std::uint64_t>();
    if (offset > buffer.bytes.size() || length > buffer.bytes.size() - offset) {
        fail(place, "expected bufferViews/{} within the {} bytes of buffers/{}, found {} bytes at {}",
             bufferView, buffer.bytes.size(), view["buffer"].get<std::size_t>(), length, offset);
    }
    return buffer.bytes.subspan(offset, length);
}

} // namespace kilolux::gltf
