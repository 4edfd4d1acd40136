// Which glTF extensions the import reads, which it may leave out, and which it must refuse.
#include "renderer/document/gltf_context.h"

#include <algorithm>
#include <array>

namespace kilolux::gltf {

namespace {

constexpr std::array<std::string_view, 10> kRead = {
    "KHR_lights_punctual",
    "EXT_lights_area",
    "EXT_lights_ies",
    "KHR_texture_transform",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    "KHR_materials_emissive_strength",
    "KHR_materials_transmission",
    "KHR_materials_pbrSpecularGlossiness",
    "EXT_meshopt_compression",
};

// The file shows without them, only plainer than its author saw it.
constexpr std::array<std::string_view, 14> kLeftOut = {
    "KHR_materials_ior",
    "KHR_materials_specular",
    "KHR_materials_clearcoat",
    "KHR_materials_sheen",
    "KHR_materials_volume",
    "KHR_materials_iridescence",
    "KHR_materials_anisotropy",
    "KHR_materials_dispersion",
    "KHR_materials_variants",
    "KHR_materials_diffuse_transmission",
    "KHR_animation_pointer",
    "KHR_xmp_json_ld",
    "KHR_xmp",
    "KHR_node_hoverability",
};

bool contains(std::span<const std::string_view> list, std::string_view name) {
    return std::find(list.begin(), list.end(), name) != list.end();
}

std::string_view adviceFor(std::string_view extension) {
    if (extension == "KHR_draco_mesh_compression")
        return "expected a file exported without Draco compression";
    if (extension == "KHR_texture_basisu") return "expected PNG or JPEG textures";
    return "expected a file that can be read without it";
}

} // namespace

void checkExtensions(ImportContext& context) {
    for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
        const auto it = context.json.find(key);
        if (it == context.json.end()) continue;
        if (!it->is_array()) fail(fmt::format("/{}", key), "expected an array of names");
        for (std::size_t i = 0; i < it->size(); ++i) {
            const std::string place = fmt::format("/{}/{}", key, i);
            if (!(*it)[i].is_string()) fail(place, "expected the name of an extension");
            const std::string name = (*it)[i];
            if (contains(kRead, name)) continue;
            if (key == std::string_view("extensionsRequired") && !contains(kLeftOut, name)) {
                fail(place, "'{}' is required and not supported; {}", printable(name), adviceFor(name));
            }
            context.warnOnce("extension " + name, place, "the extension '{}' is not read", printable(name));
        }
    }
}

} // namespace kilolux::gltf
