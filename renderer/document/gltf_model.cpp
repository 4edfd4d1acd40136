// Hands the checked JSON to tinygltf, less what the import reads by itself: buffers and images (bounded,
// within the folder), lights and extras (from the JSON), and what it does not read at all. tinygltf's values
// take 150 bytes and more each, so the document is trimmed first.
#include "renderer/document/gltf_model.h"

#include <array>

namespace kilolux::gltf {

namespace {

// Extensions read through tinygltf's structures.
constexpr std::array<std::string_view, 5> kKeptExtensions = {
    "KHR_texture_transform",
    "KHR_materials_unlit",
    "KHR_materials_emissive_strength",
    "KHR_materials_transmission",
    "KHR_materials_pbrSpecularGlossiness",
};

Json trimmed(const Json& value);

Json trimmedExtensions(const Json& extensions) {
    Json kept = Json::object();
    if (!extensions.is_object()) return kept;
    for (const std::string_view name : kKeptExtensions) {
        const auto it = extensions.find(name);
        if (it != extensions.end() && it->is_object()) kept[std::string(name)] = trimmed(*it);
    }
    return kept;
}

// Recursion is bounded by the parser's limit of depth.
Json trimmed(const Json& value) {
    if (value.is_array()) {
        Json copy = Json::array();
        for (const Json& element : value)
            copy.push_back(trimmed(element));
        return copy;
    }
    if (!value.is_object()) return value;
    Json copy = Json::object();
    for (const auto& [key, member] : value.items()) {
        if (key == "extras" || key == "targets" || key == "weights" || key == "skin") continue;
        if (key == "extensions") {
            copy[key] = trimmedExtensions(member);
        } else {
            copy[key] = trimmed(member);
        }
    }
    return copy;
}

std::string trimmedText(const Json& document) {
    Json kept = {{"asset", {{"version", "2.0"}}}};
    for (const char* key : {"bufferViews", "accessors", "meshes", "nodes", "scenes", "scene", "materials",
                            "textures", "samplers", "cameras"}) {
        if (const auto it = document.find(key); it != document.end()) kept[key] = trimmed(*it);
    }
    return kept.dump();
}

} // namespace

tinygltf::Model parseModel(const ImportContext& context) {
    tinygltf::Model model;
    tinygltf::TinyGLTF loader;
    std::string error, warning;
    const std::string text = trimmedText(context.json);
    const bool good = loader.LoadASCIIFromString(
        &model, &error, &warning, text.data(), static_cast<unsigned>(text.size()), "", tinygltf::NO_REQUIRE);
    if (!good) fail("JSON", "expected a glTF 2.0 document: {}", printable(error));
    return model;
}

} // namespace kilolux::gltf
