#include "renderer/document/edit_script.h"

#include "renderer/document/edit_json.h"

#include <algorithm>
#include <fmt/format.h>

namespace kilolux {

namespace {

using Json = nlohmann::json;
using Failure = std::optional<Error>;

constexpr const char* kVerbs[] = {"set", "add", "duplicate", "delete", "make-unique", "undo", "redo"};
constexpr std::pair<const char*, EditTarget> kTargets[] = {{"light", EditTarget::Light},
                                                           {"group", EditTarget::Group},
                                                           {"bookmark", EditTarget::Bookmark},
                                                           {"node", EditTarget::Node}};

// One step against a scratch document, which takes each part before the next one is built.
class Step {
  public:
    Step(EditSession& session, const Json& json, std::string place)
        : session_(session), json_(json), place_(std::move(place)), scratch_(session.scene()) {}

    Failure run();

  private:
    Failure fail(const std::string& key, const std::string& message) const {
        return Error{place_ + (key.empty() ? "" : "/" + key) + ": " + message};
    }
    Failure checkKeys() const;
    Failure select(std::vector<std::uint64_t>& ids) const;
    Failure add();
    Failure change(std::uint64_t id);
    Failure setFields(std::uint64_t id);
    Failure setOne(std::uint64_t id, const std::string& key, const Json& json);
    Result<EditValue> transformPart(std::uint64_t id, const std::string& key, const Json& json) const;
    Failure take(const Edits& edits, const std::string& key);
    bool flag(const char* key) const { return json_.contains(key) && json_[key] == true; }
    std::string nameOf(std::uint64_t id) const;

