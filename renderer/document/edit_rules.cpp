#include "renderer/document/edit_rules.h"

#include "renderer/document/gltf_context.h"
#include "renderer/document/light_units.h"
#include "renderer/document/light_words.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace kilolux {

namespace {

constexpr double kMinTubeRadiusM = 0.001; // a line has no luminance
constexpr double kMaxEv100 = 100.0;
constexpr std::size_t kMaxNameBytes = 10'000;
constexpr std::size_t kMaxUriBytes = 32u << 20;

std::optional<Error> expected(std::string what) {
    return Error{"expected " + std::move(what)};
}

std::optional<Error> checkNumber(const EditField& field, double value) {
    if (value >= field.min && value <= field.max) return std::nullopt; // not for NaN
    return expected(fmt::format("a number from {} to {}, found {}", field.min, field.max, value));
}

// A transform that later reading and single precision can hold.
std::optional<Error> checkMatrix(const glm::dmat4& matrix) {
    const bool affine =
        matrix[0][3] == 0.0 && matrix[1][3] == 0.0 && matrix[2][3] == 0.0 && matrix[3][3] == 1.0;
    if (!affine || !fitsSinglePrecision(matrix)) return expected("a finite transform");
    return std::nullopt;
}

std::optional<Error> checkTransform(const EditValue& value) {
    if (const glm::dmat4* matrix = std::get_if<glm::dmat4>(&value)) return checkMatrix(*matrix);
    const Trs* trs = std::get_if<Trs>(&value);
    if (!trs) return expected("a transform");
    if (!(std::abs(glm::length(trs->rotation) - 1.0) < 1e-6)) return expected("a rotation of unit length");
    return checkMatrix(matrixFrom(*trs));
}

std::optional<Error> checkFrame(const EditValue& value) {
    const glm::dmat4* matrix = std::get_if<glm::dmat4>(&value);
    if (!matrix) return expected("16 numbers");
    if (std::optional<Error> error = checkMatrix(*matrix)) return error;
    const glm::dmat3 turn(*matrix);
    const glm::dmat3 product = glm::transpose(turn) * turn;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            if (!(std::abs(product[i][j] - (i == j ? 1.0 : 0.0)) < 1e-6))
                return expected("a frame without scale or shear");
        }
    }
    return glm::determinant(turn) > 0.0 ? std::nullopt : expected("a frame that is not mirrored");
}

std::optional<Error> checkText(const std::string& text) {
    if (text.size() > kMaxNameBytes) return expected(fmt::format("at most {} bytes", kMaxNameBytes));
    try {
        static_cast<void>(nlohmann::json(text).dump());
    } catch (const nlohmann::json::exception&) {
        return expected("text in UTF-8");
    }
    return std::nullopt;
}

std::optional<Error> checkWord(const EditField& field, const EditValue& value) {
    const std::string* word = std::get_if<std::string>(&value);
    std::string known;
    for (const char* each : field.words) {
        if (word && *word == each) return std::nullopt;
        known += (known.empty() ? "" : ", ") + std::string(each);
    }
    return expected("one of " + known);
}

// Text that names a file of the scene's folder, data, or a part of the scene's file; or nothing.
std::optional<Error> checkUri(const EditValue& value) {
    const std::string* uri = std::get_if<std::string>(&value);
    if (!uri) return expected("text");
    if (gltf::isDataUri(*uri)) return uri->size() <= kMaxUriBytes ? std::nullopt : expected("a smaller file");
    if (std::optional<Error> error = checkText(*uri)) return error;
    if (uri->empty() || uri->starts_with('#')) return std::nullopt;
    try {
        static_cast<void>(gltf::resolveUri({}, *uri, "a file"));
    } catch (const gltf::ImportFailure& failure) {
        return Error{failure.text};
    }
    return std::nullopt;
}

// --- objects as a whole ---

