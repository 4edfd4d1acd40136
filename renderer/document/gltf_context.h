// What the parts of the glTF import share: the file's JSON, the parsed model, its buffers, the scene that
// grows, and the one way to fail. Internal to renderer/document.
#pragma once

#include "renderer/document/gltf_import.h"

#include <cstdint>
#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tinygltf {
class Model;
}

namespace kilolux::gltf {

using Json = nlohmann::json;
using Bytes = std::vector<std::uint8_t>;

// Thrown at the place that finds the fault, caught in importGltf, or earlier where only a part of the file is
// given up: a Result passed through every helper would drown the code that reads the file. `text` is "place:
// what was expected".
struct ImportFailure {
    std::string text;
};

// Thrown where the import looks whether anybody still waits for it.
struct ImportCancelled {};

// Text from a file made fit for one line of a message: control characters replaced, long text cut.
std::string printable(std::string_view text);

template<typename... Args>
[[noreturn]] void fail(std::string_view place, fmt::format_string<Args...> format, Args&&... args) {
    throw ImportFailure{
        fmt::format("{}: {}", printable(place), fmt::format(format, std::forward<Args>(args)...))};
}

struct Buffer {
    std::shared_ptr<const Bytes> storage; // shared by buffers that name one file
    std::span<const std::uint8_t> bytes;
};

struct ImportContext {
    std::filesystem::path path;
    ImportOptions options;
    Json json;                         // the checked document; long data URIs are dropped once decoded
    std::vector<Buffer> buffers;       // as /buffers
    std::map<int, Bytes> decodedViews; // bufferViews that were compressed
    std::span<const std::uint8_t> binaryChunk; // of a .glb
    std::uint64_t fileBytes = 0;               // of all files read so far
    std::uint64_t geometryBytes = 0;           // decoded so far
    std::set<std::string, std::less<>> warned; // places and extensions already told
    Scene scene;

    template<typename... Args>
    void warn(std::string_view place, fmt::format_string<Args...> format, Args&&... args) {
        addWarning(fmt::format("{}: {}", printable(place), fmt::format(format, std::forward<Args>(args)...)));
    }
    // The same, but only once per key in this file.
    template<typename... Args>
    void warnOnce(std::string_view key, std::string_view place, fmt::format_string<Args...> format,
                  Args&&... args) {
        if (warned.emplace(key).second) warn(place, format, std::forward<Args>(args)...);
    }
    void addWarning(std::string text); // keeps the list short: past a limit only the count grows

    // Accounts for decoded geometry and fails at `place` where the file asks for far more than it could hold
    // (an accessor without data or one shared by thousands of primitives costs a few bytes of JSON).
    void chargeGeometry(std::uint64_t bytes, std::string_view place);

    // Tells the watch how much of the whole import is done; throws ImportCancelled when nobody waits for it.
    void reach(const char* doing, double share) const;
    // The same for one of many parts that together take the import from one share to another.
    void reach(const char* doing, double from, double to, std::size_t part, std::size_t parts) const;

    std::size_t droppedWarnings = 0;
};

// --- gltf_file.cpp ---

// Reads a regular file of at most `maxBytes`; fails at `place` otherwise. `context`: whose watch is asked
// meanwhile; null: nobody's.
Bytes readFile(const std::filesystem::path& path, std::uint64_t maxBytes, std::string_view place,
               const ImportContext* context = nullptr);

// Splits .glb chunks or takes the text as it is, and parses the JSON within limits of depth and size.
// `file` must outlive the context's binaryChunk.
void parseDocument(ImportContext& context, std::span<const std::uint8_t> file);

// --- gltf_schema.cpp ---

// Checks types, ranges and references of everything that the import uses. What geometry or the node graph
// needs must be right; a wrong value elsewhere is removed from the JSON with a warning, so that its default
// applies.
void checkSchema(ImportContext& context);

// Refuses extensions that the file cannot be read without.
void checkExtensions(ImportContext& context);

// --- gltf_resources.cpp ---

// Percent-decoded `uri` below a folder, that of the scene; fails at `place` where it leaves that folder.
std::filesystem::path resolveUri(const std::filesystem::path& folder, std::string_view uri,
                                 std::string_view place);

// Bytes of a data URI; fails at `place` where it is damaged.
Bytes decodeDataUri(std::string_view uri, std::string_view place);

bool isDataUri(std::string_view uri);

void loadBuffers(ImportContext& context);

// Fills decodedViews (gltf_meshopt.cpp).
void decodeCompressedViews(ImportContext& context);

// The bytes of a buffer view, checked against its buffer.
std::span<const std::uint8_t> bufferViewBytes(const ImportContext& context, int bufferView,
                                              std::string_view place);

// --- gltf_light_files.cpp ---

// Gives the scene's files what URIs that start with '#' name: '#/bufferViews/N', a photometric profile, and
// '#/images/N', a picture.
void keepLightFiles(ImportContext& context, const LightDef& def);
void keepLightFiles(ImportContext& context, const Dome& dome);

// --- gltf_model.cpp ---

// Lets tinygltf turn the checked JSON into its structures; no file is touched.
tinygltf::Model parseModel(const ImportContext& context);

// --- gltf_materials.cpp, gltf_meshes.cpp, gltf_nodes.cpp, gltf_animations.cpp, gltf_scene_extras.cpp,
// gltf_lights.cpp ---

void importMaterials(ImportContext& context, const tinygltf::Model& model);
void importMeshes(ImportContext& context, const tinygltf::Model& model);
void importNodes(ImportContext& context, const tinygltf::Model& model);
void importAnimations(ImportContext& context, const tinygltf::Model& model); // needs the nodes
void importSceneExtras(ImportContext& context); // of the default scene; needs the scene's files
void importLights(ImportContext& context);      // needs world transforms and the scene's groups

} // namespace kilolux::gltf
