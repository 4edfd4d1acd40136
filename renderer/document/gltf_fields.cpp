#include "renderer/document/gltf_fields.h"

#include <algorithm>

namespace kilolux::gltf {

const Json* Fields::find(const char* key) const {
    const auto it = object_.find(key);
    return it == object_.end() ? nullptr : &*it;
}

bool Fields::number(const char* key, double min, double max, double& target) const {
    const Json* value = find(key);
    if (!value) return false;
    if (!value->is_number()) {
        context_.warn(place_ + "/" + key, "expected a number; ignored");
        return false;
    }
    const double typed = value->get<double>();
    target = std::clamp(typed, min, max);
    if (target != typed) {
        context_.warn(place_ + "/" + key, "expected a number from {} to {}, found {}; {} is used", min, max,
                      typed, target);
    }
    return true;
}

bool Fields::flag(const char* key, bool& target) const {
    const Json* value = find(key);
    if (!value) return false;
    if (!value->is_boolean()) {
        context_.warn(place_ + "/" + key, "expected true or false; ignored");
        return false;
    }
    target = value->get<bool>();
    return true;
}

bool Fields::numbers(const char* key, std::span<double> target) const {
    const Json* value = find(key);
    if (!value) return false;
    const bool good = value->is_array() && value->size() == target.size() &&
                      std::all_of(value->begin(), value->end(), [](const Json& e) { return e.is_number(); });
    if (!good) {
        context_.warn(place_ + "/" + key, "expected an array of {} numbers; ignored", target.size());
        return false;
    }
    for (std::size_t i = 0; i < target.size(); ++i)
        target[i] = std::clamp((*value)[i].get<double>(), -kHuge, kHuge);
    return true;
}

bool Fields::text(const char* key, std::string& target) const {
    const Json* value = find(key);
    if (!value) return false;
    if (!value->is_string()) {
        context_.warn(place_ + "/" + key, "expected a string; ignored");
        return false;
    }
    target = value->get<std::string>();
    return true;
}

const Json* findObject(const Json& parent, const char* key) {
    const auto it = parent.find(key);
    return it == parent.end() || !it->is_object() ? nullptr : &*it;
}

const Json* findExtension(const Json& parent, const char* name) {
    const Json* extensions = findObject(parent, "extensions");
    return extensions ? findObject(*extensions, name) : nullptr;
}

int defaultScene(const Json& document) {
    const auto scenes = document.find("scenes");
    if (scenes == document.end() || scenes->empty()) return -1;
    return document.value("scene", 0);
}

} // namespace kilolux::gltf