    EditSession& session_;
    const Json& json_;
    std::string place_;
    Scene scratch_;
    Edits edits_;
    std::string verb_;
    EditTarget target_ = EditTarget::Scene;
    std::string targetKey_;
};

Failure Step::checkKeys() const {
    static constexpr const char* kKnown[] = {"do",  "light", "group",  "bookmark", "node",
                                             "set", "all",   "shared", "comment"};
    for (const auto& [key, value] : json_.items()) {
        if (std::find(std::begin(kKnown), std::end(kKnown), key) == std::end(kKnown))
            return fail(key, "expected one of do, light, group, bookmark, node, set, all, shared, comment");
    }
    for (const char* key : {"all", "shared"})
        if (json_.contains(key) && !json_[key].is_boolean()) return fail(key, "expected true or false");
    if (json_.contains("set") && !json_["set"].is_object())
        return fail("set", "expected an object of fields");
    return std::nullopt;
}

std::string Step::nameOf(std::uint64_t id) const {
    const Scene& scene = scratch_;
    if (target_ == EditTarget::Group) return scene.groups[findGroup(scene, id)].name;
    if (target_ == EditTarget::Bookmark) return scene.bookmarks[findBookmark(scene, id)].name;
    if (target_ == EditTarget::Node) return scene.nodes[id].name;
    return scene.nodes[scene.lights[findLight(scene, id)].node].name;
}

Failure Step::select(std::vector<std::uint64_t>& ids) const {
    const Json& wanted = json_[targetKey_];
    const Scene& scene = scratch_;
    std::vector<std::uint64_t> all;
    if (target_ == EditTarget::Light)
        for (const LightNode& light : scene.lights)
            all.push_back(light.id);
    if (target_ == EditTarget::Group)
        for (const LightGroup& group : scene.groups)
            all.push_back(group.id);
    if (target_ == EditTarget::Bookmark)
        for (const Camera& bookmark : scene.bookmarks)
            all.push_back(bookmark.id);
    for (std::size_t i = 0; target_ == EditTarget::Node && i < scene.nodes.size(); ++i)
        all.push_back(i);
    const auto isWanted = [&](std::uint64_t id) {
        if (wanted.is_string()) return wanted == "*" || wanted == nameOf(id);
        if (wanted.is_number_unsigned()) return wanted == id;
        const bool byNode = wanted.is_object() && wanted.size() == 1 && wanted.contains("node");
        return byNode && target_ == EditTarget::Light &&
               wanted["node"] == scene.lights[findLight(scene, id)].node;
    };
    const bool usable = wanted.is_string() || wanted.is_number_unsigned() ||
                        (wanted.is_object() && wanted.contains("node") && target_ == EditTarget::Light);
    if (!usable) return fail(targetKey_, "expected a name, an id or {\"node\": index}");
    std::copy_if(all.begin(), all.end(), std::back_inserter(ids), isWanted);
    if (ids.empty())
        return fail(targetKey_,
                    fmt::format("expected a {} that exists, found {}", targetKey_, wanted.dump()));
    if (ids.size() > 1 && wanted != "*" && !flag("all")) {
        return fail(targetKey_,
                    fmt::format("expected one {}, found {} named {}; \"all\": true means all of them",
                                targetKey_, ids.size(), wanted.dump()));
    }
    return std::nullopt;
}

Failure Step::take(const Edits& edits, const std::string& key) {
    if (Failure error = applyEdits(scratch_, edits, Rules::Skip)) return fail(key, error->message);
    edits_.insert(edits_.end(), edits.begin(), edits.end());
    return std::nullopt;
}

Result<EditValue> Step::transformPart(std::uint64_t id, const std::string& key, const Json& json) const {
    const EditField& field = *findEditField(EditTarget::Light, "transform");
    EditValue before = field.get(scratch_, id);
    // A node that is given by a matrix is moved by its matrix; turning it needs all of it.
    if (const glm::dmat4* matrix = std::get_if<glm::dmat4>(&before)) {
        if (key != "translation")
            return Error{"expected a node without 'matrix'; set all of 'transform' for this one"};
        glm::dmat4 moved = *matrix;
        const Result<EditValue> read = valueFromJson(json, *findEditField(EditTarget::Definition, "color"));
        if (!read) return read;
        moved[3] = glm::dvec4(std::get<glm::dvec3>(read.value()), 1.0);
        return EditValue(moved);
    }
    return valueFromJson(Json{{key, json}}, field, before);
}

Failure Step::setOne(std::uint64_t id, const std::string& key, const Json& json) {
    const Sharing sharing = flag("shared") ? Sharing::EditAll : Sharing::MakeUnique;
    const bool isPart =
        target_ == EditTarget::Light && (key == "translation" || key == "rotation" || key == "scale");
    const EditField* field = target_ == EditTarget::Light ? findLightField(isPart ? "transform" : key)
                                                          : findEditField(target_, key);
    if (!field || field->kind == FieldKind::DefIndex)
        return fail("set/" + key, "expected a field that 'kilolux edit --list' names");
    Result<EditValue> value = EditValue();
    if (isPart) {
        value = transformPart(id, key, json);
    } else if (field->kind == FieldKind::GroupId) {
        // By name; null is none.
        const Scene& scene = scratch_;
        const auto group = std::find_if(scene.groups.begin(), scene.groups.end(),
                                        [&](const LightGroup& each) { return json == each.name; });
        if (!json.is_null() && group == scene.groups.end())
            return fail("set/" + key, "expected the name of a group, or null, found " + json.dump());
        value = EditValue(json.is_null() ? std::uint64_t{0} : group->id);
    } else {
        value = valueFromJson(json, *field,
                              field->kind == FieldKind::Transform ? field->get(scratch_, id) : EditValue());
    }
    if (!value) return fail("set/" + key, value.error());
    const Result<Edits> edits = setField(scratch_, target_, id, *field, std::move(value.value()), sharing);
    if (!edits) return fail("set/" + key, edits.error());
    return take(edits.value(), "set/" + key);
}

// Type and size decide what a unit means, and the unit what a number means.
int orderOf(std::string_view key) {
    static constexpr std::string_view kFirst[] = {"type",
                                                  "radiusM",
                                                  "lengthM",
                                                  "widthM",
                                                  "heightM",
                                                  "outerConeRad",
                                                  "innerConeRad",
                                                  "iesProfile",
                                                  "iesUse",
                                                  "iesIntensity",
                                                  "barnDoorAngleRad",
                                                  "barnDoorLengthM",
                                                  "lightFunctionImage",
                                                  "unit",
                                                  "intensity"};
    return static_cast<int>(std::find(std::begin(kFirst), std::end(kFirst), key) - std::begin(kFirst));
}

Failure Step::setFields(std::uint64_t id) {
    if (!json_.contains("set")) return std::nullopt;
    std::vector<std::string> keys;
    for (const auto& [key, value] : json_["set"].items())
        keys.push_back(key);
    std::stable_sort(keys.begin(), keys.end(),
                     [](const std::string& a, const std::string& b) { return orderOf(a) < orderOf(b); });
    for (const std::string& key : keys)
        if (Failure error = setOne(id, key, json_["set"][key])) return error;
    return std::nullopt;
}

Failure Step::add() {
    const Json& name = json_[targetKey_];
    if (target_ == EditTarget::Node) return fail("do", "expected a light, group or bookmark for 'add'");
    if (!name.is_string()) return fail(targetKey_, "expected the name of what is added");
    Edits edits;
    if (target_ == EditTarget::Light) {
        edits = addLight(scratch_, session_.ids(), LightDef{}, Trs{}, name);
    } else if (target_ == EditTarget::Group) {
        LightGroup group;
        group.name = name;
        edits = addGroup(session_.ids(), std::move(group));
    } else {
        Camera camera;
        camera.name = name;
        edits = addBookmark(session_.ids(), std::move(camera));
    }
    const std::uint64_t id = edits.back().id;
    if (Failure error = take(edits, targetKey_)) return error;
    return setFields(id);
}

Failure Step::change(std::uint64_t id) {
    if (verb_ == "set") return setFields(id);
    Edits edits;
    if (verb_ == "delete" && target_ != EditTarget::Node) {
        edits = target_ == EditTarget::Light   ? deleteLight(scratch_, id)
                : target_ == EditTarget::Group ? deleteGroup(scratch_, id)
                                               : deleteBookmark(scratch_, id);
        return take(edits, targetKey_);
    }
    if (target_ != EditTarget::Light) return fail("do", "expected a light for '" + verb_ + "'");
    if (verb_ == "make-unique") return take(makeUnique(scratch_, id), targetKey_);
    edits = duplicateLight(scratch_, session_.ids(), id);
    const std::uint64_t copy = edits.back().id;
    if (Failure error = take(edits, targetKey_)) return error;
    return setFields(copy);
}

Failure Step::run() {
    if (!json_.is_object()) return fail("", "expected an object");
    if (Failure error = checkKeys()) return error;
    verb_ = "set";
    if (json_.contains("do")) {
        const bool known = json_["do"].is_string() &&
                           std::find(std::begin(kVerbs), std::end(kVerbs), json_["do"].get<std::string>()) !=
                               std::end(kVerbs);
        if (!known) return fail("do", "expected one of set, add, duplicate, delete, make-unique, undo, redo");
        verb_ = json_["do"];
    }
    if (verb_ == "undo" || verb_ == "redo") {
        Failure error = verb_ == "undo" ? session_.undo() : session_.redo();
        return error ? fail("do", error->message) : std::nullopt;
    }
    for (const auto& [key, target] : kTargets) {
        if (!json_.contains(key)) continue;
        if (!targetKey_.empty()) return fail(key, "expected one target, found '" + targetKey_ + "' as well");
        targetKey_ = key;
        target_ = target;
    }
    if (targetKey_.empty() && verb_ != "set")
        return fail("", "expected a light, group or bookmark for '" + verb_ + "'");
    if (verb_ == "set" && !json_.contains("set")) return fail("", "expected 'set' with the fields, or 'do'");
    if (verb_ == "add") {
        if (Failure error = add()) return error;
    } else {
        std::vector<std::uint64_t> ids{0};
        if (!targetKey_.empty()) {
            ids.clear();
            if (Failure error = select(ids)) return error;
        }
        for (const std::uint64_t id : ids)
            if (Failure error = change(id)) return error;
    }
    Failure error = session_.apply(verb_ + (targetKey_.empty() ? "" : " " + targetKey_), std::move(edits_));
    return error ? fail("", error->message) : std::nullopt;
}

} // namespace

std::optional<Error> runEditScript(EditSession& session, const Json& script) {
    const bool isWrapped = script.is_object() && script.size() == 1 && script.contains("edits");
    const Json& steps = isWrapped ? script["edits"] : script;
    const std::string place = isWrapped ? "/edits" : "";
    if (!steps.is_array()) return Error{"/: expected an array of edits, or an object with 'edits'"};
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (Failure error = Step(session, steps[i], fmt::format("{}/{}", place, i)).run()) return error;
    }
    return std::nullopt;
}

} // namespace kilolux
