#include "renderer/document/edit_build.h"

#include "renderer/document/edit_rules.h"
#include "renderer/document/light_units.h"
#include "renderer/document/scene_files.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace kilolux {

namespace {

constexpr double kMinTubeRadiusM = 0.001;

template<typename T>
Edit appears(EditTarget target, std::uint64_t id, T object) {
    return {target, id, nullptr, EditValue(), std::make_shared<const T>(std::move(object))};
}
template<typename T>
Edit disappears(EditTarget target, std::uint64_t id, T object) {
    return inverted(appears(target, id, std::move(object)));
}

Edit fieldEdit(const Scene& scene, const EditField& field, std::uint64_t id, EditValue after) {
    return {field.target, id, &field, field.get(scene, id), std::move(after)};
}

// What a definition becomes when one field is set, the others that must follow it included.
LightDef withCompanions(const LightDef& before, LightDef def, const EditField& field) {
    const std::string_view name = field.name;
    if (name == "type") {
        if (def.type == LightType::Tube) def.radiusM = std::max(def.radiusM, kMinTubeRadiusM);
        if (def.type == LightType::Spot) def.innerConeRad = std::min(def.innerConeRad, def.outerConeRad);
        if (!unitApplies(def, def.unit)) {
            def.unit = def.type == LightType::Directional ? LightUnit::Lux : LightUnit::Candela;
            // Candela and lux at 1 m are one number, which is as near as two kinds of light can be.
            def.intensity = baseIntensity(before);
        }
    }
    if (name == "outerConeRad") def.innerConeRad = std::min(def.innerConeRad, def.outerConeRad);
    // Leaving the profile's candela keeps the light as bright as it was.
    const bool ownsIntensity = name == "iesIntensity" && !def.iesIntensity && def.ies;
    if ((name == "unit" || ownsIntensity) && unitApplies(def, def.unit)) {
        const double converted = ownsIntensity ? fromBaseIntensity(def, baseIntensity(before), def.unit)
                                               : intensityIn(before, def.unit);
        if (std::isfinite(converted)) def.intensity = converted;
    }
    // A profile that does nothing yet becomes the light's shape; what is chosen is meant to be seen.
    if (name == "iesProfile" && !def.iesUri.empty() && def.iesUse == IesUse::None) def.iesUse = IesUse::Shape;
    if (name == "lightFunctionImage" && !def.function.imageUri.empty())
        def.function.kind = LightFunctionKind::Image;
    return def;
}

// The edits that turn definition `index` from `before` into `after`.
void appendDifferences(const Scene& scene, int index, const LightDef& after, Edits& edits) {
    Scene target; // the fields read from a scene
    target.lightDefs = {after};
    for (const EditField& field : editFields()) {
        if (field.target != EditTarget::Definition || field.isShorthand) continue;
        EditValue value = field.get(target, 0);
        Edit edit = fieldEdit(scene, field, static_cast<std::uint64_t>(index), std::move(value));
        if (!sameValue(edit.before, edit.after)) edits.push_back(std::move(edit));
    }
}

LightDef withField(const Scene& scene, const LightDef& def, const EditField& field, const EditValue& value) {
    Scene one;
    one.files = scene.files;
    one.lightDefs = {def};
    field.set(one, 0, value);
    return withCompanions(def, std::as_const(one).lightDefs[0], field);
}

// A file that is chosen must be there. One that is gone later is told when the scene is opened.
std::optional<Error> checkFile(const Scene& scene, const EditField& field, const EditValue& value) {
    if (!scene.files || (field.kind != FieldKind::Profile && field.kind != FieldKind::Picture))
        return std::nullopt;
    const std::string& uri = std::get<std::string>(value);
    if (field.kind == FieldKind::Profile) {
        const auto profile = scene.files->profile(uri);
        return profile ? std::nullopt : std::optional<Error>(Error{profile.error()});
    }
    const auto image = scene.files->image(uri);
    return image ? std::nullopt : std::optional<Error>(Error{image.error()});
}

std::uint64_t indexOf(std::size_t size) {
    return static_cast<std::uint64_t>(size);
}

} // namespace

void EditIds::avoid(const Scene& scene) {
    for (const LightNode& light : scene.lights)
        next_ = std::max(next_, light.id + 1);
    for (const Node& node : scene.nodes)
        next_ = std::max(next_, node.id + 1);
    for (const LightGroup& group : scene.groups)
        next_ = std::max(next_, group.id + 1);
    for (const Camera& bookmark : scene.bookmarks)
        next_ = std::max(next_, bookmark.id + 1);
}

void EditIds::avoid(const Edit& edit) {
    if (edit.target != EditTarget::Definition && edit.target != EditTarget::Node)
        next_ = std::max(next_, edit.id + 1);
    for (const EditValue* value : {&edit.before, &edit.after})
        if (const auto* node = std::get_if<Whole<Node>>(value)) next_ = std::max(next_, (*node)->id + 1);
}

const EditField* findLightField(std::string_view name) {
    const EditField* field = findEditField(EditTarget::Light, name);
    return field ? field : findEditField(EditTarget::Definition, name);
}

