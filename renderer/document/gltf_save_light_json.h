// The JSON of one light: its definition in an extension, and what a node's extras.kilolux must add so that
// reading both gives the light again. Internal to renderer/document.
#pragma once

#include "renderer/document/gltf_save_context.h"

namespace kilolux::gltf {

// The extension that can hold a light by itself, and whether it is a profile's light: its distribution with
// its candela.
LightExtension extensionFor(const LightDef& def);
bool emitsAsProfile(const LightDef& def);

// Changes what EXT_lights_ies says on the node where reading it gave `native`.
void fitUse(Json& use, const LightDef& native, const LightDef& def);

// `json`, the definition `before` as the file has it (an empty object for a new one), changed where `def`
// differs from `before`. `nodeScale` is what reading will multiply an area light's size with.
Json definitionJson(LightExtension extension, Json json, const LightDef* before, const LightDef& def,
                    double nodeScale);

// Changes the properties of a node's extras.kilolux where reading would not give `def`; `native` is the
// definition as the extension alone says it. `extras` is an object, possibly empty.
void fitExtras(ImportContext& context, Json& extras, const LightDef& native, const LightDef& def);

// Removes what extras.md lists for nodes with a light.
void eraseLightExtras(Json& extras);

} // namespace kilolux::gltf
