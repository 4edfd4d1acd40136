// Edits and the objects that they hold as JSON: for the journal, for copying lights as text, and for lists of
// edits (edits.md). Numbers come back exactly. What is read is checked for its form; whether it suits a
// document is told by applyEdits().
#pragma once

#include "renderer/document/edit.h"

#include <nlohmann/json.hpp>

namespace kilolux {

nlohmann::json toJson(const LightNode& light);
nlohmann::json toJson(const LightDef& def);
nlohmann::json toJson(const Node& node);
nlohmann::json toJson(const LightGroup& group);
nlohmann::json toJson(const Camera& camera);
nlohmann::json toJson(const Edit& edit);
nlohmann::json toJson(const Change& change);

// Errors say what was expected, without a place. Members that are absent keep the default.
std::optional<Error> fromJson(const nlohmann::json& json, LightNode& light);
std::optional<Error> fromJson(const nlohmann::json& json, LightDef& def);
std::optional<Error> fromJson(const nlohmann::json& json, Node& node);
std::optional<Error> fromJson(const nlohmann::json& json, LightGroup& group);
std::optional<Error> fromJson(const nlohmann::json& json, Camera& camera);
std::optional<Error> fromJson(const nlohmann::json& json, Edit& edit);
std::optional<Error> fromJson(const nlohmann::json& json, Change& change);

// A field's value: a number, true or false, text, three numbers, a word, an object of translation, rotation
// (x, y, z, w) and scale, 16 numbers by column, or null. `before` fills what a partial transform leaves out.
nlohmann::json valueToJson(const EditValue& value);
Result<EditValue> valueFromJson(const nlohmann::json& json, const EditField& field,
                                const EditValue& before = {});

} // namespace kilolux
