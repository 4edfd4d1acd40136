// Round trips of everything that shapes light: random scenes with profiles, doors, pictures, masks, channels
// and a dome, saved and opened again; and what edits of them refuse.
#include "renderer/document/edit_script.h"
#include "renderer/document/light_properties.h"
#include "renderer/document/light_units.h"
#include "renderer/document/scene_files.h"
#include "tests/unit/edits/edits_kit.h"

#include <limits>

namespace kilolux {
namespace {

using namespace test;

const char* const kProfileText =
    "IESNA:LM-63-1995\nTILT=NONE\n1 500 1 3 1 1 2 0 0 0\n1 1 20\n0 45 90\n0\n90 60 0\n";

std::string pictureBytes() {
    const Result<std::shared_ptr<const Image>> tiny = SceneFiles("").image(kPictureUri);
    EXPECT_TRUE(tiny);
    // The bytes behind the data URI, by the reader's own way.
    std::string out;
    int bits = 0, count = 0;
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (const char c : kPictureUri.substr(kPictureUri.find(',') + 1)) {
        if (c == '=') break;
        bits = bits << 6 | int(kDigits.find(c)), count += 6;
        if (count >= 8) out += char(bits >> (count -= 8) & 0xff);
    }
    return out;
}

// Every light of the kit, one from EXT_lights_ies by URI and one by buffer view, and the files.
GltfBuilder shapedLights() {
    GltfBuilder builder = everyLight();
    const std::string text = kProfileText;
    const int view = builder.addView(std::vector<char>(text.begin(), text.end()));
    builder.json["extensionsUsed"].push_back("EXT_lights_ies");
    builder.json["extensions"]["EXT_lights_ies"]["lights"] = {
        {{"uri", "profiles/a%20b.ies"}, {"name", "down"}, {"extras", {{"kept", 1}}}},
        {{"bufferView", view}, {"mimeType", "application/x-ies-lm-63"}}};
    builder.addNode({{"name", "Ies"},
                     {"extensions", {{"EXT_lights_ies", {{"light", 0}, {"multiplier", 0.5}, {"x", "y"}}}}}});
    builder.addNode({{"name", "Ies two"}, {"extensions", {{"EXT_lights_ies", {{"light", 0}}}}}});
    builder.addNode(
        {{"name", "Embedded"}, {"extensions", {{"EXT_lights_ies", {{"light", 1}, {"color", {1, 0.5, 0}}}}}}});
    Json& nodes = builder.json["scenes"][0]["nodes"];
    for (int i = 0; i < 3; ++i)
        nodes.push_back(builder.json["nodes"].size() - 3 + std::size_t(i));
    return builder;
}

class ShapingSave : public testing::Test {
  protected:
    void SetUp() override {
        folder_.write("profiles/a b.ies", kProfileText);
        folder_.write("picture.png", pictureBytes());
    }
    void open(const GltfBuilder& builder = shapedLights(), bool isBinary = false) {
        path_ = isBinary ? builder.writeBinary(folder_) : builder.write(folder_);
        session_ = openSession(path_);
    }
    const Scene& scene() const { return session_->scene(); }
    std::string tried(const char* light, const char* field, EditValue value) {
        auto edits =
            setField(scene(), EditTarget::Light, lightNamed(scene(), light), field, std::move(value));
        if (!edits) return edits.error();
        const auto error = session_->apply("test", edits.value());
        return error ? error->message : "";
    }
    void set(const char* light, const char* field, EditValue value) {
        ASSERT_EQ(tried(light, field, std::move(value)), "") << light << " " << field;
    }
    Scene saved() {
        const auto error = session_->save();
        EXPECT_FALSE(error) << error->message;
        auto scene = importGltf(path_);
        EXPECT_TRUE(scene) << scene.error();
        return scene ? scene.value() : Scene{};
    }
    Json json() const { return Json::parse(readBytes(path_)); }

