// What the tests of edits share: a scene with a light of every type, groups and a bookmark, and reading
// files.
#pragma once

#include "renderer/document/edit_session.h"
#include "tests/unit/document/gltf_builder.h"

#include <fstream>
#include <iterator>
#include <random>

namespace kilolux::test {

inline std::string readBytes(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

inline Json ours(const Json& properties) {
    return {{"extras", {{"kilolux", properties}}}};
}

// Six types; lights 3 and 4 (counted from 1) share a definition; parts that nobody knows lie in between.
inline GltfBuilder everyLight() {
    GltfBuilder builder;
    builder.addTriangle({{"name", "floor"}});
    builder.addPunctualLight({{"type", "directional"}, {"intensity", 1000}}, {{"name", "Sun"}});
    builder.addPunctualLight({{"type", "point"}, {"name", "bulb"}, {"range", 5.5}, {"extras", {{"x", 1}}}},
                             {{"name", "Point"}, {"translation", {1, 2, 3}}});
    builder.addPunctualLight({{"type", "spot"},
                              {"intensity", 40.25},
                              {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}},
                              {"extensions", {{"VENDOR_unknown", {{"a", {1, 2.50, "z"}}}}}}},
                             {{"name", "Spot"}});
    builder.addLightNode(2, {{"name", "Spot two"}, {"rotation", {0, 0.6, 0, 0.8}}, {"scale", {1, 2, 1}}});
    Json tube =
        ours({{"type", "tube"}, {"radiusM", 0.05}, {"lengthM", 1.5}, {"group", "Key"}, {"strange", 7}});
    tube["name"] = "Tube";
    builder.addPunctualLight({{"type", "point"}, {"intensity", 12}}, tube);
    builder.json["extensionsUsed"].push_back("EXT_lights_area");
    builder.json["extensions"]["EXT_lights_area"]["lights"] = {
        {{"type", "rect"}, {"size", 0.5}, {"intensity", 800}, {"rect", {{"aspect", 2}}}}, {{"type", "disk"}}};
    for (const auto& [index, name] : {std::pair{0, "Rect"}, std::pair{1, "Disk"}})
        builder.addNode({{"name", name},
                         {"scale", {2, 2, 2}},
                         {"extensions", {{"EXT_lights_area", {{"light", index}}}}}});
    Json nodes = Json::array();
    for (std::size_t i = 0; i < builder.json["nodes"].size(); ++i)
        nodes.push_back(i);
    Json scene =
        ours({{"exposureEv100", 7.5},
              {"groups", {{{"name", "Key"}, {"intensity", 2}, {"note", "kept"}}, {{"name", "Fill"}}}},
              {"bookmarks", {{{"name", "Front"}, {"positionM", {0, 1, 5}}, {"yfovRad", 0.7}}}}});
    scene["nodes"] = nodes;
    builder.json["scenes"] = {scene};
    builder.json["extras"] = {{"left", {{"as", "it is"}}}};
    return builder;
}

inline std::unique_ptr<EditSession> openSession(const std::filesystem::path& path,
                                                const SessionOptions& options = {}) {
    auto session = EditSession::open(path, options);
    if (!session) ADD_FAILURE() << session.error();
    return session ? std::move(session.value()) : nullptr;
}

inline std::uint64_t lightNamed(const Scene& scene, std::string_view name) {
    for (const LightNode& light : scene.lights)
        if (scene.nodes[light.node].name == name) return light.id;
    ADD_FAILURE() << "no light '" << name << "'";
    return 0;
}

inline const LightDef& defOf(const Scene& scene, std::string_view name) {
    return scene.lightDefs[scene.lights[findLight(scene, lightNamed(scene, name))].def];
}

// A profile and a picture that need no file.
inline const std::string kProfileUri =
    "data:,IESNA:LM-63-2002%0ATILT=NONE%0A1 1000 1 3 1 1 2 0 0 0%0A1 1 0%0A0 45 90%0A0%0A200 100 0%0A";
inline const std::string kPictureUri =
    "data:image/png;base64,"
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8z8BQDwAEhQGAhKmMIQAAAABJRU5ErkJggg==";

// A value that suits the field and differs from `before`.
inline EditValue otherValue(const EditField& field, const EditValue& before, std::mt19937& random) {
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    const double u = uniform(random);
    switch (field.kind) {
    case FieldKind::Number:
    case FieldKind::OptionalNumber: {
        const double low = std::max(field.min, 0.01), high = std::min(field.max, field.min + 3.0);
        const double span = std::max(high - low, 1e-3);
        if (field.kind == FieldKind::OptionalNumber && std::holds_alternative<double>(before) && u < 0.3)
            return EditValue();
        return low + u * span;
    }
    case FieldKind::Flag:
        return !std::get<bool>(before);
    case FieldKind::Text:
        return "name \"\xC3\xA9\\" + std::to_string(random());
    case FieldKind::Color:
        return glm::dvec3(u, uniform(random), uniform(random));
    case FieldKind::Type:
        return static_cast<LightType>((static_cast<int>(std::get<LightType>(before)) + 1 + int(u * 5)) % 6);
    case FieldKind::Word: {
        const std::string_view now = std::get<std::string>(before);
        const std::size_t count = field.words.size();
        const auto at =
            std::size_t(std::find(field.words.begin(), field.words.end(), now) - field.words.begin());
        return std::string(field.words[(at + 1 + std::size_t(u * double(count - 1))) % count]);
    }
    case FieldKind::Profile:
        return std::get<std::string>(before).empty() ? kProfileUri : std::string();
    case FieldKind::Picture:
        return std::get<std::string>(before).empty() ? kPictureUri : std::string();
    case FieldKind::Channels:
        return std::uint64_t{(std::get<std::uint64_t>(before) + 1 + std::uint64_t(u * 254)) % 256};
    case FieldKind::Unit:
        return std::get<LightUnit>(before) == LightUnit::Lux ? LightUnit::Candela : LightUnit::Lux;
    case FieldKind::Transform: {
        Trs trs;
        trs.translation = {u, 2.0, -3.0 * u};
        trs.rotation = glm::normalize(glm::dquat(uniform(random) + 0.1, u, 0.3, -0.2));
        trs.scale = glm::dvec3(0.5 + u);
        return trs;
    }
    case FieldKind::Frame:
        return matrixFrom({{u, 1.0, 2.0}, glm::normalize(glm::dquat(1.0, u, 0.2, 0.1)), glm::dvec3(1.0)});
    case FieldKind::GroupId:
        return std::uint64_t{std::get<std::uint64_t>(before) == 2 ? 1u : 2u};
    case FieldKind::DefIndex:
        return std::uint64_t{std::get<std::uint64_t>(before) == 0 ? 1u : 0u};
    }
    return {};
}

} // namespace kilolux::test
