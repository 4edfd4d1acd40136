// The table of editable fields, and reading and writing them.
#include "renderer/document/edit.h"

#include <algorithm>

namespace kilolux {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kHuge = 1e18; // as in the importer

template<typename T>
EditValue toValue(const T& member) {
    return member;
}
EditValue toValue(const std::optional<double>& member) {
    return member ? EditValue(*member) : EditValue();
}
template<typename T>
void fromValue(const EditValue& value, T& member) {
    member = std::get<T>(value);
}
void fromValue(const EditValue& value, std::optional<double>& member) {
    const double* number = std::get_if<double>(&value);
    member = number ? std::optional<double>(*number) : std::nullopt;
}

// --- definitions ---

template<auto member>
EditValue getDef(const Scene& scene, std::uint64_t index) {
    return toValue(scene.lightDefs[index].*member);
}
template<auto member>
void setDef(Scene& scene, std::uint64_t index, const EditValue& value) {
    fromValue(value, scene.lightDefs[index].*member);
}

template<auto member>
constexpr EditField defField(const char* name, FieldKind kind, double min, double max, const char* unit,
                             const char* help) {
    return {EditTarget::Definition, name, kind, min, max, unit, help, getDef<member>, setDef<member>};
}

// --- lights and their nodes ---

template<auto member>
EditValue getLight(const Scene& scene, std::uint64_t id) {
    return toValue(scene.lights[findLight(scene, id)].*member);
}
template<auto member>
void setLight(Scene& scene, std::uint64_t id, const EditValue& value) {
    fromValue(value, scene.lights[findLight(scene, id)].*member);
}

const Node& nodeOf(const Scene& scene, std::uint64_t id) {
    return scene.nodes[scene.lights[findLight(scene, id)].node];
}
Node& nodeOf(Scene& scene, std::uint64_t id) {
    const int node = std::as_const(scene).lights[findLight(scene, id)].node;
    return scene.nodes[node];
}

EditValue getName(const Scene& scene, std::uint64_t id) {
    return nodeOf(scene, id).name;
}
void setName(Scene& scene, std::uint64_t id, const EditValue& value) {
    fromValue(value, nodeOf(scene, id).name);
}

EditValue getTransform(const Scene& scene, std::uint64_t id) {
    const Node& node = nodeOf(scene, id);
    return node.restTrs ? EditValue(*node.restTrs) : EditValue(node.localFromNode);
}
void setTransform(Scene& scene, std::uint64_t id, const EditValue& value) {
    Node& node = nodeOf(scene, id);
    if (const Trs* trs = std::get_if<Trs>(&value)) {
        node.restTrs = *trs;
        node.localFromNode = matrixFrom(*trs);
    } else {
        node.localFromNode = std::get<glm::dmat4>(value);
    }
}

// LightNode::def is a signed index.
EditValue getDefIndex(const Scene& scene, std::uint64_t id) {
    return static_cast<std::uint64_t>(scene.lights[findLight(scene, id)].def);
}
void setDefIndex(Scene& scene, std::uint64_t id, const EditValue& value) {
    scene.lights[findLight(scene, id)].def = static_cast<int>(std::get<std::uint64_t>(value));
}

// --- groups, bookmarks, scene ---

template<auto member>
EditValue getGroup(const Scene& scene, std::uint64_t id) {
    return toValue(scene.groups[findGroup(scene, id)].*member);
}
template<auto member>
void setGroup(Scene& scene, std::uint64_t id, const EditValue& value) {
    fromValue(value, scene.groups[findGroup(scene, id)].*member);
}
template<auto member>
EditValue getBookmark(const Scene& scene, std::uint64_t id) {
    return toValue(scene.bookmarks[findBookmark(scene, id)].*member);
}
template<auto member>
void setBookmark(Scene& scene, std::uint64_t id, const EditValue& value) {
    fromValue(value, scene.bookmarks[findBookmark(scene, id)].*member);
}

EditValue getExposure(const Scene& scene, std::uint64_t) {
    return scene.hasExposure ? EditValue(scene.exposureEv100) : EditValue();
}
void setExposure(Scene& scene, std::uint64_t, const EditValue& value) {
    const double* number = std::get_if<double>(&value);
    scene.hasExposure = number != nullptr;
    scene.exposureEv100 = number ? *number : 0.0;
}

using enum FieldKind;

constexpr EditField kFields[] = {
    {EditTarget::Light, "name", Text, 0, 0, "", "the light's name in lists", getName, setName},
    {EditTarget::Light, "transform", Transform, 0, 0, "m", "place, rotation and scale below its parent",
     getTransform, setTransform},
    {EditTarget::Light, "muted", Flag, 0, 0, "", "switched off, of this light alone",
     getLight<&LightNode::muted>, setLight<&LightNode::muted>},
    {EditTarget::Light, "group", GroupId, 0, 0, "", "the group that it belongs to",
     getLight<&LightNode::group>, setLight<&LightNode::group>},
    {EditTarget::Light, "definition", DefIndex, 0, 0, "", "which definition it shows", getDefIndex,
     setDefIndex},
    defField<&LightDef::name>("definitionName", Text, 0, 0, "", "the definition's name in the file"),
    defField<&LightDef::type>("type", Type, 0, 0, "", "directional, sphere, spot, tube, rect or disk"),
    defField<&LightDef::intensity>("intensity", Number, -100, kHuge, "", "in the light's unit"),
    defField<&LightDef::unit>("unit", Unit, 0, 0, "", "lm, cd, lux, nit or ev100"),
    defField<&LightDef::color>("color", Color, 0, kHuge, "", "linear Rec. 709 tint"),
    defField<&LightDef::temperatureK>("temperatureK", OptionalNumber, 1000, 40000, "K", "colour temperature"),
    defField<&LightDef::rangeM>("rangeM", OptionalNumber, 1e-6, kHuge, "m", "where the light ends smoothly"),
    defField<&LightDef::radiusM>("radiusM", Number, 0, kHuge, "m", "sphere, spot, tube: source radius"),
    defField<&LightDef::lengthM>("lengthM", Number, 0, kHuge, "m", "tube: between its end caps"),
    defField<&LightDef::widthM>("widthM", Number, 1e-6, kHuge, "m", "rect: local X; disk: diameter"),
    defField<&LightDef::heightM>("heightM", Number, 1e-6, kHuge, "m", "rect: local Y"),
    defField<&LightDef::innerConeRad>("innerConeRad", Number, 0, kPi / 2, "rad",
                                      "spot: full up to this angle"),
    defField<&LightDef::outerConeRad>("outerConeRad", Number, 1e-4, kPi / 2, "rad",
                                      "spot: dark from this angle"),
    defField<&LightDef::angularDiameterRad>("angularDiameterRad", Number, 0, kPi, "rad",
                                            "directional: size in the sky"),
    defField<&LightDef::barnDoorAngleRad>("barnDoorAngleRad", Number, 0, kPi / 2, "rad",
                                          "rect: pi/2 is open"),
    defField<&LightDef::barnDoorLengthM>("barnDoorLengthM", Number, 0, kHuge, "m",
                                         "rect: 0 is without doors"),
    defField<&LightDef::rayEndBiasM>("rayEndBiasM", Number, 0, kHuge, "m",
                                     "shadow rays end this far before the light"),
    {EditTarget::Group, "name", Text, 0, 0, "", "of its own among groups", getGroup<&LightGroup::name>,
     setGroup<&LightGroup::name>},
    {EditTarget::Group, "intensity", Number, 0, kHuge, "", "factor on every member",
     getGroup<&LightGroup::intensity>, setGroup<&LightGroup::intensity>},
    {EditTarget::Group, "exposureEv", Number, -100, 100, "EV", "a second factor, 2^exposureEv",
     getGroup<&LightGroup::exposureEv>, setGroup<&LightGroup::exposureEv>},
    {EditTarget::Group, "tint", Color, 0, kHuge, "", "linear Rec. 709 tint", getGroup<&LightGroup::tint>,
     setGroup<&LightGroup::tint>},
    {EditTarget::Group, "muted", Flag, 0, 0, "", "switches all members off", getGroup<&LightGroup::muted>,
     setGroup<&LightGroup::muted>},
    {EditTarget::Bookmark, "name", Text, 0, 0, "", "shown in the list of views", getBookmark<&Camera::name>,
     setBookmark<&Camera::name>},
    {EditTarget::Bookmark, "frame", Frame, 0, 0, "m", "place and rotation, 16 numbers by column",
     getBookmark<&Camera::worldFromCamera>, setBookmark<&Camera::worldFromCamera>},
    {EditTarget::Bookmark, "yfovRad", Number, 1e-4, kPi - 1e-4, "rad", "vertical field of view",
     getBookmark<&Camera::yfovRad>, setBookmark<&Camera::yfovRad>},
    {EditTarget::Scene, "exposureEv100", OptionalNumber, -30, 40, "EV", "exposure to open the scene with",
     getExposure, setExposure},
};

} // namespace

std::span<const EditField> editFields() {
    return kFields;
}

const EditField* findEditField(EditTarget target, std::string_view name) {
    for (const EditField& field : kFields)
        if (field.target == target && field.name == name) return &field;
    return nullptr;
}

} // namespace kilolux