Result<Edits> setField(const Scene& scene, EditTarget target, std::uint64_t id, const EditField& field,
                       EditValue value, Sharing sharing) {
    if (!targetExists(scene, target, id)) return Error{"expected a target that exists"};
    const auto at = [&](const std::string& message) {
        const std::string place = describeTarget(scene, target, id);
        return Error{fmt::format("{}{}{}: {}", place, place.empty() ? "" : ", ", field.name, message)};
    };
    if (Trs* trs = std::get_if<Trs>(&value); trs && field.kind == FieldKind::Transform) {
        const double length = glm::length(trs->rotation);
        // What is a unit already keeps its digits.
        if (length > 1e-12 && std::isfinite(length) && std::abs(length - 1.0) > 1e-14)
            trs->rotation = trs->rotation / length;
        const bool isMatrix = std::holds_alternative<glm::dmat4>(field.get(scene, id));
        if (isMatrix) value = matrixFrom(*trs);
    }
    if (const std::optional<Error> error = checkValue(field, value)) return at(error->message);
    if (const std::optional<Error> error = checkFile(scene, field, value)) return at(error->message);
    if (target != EditTarget::Light || field.target != EditTarget::Definition) {
        Edit edit = fieldEdit(scene, field, id, std::move(value));
        return sameValue(edit.before, edit.after) ? Edits{} : Edits{std::move(edit)};
    }
    const int index = scene.lights[findLight(scene, id)].def;
    const LightDef after = withField(scene, scene.lightDefs[index], field, value);
    Edits edits;
    if (sharing == Sharing::EditAll || userCount(scene, index) == 1) {
        appendDifferences(scene, index, after, edits);
        return edits;
    }
    if (sameValue(field.get(scene, indexOf(index)), value)) return edits;
    const std::uint64_t own = scene.lightDefs.size();
    edits.push_back(appears(EditTarget::Definition, own, after));
    edits.push_back(fieldEdit(scene, *findEditField(EditTarget::Light, "definition"), id, own));
    return edits;
}

Result<Edits> setField(const Scene& scene, EditTarget target, std::uint64_t id, std::string_view field,
                       EditValue value, Sharing sharing) {
    const EditField* found =
        target == EditTarget::Light ? findLightField(field) : findEditField(target, field);
    if (!found) return Error{fmt::format("expected a field that exists, found '{}'", field)};
    return setField(scene, target, id, *found, std::move(value), sharing);
}

Edits addLight(const Scene& scene, EditIds& ids, const LightDef& def, const Trs& transform, std::string name,
               int parent) {
    const std::uint64_t nodeIndex = scene.nodes.size(), defIndex = scene.lightDefs.size();
    Node node;
    node.id = ids.next();
    node.name = std::move(name);
    node.parent = parent;
    node.restTrs = transform;
    node.localFromNode = matrixFrom(transform);
    LightNode light;
    light.id = ids.next();
    light.node = static_cast<int>(nodeIndex);
    light.def = static_cast<int>(defIndex);
    return {appears(EditTarget::Definition, defIndex, def),
            appears(EditTarget::Node, nodeIndex, std::move(node)),
            appears(EditTarget::Light, light.id, light)};
}

Edits duplicateLight(const Scene& scene, EditIds& ids, std::uint64_t light) {
    const int at = findLight(scene, light);
    if (at < 0) return {};
    LightNode copy = scene.lights[at];
    const Node& original = scene.nodes[copy.node];
    Node node;
    node.id = ids.next();
    node.name = original.name;
    node.parent = original.parent;
    node.localFromNode = original.localFromNode;
    node.restTrs = original.restTrs;
    copy.id = ids.next();
    copy.node = static_cast<int>(scene.nodes.size());
    return {appears(EditTarget::Node, indexOf(scene.nodes.size()), std::move(node)),
            appears(EditTarget::Light, copy.id, copy)};
}

Edits deleteLight(const Scene& scene, std::uint64_t light) {
    const int at = findLight(scene, light);
    if (at < 0) return {};
    return {disappears(EditTarget::Light, light, scene.lights[at])};
}

Edits makeUnique(const Scene& scene, std::uint64_t light) {
    const int at = findLight(scene, light);
    if (at < 0 || userCount(scene, scene.lights[at].def) == 1) return {};
    const std::uint64_t own = scene.lightDefs.size();
    return {appears(EditTarget::Definition, own, scene.lightDefs[scene.lights[at].def]),
            fieldEdit(scene, *findEditField(EditTarget::Light, "definition"), light, own)};
}

Edits addGroup(EditIds& ids, LightGroup group) {
    group.id = ids.next();
    const std::uint64_t id = group.id;
    return {appears(EditTarget::Group, id, std::move(group))};
}

Edits deleteGroup(const Scene& scene, std::uint64_t group) {
    const int at = findGroup(scene, group);
    if (at < 0) return {};
    Edits edits;
    for (const LightNode& light : scene.lights) {
        if (light.group != group) continue;
        edits.push_back(
            fieldEdit(scene, *findEditField(EditTarget::Light, "group"), light.id, std::uint64_t{0}));
    }
    edits.push_back(disappears(EditTarget::Group, group, scene.groups[at]));
    return edits;
}

Edits addBookmark(EditIds& ids, Camera camera) {
    camera.id = ids.next();
    camera.node = -1;
    const std::uint64_t id = camera.id;
    return {appears(EditTarget::Bookmark, id, std::move(camera))};
}

Edits deleteBookmark(const Scene& scene, std::uint64_t bookmark) {
    const int at = findBookmark(scene, bookmark);
    if (at < 0) return {};
    return {disappears(EditTarget::Bookmark, bookmark, scene.bookmarks[at])};
}

} // namespace kilolux
