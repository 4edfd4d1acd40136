// Reads members of a JSON object by their kind and remembers the first that is wrong. Internal to
// renderer/document.
#pragma once

#include "renderer/document/light_words.h"
#include "renderer/document/result.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace kilolux {

inline nlohmann::json numbersJson(const double* values, int count) {
    nlohmann::json array = nlohmann::json::array();
    for (int i = 0; i < count; ++i)
        array.push_back(values[i]);
    return array;
}

inline bool readNumbers(const nlohmann::json& json, double* values, std::size_t count) {
    const bool good =
        json.is_array() && json.size() == count &&
        std::all_of(json.begin(), json.end(), [](const nlohmann::json& e) { return e.is_number(); });
    for (std::size_t i = 0; good && i < count; ++i)
        values[i] = json[i].get<double>();
    return good;
}

class Members {
  public:
    explicit Members(const nlohmann::json& json) : json_(json) {
        if (!json.is_object()) wrong_ = "expected an object";
    }

    void read(const char* key, bool& target) {
        if (const nlohmann::json* value = find(key))
            check(key, value->is_boolean(), "true or false", target, *value);
    }
    void read(const char* key, double& target) {
        if (const nlohmann::json* value = find(key))
            check(key, value->is_number(), "a number", target, *value);
    }
    void read(const char* key, int& target) {
        const nlohmann::json* value = find(key);
        if (!value) return;
        const bool good = value->is_number_integer() && value->get<std::int64_t>() >= -1 &&
                          value->get<std::int64_t>() < INT32_MAX;
        check(key, good, "an index", target, *value);
    }
    void read(const char* key, std::uint64_t& target) {
        if (const nlohmann::json* value = find(key))
            check(key, value->is_number_unsigned(), "an id", target, *value);
    }
    void read(const char* key, std::string& target) {
        if (const nlohmann::json* value = find(key)) check(key, value->is_string(), "text", target, *value);
    }
    void read(const char* key, std::optional<double>& target) {
        const nlohmann::json* value = find(key);
        if (!value || value->is_null()) return;
        double number = 0.0;
        read(key, number);
        target = number;
    }
    void read(const char* key, glm::dvec3& target) { readArray(key, &target.x, 3); }
    void read(const char* key, glm::dmat4& target) { readArray(key, &target[0][0], 16); }
    void read(const char* key, Trs& target) {
        const nlohmann::json* value = find(key);
        if (!value) return;
        Members parts(*value);
        double rotation[4] = {target.rotation.x, target.rotation.y, target.rotation.z, target.rotation.w};
        parts.read("translation", target.translation);
        parts.readArray("rotation", rotation, 4);
        parts.read("scale", target.scale);
        target.rotation = glm::dquat(rotation[3], rotation[0], rotation[1], rotation[2]);
        if (!parts.wrong_.empty() && wrong_.empty()) wrong_ = std::string(key) + "/" + parts.wrong_;
    }
    void read(const char* key, LightType& target) {
        readWord(key, kLightTypeWords, &LightTypeWord::type, target);
    }
    void read(const char* key, LightUnit& target) {
        readWord(key, kLightUnitWords, &LightUnitWord::unit, target);
    }
    void read(const char* key, IesUse& target) { readWord(key, kIesUseWords, &IesUseWord::use, target); }
    void read(const char* key, LightFunctionKind& target) {
        readWord(key, kLightFunctionWords, &LightFunctionWord::kind, target);
    }
    void read(const char* key, std::uint8_t& target) {
        const nlohmann::json* value = find(key);
        if (value)
            check(key, value->is_number_unsigned() && *value <= 255, "a number from 0 to 255", target,
                  *value);
    }

    const nlohmann::json* find(const char* key) const {
        if (!json_.is_object()) return nullptr;
        const auto it = json_.find(key);
        return it == json_.end() ? nullptr : &*it;
    }
    void fail(const std::string& message) {
        if (wrong_.empty()) wrong_ = message;
    }
    std::optional<Error> error() const {
        return wrong_.empty() ? std::nullopt : std::optional<Error>(Error{wrong_});
    }

  private:
    template<typename T>
    void check(const char* key, bool good, const char* what, T& target, const nlohmann::json& value) {
        if (good) {
            target = value.get<T>();
        } else {
            fail(fmt::format("{}: expected {}", key, what));
        }
    }
    void readArray(const char* key, double* target, std::size_t count) {
        const nlohmann::json* value = find(key);
        if (value && !readNumbers(*value, target, count))
            fail(fmt::format("{}: expected {} numbers", key, count));
    }
    template<typename Word, std::size_t N, typename T>
    void readWord(const char* key, const Word (&words)[N], T Word::*member, T& target) {
        const nlohmann::json* value = find(key);
        if (!value) return;
        std::string known;
        for (const Word& word : words) {
            if (value->is_string() && value->get_ref<const std::string&>() == word.name) {
                target = word.*member;
                return;
            }
            known += (known.empty() ? "" : ", ") + std::string(word.name);
        }
        fail(fmt::format("{}: expected one of {}", key, known));
    }

    const nlohmann::json& json_;
    std::string wrong_;
};

} // namespace kilolux
