// The table of editable fields, and reading and writing them.
#include "renderer/document/edit.h"

#include "renderer/document/light_properties.h"
#include "renderer/document/scene_files.h"

#include <algorithm>
#include <utility>

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
EditValue toValue(IesUse member) {
    return std::string(wordOf(member));
}
EditValue toValue(LightFunctionKind member) {
    return std::string(wordOf(member));
}
EditValue toValue(std::uint8_t member) {
    return std::uint64_t{member};
}
template<typename T>
void fromValue(const EditValue& value, T& member) {
    member = std::get<T>(value);
}
void fromValue(const EditValue& value, std::optional<double>& member) {
    const double* number = std::get_if<double>(&value);
    member = number ? std::optional<double>(*number) : std::nullopt;
}

void fromValue(const EditValue& value, std::uint8_t& member) {
    member = static_cast<std::uint8_t>(std::get<std::uint64_t>(value));
}
template<typename Word>
requires std::is_same_v<Word, IesUse> || std::is_same_v<Word, LightFunctionKind>
void fromValue(const EditValue& value, Word& member) {
    member = parseWord(std::get<std::string>(value), member).value_or(member);
}

// Just the names, in the order of the words.
template<std::size_t N>
constexpr auto namesOf(const auto(&words)[N]) {
    std::array<const char*, N> names{};
    std::transform(std::begin(words), std::end(words), names.begin(), [](const auto& w) { return w.name; });
    return names;
}
constexpr auto kIesUses = namesOf(kIesUseWords);
constexpr auto kLightFunctions = namesOf(kLightFunctionWords);

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

template<auto member>
EditValue getDoors(const Scene& scene, std::uint64_t index) {
    return scene.lightDefs[index].barnDoors[0].*member;
}
template<auto member>
void setDoors(Scene& scene, std::uint64_t index, const EditValue& value) {
    for (BarnDoor& door : scene.lightDefs[index].barnDoors)
        door.*member = std::get<double>(value);
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

EditValue getMeshChannels(const Scene& scene, std::uint64_t node) {
    return toValue(scene.nodes[node].meshChannels);
}
void setMeshChannels(Scene& scene, std::uint64_t node, const EditValue& value) {
    fromValue(value, scene.nodes[node].meshChannels);
}

template<auto member>
EditValue getDome(const Scene& scene, std::uint64_t) {
    return toValue(scene.dome.*member);
}
template<auto member>
void setDome(Scene& scene, std::uint64_t, const EditValue& value) {
    fromValue(value, scene.dome.*member);
    loadFiles(scene.files.get(), scene.dome);
}
template<auto member>
constexpr EditField domeField(const char* name, FieldKind kind, double min, double max, const char* unit,
                              const char* help) {
    return {EditTarget::Scene, name, kind, min, max, unit, help, getDome<member>, setDome<member>};
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

constexpr EditField kNamedFields[] = {
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
    defField<&LightDef::innerConeRad>("innerConeRad", Number, 0, kPi / 2, "rad",
                                      "spot: full up to this angle"),
    defField<&LightDef::outerConeRad>("outerConeRad", Number, 1e-4, kPi / 2, "rad",
                                      "spot: dark from this angle"),
    {EditTarget::Definition,
     "barnDoorAngleRad",
     Number,
     0,
     kPi / 2,
     "rad",
     "rect, all four flaps",
     getDoors<&BarnDoor::angleRad>,
     setDoors<&BarnDoor::angleRad>,
     {},
     true},
    {EditTarget::Definition,
     "barnDoorLengthM",
     Number,
     0,
     kHuge,
     "m",
     "rect, all four flaps",
     getDoors<&BarnDoor::lengthM>,
     setDoors<&BarnDoor::lengthM>,
     {},
     true},
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
    {EditTarget::Node, "meshChannels", Channels, 0, 255, "",
     "bits 1 to 128: reached by lights that share one", getMeshChannels, setMeshChannels},
    {EditTarget::Scene, "exposureEv100", OptionalNumber, -30, 40, "EV", "exposure to open the scene with",
     getExposure, setExposure},
    domeField<&Dome::imageUri>("domeImage", Picture, 0, 0, "",
                               "light from all around: a latitude-longitude picture"),
    domeField<&Dome::color>("domeColor", Color, 0, kHuge, "", "linear Rec. 709, of the dome"),
    domeField<&Dome::intensityNit>("domeNit", Number, 0, kHuge, "nit", "of the dome; 0 is without"),
    domeField<&Dome::rotationRad>("domeRotationRad", Number, -1e3, 1e3, "rad", "of the dome about +Y"),
    domeField<&Dome::visible>("domeVisible", Flag, 0, 0, "", "the dome is seen behind the scene"),
    domeField<&Dome::fillColor>("fillColor", Color, 0, kHuge, "", "linear Rec. 709, of the fill"),
    domeField<&Dome::fillNit>("fillNit", Number, 0, kHuge, "nit", "plain ambient light without shadows"),
};

// --- the rows of light_properties.h ---

template<typename T>
constexpr FieldKind kindOf(properties::Names names) {
    if (names == properties::Names::Profile) return Profile;
    if (names == properties::Names::Picture) return FieldKind::Picture;
    if constexpr (std::is_same_v<T, double>) return Number;
    if constexpr (std::is_same_v<T, std::optional<double>>) return OptionalNumber;
    if constexpr (std::is_same_v<T, bool>) return Flag;
    if constexpr (std::is_same_v<T, std::uint8_t>) return Channels;
    return Word;
}

template<typename T>
constexpr std::span<const char* const> wordsOf() {
    if constexpr (std::is_same_v<T, IesUse>) return kIesUses;
    if constexpr (std::is_same_v<T, LightFunctionKind>) return kLightFunctions;
    return {};
}

template<std::size_t i>
EditValue getProperty(const Scene& scene, std::uint64_t index) {
    return toValue(std::get<i>(properties::kList).access(scene.lightDefs[index]));
}
template<std::size_t i>
void setProperty(Scene& scene, std::uint64_t index, const EditValue& value) {
    constexpr auto property = std::get<i>(properties::kList);
    LightDef& def = scene.lightDefs[index];
    fromValue(value, property.access(def));
    // What cannot be read is told by who chose it; the light stays.
    if (property.names != properties::Names::Nothing) loadFiles(scene.files.get(), def);
}
template<std::size_t i>
constexpr EditField propertyField() {
    constexpr auto row = std::get<i>(properties::kList);
    using T = std::decay_t<decltype(row.access(std::declval<LightDef&>()))>;
    return {
        EditTarget::Definition, row.name,       kindOf<T>(row.names), row.min, row.max, row.unit, row.help,
        getProperty<i>,         setProperty<i>, wordsOf<T>()};
}

constexpr auto kFields = [] {
    std::array<EditField, std::size(kNamedFields) + kLightPropertyCount> fields{};
    const auto* others = std::find_if(std::begin(kNamedFields), std::end(kNamedFields),
                                      [](const EditField& f) { return f.target == EditTarget::Group; });
    auto* rows = std::copy(std::begin(kNamedFields), others, fields.begin());
    [&]<std::size_t... i>(std::index_sequence<i...>) {
        ((rows[i] = propertyField<i>()), ...);
    }
    (std::make_index_sequence<kLightPropertyCount>());
    std::copy(others, std::end(kNamedFields), rows + kLightPropertyCount);
    return fields;
}();

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