    TempFolder folder_;
    std::filesystem::path path_;
    std::unique_ptr<EditSession> session_;
};

TEST_F(ShapingSave, ProfilesOfTheExtensionAreRead) {
    open();
    EXPECT_TRUE(scene().warnings.empty()) << scene().warnings.front();
    const LightDef &down = defOf(scene(), "Ies"), &embedded = defOf(scene(), "Embedded");
    EXPECT_EQ(down.type, LightType::Sphere);
    EXPECT_EQ(down.iesUse, IesUse::Shape);
    EXPECT_EQ(down.iesUri, "profiles/a%20b.ies");
    ASSERT_TRUE(down.ies && embedded.ies);
    EXPECT_EQ(baseIntensity(down), 45.0) << "90 cd at the profile's maximum, times the multiplier";
    EXPECT_EQ(baseIntensity(defOf(scene(), "Ies two")), 90.0);
    EXPECT_EQ(defOf(scene(), "Ies two").ies, down.ies) << "one profile, shared";
    EXPECT_EQ(embedded.iesUri.substr(0, 14), "#/bufferViews/");
    EXPECT_EQ(embedded.color, glm::dvec3(1, 0.5, 0));
    EXPECT_EQ(down.name, "down");
}

// Many edits of random fields, saved and opened: everything comes back, in both containers.
TEST_F(ShapingSave, RandomScenesComeBack) {
    std::mt19937 random(11);
    std::size_t changes = 0;
    for (int round = 0; round < 12; ++round) {
        open(shapedLights(), round % 2 == 1);
        for (int step = 0; step < 40; ++step) {
            const auto fields = editFields();
            const EditField& field = fields[random() % fields.size()];
            EditTarget target = field.target == EditTarget::Definition ? EditTarget::Light : field.target;
            if (field.kind == FieldKind::DefIndex || target == EditTarget::Bookmark) continue;
            std::uint64_t id = 0;
            if (target == EditTarget::Light) id = scene().lights[random() % scene().lights.size()].id;
            if (target == EditTarget::Group) id = 1 + random() % 2;
            if (target == EditTarget::Node) id = random() % scene().nodes.size();
            const bool isDef = field.target == EditTarget::Definition;
            const std::uint64_t own = isDef ? std::uint64_t(scene().lights[findLight(scene(), id)].def) : id;
            auto edits =
                setField(scene(), target, id, field, otherValue(field, field.get(scene(), own), random));
            ASSERT_TRUE(edits) << edits.error();
            if (!session_->apply("x", edits.value())) ++changes;
        }
        const Scene before = scene();
        saved();
        const std::unique_ptr<EditSession> again = openSession(path_);
        ASSERT_TRUE(again);
        ASSERT_EQ(again->scene().lights.size(), before.lights.size());
        for (std::size_t i = 0; i < before.lights.size(); ++i) {
            const LightDef &was = before.lightDefs[before.lights[i].def],
                           &is = again->scene().lightDefs[again->scene().lights[i].def];
            SCOPED_TRACE("light " + std::to_string(i) + " of round " + std::to_string(round));
            EXPECT_EQ(is.type, was.type);
            EXPECT_EQ(is.intensity, was.intensity);
            EXPECT_EQ(is.unit, was.unit);
            EXPECT_EQ(is.color, was.color);
            EXPECT_EQ(is.ies != nullptr, was.ies != nullptr && was.type != LightType::Directional);
            forEachLightProperty([&](const auto& each) {
                if (!(each.types & typeBit(was.type))) return;
                if constexpr (std::is_same_v<std::decay_t<decltype(each.access(was))>, double>) {
                    EXPECT_NEAR(each.access(is), each.access(was), 1e-12 * std::abs(each.access(was)))
                        << each.name;
                } else {
                    EXPECT_TRUE(each.access(is) == each.access(was)) << each.name;
                }
            });
        }
        for (std::size_t i = 0; i < before.nodes.size(); ++i)
            EXPECT_EQ(again->scene().nodes[i].meshChannels, before.nodes[i].meshChannels);
        for (const EditField& field : editFields())
            if (field.target == EditTarget::Scene) {
                EXPECT_TRUE(sameValue(field.get(again->scene(), 0), field.get(before, 0))) << field.name;
            }
        // Saved once more, nothing changes.
        const std::string bytes = readBytes(path_);
        ASSERT_FALSE(again->save());
        EXPECT_EQ(readBytes(path_), bytes);
        while (session_->history().canUndo())
            ASSERT_FALSE(session_->undo());
    }
    EXPECT_GT(changes, 300u);
}

TEST_F(ShapingSave, UnknownPartsOfProfileLightsStay) {
    open();
    const Json before = json();
    set("Ies", "iesMultiplier", 2.0);
    set("Embedded", "radiusM", 0.1);
    saved();
    Json after = json();
    EXPECT_EQ(after["extensions"], before["extensions"]);
    const std::size_t first = before["nodes"].size() - 3;
    EXPECT_EQ(after["nodes"][first]["extensions"]["EXT_lights_ies"],
              Json({{"light", 0}, {"multiplier", 2.0}, {"x", "y"}}));
    EXPECT_EQ(after["nodes"][first + 2]["extras"]["kilolux"], Json({{"radiusM", 0.1}}));
    // Another profile for one of two that share it: the file's entry stays, a second one is made.
    set("Ies", "iesProfile", kProfileUri);
    saved();
    after = json();
    EXPECT_EQ(after["extensions"]["EXT_lights_ies"]["lights"].size(), 3u);
    EXPECT_EQ(after["extensions"]["EXT_lights_ies"]["lights"][0]["extras"], Json({{"kept", 1}}));
    EXPECT_EQ(after["nodes"][first + 1]["extensions"]["EXT_lights_ies"]["light"], 0);
}

TEST_F(ShapingSave, LightsMoveBetweenExtensionsWithTheirProfile) {
    open();
    set("Point", "iesProfile", std::string("profiles/a%20b.ies"));
    EXPECT_EQ(defOf(scene(), "Point").iesUse, IesUse::Shape);
    EXPECT_EQ(baseIntensity(defOf(scene(), "Point")), 90.0);
    Scene after = saved();
    Json node = json()["nodes"][2];
    EXPECT_TRUE(node["extensions"].contains("EXT_lights_ies")) << node;
    EXPECT_FALSE(node["extensions"].contains("KHR_lights_punctual"));
    EXPECT_EQ(*defOf(after, "Point").rangeM, 5.5) << "which the extension does not have";
    // As a mask on its own shape it is a point again, that other readers know.
    set("Point", "iesUse", std::string("mask"));
    after = saved();
    node = json()["nodes"][2];
    EXPECT_TRUE(node["extensions"].contains("KHR_lights_punctual"));
    EXPECT_EQ(node["extras"]["kilolux"]["iesUse"], "mask");
    EXPECT_EQ(defOf(after, "Point").ies->maxCandela(), 90.0);
    // On a spot the profile stands beside the cone.
    set("Spot", "iesProfile", std::string("profiles/a%20b.ies"));
    after = saved();
    EXPECT_EQ(defOf(after, "Spot").type, LightType::Spot);
    EXPECT_EQ(baseIntensity(defOf(after, "Spot")), 90.0);
}

TEST_F(ShapingSave, OnePairOfDoorsOrFour) {
    open();
    set("Rect", "barnDoorAngleRad", 0.5);
    set("Rect", "barnDoorLengthM", 0.25);
    saved();
    const auto extras = [&] { return json()["nodes"][6]["extras"]["kilolux"]; };
    EXPECT_EQ(extras(), Json({{"barnDoorAngleRad", 0.5}, {"barnDoorLengthM", 0.25}}));
    set("Rect", "barnDoorTopLengthM", 0.0);
    set("Rect", "barnDoorLeftAngleRad", 1.0);
    const Scene after = saved();
    EXPECT_EQ(extras(), Json({{"barnDoorLeftAngleRad", 1.0},
                              {"barnDoorLeftLengthM", 0.25},
                              {"barnDoorRightAngleRad", 0.5},
                              {"barnDoorRightLengthM", 0.25},
                              {"barnDoorTopAngleRad", 0.5},
                              {"barnDoorBottomAngleRad", 0.5},
                              {"barnDoorBottomLengthM", 0.25}}));
    const auto& doors = defOf(after, "Rect").barnDoors;
    EXPECT_EQ(doors[0], (BarnDoor{1.0, 0.25}));
    EXPECT_EQ(doors[1], (BarnDoor{0.5, 0.25}));
    EXPECT_EQ(doors[2], (BarnDoor{0.5, 0.0}));
    set("Rect", "barnDoorAngleRad", 0.75);
    set("Rect", "barnDoorLengthM", 0.1);
    saved();
    EXPECT_EQ(extras(), Json({{"barnDoorAngleRad", 0.75}, {"barnDoorLengthM", 0.1}}));
}

// Relative photometry: what was typed is held while the profile only says where the light goes. Absolute: the
// profile's candela times the multiplier, whatever was typed.
TEST_F(ShapingSave, TypedIntensityIsHeldUnderAnotherProfile) {
    open();
    set("Point", "unit", LightUnit::Lumen);
    set("Point", "intensity", 800.0);
    set("Point", "iesProfile", kProfileUri);
    EXPECT_EQ(baseIntensity(defOf(scene(), "Point")), 200.0);
    set("Point", "iesMultiplier", 0.25);
    EXPECT_EQ(baseIntensity(defOf(scene(), "Point")), 50.0);
    const double flux = fluxLumen(defOf(scene(), "Point"));
    set("Point", "iesIntensity", false);
    EXPECT_NEAR(defOf(scene(), "Point").intensity, flux, 1e-9) << "as bright as it was, in its own unit";
    set("Point", "intensity", 1000.0);
    for (const std::string& profile : {kProfileUri, std::string("profiles/a%20b.ies")}) {
        set("Point", "iesProfile", profile);
        EXPECT_EQ(defOf(scene(), "Point").intensity, 1000.0);
        EXPECT_NEAR(fluxLumen(defOf(scene(), "Point")), 1000.0, 1e-9) << "lumens of the whole profile";
    }
    set("Point", "iesUse", std::string("mask"));
    EXPECT_NEAR(baseIntensity(defOf(scene(), "Point")), 1000.0 / (4.0 * properties::kPi), 1e-9)
        << "a mask takes light away";
    EXPECT_EQ(saved().lights.size(), 10u);
}

TEST_F(ShapingSave, WhatIsMissingOrBadIsToldOnceAndTheLightStays) {
    GltfBuilder builder = shapedLights();
    folder_.write("bad.ies", "IESNA:LM-63-1995\nTILT=NONE\n1 500 1 x 1 1 2 0 0 0\n");
    Json& lights = builder.json["extensions"]["EXT_lights_ies"]["lights"];
    lights[0]["uri"] = "profiles/none.ies";
    builder.json["nodes"][2]["extras"]["kilolux"] = {
        {"iesProfile", "bad.ies"}, {"iesUse", "mask"}, {"lightFunctionImage", "../outside.png"}};
    builder.json["nodes"][3]["extras"]["kilolux"] = {
        {"iesProfile", "/etc/passwd"}, {"channels", 1e300}, {"lightFunctionScale", -1e308}};
    builder.json["nodes"][6]["extras"]["kilolux"] = {{"sourceTexture", "#/images/7"}, {"penumbraScale", "x"}};
    open(builder);
    ASSERT_EQ(scene().lights.size(), 10u);
    const auto told = [&](std::string_view text) {
        return std::count_if(scene().warnings.begin(), scene().warnings.end(),
                             [&](const std::string& warning) {
                                 return warning.find(text) != std::string::npos &&
                                        warning.find("expected") != std::string::npos;
                             });
    };
    EXPECT_EQ(told("profiles/none.ies"), 1) << "two lights have it";
    EXPECT_EQ(told("/nodes/2/extras/kilolux: iesProfile: 'bad.ies':3"), 1);
    EXPECT_EQ(told("../outside.png"), 1);
    EXPECT_EQ(told("/etc/passwd"), 1);
    EXPECT_EQ(told("#/images/7"), 1);
    EXPECT_EQ(told("/nodes/6/extras/kilolux/penumbraScale"), 1);
    EXPECT_EQ(told("/nodes/3/extras/kilolux/channels"), 1);
    EXPECT_EQ(defOf(scene(), "Spot").function.scale, 1e-4);
    EXPECT_EQ(baseIntensity(defOf(scene(), "Ies")), 1.0) << "without its profile as typed";
    // And saving keeps the names.
    set("Point", "iesMultiplier", 3.0);
    saved();
    EXPECT_EQ(json()["nodes"][2]["extras"]["kilolux"]["iesProfile"], "bad.ies");
    EXPECT_EQ(json()["nodes"][2]["extras"]["kilolux"]["lightFunctionImage"], "../outside.png");
}

TEST_F(ShapingSave, EditsRefuseWhatCannotBe) {
    open();
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 inf = std::numeric_limits<double>::infinity();
    const auto refused = [&](const char* light, const char* field, EditValue value, std::string_view words) {
        const std::string message = tried(light, field, std::move(value));
        EXPECT_NE(message.find(words), std::string::npos) << field << ": " << message;
    };
    refused("Rect", "barnDoorTopAngleRad", nan, "expected a number from 0");
    refused("Rect", "barnDoorAngleRad", 1.6, "expected a number from 0");
    refused("Point", "iesMultiplier", inf, "expected a number from 0");
    refused("Point", "lightFunctionSoftness", 1.1, "expected a number from 0 to 1");
    refused("Point", "iesUse", std::string("both"), "expected one of none, shape, mask");
    refused("Point", "iesProfile", std::string("profiles/none.ies"), "expected");
    refused("Point", "iesProfile", std::string("../a.ies"), "within the folder");
    refused("Rect", "sourceTexture", std::string("http://x/y.png"), "within the folder");
    refused("Rect", "sourceTexture", std::string("profiles/a b.ies"), "expected");
    refused("Point", "channels", std::uint64_t{256}, "expected a number of bits");
}

TEST_F(ShapingSave, SavingElsewhereTakesProfilesAndPicturesAlong) {
    open();
    set("Rect", "sourceTexture", std::string("picture.png"));
    ASSERT_TRUE(defOf(scene(), "Rect").sourceImage);
    EXPECT_EQ(defOf(scene(), "Rect").sourceImage->width, 1);
    std::filesystem::create_directory(folder_.path() / "there");
    const auto error = session_->saveAs(folder_.path() / "there" / "copy.gltf");
    ASSERT_FALSE(error) << error->message;
    const auto copy = importGltf(folder_.path() / "there" / "copy.gltf");
    ASSERT_TRUE(copy) << copy.error();
    EXPECT_TRUE(copy.value().warnings.empty());
    EXPECT_TRUE(defOf(copy.value(), "Rect").sourceImage && defOf(copy.value(), "Ies").ies);
}

TEST_F(ShapingSave, ListsOfEditsReachEveryShaping) {
    open();
    const auto error = runEditScript(*session_, Json::parse(R"([
        {"light": "Rect", "set": {"barnDoorLengthM": 0.2, "barnDoorLeftLengthM": 0.4, "sourceTexture": "picture.png"}},
        {"light": "Spot", "all": true, "set": {"lightFunction": "blinds", "lightFunctionAngleRad": 0.5}},
        {"light": "Tube", "set": {"iesProfile": "profiles/a b.ies", "iesUse": "mask", "channels": 6}},
        {"node": "floor", "set": {"meshChannels": 2}},
        {"set": {"domeNit": 100, "domeColor": [0.2, 0.3, 0.5], "fillNit": 3}}])"));
    ASSERT_FALSE(error) << error->message;
    const Scene after = saved();
    EXPECT_EQ(defOf(after, "Rect").barnDoors[0].lengthM, 0.4);
    EXPECT_EQ(defOf(after, "Rect").barnDoors[3].lengthM, 0.2);
    EXPECT_EQ(defOf(after, "Spot").function.kind, LightFunctionKind::Blinds);
    EXPECT_EQ(defOf(after, "Tube").iesUse, IesUse::Mask);
    EXPECT_EQ(defOf(after, "Tube").channels, 6);
    EXPECT_EQ(after.nodes[0].meshChannels, 2);
    EXPECT_EQ(after.dome.intensityNit, 100.0);
    EXPECT_EQ(after.dome.color, glm::dvec3(0.2, 0.3, 0.5));
    EXPECT_EQ(after.dome.fillNit, 3.0);
}

} // namespace
} // namespace kilolux
