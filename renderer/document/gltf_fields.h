// Reads properties of one JSON object that the schema does not cover (extensions of lights, extras.kilolux):
// what is wrong is reported under the object's place and counts as absent. Internal to renderer/document.
#pragma once

#include "renderer/document/gltf_context.h"

namespace kilolux::gltf {

// The largest length or intensity that a file may hold.
inline constexpr double kHuge = 1e18;

class Fields {
  public:
    Fields(ImportContext& context, const Json& object, std::string place)
        : context_(context), object_(object), place_(std::move(place)) {}

    const std::string& place() const { return place_; }
    const Json* find(const char* key) const;

    // False if absent or not a number; a number out of range is moved to its nearest bound.
    bool number(const char* key, double min, double max, double& target) const;
    bool flag(const char* key, bool& target) const;
    // False if absent or not an array of numbers of the target's length.
    bool numbers(const char* key, std::span<double> target) const;
    bool text(const char* key, std::string& target) const;

    // The entry of `names` that the property names.
    template<typename Named, std::size_t N>
    const Named* name(const char* key, const Named (&names)[N]) const {
        const Json* value = find(key);
        if (!value) return nullptr;
        std::string expected;
        for (const Named& each : names) {
            if (value->is_string() && value->get_ref<const std::string&>() == each.name) return &each;
            expected += (expected.empty() ? "" : ", ") + std::string(each.name);
        }
        context_.warn(place_ + "/" + key, "expected one of {}; ignored", expected);
        return nullptr;
    }

  private:
    ImportContext& context_;
    const Json& object_;
    std::string place_;
};

// The member of that name if it is an object.
const Json* findObject(const Json& parent, const char* key);

// What the object has under `extensions` and this name.
const Json* findExtension(const Json& parent, const char* name);

// The index of the scene that is shown, -1 in a file without scenes.
int defaultScene(const Json& document);

} // namespace kilolux::gltf
