#include "renderer/probe.h"

#include <nlohmann/json.hpp>

namespace kilolux {

namespace {

using Json = nlohmann::ordered_json;

Json asJson(const glm::dvec3& v) {
    return Json::array({v.x, v.y, v.z});
}

Json asJson(const glm::ivec2& v) {
    return Json::array({v.x, v.y});
}

Json asJson(const ProbedLight& light) {
    Json json;
    json["id"] = light.id;
    json["slot"] = light.slot;
    json["name"] = light.name;
    json["type"] = light.type;
    json["reaches"] = light.reaches;
    json["inCell"] = light.inCell;
    json["listed"] = light.listed;
    json["fresh"] = light.fresh;
    json["candidate"] = light.candidate;
    json["list"] = light.list;
    json["areaMask"] = light.areaMask;
    json["unseenFrames"] = light.unseenFrames;
    json["weight"] = light.weight;
    json["probability"] = light.probability;
    json["chosen"] = light.chosen;
    json["chosenVisible"] = light.chosenVisible;
    json["visibility"] = light.visibility;
    json["energy"] = {{"irradianceLux", asJson(light.irradianceLux)},
                      {"reflectedNit", asJson(light.reflectedNit)},
                      {"lux", light.lux},
                      {"nit", light.nit},
                      {"share", light.share}};
    json["rays"] = Json::array();
    for (const ProbeRay& ray : light.rays)
        json["rays"].push_back({{"pointWs", asJson(ray.pointWs)}, {"visible", ray.visible}});
    return json;
}

} // namespace

Json probeJson(const Probe& probe) {
    Json json;
    json["pixel"] = asJson(probe.pixel);
    json["view"] = probe.view;
    json["viewValue"] = asJson(probe.viewValue);
    json["pictureNit"] = asJson(probe.pictureNit);
    json["exposureEv100"] = probe.exposureEv100;
    json["stops"] = probe.stops;
    json["surface"] = probe.surface;
    if (!probe.surface) return json;
    json["depthM"] = probe.depthM;
    json["positionWs"] = asJson(probe.positionWs);
    json["normalWs"] = asJson(probe.normalWs);
    json["geometricNormalWs"] = asJson(probe.geometricNormalWs);
    json["viewDirWs"] = asJson(probe.viewDirWs);
    json["node"] = probe.node;
    json["mesh"] = probe.mesh;
    json["instance"] = probe.instance;
    json["triangle"] = probe.triangle;
    json["material"] = {{"name", probe.material},
                        {"baseColor", asJson(probe.baseColor)},
                        {"roughness", probe.roughness},
                        {"metallic", probe.metallic}};
    json["illuminanceLux"] = probe.illuminanceLux;
    json["choice"] = {{"pixel", asJson(probe.choosing)},
                      {"hasTurn", probe.hasTurn},
                      {"missed", probe.missed},
                      {"candidates", probe.candidates},
                      {"cellLights", probe.cellLights},
                      {"stride", probe.stride},
                      {"listLights", probe.listLights},
                      {"listTile", asJson(probe.listTile)},
                      {"visibleWeight", probe.visibleWeight},
                      {"hiddenWeight", probe.hiddenWeight},
                      {"directionalWeight", probe.directionalWeight},
                      {"domeWeight", probe.domeWeight},
                      {"hiddenBudget", probe.hiddenBudget},
                      {"directionalBudget", probe.directionalBudget},
                      {"domeBudget", probe.domeBudget}};
    json["lightsInRange"] = probe.lightsInRange;
    json["lightsSeen"] = probe.lightsSeen;
    json["effectiveLights"] = probe.effectiveLights;
    json["lux"] = probe.lux;
    json["nit"] = probe.nit;
    json["lights"] = Json::array();
    for (const ProbedLight& light : probe.lights)
        json["lights"].push_back(asJson(light));
    return json;
}

} // namespace kilolux
