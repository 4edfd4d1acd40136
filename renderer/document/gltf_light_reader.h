// A light definition from the JSON of KHR_lights_punctual, EXT_lights_ies or the draft EXT_lights_area, and
// what extras.kilolux adds to it (extras.md). Saving reads its own work back with this. Internal to
// renderer/document.
#pragma once

#include "renderer/document/gltf_fields.h"

namespace kilolux::gltf {

enum class LightExtension : std::uint8_t { Punctual, Area, Ies };
inline constexpr LightExtension kLightExtensions[] = {LightExtension::Punctual, LightExtension::Area,
                                                      LightExtension::Ies};

constexpr const char* nameOf(LightExtension extension) {
    if (extension == LightExtension::Ies) return "EXT_lights_ies";
    return extension == LightExtension::Area ? "EXT_lights_area" : "KHR_lights_punctual";
}

class LightReader {
  public:
    explicit LightReader(ImportContext& context) : context_(context) {}

    // The definition as the extension says it; nothing where it cannot be used. `use` is the extension's
    // object on the node. An area light's size follows the largest scale of its
    // node in the world.
    std::optional<LightDef> read(LightExtension extension, const Json& light, const std::string& pointer,
                                 const Fields& use, double nodeScale);

    // What the node's extras.kilolux changes.
    void applyExtras(const Fields& extras, LightDef& def);

    // Fills in what the definition's URIs name, with a warning where that cannot be.
    void loadFiles(LightDef& def, const std::string& place);

  private:
    std::optional<LightDef> readPunctual(const Json& light, const std::string& pointer);
    std::optional<LightDef> readArea(const Json& light, const std::string& pointer, double nodeScale);
    std::optional<LightDef> readIes(const Json& light, const std::string& pointer, const Fields& use);
    void readCommon(const Fields& fields, LightDef& def);
    void readColor(const Fields& fields, LightDef& def);
    void readSpot(const Fields& fields, LightDef& def);
    void applyIntensity(const Fields& extras, const LightDef& before, LightDef& def);

    ImportContext& context_;
};

// What names a profile of EXT_lights_ies in LightDef::iesUri: its own URI, or '#/bufferViews/N'. Empty where
// it has none.
std::string profileUri(const Json& light);

double largestScale(const glm::dmat4& worldFromNode);

} // namespace kilolux::gltf