std::optional<Error> checkDefinition(const LightDef& def) {
    if (def.type == LightType::Spot && def.innerConeRad > def.outerConeRad) {
        return Error{fmt::format("innerConeRad: expected up to outerConeRad {}, found {}", def.outerConeRad,
                                 def.innerConeRad)};
    }
    if (def.type == LightType::Tube && def.radiusM < kMinTubeRadiusM)
        return Error{
            fmt::format("radiusM: expected at least {} for a tube, found {}", kMinTubeRadiusM, def.radiusM)};
    if (!unitApplies(def, def.unit)) {
        return Error{fmt::format("unit: expected one that suits a light of type {} and its size, found {}",
                                 wordOf(def.type), wordOf(def.unit))};
    }
    const bool isExposure = def.unit == LightUnit::Ev100;
    if (isExposure ? std::abs(def.intensity) > kMaxEv100 : def.intensity < 0.0) {
        return Error{fmt::format("intensity: expected a number from {} to {} in {}, found {}",
                                 isExposure ? -kMaxEv100 : 0.0, isExposure ? kMaxEv100 : 1e18,
                                 wordOf(def.unit), def.intensity)};
    }
    if (!std::isfinite(baseIntensity(def)))
        return Error{"intensity: expected a finite one at the light's size"};
    return std::nullopt;
}

// Every field of an object that has just appeared.
std::optional<Error> checkFields(const Scene& scene, EditTarget target, std::uint64_t id) {
    for (const EditField& field : editFields()) {
        if (field.target != target || field.isShorthand) continue;
        if (std::optional<Error> error = checkValue(field, field.get(scene, id)))
            return Error{std::string(field.name) + ": " + error->message};
    }
    return std::nullopt;
}

std::optional<Error> checkLight(const Scene& scene, const LightNode& light) {
    const int nodes = static_cast<int>(scene.nodes.size()), defs = static_cast<int>(scene.lightDefs.size());
    if (light.node < 0 || light.node >= nodes) return Error{"node: expected one that exists"};
    if (light.def < 0 || light.def >= defs) return Error{"definition: expected one that exists"};
    if (light.group != 0 && findGroup(scene, light.group) < 0)
        return Error{"group: expected one that exists"};
    return std::nullopt;
}

std::optional<Error> checkGroup(const Scene& scene, const LightGroup& group) {
    const auto same = std::count_if(scene.groups.begin(), scene.groups.end(),
                                    [&](const LightGroup& other) { return other.name == group.name; });
    if (group.name.empty() || same > 1) return Error{"name: expected one of its own"};
    return std::nullopt;
}

std::optional<Error> checkNode(const Scene& scene, std::uint64_t index) {
    const Node& node = scene.nodes[index];
    // Files may have children before their parents; what is excluded is a cycle.
    const auto count = static_cast<int>(scene.nodes.size());
    int above = node.parent;
    for (int steps = 0; above >= 0; ++steps) {
        if (above >= count || steps > count) return Error{"parent: expected a node, and no cycle"};
        above = scene.nodes[static_cast<std::size_t>(above)].parent;
    }
    if (node.mesh >= static_cast<int>(scene.meshes.size())) return Error{"mesh: expected one that exists"};
    if (std::optional<Error> error = checkText(node.name)) return error;
    return checkTransform(node.restTrs ? EditValue(*node.restTrs) : EditValue(node.localFromNode));
}

// Nothing may refer to what has disappeared.
std::optional<Error> checkGone(const Scene& scene, const Edit& edit) {
    if (edit.target == EditTarget::Light || edit.target == EditTarget::Bookmark) return std::nullopt;
    const int index = static_cast<int>(edit.id);
    for (const LightNode& light : scene.lights) {
        const bool refers = (edit.target == EditTarget::Definition && light.def == index) ||
                            (edit.target == EditTarget::Node && light.node == index) ||
                            (edit.target == EditTarget::Group && light.group == edit.id);
        if (refers) return Error{"expected that no light refers to it"};
    }
    if (edit.target != EditTarget::Node) return std::nullopt;
    for (const Node& node : scene.nodes)
        if (node.parent == index) return Error{"expected that it has no children"};
    return std::nullopt;
}

