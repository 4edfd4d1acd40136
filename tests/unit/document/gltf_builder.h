// Builds small glTF files for the import tests: a JSON document and one buffer, written into a folder of the
// test's own that is removed afterwards.
#pragma once

#include "renderer/document/gltf_import.h"

#include <cstring>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace kilolux::test {

using Json = nlohmann::json;

class TempFolder {
  public:
    TempFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "kilolux-document-XXXXXX").string();
        path_ = mkdtemp(pattern.data());
    }
    ~TempFolder() { std::filesystem::remove_all(path_); }
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;

    std::filesystem::path path() const { return path_; }
    std::filesystem::path write(const std::string& name, const std::string& bytes) const {
        std::filesystem::create_directories((path_ / name).parent_path());
        std::ofstream(path_ / name, std::ios::binary) << bytes;
        return path_ / name;
    }

  private:
    std::filesystem::path path_;
};

enum class Component { Byte = 5120, UnsignedByte, Short, UnsignedShort, UnsignedInt = 5125, Float };

class GltfBuilder {
  public:
    Json json = {{"asset", {{"version", "2.0"}}}};
    std::string buffer;

    // Appends raw data as a buffer view of its own, 4-byte aligned.
    template<typename T>
    int addView(const std::vector<T>& data, int stride = 0) {
        buffer.resize((buffer.size() + 3) / 4 * 4);
        Json view = {{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", data.size() * sizeof(T)}};
        if (stride > 0) view["byteStride"] = stride;
        buffer.append(reinterpret_cast<const char*>(data.data()), data.size() * sizeof(T));
        json["bufferViews"].push_back(view);
        return static_cast<int>(json["bufferViews"].size()) - 1;
    }
    template<typename T>
    int addAccessor(const std::vector<T>& data, Component component, const char* type, std::size_t count,
                    const Json& more = Json::object()) {
        Json accessor = {{"bufferView", addView(data)},
                         {"componentType", static_cast<int>(component)},
                         {"type", type},
                         {"count", count}};
        accessor.update(more);
        json["accessors"].push_back(accessor);
        return static_cast<int>(json["accessors"].size()) - 1;
    }
    int addVec3(const std::vector<float>& data) {
        return addAccessor(data, Component::Float, "VEC3", data.size() / 3);
    }
    int addVec2(const std::vector<float>& data) {
        return addAccessor(data, Component::Float, "VEC2", data.size() / 2);
    }
    int addIndices(const std::vector<std::uint32_t>& data) {
        return addAccessor(data, Component::UnsignedInt, "SCALAR", data.size());
    }
    // A mesh of one primitive and a node that shows it; returns the node.
    int addMesh(const Json& primitive, const Json& node = Json::object()) {
        json["meshes"].push_back({{"primitives", {primitive}}});
        Json shown = node;
        shown["mesh"] = json["meshes"].size() - 1;
        return addNode(shown);
    }
    int addNode(const Json& node) {
        json["nodes"].push_back(node);
        return static_cast<int>(json["nodes"].size()) - 1;
    }
    // The unit right triangle in the XY plane, counter-clockwise seen from +Z.
    int addTriangle(const Json& node = Json::object()) {
        return addMesh({{"attributes", {{"POSITION", addVec3({0, 0, 0, 1, 0, 0, 0, 1, 0})}}}}, node);
    }
    int addPunctualLight(const Json& light, const Json& node = Json::object()) {
        json["extensionsUsed"] = {"KHR_lights_punctual"};
        json["extensions"]["KHR_lights_punctual"]["lights"].push_back(light);
        return addLightNode(static_cast<int>(json["extensions"]["KHR_lights_punctual"]["lights"].size()) - 1,
                            node);
    }
    int addLightNode(int light, const Json& node = Json::object()) {
        Json carrier = node;
        carrier["extensions"]["KHR_lights_punctual"]["light"] = light;
        return addNode(carrier);
    }

    // Writes scene.gltf and its scene.bin into the folder.
    std::filesystem::path write(const TempFolder& folder) const {
        Json document = json;
        if (!buffer.empty() && !document.contains("buffers")) {
            document["buffers"] = {{{"uri", "scene.bin"}, {"byteLength", buffer.size()}}};
        }
        if (!buffer.empty()) folder.write("scene.bin", buffer);
        return folder.write("scene.gltf", document.dump());
    }
    std::filesystem::path writeBinary(const TempFolder& folder) const {
        Json document = json;
        if (!buffer.empty()) document["buffers"] = {{{"byteLength", buffer.size()}}};
        std::string text = document.dump(), binary = buffer;
        text.resize((text.size() + 3) / 4 * 4, ' ');
        binary.resize((binary.size() + 3) / 4 * 4, '\0');
        const auto u32 = [](std::size_t value) {
            const auto narrow = static_cast<std::uint32_t>(value);
            return std::string(reinterpret_cast<const char*>(&narrow), 4);
        };
        std::string file = "glTF" + u32(2) + u32(28 + text.size() + binary.size());
        file += u32(text.size()) + "JSON" + text + u32(binary.size()) + std::string("BIN\0", 4) + binary;
        return folder.write("scene.glb", file);
    }

    // Imports what has been built so far; a refusal fails the test.
    Scene import(const ImportOptions& options = {}) const {
        const TempFolder folder;
        auto scene = importGltf(write(folder), options);
        if (!scene) ADD_FAILURE() << scene.error();
        return scene ? scene.value() : Scene{};
    }
    // The message of a refusal without the folder, or "opened".
    std::string refusal() const {
        const TempFolder folder;
        const auto scene = importGltf(write(folder));
        return scene ? "opened" : scene.error().substr(folder.path().string().size() + 1);
    }
};

inline bool hasWarning(const Scene& scene, std::string_view text) {
    for (const std::string& warning : scene.warnings) {
        if (warning.find(text) != std::string::npos) return true;
    }
    return false;
}

} // namespace kilolux::test
