#include "renderer/document/gltf_save.h"

#include "renderer/document/file_hash.h"
#include "renderer/document/file_replace.h"
#include "renderer/document/gltf_save_context.h"
#include "renderer/document/json_rewrite.h"
#include "renderer/document/light_properties.h"

#include <algorithm>
#include <cmath>

namespace kilolux {

namespace {

using gltf::fail;
using gltf::Json;

// Sizes pass through the node's scale and come back with its rounding; everything else comes back exactly.
bool near(double a, double b) {
    return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b));
}

bool sameLight(const LightDef& a, const LightDef& b) {
    bool same = a.name == b.name && a.type == b.type && a.intensity == b.intensity && a.unit == b.unit &&
                a.color == b.color;
    if (a.type == LightType::Spot)
        same = same && near(a.innerConeRad, b.innerConeRad) && a.outerConeRad == b.outerConeRad;
    forEachLightProperty([&](const auto& each) {
        if (!(each.types & typeBit(a.type))) return;
        const auto &x = each.access(a), &y = each.access(b);
        if constexpr (std::is_same_v<std::decay_t<decltype(x)>, double>) {
            same = same && near(x, y);
        } else {
            same = same && x == y;
        }
    });
    return same;
}

bool sameDome(const Dome& a, const Dome& b) {
    return a.imageUri == b.imageUri && a.color == b.color && a.intensityNit == b.intensityNit &&
           a.rotationRad == b.rotationRad && a.visible == b.visible && a.fillColor == b.fillColor &&
           a.fillNit == b.fillNit;
}

std::string groupName(const Scene& scene, const LightNode& light) {
    for (const LightGroup& group : scene.groups)
        if (group.id == light.group) return group.name;
    return "";
}

// Imports the lights of the text that is about to be saved.
Scene readBack(const gltf::SaveContext& context, const SourceFile& source, const std::string& text) {
    gltf::ImportContext reading;
    reading.path = source.path.parent_path() / "text.gltf"; // the JSON alone, of a .glb as well
    reading.fileBytes = text.size();
    gltf::parseDocument(reading, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    gltf::checkSchema(reading);
    const auto nodes = reading.json.find("nodes");
    reading.scene.nodes.resize(nodes == reading.json.end() ? 0 : nodes->size());
    for (std::size_t i = 0; i < context.nodeIndices.size(); ++i) {
        if (context.nodeIndices[i] >= 0) reading.scene.nodes[context.nodeIndices[i]] = context.scene.nodes[i];
    }
    reading.scene.files = context.scene.files; // what has been read of them
    gltf::importSceneExtras(reading);
    gltf::importLights(reading);
    return std::move(reading.scene);
}

void checkReadBack(const gltf::SaveContext& context, const Scene& saved) {
    const Scene& scene = context.scene;
    if (saved.lights.size() != scene.lights.size())
        fail("lights", "expected to save {}, the file would have {}", scene.lights.size(),
             saved.lights.size());
    std::unordered_map<int, const LightNode*> savedLights;
    for (const LightNode& light : saved.lights.read())
        savedLights[light.node] = &light;
    for (const LightNode& light : scene.lights) {
        const auto found = savedLights.find(context.nodeIndices[light.node]);
        const bool same =
            found != savedLights.end() && found->second->muted == light.muted &&
            groupName(saved, *found->second) == groupName(scene, light) &&
            sameLight(scene.lightDefs[light.def], std::as_const(saved).lightDefs[found->second->def]);
        if (!same) {
            fail(fmt::format("light '{}'", scene.nodes[light.node].name),
                 "expected to be saved as it is, the file would open with another one");
        }
    }
    if (saved.groups.size() != scene.groups.size() || saved.bookmarks.size() != scene.bookmarks.size() ||
        saved.hasExposure != scene.hasExposure ||
        (scene.hasExposure && saved.exposureEv100 != scene.exposureEv100) ||
        !sameDome(saved.dome, scene.dome))
        fail("scene", "expected groups, bookmarks, exposure and dome to be saved as they are");
}

SavePlan makePlan(const SourceFile& source, const Scene& opened, const Scene& scene) {
    const Json before = Json::parse(source.jsonText);
    Json after = before;
    gltf::SaveContext context{opened, scene, before, after};
    gltf::saveNodes(context);
    gltf::saveLights(context);
    gltf::saveSceneExtras(context);
    SavePlan plan;
    plan.jsonText = before == after ? source.jsonText : rewriteJson(source.jsonText, before, after);
    checkReadBack(context, readBack(context, source, plan.jsonText));
    plan.nodeIndices = std::move(context.nodeIndices);
    plan.defPointers = std::move(context.defPointers);
    return plan;
}

} // namespace

namespace gltf {

Json& memberObject(Json& parent, const char* key, std::string_view place) {
    Json& member = parent[key];
    if (member.is_null()) member = Json::object();
    if (!member.is_object()) fail(place, "expected an object under '{}'", key);
    return member;
}

Json& kiloluxExtras(Json& owner) {
    Json& extras = owner["extras"];
    if (extras.is_null()) extras = Json::object();
    if (!extras.is_object()) extras = {{"value", extras}};
    Json& ours = extras["kilolux"];
    if (!ours.is_object()) ours = Json::object();
    return ours;
}

const Json* findKiloluxExtras(const Json& owner) {
    const Json* extras = findObject(owner, "extras");
    return extras ? findObject(*extras, "kilolux") : nullptr;
}

void dropEmptyExtras(Json& owner) {
    const Json* ours = findKiloluxExtras(owner);
    if (!ours || !ours->empty()) return;
    owner["extras"].erase("kilolux");
    if (owner["extras"].empty()) owner.erase("extras");
}

Json colorJson(const glm::dvec3& color) {
    return Json::array({color.r, color.g, color.b});
}

} // namespace gltf

Result<SavePlan> planSave(const SourceFile& source, const Scene& opened, const Scene& scene) {
    const std::string name = gltf::printable(source.path.string());
    try {
        return makePlan(source, opened, scene);
    } catch (const gltf::ImportFailure& failure) {
        return Error{name + ": cannot be saved: " + failure.text};
    } catch (const Json::exception& error) {
        return Error{fmt::format("{}: cannot be saved: {}", name, gltf::printable(error.what()))};
    }
}

} // namespace kilolux
