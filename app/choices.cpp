// Lists for people and programs, and one way to refuse an unknown name.
#include "app/choices.h"

#include "renderer/nearest_name.h"
#include "renderer/settings_presets.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace kilolux {
namespace {

constexpr int kMaxSidePx = 16384;
constexpr std::int64_t kMaxPixels = 7680ll * 4320; // 8K UHD

std::string choicesText(std::string_view title, std::span<const NamedChoice> choices) {
    std::string text = fmt::format("{}\n", title);
    for (const NamedChoice& choice : choices)
        text += fmt::format("  {:<20} {}{}\n", choice.name, choice.help,
                            choice.name == choices.front().name ? " (default)" : "");
    return text + "\n";
}

std::string settingsText(std::string_view title, bool expert) {
    const Settings defaults;
    std::string text = fmt::format("{}\n", title);
    for (const SettingRow& row : settingRows()) {
        if (row.expert != expert) continue;
        text += fmt::format("  {:<20} {}\n", row.name, row.help);
        text += fmt::format("  {:<20} {}{}{}, default {}\n", "", settingTypeText(row),
                            row.unit.empty() ? "" : " ", row.unit, settingValueText(row, defaults));
        const ChoiceMember* choice = std::get_if<ChoiceMember>(&row.member);
        if (!choice) continue;
        for (const SettingWord& word : choice->words)
            text += fmt::format("  {:<20}   {:<16} {}\n", "", word.word, word.help);
    }
    return text;
}

std::string presetsText() {
    std::string text = "Presets (--preset)\n";
    for (const SettingsPreset& preset : settingsPresets()) {
        text += fmt::format("  {:<20} {}\n", preset.name, preset.help);
        text += fmt::format("  {:<20}   look: {}\n", "", preset.look);
        if (!preset.values.empty()) text += fmt::format("  {:<20}   {}\n", "", fmt::join(preset.values, " "));
    }
    return text + "\n";
}

nlohmann::ordered_json presetsJson() {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const SettingsPreset& preset : settingsPresets()) {
        Settings settings;
        applyPreset(settings, preset);
        nlohmann::ordered_json values = nlohmann::ordered_json::object();
        const nlohmann::json all = settingsJson(settings);
        for (const std::string_view value : preset.values) {
            const std::string key(value.substr(0, value.find('=')));
            values[key] = all[key];
        }
        list.push_back(
            {{"name", preset.name}, {"help", preset.help}, {"look", preset.look}, {"settings", values}});
    }
    return list;
}

nlohmann::ordered_json choicesJson(std::span<const NamedChoice> choices) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const NamedChoice& choice : choices)
        list.push_back(
            {{"name", choice.name}, {"help", choice.help}, {"default", choice.name == choices.front().name}});
    return list;
}

std::string_view settingTypeName(const SettingRow& row) {
    if (std::holds_alternative<bool Settings::*>(row.member)) return "bool";
    if (std::holds_alternative<int Settings::*>(row.member)) return "int";
    if (std::holds_alternative<double Settings::*>(row.member)) return "float";
    if (std::holds_alternative<AutoNumber Settings::*>(row.member)) return "float or auto";
    return "enum";
}

nlohmann::ordered_json settingRowsJson() {
    const nlohmann::json defaults = settingsJson(Settings{});
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const SettingRow& row : settingRows()) {
        nlohmann::ordered_json entry = {{"name", row.name},
                                        {"type", settingTypeName(row)},
                                        {"default", defaults[std::string(row.name)]},
                                        {"help", row.help}};
        if (row.expert) entry["expert"] = true;
        if (!row.unit.empty()) entry["unit"] = row.unit;
        if (std::isfinite(row.min)) entry["min"] = row.min;
        if (std::isfinite(row.max)) entry["max"] = row.max;
        if (const ChoiceMember* choice = std::get_if<ChoiceMember>(&row.member))
            for (const SettingWord& word : choice->words)
                entry["words"].push_back({{"word", word.word}, {"help", word.help}});
        list.push_back(std::move(entry));
    }
    return list;
}

// An unknown name is answered with the nearest one, and all of them beside it.
std::optional<Error> checkName(std::string_view kind, std::string_view name,
                               std::span<const std::string_view> names) {
    if (name.empty() || std::find(names.begin(), names.end(), name) != names.end()) return std::nullopt;
    const std::string_view nearest = nearestName(name, names);
    const std::string meant = nearest.empty() ? std::string() : fmt::format("did you mean '{}'? ", nearest);
    return Error{fmt::format("unknown {} '{}'; {}{}", kind, name, meant, namesHint(names))};
}

} // namespace

std::string listChoices(ListFormat format) {
    if (format == ListFormat::Text)
        return choicesText("Methods (--method)", Renderer::methods()) +
               choicesText("Views (--view)", Renderer::views()) + presetsText() +
               settingsText("Settings (--set key=value)", false) +
               settingsText("\nSettings for experts: numbers inside the method, best left as they are", true);
    nlohmann::ordered_json json;
    json["methods"] = choicesJson(Renderer::methods());
    json["views"] = choicesJson(Renderer::views());
    json["presets"] = presetsJson();
    json["settings"] = settingRowsJson();
    return json.dump(2) + "\n";
}

std::optional<Error> checkChoice(std::string_view kind, std::string_view name,
                                 std::span<const NamedChoice> choices) {
    std::vector<std::string_view> names;
    for (const NamedChoice& choice : choices)
        names.push_back(choice.name);
    return checkName(kind, name, names);
}

std::optional<Error> checkCamera(std::string_view name, const Scene& scene) {
    if (!name.empty() && scene.cameras.empty())
        return Error{fmt::format(
            "unknown camera '{}'; the scene has none, leave --camera out for one that shows all", name)};
    std::vector<std::string_view> names;
    for (const Camera& camera : scene.cameras)
        names.push_back(camera.name);
    return checkName("camera", name, names);
}

Result<PictureSize> parsePictureSize(std::string_view text) {
    PictureSize size;
    const char* const end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, size.width);
    const bool separated =
        width.ec == std::errc() && width.ptr != end && (*width.ptr == 'x' || *width.ptr == 'X');
    const auto height = separated ? std::from_chars(width.ptr + 1, end, size.height) : width;
    if (!separated || height.ec != std::errc() || height.ptr != end)
        return Error{fmt::format("--size '{}': expected WIDTHxHEIGHT in pixels, such as 960x540", text)};
    const auto inRange = [](int side) { return side >= 1 && side <= kMaxSidePx; };
    if (!inRange(size.width) || !inRange(size.height) || std::int64_t(size.width) * size.height > kMaxPixels)
        return Error{
            fmt::format("--size '{}': each side must be 1 to {} pixels, and the picture at most {} pixels",
                        text, kMaxSidePx, kMaxPixels)};
    return size;
}

std::optional<Error> applyPictureArguments(std::string_view size, std::string_view preset,
                                           std::span<const std::string> sets, RenderOptions& options) {
    const Result<PictureSize> parsed = parsePictureSize(size);
    if (!parsed) return Error{parsed.error()};
    options.width = parsed.value().width;
    options.height = parsed.value().height;
    if (auto error = checkChoice("method", options.method, Renderer::methods())) return error;
    if (!preset.empty())
        if (auto error = applyPreset(options.settings, preset)) return error;
    for (const std::string& set : sets)
        if (auto error = applySetting(options.settings, set)) return error;
    return std::nullopt;
}

} // namespace kilolux
