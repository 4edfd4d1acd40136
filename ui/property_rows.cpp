#include "ui/property_rows.h"

#include "renderer/document/light_units.h"
#include "renderer/document/light_words.h"
#include "ui/light_actions.h"
#include "ui/light_place.h"
#include "ui/shaping_rows.h"
#include "ui/text_case.h"
#include "ui/theme.h"
#include "ui/widgets.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <imgui.h>

namespace kilolux {

namespace {

constexpr int kTypedDigits = 12;
constexpr double kPxPerOctave = 100.0; // of dragging, where a pixel is a factor

// 'Intensity of 3 lights'
std::string stepName(const Desk& desk, const char* label) {
    return fmt::format("{} of {}", label, countedLights(desk.selection.size()));
}

// What dragging by so many pixels adds or multiplies.
ValueEntry entryOf(double pixels, double step) {
    if (step == 0.0) return {ValueEntry::How::Multiply, std::exp2(pixels / kPxPerOctave), {}};
    return {ValueEntry::How::Add, pixels * step, {}};
}

void tellRefused(Desk& desk, const std::string& label, const std::string& message) {
    notify(desk, Notice::Kind::Error, fmt::format("{}: {}", label, message));
}

// What stands for a number that is left out: a range follows from the intensity then.
const char* absentWord(std::string_view field) {
    return field == "rangeM" ? "auto" : "none";
}

FieldText textOf(const CommonValue& value, Quantity quantity, LightUnit unit, const char* absent = "none") {
    if (value.mixed) return {"mixed", "", "", FieldText::Tone::Dim};
    const double* number = std::get_if<double>(&value.value);
    if (!number) return {absent, "", "", FieldText::Tone::Dim};
    return {formatQuantity(*number, quantity, 5), std::string(unitLabel(quantity, unit)),
            formatQuantity(*number, quantity, kTypedDigits)};
}

// The unit of an intensity, to be chosen from those that suit all selected lights; a change converts the
// numbers.
void drawUnit(Desk& desk, float widthPx) {
    const Scene& scene = desk.session->scene();
    const CommonValue value = valueOf(desk, "unit");
    const LightUnit unit = std::get<LightUnit>(value.value);
    ImGui::SetNextItemWidth(widthPx);
    if (ImGui::BeginCombo("##unit", value.mixed ? "mixed" : unitLabel(Quantity::Intensity, unit).data(),
                          ImGuiComboFlags_NoArrowButton)) {
        for (const LightUnitWord& word : kLightUnitWords) {
            const bool suits =
                std::all_of(desk.selection.begin(), desk.selection.end(),
                            [&](std::uint64_t light) { return unitApplies(defOf(scene, light), word.unit); });
            if (!suits) continue;
            const bool same = !value.mixed && word.unit == unit;
            if (ImGui::Selectable(unitLabel(Quantity::Intensity, word.unit).data(), same) && !same) {
                applyEdits(desk, editsForValue(scene, desk.selection, "unit", word.unit, sharingOf(desk)),
                           stepName(desk, "Unit"));
            }
            mark(desk, std::string("unit.") + word.name);
        }
        ImGui::EndCombo();
    }
    mark(desk, "unit");
    tooltip("Another unit keeps the light and converts the number");
}

glm::dvec3 angleHint(const PropertiesState& state) {
    return state.eulerRad;
}

// A coordinate or angle of the selection, remembered as valueOf() does.
CommonValue coordinateOf(Desk& desk, bool isAngle, int axis) {
    PropertiesState& state = propertiesOf(desk);
    const Scene& scene = desk.session->scene();
    CommonValue& value = state.coordinates[std::size_t(isAngle ? 3 + axis : axis)];
    if (!std::holds_alternative<std::monostate>(value.value)) return value;
    const auto numberOf = [&](std::uint64_t light) {
        return isAngle ? eulerFrom(rotationOf(scene, light), angleHint(state))[axis]
                       : positionOf(scene, light)[axis];
    };
    value = {numberOf(state.selection.front()), false};
    for (std::size_t i = 1; i < state.selection.size() && !value.mixed; ++i)
        value.mixed = std::abs(numberOf(state.selection[i]) - std::get<double>(value.value)) > 1e-9;
    return value;
}

// One of three numbers in a row.
void drawCoordinate(Desk& desk, bool isAngle, int axis, float widthPx) {
    PropertiesState& state = propertiesOf(desk);
    const Scene& scene = desk.session->scene();
    constexpr const char* kAxes[] = {"x", "y", "z"};
    const Quantity quantity = isAngle ? Quantity::Angle : Quantity::Length;
    const CommonValue value = coordinateOf(desk, isAngle, axis);
    FieldText text = textOf(value, quantity, LightUnit::Candela);
    if (!value.mixed)
        text.shown = fmt::format(
            "{:.{}f}", isAngle ? glm::degrees(std::get<double>(value.value)) : std::get<double>(value.value),
            isAngle ? 1 : 3);
    if (text.shown == (isAngle ? "-0.0" : "-0.000")) text.shown.erase(0, 1);
    text.unit.clear(); // in the label
    const char* what = isAngle ? "Rotation" : "Position";
    const FieldEvent event = valueField(
        desk, fmt::format("{}.{}", isAngle ? "rotation" : "position", kAxes[axis]), text, widthPx, nullptr);
    if (event.kind == FieldEvent::Kind::None) return;
    const bool dragged = event.kind == FieldEvent::Kind::Dragged;
    Result<ValueEntry> entry =
        dragged ? Result<ValueEntry>(entryOf(event.pixels, isAngle ? glm::radians(0.5) : 0.01))
                : parseEntry(event.text, quantity);
    if (!entry) return tellRefused(desk, what, entry.error());
    const Scene& from = dragged ? state.dragStart : scene;
    const Result<Edits> edits =
        isAngle ? editsForAngle(scene, from, state.selection, axis, entry.value(), angleHint(state))
                : editsForPosition(scene, from, state.selection, axis, entry.value());
    if (applyEdits(desk, edits, stepName(desk, what), dragged ? dragKey(state) : "") && dragged &&
        !edits.value().empty())
        noteDragged(desk);
}

void drawTriple(Desk& desk, const char* label, const char* help, bool isAngle) {
    const float width = rowLabel(desk, label, help), gap = px(desk, 4);
    const float each = std::floor((width - 2 * gap) / 3.0f);
    for (int axis = 0; axis < 3; ++axis) {
        if (axis > 0) ImGui::SameLine(0, gap);
        drawCoordinate(desk, isAngle, axis, each);
    }
}

// What stands by itself: a group, or the scene. `id` 0 is the scene.
struct Owner {
    EditTarget target;
    std::uint64_t id;
    const char* word; // before the names of steps
    std::string prefix() const { return target == EditTarget::Group ? "group." : "scene."; }
};

// A number of it, by its field in the table of edits.
void drawOwnNumber(Desk& desk, const Owner& owner, const char* label, const char* name, Quantity quantity,
                   double step, const char* help) {
    PropertiesState& state = propertiesOf(desk);
    const EditField& field = *findEditField(owner.target, name);
    const CommonValue value{field.get(desk.session->scene(), owner.id), false};
    const float width = rowLabel(desk, label, help);
    const FieldEvent event =
        valueField(desk, owner.prefix() + name, textOf(value, quantity, LightUnit::Candela), width, help);
    if (event.kind == FieldEvent::Kind::None) return;
    const bool dragged = event.kind == FieldEvent::Kind::Dragged;
    const Result<ValueEntry> entry =
        dragged ? Result<ValueEntry>(entryOf(event.pixels, step)) : parseEntry(event.text, quantity);
    if (!entry) return tellRefused(desk, label, entry.error());
    const double before =
        std::get<double>(field.get(dragged ? state.dragStart : desk.session->scene(), owner.id));
    double after = changed(before, entry.value());
    if (dragged) after = std::clamp(after, field.min, field.max);
    const Result<Edits> edits = setField(desk.session->scene(), owner.target, owner.id, field, after);
    if (applyEdits(desk, edits, fmt::format("{} {}", owner.word, withinSentence(label)),
                   dragged ? dragKey(state) : "") &&
        dragged && !edits.value().empty())
        noteDragged(desk);
}

// A swatch with a picker behind it, and the numbers to type. Returns the new colour; `ended` closes a drag in
// it.
std::optional<glm::dvec3> colorField(Desk& desk, const std::string& id, const CommonValue& value,
                                     float widthPx, bool& ended) {
    PropertiesState& state = propertiesOf(desk);
    const glm::dvec3 linear = std::get<glm::dvec3>(value.value);
    const double most = std::max({linear.x, linear.y, linear.z, 1.0}); // brighter tints keep their brightness
    const glm::dvec3 srgb = srgbFromLinear(linear / most);
    float picked[3] = {float(srgb.x), float(srgb.y), float(srgb.z)};
    const float side = ImGui::GetFrameHeight();
    std::optional<glm::dvec3> result;
    ImGui::PushID(id.c_str());
    if (ImGui::ColorButton("##swatch", {picked[0], picked[1], picked[2], 1.0f}, ImGuiColorEditFlags_NoTooltip,
                           {side, side})) {
        ++state.drags;
        ImGui::OpenPopup("picker");
    }
    mark(desk, id + ".swatch");
    if (ImGui::BeginPopup("picker")) {
        closePopupOnEscape();
        if (ImGui::ColorPicker3("##picker", picked,
                                ImGuiColorEditFlags_NoSidePreview | ImGuiColorEditFlags_DisplayRGB))
            result = most * linearFromSrgb({picked[0], picked[1], picked[2]});
        mark(desk, id + ".picker");
        ended = !ImGui::IsMouseDown(0) && !ImGui::IsAnyItemActive();
        ImGui::EndPopup();
    }
    ImGui::PopID();
    ImGui::SameLine(0, px(desk, 4));
    const std::string text = formatColor(linear);
    const FieldEvent event =
        valueField(desk, id,
                   {value.mixed ? "mixed" : text, "", value.mixed ? "" : text,
                    value.mixed ? FieldText::Tone::Dim : FieldText::Tone::Bright},
                   widthPx - side - px(desk, 4), "Linear red, green, blue; or #rrggbb", FieldDrag::Never);
    if (event.kind != FieldEvent::Kind::Typed) return result;
    const Result<glm::dvec3> typed = parseColor(event.text);
    if (!typed) {
        tellRefused(desk, "Tint", typed.error());
        return result;
    }
    ended = true;
    return typed.value();
}

// Where profiles bring their own candela the light's intensity says nothing: theirs is shown instead.
bool drawProfileIntensity(Desk& desk) {
    const Scene& scene = desk.session->scene();
    const auto usesProfile = [&](std::uint64_t light) {
        const LightDef& def = defOf(scene, light);
        return isShapedByProfile(def) && def.iesIntensity;
    };
    if (!std::all_of(desk.selection.begin(), desk.selection.end(), usesProfile)) return false;
    const auto candelaOf = [&](std::uint64_t light) { return baseIntensity(defOf(scene, light)); };
    const double first = candelaOf(desk.selection.front());
    const bool mixed = std::any_of(desk.selection.begin(), desk.selection.end(),
                                   [&](std::uint64_t light) { return candelaOf(light) != first; });
    const char* help =
        "The profile's own, at its brightest. The multiplier below 'Profile' changes it; without "
        "'Its intensity' the light has one of its own again";
    rowLabel(desk, "Intensity", help);
    ImGui::TextDisabled(
        "%s",
        mixed ? "of the profiles, mixed"
              : fmt::format("{} cd, of the profile", formatQuantity(first, Quantity::Intensity, 5)).c_str());
    mark(desk, "intensity.profile");
    tooltip(help);
    return true;
}

void drawNumberRow(Desk& desk, const LightField& row) {
    PropertiesState& state = propertiesOf(desk);
    if (row.quantity == Quantity::Intensity && drawProfileIntensity(desk)) return;
    const bool isIntensity = row.quantity == Quantity::Intensity;
    const CommonValue value = valueOf(desk, row.field);
    const CommonValue unit = isIntensity ? valueOf(desk, "unit") : CommonValue{LightUnit::Candela, false};
    float width = rowLabel(desk, row.label, row.help);
    const float unitWidth = isIntensity ? px(desk, 52) : 0.0f;
    FieldText text = textOf(value, row.quantity, std::get<LightUnit>(unit.value), absentWord(row.field));
    if (isIntensity) text.unit.clear(); // beside it
    const FieldEvent event =
        valueField(desk, row.field, text, width - (isIntensity ? unitWidth + px(desk, 4) : 0.0f), row.help);
    if (isIntensity) {
        ImGui::SameLine(0, px(desk, 4));
        drawUnit(desk, unitWidth);
    }
    if (event.kind == FieldEvent::Kind::None) return;
    const bool dragged = event.kind == FieldEvent::Kind::Dragged;
    const Result<ValueEntry> entry =
        dragged ? Result<ValueEntry>(entryOf(event.pixels, row.step)) : parseEntry(event.text, row.quantity);
    if (!entry) return tellRefused(desk, row.label, entry.error());
    // Nothing there to drag from.
    if (dragged && std::holds_alternative<std::monostate>(value.value)) return;
    const Scene& scene = desk.session->scene();
    const Result<Edits> edits =
        editsForEntry(scene, dragged ? state.dragStart : scene, state.selection, row, entry.value(),
                      state.sharing, dragged ? OutOfRange::Clamp : OutOfRange::Refuse);
    if (applyEdits(desk, edits, stepName(desk, row.label), dragged ? dragKey(state) : "") && dragged &&
        !edits.value().empty())
        noteDragged(desk);
}

void drawOwnFlag(Desk& desk, const Owner& owner, const char* label, const char* name, const char* help) {
    const EditField& field = *findEditField(owner.target, name);
    const Scene& scene = desk.session->scene();
    bool on = std::get<bool>(field.get(scene, owner.id));
    rowLabel(desk, label, help);
    const bool pressed = ImGui::Checkbox(fmt::format("##{}", name).c_str(), &on);
    mark(desk, owner.prefix() + name);
    if (pressed)
        applyEdits(desk, setField(scene, owner.target, owner.id, field, on),
                   fmt::format("{} {}", owner.word, withinSentence(label)));
}

// The same for a colour.
void drawOwnColor(Desk& desk, const Owner& owner, const char* label, const char* name, const char* help) {
    PropertiesState& state = propertiesOf(desk);
    bool ended = false;
    const EditField& field = *findEditField(owner.target, name);
    const CommonValue value{field.get(desk.session->scene(), owner.id), false};
    const float width = rowLabel(desk, label, help);
    const std::string key = fmt::format("{}{} {}", owner.prefix(), name, state.drags);
    if (const auto color = colorField(desk, owner.prefix() + name, value, width, ended)) {
        applyEdits(desk, setField(desk.session->scene(), owner.target, owner.id, field, *color),
                   fmt::format("{} {}", owner.word, withinSentence(label)), key);
    }
    if (ended && desk.session->history().wouldMerge(key)) endDrag(desk), ++state.drags;
}

} // namespace

float rowLabel(Desk& desk, const char* label, const char* help) {
    const float whole = ImGui::GetContentRegionAvail().x;
    const float labels = std::min(px(desk, 108), 0.42f * whole);
    const float x = ImGui::GetCursorPosX();
    ImGui::AlignTextToFramePadding();
    textWithin(label, labels - px(desk, 4));
    if (help) tooltip(help);
    ImGui::SameLine(x + labels);
    return whole - labels;
}

const CommonValue& valueOf(Desk& desk, const char* field) {
    PropertiesState& state = propertiesOf(desk);
    const auto [at, isNew] = state.values.try_emplace(field);
    if (isNew) at->second = commonValue(desk.session->scene(), state.selection, field);
    return at->second;
}

void drawFieldRow(Desk& desk, const LightField& row) {
    switch (findLightField(row.field)->kind) {
    case FieldKind::Flag:
        return drawFlagRow(desk, row);
    case FieldKind::Word:
        return drawWordRow(desk, row);
    case FieldKind::Channels:
        return drawChannelsRow(desk, row);
    case FieldKind::Profile:
    case FieldKind::Picture:
        return drawFileRow(desk, row);
    default:
        return drawNumberRow(desk, row);
    }
}

void drawPlaceRows(Desk& desk) {
    drawTriple(desk, "Position  m", "In the world: X, Y up, Z", false);
    // The lights may be gone after an edit.
    if (!desk.selection.empty())
        drawTriple(desk, "Rotation  \u00b0", "About X, then Y, then Z of the world", true);
}

void drawTintRow(Desk& desk) {
    PropertiesState& state = propertiesOf(desk);
    bool ended = false;
    const CommonValue value = valueOf(desk, "color");
    const float width = rowLabel(desk, "Tint", "Multiplies the temperature's colour");
    const auto color = colorField(desk, "color", value, width, ended);
    if (color) {
        applyEdits(desk,
                   editsForValue(desk.session->scene(), state.selection, "color", *color, state.sharing),
                   stepName(desk, "Tint"), fmt::format("tint {}", state.drags));
    }
    if (ended && desk.session->history().wouldMerge(fmt::format("tint {}", state.drags)))
        endDrag(desk), ++state.drags;
}

void drawGroupRows(Desk& desk, std::uint64_t group) {
    const Owner owner{EditTarget::Group, group, "Group"};
    drawOwnNumber(desk, owner, "Master", "intensity", Quantity::Number, 0.005, "A factor on all its lights");
    drawOwnNumber(desk, owner, "Exposure", "exposureEv", Quantity::Exposure, 0.01,
                  "A second factor, in stops");
    drawOwnColor(desk, owner, "Tint", "tint", "On all its lights");
    if (textButton(desk, "group.select", "Select its lights"))
        select(desk, membersOf(desk.session->scene(), group));
}

void drawDomeRows(Desk& desk) {
    const Owner owner{EditTarget::Scene, 0, "Dome"};
    const EditField& image = *findEditField(EditTarget::Scene, "domeImage");
    const CommonValue uri{image.get(desk.session->scene(), 0), false};
    const float width =
        rowLabel(desk, "Picture", "Latitude-longitude, its middle towards -Z; none: one colour");
    if (const auto chosen = fileCombo(desk, "scene.domeImage", uri, false, width))
        applyEdits(desk, setField(desk.session->scene(), EditTarget::Scene, 0, image, *chosen),
                   "Dome picture");
    drawOwnNumber(desk, owner, "Dome  nit", "domeNit", Quantity::Number, 1.0,
                  "Luminance all around, or of a pixel of value 1; 0 is without");
    drawOwnColor(desk, owner, "Colour", "domeColor", "On the picture as well");
    drawOwnNumber(desk, owner, "Turn", "domeRotationRad", Quantity::Angle, glm::radians(0.5), "About +Y");
    drawOwnFlag(desk, owner, "In the picture", "domeVisible", "Seen behind the scene, where nothing else is");
    const Owner fill{EditTarget::Scene, 0, "Fill"};
    drawOwnNumber(desk, fill, "Fill  nit", "fillNit", Quantity::Number, 0.1,
                  "A plain ambient light without shadows, for context only");
    drawOwnColor(desk, fill, "Fill colour", "fillColor", "Of the ambient light");
}

} // namespace kilolux
