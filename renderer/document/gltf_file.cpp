// From a file to a JSON document: bounded reading, .glb chunks (glTF 2.0, section 4.4), and JSON within
// limits of depth and size, because the parsed form takes many times the text.
#include "renderer/document/gltf_context.h"
#include "renderer/document/task_watch.h"

#include <cstring>
#include <fstream>

namespace kilolux::gltf {

namespace {

constexpr std::uint32_t kGlbMagic = 0x46546C67;      // "glTF"
constexpr std::uint32_t kJsonChunkType = 0x4E4F534A; // "JSON"
constexpr std::uint32_t kBinaryChunkType = 0x004E4942;
constexpr std::size_t kGlbHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;
constexpr int kMaxJsonDepth = 100;
// A parsed value takes up to about 50 bytes, in this document and again in tinygltf's.
constexpr std::size_t kFreeJsonValues = 1'500'000;
constexpr std::size_t kTextBytesPerJsonValue = 8;

std::uint32_t readU32(std::span<const std::uint8_t> bytes, std::size_t offset) {
    return static_cast<std::uint32_t>(bytes[offset]) | static_cast<std::uint32_t>(bytes[offset + 1]) << 8 |
           static_cast<std::uint32_t>(bytes[offset + 2]) << 16 |
           static_cast<std::uint32_t>(bytes[offset + 3]) << 24;
}

// Returns the JSON chunk and sets the context's binary chunk.
std::string_view splitGlb(ImportContext& context, std::span<const std::uint8_t> file) {
    if (file.size() < kGlbHeaderBytes) fail("header", "expected 12 bytes, found {}", file.size());
    const std::uint32_t version = readU32(file, 4);
    if (version != 2) fail("header", "expected version 2 of the binary container, found {}", version);
    const std::uint32_t length = readU32(file, 8);
    if (length > file.size() || length < kGlbHeaderBytes) {
        fail("header", "expected a length up to the file's {} bytes, found {}", file.size(), length);
    }
    std::string_view json;
    std::size_t offset = kGlbHeaderBytes;
    for (int chunk = 0; offset < length; ++chunk) {
        const std::string place = fmt::format("chunk {}", chunk);
        if (length - offset < kChunkHeaderBytes) fail(place, "expected a header of 8 bytes, the file ends");
        const std::size_t chunkBytes = readU32(file, offset);
        const std::uint32_t type = readU32(file, offset + 4);
        offset += kChunkHeaderBytes;
        if (chunkBytes > length - offset) {
            fail(place, "expected at most {} bytes, found a length of {}", length - offset, chunkBytes);
        }
        const auto payload = file.subspan(offset, chunkBytes);
        if ((chunk == 0) != (type == kJsonChunkType))
            fail(place, "expected exactly one JSON chunk, as the first");
        if (chunk == 0) json = {reinterpret_cast<const char*>(payload.data()), payload.size()};
        if (chunk == 1 && type == kBinaryChunkType) context.binaryChunk = payload;
        offset += chunkBytes;
    }
    if (!json.data()) fail("chunk 0", "expected a JSON chunk, the file ends");
    return json;
}

// One pass over the text before anything is allocated for it.
void checkJsonLimits(std::string_view text) {
    const std::size_t maxValues = kFreeJsonValues + text.size() / kTextBytesPerJsonValue;
    std::size_t values = 1;
    int depth = 0;
    bool inString = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (inString) {
            if (c == '\\') ++i;
            if (c == '"') inString = false;
            continue;
        }
        if (c == '"') inString = true;
        if (c == '{' || c == '[') ++depth;
        if (c == '}' || c == ']') --depth;
        if (c == ',' || c == '{' || c == '[') ++values;
        if (depth > kMaxJsonDepth)
            fail(fmt::format("byte {}", i), "expected at most {} nested levels", kMaxJsonDepth);
    }
    if (values > maxValues) fail("JSON", "expected at most {} values, found about {}", maxValues, values);
}

} // namespace

