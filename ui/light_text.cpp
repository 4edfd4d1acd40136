// Lights as text for the clipboard, declared in light_actions.h. Per line one light: "kilolux": "light", its
// name, where it stands in the world, its definition or the number of the line whose definition it shares,
// its group with masters.
#include "renderer/document/edit_json.h"
#include "ui/change_builder.h"
#include "ui/light_actions.h"
#include "ui/light_place.h"

#include <fmt/format.h>
#include <map>

namespace kilolux {

namespace {

using Json = nlohmann::ordered_json;

Json lineOf(const Scene& scene, const LightNode& light, std::map<int, std::size_t>& lineOfDef,
            std::size_t line) {
    Trs trs;
    trs.translation = positionOf(scene, light.id);
    trs.rotation = rotationOf(scene, light.id);
    Json json = {{"kilolux", "light"}, {"name", scene.nodes[std::size_t(light.node)].name}};
    json["transform"] = valueToJson(trs);
    if (light.muted) json["muted"] = true;
    if (const int group = findGroup(scene, light.group); group >= 0) {
        json["group"] = toJson(scene.groups[std::size_t(group)]);
        json["group"].erase("id");
    }
    const auto [known, isNew] = lineOfDef.try_emplace(light.def, line);
    if (isNew) {
        json["definition"] = toJson(scene.lightDefs[std::size_t(light.def)]);
        json["definition"].erase("pointer");
    } else {
        json["definitionOfLine"] = known->second;
    }
    return json;
}

// Builds what the lines say, one after the other.
class Paste {
  public:
    Paste(const Scene& scene, EditIds& ids) : builder_(scene), ids_(ids), names_(scene) {}

    std::optional<Error> add(const Json& json) {
        if (!json.is_object() || json.value("kilolux", Json()) != "light")
            return Error{"expected a light of Kilolux"};
        LightDef def;
        std::optional<int> shared;
        if (std::optional<Error> error = readDefinition(json, def, shared)) return error;
        const EditField& transform = *findEditField(EditTarget::Light, "transform");
        const Result<EditValue> trs = valueFromJson(json.value("transform", Json()), transform, Trs{});
        if (!trs || !std::holds_alternative<Trs>(trs.value())) return Error{"transform: expected a place"};
        const Json name = json.value("name", Json("Light"));
        if (!name.is_string()) return Error{"name: expected text"};
        const Scene& scene = builder_.scene();
        Edits edits = addLight(scene, ids_, def, std::get<Trs>(trs.value()), names_.take(name));
        // The definition comes first among the edits; a shared one stands there already.
        if (shared) {
            LightNode light = *std::get<Whole<LightNode>>(edits.back().after);
            light.def = *shared;
            edits.back().after = std::make_shared<const LightNode>(light);
            edits.erase(edits.begin());
        }
        const std::uint64_t id = edits.back().id;
        builder_.take(edits);
        defs_.push_back(scene.lights.read().back().def);
        if (json.value("muted", Json(false)) == true) builder_.set(EditTarget::Light, id, "muted", true);
        return json.contains("group") ? joinGroup(json["group"], id) : std::nullopt;
    }

    Result<Edits> finish() { return builder_.finish(); }

  private:
    std::optional<Error> readDefinition(const Json& json, LightDef& def, std::optional<int>& shared) const {
        const Json line = json.value("definitionOfLine", Json());
        if (line.is_number_unsigned() && line.get<std::size_t>() < defs_.size()) {
            shared = defs_[line.get<std::size_t>()];
            return std::nullopt;
        }
        if (!json.contains("definition")) return Error{"definition: expected the properties of a light"};
        std::optional<Error> error = fromJson(json["definition"], def);
        def.pointer.clear(); // of another file
        return error ? Error{"definition/" + error->message} : error;
    }

    std::optional<Error> joinGroup(const Json& json, std::uint64_t light) {
        LightGroup group;
        if (const std::optional<Error> error = fromJson(json, group)) return Error{"group/" + error->message};
        std::uint64_t id = 0;
        for (const LightGroup& each : builder_.scene().groups)
            if (each.name == group.name) id = each.id;
        if (id == 0) {
            builder_.take(addGroup(ids_, group));
            id = builder_.scene().groups.read().back().id;
        }
        builder_.set(EditTarget::Light, light, "group", id);
        return std::nullopt;
    }

    ChangeBuilder builder_;
    EditIds& ids_;
    FreeNames names_;
    std::vector<int> defs_; // of the lines so far
};

} // namespace

std::string lightsToText(const Scene& scene, std::span<const std::uint64_t> lights) {
    std::string text;
    std::map<int, std::size_t> lineOfDef;
    std::size_t line = 0;
    for (const std::uint64_t id : lights) {
        text += lineOf(scene, lightOf(scene, id), lineOfDef, line++)
                    .dump(-1, ' ', false, Json::error_handler_t::replace) +
                '\n';
    }
    return text;
}

Result<Edits> lightsFromText(const Scene& scene, EditIds& ids, std::string_view text) {
    Paste paste(scene, ids);
    std::size_t line = 0;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view row = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (row.find_first_not_of(" \t\r") == std::string_view::npos) continue;
        const Json json = Json::parse(row, nullptr, false);
        std::optional<Error> error;
        if (json.is_discarded()) {
            error = Error{"expected a light as JSON"};
        } else {
            error = paste.add(json);
        }
        if (error && line == 0)
            return Error{fmt::format("The clipboard holds no lights: {}", error->message)};
        if (error)
            return Error{fmt::format("Cannot paste, line {} of the clipboard: {}", line + 1, error->message)};
        ++line;
    }
    if (line == 0) return Error{"The clipboard is empty"};
    return paste.finish();
}

} // namespace kilolux