std::optional<Error> checkExisting(const Scene& scene, const Edit& edit) {
    switch (edit.target) {
    case EditTarget::Light: {
        const LightNode& light = scene.lights[findLight(scene, edit.id)];
        if (std::optional<Error> error = checkLight(scene, light)) return error;
        // A node carries one light.
        const auto same =
            edit.field ? 1 : std::count_if(scene.lights.begin(), scene.lights.end(), [&](const LightNode& l) {
                return l.node == light.node;
            });
        return same == 1 ? std::nullopt : std::optional<Error>(Error{"node: expected one without a light"});
    }
    case EditTarget::Definition:
        return checkDefinition(scene.lightDefs[edit.id]);
    case EditTarget::Node:
        return checkNode(scene, edit.id);
    case EditTarget::Group:
        return checkGroup(scene, scene.groups[findGroup(scene, edit.id)]);
    case EditTarget::Bookmark:
    case EditTarget::Scene:
        break;
    }
    return std::nullopt;
}

} // namespace

std::optional<Error> checkValue(const EditField& field, const EditValue& value) {
    const double* number = std::get_if<double>(&value);
    switch (field.kind) {
    case FieldKind::OptionalNumber:
        if (std::holds_alternative<std::monostate>(value)) return std::nullopt;
        return number ? checkNumber(field, *number) : expected("a number or null");
    case FieldKind::Number:
        return number ? checkNumber(field, *number) : expected("a number");
    case FieldKind::Flag:
        return std::holds_alternative<bool>(value) ? std::nullopt : expected("true or false");
    case FieldKind::Text:
        return std::holds_alternative<std::string>(value) ? checkText(std::get<std::string>(value))
                                                          : expected("text");
    case FieldKind::Color: {
        const glm::dvec3* color = std::get_if<glm::dvec3>(&value);
        for (int i = 0; i < 3; ++i) {
            if (!color || !((*color)[i] >= 0.0 && (*color)[i] <= field.max))
                return expected("three numbers from 0 up");
        }
        return std::nullopt;
    }
    case FieldKind::Type:
        return std::holds_alternative<LightType>(value) ? std::nullopt : expected("a type of light");
    case FieldKind::Unit:
        return std::holds_alternative<LightUnit>(value) ? std::nullopt : expected("a unit of light");
    case FieldKind::Word:
        return checkWord(field, value);
    case FieldKind::Profile:
    case FieldKind::Picture:
        return checkUri(value);
    case FieldKind::Channels: {
        const std::uint64_t* bits = std::get_if<std::uint64_t>(&value);
        return bits && *bits <= 255 ? std::nullopt : expected("a number of bits from 0 to 255");
    }
    case FieldKind::Transform:
        return checkTransform(value);
    case FieldKind::Frame:
        return checkFrame(value);
    case FieldKind::GroupId:
    case FieldKind::DefIndex:
        return std::holds_alternative<std::uint64_t>(value) ? std::nullopt : expected("an id");
    }
    return std::nullopt;
}

std::optional<Error> checkTouched(const Scene& scene, const Edit& edit) {
    std::optional<Error> error;
    const bool isLight = edit.target == EditTarget::Light; // one without its node is there, and wrong
    if (isLight ? findLight(scene, edit.id) < 0 : !targetExists(scene, edit.target, edit.id)) {
        error = checkGone(scene, edit);
    } else {
        error = checkExisting(scene, edit);
        if (!error && !edit.field && edit.target != EditTarget::Node)
            error = checkFields(scene, edit.target, edit.id);
    }
    if (!error) return std::nullopt;
    const std::string place = describeTarget(scene, edit.target, edit.id);
    return Error{place.empty() ? error->message : place + ", " + error->message};
}

} // namespace kilolux