std::string printable(std::string_view text) {
    constexpr std::size_t kMaxChars = 240;
    std::string line;
    for (const char c : text.substr(0, kMaxChars)) {
        const auto byte = static_cast<unsigned char>(c);
        line += byte < 0x20 || byte == 0x7F ? '?' : c;
    }
    if (text.size() > kMaxChars) {
        // Not in the middle of a UTF-8 sequence.
        while (!line.empty() && (static_cast<unsigned char>(line.back()) & 0xC0) == 0x80)
            line.pop_back();
        if (!line.empty() && static_cast<unsigned char>(line.back()) >= 0x80) line.pop_back();
        line += "...";
    }
    return line;
}

void ImportContext::addWarning(std::string text) {
    constexpr std::size_t kMaxWarnings = 200;
    if (scene.warnings.size() < kMaxWarnings) {
        scene.warnings.push_back(std::move(text));
    } else {
        ++droppedWarnings;
    }
}

void ImportContext::chargeGeometry(std::uint64_t bytes, std::string_view place) {
    constexpr std::uint64_t kFreeBytes = 32ull << 20;
    constexpr std::uint64_t kTimesFile = 9;
    const std::uint64_t limit = kFreeBytes + kTimesFile * fileBytes;
    geometryBytes += bytes;
    if (bytes > limit || geometryBytes > limit) {
        fail(place, "expected at most {} MiB of geometry in a file of {} bytes", limit >> 20, fileBytes);
    }
}

void ImportContext::reach(const char* doing, double share) const {
    if (!options.watch) return;
    if (options.watch->isCancelled()) throw ImportCancelled();
    options.watch->reach(doing, share);
}

void ImportContext::reach(const char* doing, double from, double to, std::size_t part,
                          std::size_t parts) const {
    reach(doing, from + (to - from) * double(part) / double(std::max<std::size_t>(parts, 1)));
}

Bytes readFile(const std::filesystem::path& path, std::uint64_t maxBytes, std::string_view place,
               const ImportContext* context) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status))
        fail(place, "expected the file '{}', not found", printable(path.string()));
    // A pipe or a device would block or never end.
    if (!std::filesystem::is_regular_file(status)) {
        fail(place, "expected a regular file, found '{}'", printable(path.string()));
    }
    const std::uint64_t size = std::filesystem::file_size(path, error);
    if (error) fail(place, "expected a readable file, '{}': {}", printable(path.string()), error.message());
    Bytes bytes(std::min<std::uint64_t>(size, maxBytes));
    std::ifstream stream(path, std::ios::binary);
    // In parts, so that a slow disk can be given up.
    constexpr std::size_t kPartBytes = 8u << 20;
    for (std::size_t at = 0; at < bytes.size(); at += kPartBytes) {
        if (context && context->options.watch && context->options.watch->isCancelled())
            throw ImportCancelled();
        const std::size_t part = std::min(kPartBytes, bytes.size() - at);
        stream.read(reinterpret_cast<char*>(bytes.data()) + at, static_cast<std::streamsize>(part));
        if (!stream || static_cast<std::size_t>(stream.gcount()) != part)
            fail(place, "expected {} readable bytes in '{}'", bytes.size(), printable(path.string()));
    }
    return bytes;
}

void parseDocument(ImportContext& context, std::span<const std::uint8_t> file) {
    const bool binary = file.size() >= 4 && readU32(file, 0) == kGlbMagic;
    if (!binary && context.path.extension() == ".glb") fail("header", "expected the four letters 'glTF'");
    const std::string_view text =
        binary ? splitGlb(context, file)
               : std::string_view(reinterpret_cast<const char*>(file.data()), file.size());
    if (text.empty()) fail("JSON", "expected a glTF document, found nothing");
    checkJsonLimits(text);
    try {
        context.json = Json::parse(text.begin(), text.end());
    } catch (const Json::exception& e) {
        // "[json.exception.parse_error.101] parse error at line 1, column 2: ...": the bracket says nothing
        // to users.
        std::string_view what = e.what();
        if (const auto bracket = what.find("] "); bracket != what.npos) what.remove_prefix(bracket + 2);
        fail("JSON", "expected valid JSON, found a {}", printable(what));
    }
    if (!context.json.is_object()) fail("JSON", "expected an object at the top level");
}

} // namespace kilolux::gltf
