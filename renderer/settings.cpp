// The settings table and everything that is derived from it: parsing, range checks, JSON and the hash.
#include "renderer/settings.h"

#include "renderer/nearest_name.h"
#include "renderer/settings_presets.h"

#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace kilolux {
namespace {

template<typename... F>
struct Overload : F... {
    using F::operator()...;
};
template<typename... F>
Overload(F...) -> Overload<F...>;

// ---------------------------------------------------------------------------------------------------------
// Reading values

Error unexpected(const SettingRow& row, std::string_view value) {
    std::string unit = row.unit.empty() ? "" : fmt::format(" {}", row.unit);
    return {fmt::format("setting '{}': '{}' is not {}{}", row.name, value, settingTypeText(row), unit)};
}

// A decimal number or a fraction such as 1/4; nothing else before or after it.
std::optional<double> parseNumber(std::string_view text) {
    const auto decimal = [](std::string_view t) -> std::optional<double> {
        double value = 0.0;
        const auto [end, failure] = std::from_chars(t.data(), t.data() + t.size(), value);
        if (failure != std::errc() || end != t.data() + t.size() || !std::isfinite(value))
            return std::nullopt;
        return value;
    };
    const std::size_t slash = text.find('/');
    if (slash == std::string_view::npos) return decimal(text);
    const std::optional<double> above = decimal(text.substr(0, slash));
    const std::optional<double> below = decimal(text.substr(slash + 1));
    if (!above || !below || *below == 0.0) return std::nullopt;
    return *above / *below;
}

std::optional<double> parseInRange(const SettingRow& row, std::string_view text) {
    const std::optional<double> value = parseNumber(text);
    if (!value || *value < row.min || *value > row.max) return std::nullopt;
    return value;
}

std::optional<bool> parseBool(std::string_view text) {
    if (text == "true" || text == "on" || text == "yes" || text == "1") return true;
    if (text == "false" || text == "off" || text == "no" || text == "0") return false;
    return std::nullopt;
}

// False when the text is not a value of the row's type and range.
bool setFromText(const SettingRow& row, Settings& settings, std::string_view text) {
    return std::visit(Overload{[&](bool Settings::*member) {
                                   const std::optional<bool> value = parseBool(text);
                                   if (value) settings.*member = *value;
                                   return value.has_value();
                               },
                               [&](int Settings::*member) {
                                   const std::optional<double> value = parseInRange(row, text);
                                   if (!value || *value != std::trunc(*value)) return false;
                                   settings.*member = static_cast<int>(*value);
                                   return true;
                               },
                               [&](double Settings::*member) {
                                   const std::optional<double> value = parseInRange(row, text);
                                   if (value) settings.*member = *value;
                                   return value.has_value();
                               },
                               [&](AutoNumber Settings::*member) {
                                   const std::optional<double> value = parseInRange(row, text);
                                   if (value) settings.*member = AutoNumber{false, *value};
                                   if (text == "auto") settings.*member = AutoNumber{};
                                   return value || text == "auto";
                               },
                               [&](const ChoiceMember& member) {
                                   for (const SettingWord& w : member.words) {
                                       if (w.word != text) continue;
                                       member.set(settings, w.value);
                                       return true;
                                   }
                                   return false;
                               }},
                      row.member);
}

std::string_view wordOf(const ChoiceMember& member, const Settings& settings) {
    for (const SettingWord& w : member.words)
        if (w.value == member.get(settings)) return w.word;
    return "?";
}

nlohmann::json valueJson(const SettingRow& row, const Settings& settings) {
    return std::visit(
        Overload{[&](AutoNumber Settings::*member) -> nlohmann::json {
                     const AutoNumber& number = settings.*member;
                     if (number.automatic) return "auto";
                     return number.value;
                 },
                 [&](const ChoiceMember& member) -> nlohmann::json { return wordOf(member, settings); },
                 [&](auto member) -> nlohmann::json { return settings.*member; }},
        row.member);
}

Error unknownSetting(std::string_view name) {
    std::vector<std::string_view> names;
    for (const SettingRow& row : settingRows())
        names.push_back(row.name);
    return {fmt::format("unknown setting '{}'; {}", name, nearestNameHint(name, names))};
}

} // namespace

const SettingRow* findSetting(std::string_view name) {
    for (const SettingRow& row : settingRows())
        if (row.name == name) return &row;
    return nullptr;
}

std::optional<Error> applySetting(Settings& settings, std::string_view keyValue) {
    const std::size_t equals = keyValue.find('=');
    if (equals == std::string_view::npos || equals == 0)
        return Error{fmt::format("setting '{}': expected key=value", keyValue)};
    if (keyValue.substr(0, equals) == "preset") return applyPreset(settings, keyValue.substr(equals + 1));
    const SettingRow* row = findSetting(keyValue.substr(0, equals));
    if (!row) return unknownSetting(keyValue.substr(0, equals));
    const std::string_view value = keyValue.substr(equals + 1);
    if (!setFromText(*row, settings, value)) return unexpected(*row, value);
    return std::nullopt;
}

std::optional<Error> applySettings(Settings& settings, const nlohmann::json& object) {
    if (!object.is_object()) return Error{"settings: expected an object of names and values"};
    Settings changed = settings;
    for (const auto& [name, value] : object.items()) {
        const SettingRow* row = findSetting(name);
        if (!row) return unknownSetting(name);
        const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
        if (!setFromText(*row, changed, text)) return unexpected(*row, text);
    }
    settings = changed;
    return std::nullopt;
}

std::string settingTypeText(const SettingRow& row) {
    const std::string range = fmt::format("{:g} to {:g}", row.min, row.max);
    return std::visit(Overload{[&](bool Settings::*) -> std::string { return "true|false"; },
                               [&](int Settings::*) { return "a whole number from " + range; },
                               [&](double Settings::*) { return "a number from " + range; },
                               [&](AutoNumber Settings::*) { return "auto or a number from " + range; },
                               [&](const ChoiceMember& member) {
                                   std::string words;
                                   for (const SettingWord& w : member.words)
                                       words += fmt::format("{}{}", words.empty() ? "" : "|", w.word);
                                   return words;
                               }},
                      row.member);
}

std::string settingValueText(const SettingRow& row, const Settings& settings) {
    const nlohmann::json value = valueJson(row, settings);
    return value.is_string() ? value.get<std::string>() : value.dump();
}

nlohmann::json settingsJson(const Settings& settings) {
    nlohmann::json object = nlohmann::json::object(); // keeps its keys sorted
    for (const SettingRow& row : settingRows())
        object[std::string(row.name)] = valueJson(row, settings);
    return object;
}

std::uint64_t settingsHash(const Settings& settings) {
    std::uint64_t hash = 0xcbf29ce484222325ull;
    for (const char c : settingsJson(settings).dump())
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
    return hash;
}

} // namespace kilolux
