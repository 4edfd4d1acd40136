#include "renderer/document/edit_json.h"

#include "renderer/document/json_members.h"
#include "renderer/document/light_properties.h"

#include <algorithm>

namespace kilolux {

namespace {

using Json = nlohmann::json;

constexpr const char* kTargetWords[] = {"light", "definition", "node", "group", "bookmark", "scene"};

Json optionalNumber(const std::optional<double>& number) {
    return number ? Json(*number) : Json();
}

template<typename T>
EditValue wholeFrom(const Json& json, std::optional<Error>& error) {
    auto object = std::make_shared<T>();
    error = fromJson(json, *object);
    return Whole<T>(std::move(object));
}

EditValue objectFromJson(const Json& json, EditTarget target, std::optional<Error>& error) {
    if (json.is_null()) return {};
    switch (target) {
    case EditTarget::Light:
        return wholeFrom<LightNode>(json, error);
    case EditTarget::Definition:
        return wholeFrom<LightDef>(json, error);
    case EditTarget::Node:
        return wholeFrom<Node>(json, error);
    case EditTarget::Group:
        return wholeFrom<LightGroup>(json, error);
    case EditTarget::Bookmark:
        return wholeFrom<Camera>(json, error);
    case EditTarget::Scene:
        error = Error{"expected a field of the scene"};
        break;
    }
    return {};
}

Json trsToJson(const Trs& trs) {
    const double rotation[4] = {trs.rotation.x, trs.rotation.y, trs.rotation.z, trs.rotation.w};
    return {{"translation", numbersJson(&trs.translation.x, 3)},
            {"rotation", numbersJson(rotation, 4)},
            {"scale", numbersJson(&trs.scale.x, 3)}};
}

// One list of members for both directions: `io(name, member)`.
template<typename Io, typename Light>
void visitLight(Io&& io, Light& light) {
    io("id", light.id), io("node", light.node), io("def", light.def), io("muted", light.muted),
        io("group", light.group);
}
template<typename Io, typename Def>
void visitDef(Io&& io, Def& def) {
    io("name", def.name), io("type", def.type), io("intensity", def.intensity), io("unit", def.unit),
        io("color", def.color), io("innerConeRad", def.innerConeRad), io("outerConeRad", def.outerConeRad),
        io("pointer", def.pointer);
    forEachLightProperty([&](const auto& each) { io(each.name, each.access(def)); });
}
template<typename Io, typename Group>
void visitGroup(Io&& io, Group& group) {
    io("id", group.id), io("name", group.name), io("intensity", group.intensity),
        io("exposureEv", group.exposureEv), io("tint", group.tint), io("muted", group.muted);
}
template<typename Io, typename Cam>
void visitCamera(Io&& io, Cam& camera) {
    io("id", camera.id), io("name", camera.name), io("orthographic", camera.orthographic),
        io("yfovRad", camera.yfovRad), io("aspect", camera.aspect), io("znearM", camera.znearM),
        io("zfarM", camera.zfarM), io("xmagM", camera.xmagM), io("ymagM", camera.ymagM),
        io("frame", camera.worldFromCamera);
}

struct Writer {
    Json& json;
    template<typename T>
    void operator()(const char* key, const T& member) {
        json[key] = member;
    }
    void operator()(const char* key, const glm::dvec3& member) { json[key] = numbersJson(&member.x, 3); }
    void operator()(const char* key, const glm::dmat4& member) { json[key] = numbersJson(&member[0][0], 16); }
    void operator()(const char* key, const std::optional<double>& member) {
        json[key] = optionalNumber(member);
    }
    void operator()(const char* key, LightType member) { json[key] = wordOf(member); }
    void operator()(const char* key, LightUnit member) { json[key] = wordOf(member); }
    void operator()(const char* key, IesUse member) { json[key] = wordOf(member); }
    void operator()(const char* key, LightFunctionKind member) { json[key] = wordOf(member); }
};

} // namespace

Json toJson(const LightNode& light) {
    Json json;
    visitLight(Writer{json}, light);
    return json;
}
Json toJson(const LightDef& def) {
    Json json;
    visitDef(Writer{json}, def);
    // Most lights have few of the properties; absent ones keep their default.
    static const LightDef kDefault;
    forEachLightProperty([&](const auto& each) {
        if (each.access(def) == each.access(kDefault)) json.erase(each.name);
    });
    return json;
}
Json toJson(const Node& node) {
    Json json = {{"id", node.id},
                 {"name", node.name},
                 {"parent", node.parent},
                 {"mesh", node.mesh},
                 {"meshChannels", node.meshChannels},
                 {"visible", node.visible}};
    if (node.restTrs) {
        json["transform"] = trsToJson(*node.restTrs);
    } else {
        json["matrix"] = numbersJson(&node.localFromNode[0][0], 16);
    }
    return json;
}
Json toJson(const LightGroup& group) {
    Json json;
    visitGroup(Writer{json}, group);
    return json;
}
Json toJson(const Camera& camera) {
    Json json;
    visitCamera(Writer{json}, camera);
    return json;
}

Json toJson(const Edit& edit) {
    Json json = {{"on", kTargetWords[static_cast<int>(edit.target)]},
                 {"id", edit.id},
                 {"from", valueToJson(edit.before)},
                 {"to", valueToJson(edit.after)}};
    if (edit.field) json["field"] = edit.field->name;
    return json;
}

Json toJson(const Change& change) {
    Json edits = Json::array();
    for (const Edit& edit : change.edits)
        edits.push_back(toJson(edit));
    return {{"name", change.name}, {"merge", change.mergeKey}, {"edits", std::move(edits)}};
}

std::optional<Error> fromJson(const Json& json, LightNode& light) {
    Members members(json);
    visitLight([&](const char* key, auto& member) { members.read(key, member); }, light);
    return members.error();
}
std::optional<Error> fromJson(const Json& json, LightDef& def) {
    Members members(json);
    visitDef([&](const char* key, auto& member) { members.read(key, member); }, def);
    return members.error();
}
std::optional<Error> fromJson(const Json& json, LightGroup& group) {
    Members members(json);
    visitGroup([&](const char* key, auto& member) { members.read(key, member); }, group);
    return members.error();
}
std::optional<Error> fromJson(const Json& json, Camera& camera) {
    Members members(json);
    visitCamera([&](const char* key, auto& member) { members.read(key, member); }, camera);
    return members.error();
}
std::optional<Error> fromJson(const Json& json, Node& node) {
    Members members(json);
    members.read("id", node.id);
    members.read("name", node.name);
    members.read("parent", node.parent);
    members.read("mesh", node.mesh);
    members.read("meshChannels", node.meshChannels);
    members.read("visible", node.visible);
    if (members.find("transform")) {
        node.restTrs.emplace();
        members.read("transform", *node.restTrs);
        node.localFromNode = matrixFrom(*node.restTrs);
    } else {
        members.read("matrix", node.localFromNode);
    }
    return members.error();
}

std::optional<Error> fromJson(const Json& json, Edit& edit) {
    Members members(json);
    std::string on, field;
    members.read("on", on);
    members.read("id", edit.id);
    members.read("field", field);
    if (const std::optional<Error> error = members.error()) return error;
    const auto word = std::find(std::begin(kTargetWords), std::end(kTargetWords), on);
    if (word == std::end(kTargetWords)) return Error{"on: expected what the edit is of"};
    edit.target = static_cast<EditTarget>(word - std::begin(kTargetWords));
    edit.field = field.empty() ? nullptr : findEditField(edit.target, field);
    if (!field.empty() && !edit.field) return Error{"field: expected one that exists, found '" + field + "'"};
    for (const auto& [key, value] : {std::pair{"from", &edit.before}, std::pair{"to", &edit.after}}) {
        const Json nothing, *found = members.find(key);
        std::optional<Error> error;
        if (edit.field) {
            Result<EditValue> read = valueFromJson(found ? *found : nothing, *edit.field);
            if (!read) return Error{std::string(key) + ": " + read.error()};
            *value = std::move(read.value());
        } else {
            *value = objectFromJson(found ? *found : nothing, edit.target, error);
        }
        if (error) return Error{std::string(key) + "/" + error->message};
    }
    return std::nullopt;
}

std::optional<Error> fromJson(const Json& json, Change& change) {
    Members members(json);
    members.read("name", change.name);
    members.read("merge", change.mergeKey);
    const Json* edits = members.find("edits");
    if (!edits || !edits->is_array()) members.fail("edits: expected an array");
    if (const std::optional<Error> error = members.error()) return error;
    for (const Json& each : *edits) {
        change.edits.emplace_back();
        if (const std::optional<Error> error = fromJson(each, change.edits.back())) return error;
    }
    return std::nullopt;
}

Json valueToJson(const EditValue& value) {
    return std::visit(
        [](const auto& held) -> Json {
            using T = std::decay_t<decltype(held)>;
            if constexpr (std::is_same_v<T, std::monostate>) {
                return nullptr;
            } else if constexpr (std::is_same_v<T, glm::dvec3>) {
                return numbersJson(&held.x, 3);
            } else if constexpr (std::is_same_v<T, glm::dmat4>) {
                return numbersJson(&held[0][0], 16);
            } else if constexpr (std::is_same_v<T, Trs>) {
                return trsToJson(held);
            } else if constexpr (std::is_same_v<T, LightType> || std::is_same_v<T, LightUnit>) {
                return wordOf(held);
            } else if constexpr (requires {
                                     *held;
                                     held.use_count();
                                 }) {
                return toJson(*held);
            } else {
                return held;
            }
        },
        value);
}

Result<EditValue> valueFromJson(const Json& json, const EditField& field, const EditValue& before) {
    // Read as the one member of an object, so that the messages have the same words.
    const Json holder = {{"value", json}};
    Members members(holder);
    const auto read = [&](auto target) -> Result<EditValue> {
        members.read("value", target);
        if (const std::optional<Error> error = members.error())
            return Error{error->message.substr(error->message.find("value") + 5)
                             .substr(error->message.starts_with("value: ") ? 2 : 1)};
        return EditValue(std::move(target));
    };
    switch (field.kind) {
    case FieldKind::OptionalNumber:
        if (json.is_null()) return EditValue();
        return read(0.0);
    case FieldKind::Number:
        return read(0.0);
    case FieldKind::Flag:
        return read(false);
    case FieldKind::Text:
    case FieldKind::Word:
        return read(std::string());
    case FieldKind::Profile:
    case FieldKind::Picture:
        if (json.is_null()) return EditValue(std::string());
        return read(std::string());
    case FieldKind::Color:
        return read(glm::dvec3(0.0));
    case FieldKind::Type:
        return read(LightType::Sphere);
    case FieldKind::Unit:
        return read(LightUnit::Candela);
    case FieldKind::Transform:
        if (json.is_object()) return read(std::get_if<Trs>(&before) ? std::get<Trs>(before) : Trs{});
        return read(glm::dmat4(1.0));
    case FieldKind::Frame:
        return read(glm::dmat4(1.0));
    case FieldKind::Channels:
    case FieldKind::GroupId:
    case FieldKind::DefIndex:
        return read(std::uint64_t{0});
    }
    return Error{"expected a value"};
}

} // namespace kilolux
