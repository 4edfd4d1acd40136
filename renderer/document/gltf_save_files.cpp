// Saving, the bytes: the JSON of a .glb among its chunks, and the files that a .gltf refers to.
#include "renderer/document/file_hash.h"
#include "renderer/document/file_replace.h"
#include "renderer/document/gltf_context.h"
#include "renderer/document/gltf_save.h"
#include "renderer/document/light_properties.h"

#include <cstring>

namespace kilolux {

namespace {

namespace fs = std::filesystem;
using gltf::Json;

constexpr std::size_t kGlbHeadBytes = 20; // header, and the head of the first chunk

std::uint32_t readU32(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
    return value;
}

void putU32(std::string& bytes, std::size_t value) {
    for (std::size_t i = 0; i < 4; ++i)
        bytes += static_cast<char>(value >> (8 * i));
}

bool isGlb(std::string_view bytes) {
    return bytes.starts_with("glTF");
}

// Where the JSON ends in a file; nothing where it is not a .glb that could be read.
std::optional<std::size_t> jsonEnd(std::string_view bytes) {
    if (bytes.size() < kGlbHeadBytes || readU32(bytes, 12) > bytes.size() - kGlbHeadBytes)
        return std::nullopt;
    return kGlbHeadBytes + readU32(bytes, 12);
}

// Every string under the key "uri", at any depth: extensions that nobody here knows keep theirs so too. And
// what lights and the dome name in their extras.
void collectUris(const Json& json, std::vector<std::string>& uris) {
    const auto isUri = [](const std::string& key) {
        bool is = key == "uri" || key == "domeImage";
        forEachLightProperty([&](const auto& each) {
            is = is || (each.names != properties::Names::Nothing && key == each.name);
        });
        return is;
    };
    for (auto it = json.begin(); it != json.end(); ++it) {
        if (json.is_object() && it->is_string() && isUri(it.key())) uris.push_back(it->get<std::string>());
        if (it->is_structured()) collectUris(*it, uris);
    }
}

std::optional<Error> copyResource(const fs::path& from, const fs::path& to) {
    std::error_code error;
    if (!fs::is_regular_file(from, error)) return std::nullopt; // missing already in the original
    if (!fs::exists(to, error)) {
        fs::create_directories(to.parent_path(), error);
        if (fs::copy_file(from, to, error)) return std::nullopt;
        return Error{
            fmt::format("{}: cannot be copied from '{}': {}", to.string(), from.string(), error.message())};
    }
    const Result<std::string> a = readWholeFile(from), b = readWholeFile(to);
    if (a && b && a.value() == b.value()) return std::nullopt;
    return Error{fmt::format("{}: expected nothing, or the same file as '{}', which the scene refers to",
                             to.string(), from.string())};
}

} // namespace

Result<SourceFile> readSource(const fs::path& path) {
    Result<std::string> file = readWholeFile(path);
    if (!file) return Error{file.error()};
    const std::string& bytes = file.value();
    SourceFile source;
    source.path = path;
    source.diskHash = hashBytes(bytes);
    source.isBinary = isGlb(bytes);
    if (!source.isBinary) {
        source.jsonText = std::move(file.value());
        return source;
    }
    const std::optional<std::size_t> end = jsonEnd(bytes);
    if (!end) return Error{path.string() + ": chunk 0: expected a JSON chunk within the file"};
    source.jsonText = bytes.substr(kGlbHeadBytes, *end - kGlbHeadBytes);
    source.restHash = hashBytes(std::string_view(bytes).substr(*end));
    return source;
}

Result<std::string> withJsonText(const SourceFile& source, std::string_view diskBytes,
                                 std::string_view jsonText) {
    if (!source.isBinary) return std::string(jsonText);
    const std::optional<std::size_t> end = isGlb(diskBytes) ? jsonEnd(diskBytes) : std::nullopt;
    if (!end || hashBytes(diskBytes.substr(*end)) != source.restHash) {
        return Error{source.path.string() +
                     ": expected the binary data that the scene was opened with; another "
                     "program has changed it"};
    }
    std::string json(jsonText);
    if (json != source.jsonText) {
        json.erase(json.find_last_not_of(' ') + 1);
        json.resize((json.size() + 3) / 4 * 4, ' ');
    }
    const std::string_view rest = diskBytes.substr(*end);
    // Bytes behind the container's stated length stay behind it.
    const std::size_t stated = readU32(diskBytes, 8), trailing = diskBytes.size() - stated;
    const std::size_t length = kGlbHeadBytes + json.size() + rest.size() - trailing;
    if (stated > diskBytes.size() || length > UINT32_MAX)
        return Error{source.path.string() + ": expected at most 4 GiB, which a .glb can hold"};
    std::string bytes(diskBytes.substr(0, 8));
    putU32(bytes, length);
    putU32(bytes, json.size());
    bytes += "JSON";
    bytes += json;
    bytes += rest;
    return bytes;
}

std::optional<Error> copyResources(const fs::path& source, std::string_view jsonText,
                                   const fs::path& target) {
    std::error_code error;
    const fs::path from = source.parent_path(), to = target.parent_path();
    if (fs::equivalent(from.empty() ? "." : from, to.empty() ? "." : to, error)) return std::nullopt;
    std::vector<std::string> uris;
    collectUris(Json::parse(jsonText), uris);
    for (const std::string& uri : uris) {
        if (gltf::isDataUri(uri) || uri.starts_with('#')) continue;
        try {
            const fs::path resource = gltf::resolveUri(from, uri, "uri");
            const fs::path relative = from.empty() ? resource : resource.lexically_relative(from);
            if (std::optional<Error> failed = copyResource(resource, to / relative)) return failed;
        } catch (const gltf::ImportFailure&) {
            continue; // not a file of the scene's folder: the import did not open it either
        }
    }
    return std::nullopt;
}

} // namespace kilolux
