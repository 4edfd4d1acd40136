// Lights of the glTF import: both extensions, shared definitions, and extras.kilolux
// (renderer/document/extras.md).
#include "renderer/document/light_units.h"
#include "tests/unit/document/gltf_builder.h"

#include <cmath>

namespace kilolux::test {
namespace {

constexpr double kPi = 3.14159265358979323846;

Json withExtras(const Json& extras) {
    return {{"extras", {{"kilolux", extras}}}};
}

const LightDef& defOf(const Scene& scene, std::size_t light = 0) {
    static const LightDef kNone;
    if (light >= scene.lights.size()) {
        ADD_FAILURE() << "no light " << light;
        return kNone;
    }
    return scene.lightDefs[scene.lights[light].def];
}

void addAreaLight(GltfBuilder& builder, const Json& light, const Json& node = Json::object()) {
    builder.json["extensionsUsed"] = {"EXT_lights_area"};
    builder.json["extensions"]["EXT_lights_area"]["lights"].push_back(light);
    Json carrier = node;
    carrier["extensions"]["EXT_lights_area"]["light"] =
        builder.json["extensions"]["EXT_lights_area"]["lights"].size() - 1;
    builder.addNode(carrier);
}

TEST(GltfLights, PunctualTypesUnitsAndDefaults) {
    GltfBuilder builder;
    builder.addPunctualLight({{"type", "point"}, {"intensity", 12}, {"range", 3}, {"name", "bulb"}});
    builder.addPunctualLight({{"type", "spot"}, {"spot", Json::object()}, {"color", {1, 0.5, 0}}});
    builder.addPunctualLight({{"type", "directional"}, {"intensity", 90000}});
    const Scene scene = builder.import();
    ASSERT_EQ(scene.lights.size(), 3u);
    EXPECT_EQ(defOf(scene, 0).type, LightType::Sphere);
    EXPECT_EQ(defOf(scene, 0).unit, LightUnit::Candela);
    EXPECT_EQ(defOf(scene, 0).intensity, 12.0);
    EXPECT_EQ(defOf(scene, 0).rangeM, 3.0);
    EXPECT_EQ(defOf(scene, 0).name, "bulb");
    EXPECT_EQ(defOf(scene, 0).radiusM, 0.0);
    EXPECT_EQ(defOf(scene, 0).pointer, "/extensions/KHR_lights_punctual/lights/0");
    EXPECT_EQ(defOf(scene, 1).type, LightType::Spot);
    EXPECT_EQ(defOf(scene, 1).intensity, 1.0);
    EXPECT_DOUBLE_EQ(defOf(scene, 1).outerConeRad, kPi / 4.0);
    EXPECT_EQ(defOf(scene, 1).color, glm::dvec3(1, 0.5, 0));
    EXPECT_EQ(defOf(scene, 2).type, LightType::Directional);
    EXPECT_EQ(defOf(scene, 2).unit, LightUnit::Lux);
}

TEST(GltfLights, DefinitionsAreSharedUnlessExtrasDiffer) {
    GltfBuilder builder;
    builder.addPunctualLight({{"type", "point"}});
    builder.addLightNode(0);
    builder.addLightNode(0, withExtras({{"radiusM", 0.1}}));
    builder.addLightNode(0, withExtras({{"radiusM", 0.1}, {"muted", true}}));
    builder.addLightNode(0, withExtras({{"radiusM", 0.2}}));
    const Scene scene = builder.import();
    ASSERT_EQ(scene.lights.size(), 5u);
    EXPECT_EQ(scene.lightDefs.size(), 3u);
    EXPECT_EQ(scene.lights[0].def, scene.lights[1].def);
    EXPECT_EQ(scene.lights[2].def, scene.lights[3].def);
    EXPECT_FALSE(scene.lights[2].muted);
    EXPECT_TRUE(scene.lights[3].muted);
    EXPECT_EQ(defOf(scene, 4).radiusM, 0.2);
}

TEST(GltfLights, AreaLightsTakeSizeFromTheNodesLargestScale) {
    GltfBuilder builder;
    addAreaLight(builder, {{"type", "rect"}, {"size", 2}, {"rect", {{"aspect", 1.5}}}, {"intensity", 500}},
                 {{"scale", {1, -3, 2}}});
    addAreaLight(builder, {{"type", "disk"}, {"size", 0.4}});
    addAreaLight(builder, {{"type", "disk"}, {"luminance", 70}});
    const Scene scene = builder.import();
    EXPECT_EQ(defOf(scene, 0).type, LightType::Rect);
    EXPECT_EQ(defOf(scene, 0).unit, LightUnit::Nit);
    EXPECT_NEAR(defOf(scene, 0).heightM, 6.0, 1e-12);
    EXPECT_NEAR(defOf(scene, 0).widthM, 9.0, 1e-12);
    EXPECT_EQ(defOf(scene, 0).intensity, 500.0);
    EXPECT_EQ(defOf(scene, 1).type, LightType::Disk);
    EXPECT_EQ(defOf(scene, 1).widthM, 0.4);
    EXPECT_EQ(defOf(scene, 1).intensity, 1000.0) << "the draft's default";
    EXPECT_EQ(defOf(scene, 2).intensity, 70.0) << "the older field name";
}

TEST(GltfLights, ExtrasSetEveryProperty) {
    GltfBuilder builder;
    builder.addPunctualLight({{"type", "point"}, {"intensity", 5}}, withExtras({{"type", "tube"},
                                                                                {"radiusM", 0.02},
                                                                                {"lengthM", 1.2},
                                                                                {"unit", "lm"},
                                                                                {"intensity", 3000},
                                                                                {"temperatureK", 4000},
                                                                                {"rayEndBiasM", 0.05}}));
    builder.addPunctualLight({{"type", "directional"}}, withExtras({{"angularDiameterRad", 0.0093}}));
    builder.addPunctualLight({{"type", "spot"}, {"spot", Json::object()}},
                             withExtras({{"type", "rect"},
                                         {"widthM", 0.6},
                                         {"heightM", 0.3},
                                         {"barnDoorAngleRad", 1.0},
                                         {"barnDoorLengthM", 0.2}}));
    const Scene scene = builder.import();
    EXPECT_EQ(defOf(scene, 0).type, LightType::Tube);
    EXPECT_EQ(defOf(scene, 0).lengthM, 1.2);
    EXPECT_EQ(defOf(scene, 0).unit, LightUnit::Lumen);
    EXPECT_EQ(defOf(scene, 0).intensity, 3000.0);
    EXPECT_EQ(defOf(scene, 0).temperatureK, 4000.0);
    EXPECT_EQ(defOf(scene, 0).rayEndBiasM, 0.05);
    EXPECT_EQ(defOf(scene, 1).angularDiameterRad, 0.0093);
    EXPECT_EQ(defOf(scene, 2).type, LightType::Rect);
    EXPECT_EQ(defOf(scene, 2).widthM, 0.6);
    for (const BarnDoor& door : defOf(scene, 2).barnDoors)
        EXPECT_EQ(door, (BarnDoor{1.0, 0.2})) << "one pair is for all four";
    EXPECT_TRUE(scene.warnings.size() == 1) << "only the missing triangles";
}

TEST(GltfLights, AUnitAloneConvertsTheExtensionsIntensity) {
    GltfBuilder builder;
    builder.addPunctualLight({{"type", "point"}, {"intensity", 10}}, withExtras({{"unit", "lm"}}));
    const Scene scene = builder.import();
    EXPECT_EQ(defOf(scene).unit, LightUnit::Lumen);
    EXPECT_NEAR(defOf(scene).intensity, 40.0 * kPi, 1e-9);
    EXPECT_NEAR(baseIntensity(defOf(scene)), 10.0, 1e-12);
}

TEST(GltfLights, AUnitThatMeansNothingFallsBackWithAWarning) {
    GltfBuilder builder;
    builder.addPunctualLight({{"type", "directional"}, {"intensity", 7}}, withExtras({{"unit", "lm"}}));
    builder.addPunctualLight({{"type", "point"}, {"intensity", 7}}, withExtras({{"unit", "nit"}}));
    const Scene scene = builder.import();
    EXPECT_EQ(defOf(scene, 0).unit, LightUnit::Lux);
    EXPECT_EQ(defOf(scene, 0).intensity, 7.0);
    EXPECT_EQ(defOf(scene, 1).unit, LightUnit::Candela);
    EXPECT_EQ(defOf(scene, 1).intensity, 7.0);
    EXPECT_TRUE(hasWarning(scene, "/nodes/1/extras/kilolux"));
}

TEST(GltfLights, BrokenValuesAreReplacedWithAWarningThatNamesThem) {
    GltfBuilder builder;
    builder.addPunctualLight({{"type", "point"}, {"intensity", -5}, {"color", {1, 2}}, {"range", 0}});
    builder.addPunctualLight(
        {{"type", "spot"}, {"spot", {{"innerConeAngle", 1.2}, {"outerConeAngle", 0.5}}}});
    builder.addPunctualLight({{"type", "laser"}});
    builder.addLightNode(17);
    const Scene scene = builder.import();
    ASSERT_EQ(scene.lights.size(), 2u);
    EXPECT_EQ(defOf(scene, 0).intensity, 0.0);
    EXPECT_EQ(defOf(scene, 0).color, glm::dvec3(1.0));
    EXPECT_FALSE(defOf(scene, 0).rangeM);
    EXPECT_EQ(defOf(scene, 1).innerConeRad, 0.5);
    const std::string root = "/extensions/KHR_lights_punctual/lights/";
    for (const std::string& place :
         {root + "0/intensity", root + "0/color", root + "0/range", root + "1/spot", root + "2/type",
          std::string("/nodes/3/extensions/KHR_lights_punctual/light")}) {
        EXPECT_TRUE(hasWarning(scene, place)) << place;
    }
}

// Numbers stay as they are, since the exporter's mode stands nowhere; what can only be watts is told.
TEST(GltfLights, WattsOfOlderBlenderExportersAreTold) {
    for (const auto& [version, isWatts] :
         {std::pair{"v1.2.75", true}, {"v3.5.30", true}, {"v3.6.27", false}, {"v4.0.44", false}}) {
        GltfBuilder builder;
        builder.json["asset"]["generator"] = std::string("Khronos glTF Blender I/O ") + version;
        builder.addPunctualLight({{"type", "point"}, {"intensity", 54.35}});
        const Scene scene = builder.import();
        EXPECT_EQ(defOf(scene).intensity, 54.35);
        EXPECT_EQ(hasWarning(scene, "/asset/generator"), isWatts) << version;
    }
    GltfBuilder sun;
    sun.json["asset"]["generator"] = "Khronos glTF Blender I/O v1.2.75";
    sun.addPunctualLight({{"type", "directional"}});
    EXPECT_FALSE(hasWarning(sun.import(), "/asset/generator"));
}

TEST(GltfLights, OneNodeCarriesOneLight) {
    GltfBuilder builder;
    builder.addPunctualLight({{"type", "point"}});
    builder.json["extensions"]["EXT_lights_area"]["lights"] = {{{"type", "rect"}}};
    builder.json["nodes"][0]["extensions"]["EXT_lights_area"]["light"] = 0;
    const Scene scene = builder.import();
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(defOf(scene).type, LightType::Rect);
}

TEST(GltfLights, LightsOutsideTheDefaultSceneAreNotLit) {
    GltfBuilder builder;
    builder.addPunctualLight({{"type", "point"}});
    builder.addLightNode(0);
    builder.json["scenes"] = {{{"nodes", {1}}, {"extras", {{"kilolux", {{"exposureEv100", 9.5}}}}}}};
    const Scene scene = builder.import();
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].node, 1);
    EXPECT_TRUE(scene.hasExposure);
    EXPECT_EQ(scene.exposureEv100, 9.5);
}

} // namespace
} // namespace kilolux::test
