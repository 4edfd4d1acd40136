// Saving: what comes back when the file is opened again, and what stays byte for byte.
#include "renderer/document/edit_json.h"
#include "renderer/document/light_properties.h"
#include "tests/unit/edits/edits_kit.h"

namespace kilolux {
namespace {

using namespace test;

class SaveTest : public testing::Test {
  protected:
    void open(const GltfBuilder& builder, bool isBinary = false) {
        path_ = isBinary ? builder.writeBinary(folder_) : builder.write(folder_);
        original_ = readBytes(path_);
        session_ = openSession(path_);
    }
    void SetUp() override { open(everyLight()); }

    const Scene& scene() const { return session_->scene(); }
    void set(const char* light, const char* field, EditValue value, Sharing sharing = Sharing::MakeUnique) {
        auto edits = setField(scene(), EditTarget::Light, lightNamed(scene(), light), field, std::move(value),
                              sharing);
        ASSERT_TRUE(edits) << edits.error();
        apply(edits.value());
    }
    void apply(Edits edits) {
        const auto error = session_->apply("test", std::move(edits));
        ASSERT_FALSE(error) << error->message;
    }
    // Saves and opens what was saved.
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
    std::string original_;
    std::unique_ptr<EditSession> session_;
};

void expectSameLights(const Scene& a, const Scene& b) {
    ASSERT_EQ(a.lights.size(), b.lights.size());
    for (const LightNode& light : a.lights) {
        const std::string& name = a.nodes[light.node].name;
        const LightNode& other = b.lights[findLight(b, lightNamed(b, name))];
        EXPECT_EQ(light.muted, other.muted) << name;
        Json da = toJson(a.lightDefs[light.def]), db = toJson(b.lightDefs[other.def]);
        da.erase("pointer"), db.erase("pointer");
        const bool isDisk = da["type"] == "disk"; // has a width alone
        // What is left out is the default.
        for (const auto& [key, value] : db.items())
            EXPECT_TRUE(da.contains(key) || key == "widthM" || key == "heightM") << name << " " << key;
        for (const auto& [key, value] : da.items()) {
            if (isDisk && key == "heightM") continue;
            if (key == "widthM" || key == "heightM") {
                EXPECT_NEAR(value.get<double>(), db[key].get<double>(), 1e-12) << name << " " << key;
            } else {
                EXPECT_EQ(value, db[key]) << name << " " << key;
            }
        }
        for (int i = 0; i < 16; ++i)
            EXPECT_NEAR(a.nodes[light.node].worldFromNode[i / 4][i % 4],
                        b.nodes[other.node].worldFromNode[i / 4][i % 4], 1e-12)
                << name;
    }
}

bool hasField(LightType type, std::string_view name) {
    bool has = !(name.ends_with("ConeRad") && type != LightType::Spot) &&
               !(name.starts_with("barnDoor") && type != LightType::Rect);
    forEachLightProperty([&](const auto& each) {
        if (name == each.name) has = (each.types & typeBit(type)) != 0;
    });
    return has;
}

TEST_F(SaveTest, WithoutEditsEveryByteStays) {
    saved();
    EXPECT_EQ(readBytes(path_), original_);
    open(everyLight(), true);
    saved();
    EXPECT_EQ(readBytes(path_), original_);
}

// Each field of each light by itself: that comes back, and every other light is the same.
TEST_F(SaveTest, EveryFieldOfEveryLightComesBack) {
    std::mt19937 random(7);
    int count = 0;
    for (const bool isBinary : {false, true}) {
        for (const EditField& field : editFields()) {
            if ((field.target != EditTarget::Light && field.target != EditTarget::Definition) ||
                field.kind == FieldKind::DefIndex)
                continue;
            for (std::uint64_t id = 1; id <= 7; ++id) {
                open(everyLight(), isBinary);
                const bool isDef = field.target == EditTarget::Definition;
                const std::uint64_t own =
                    isDef ? std::uint64_t(scene().lights[findLight(scene(), id)].def) : id;
                auto edits = setField(scene(), EditTarget::Light, id, field,
                                      otherValue(field, field.get(scene(), own), random));
                ASSERT_TRUE(edits) << edits.error();
                if (session_->apply("x", edits.value())) continue;
                const Scene before = scene(), after = saved();
                // What a type does not have is not saved.
                const LightType type = before.lightDefs[before.lights[findLight(before, id)].def].type;
                if (!hasField(type, field.name)) continue;
                if (field.kind == FieldKind::Type) continue; // checked on saving; sizes of other types go
                SCOPED_TRACE(std::string(field.name) + " of light " + std::to_string(id));
                expectSameLights(before, after);
                ++count;
            }
        }
    }
    EXPECT_GT(count, 400);
}

TEST_F(SaveTest, UnknownPartsStay) {
    set("Spot", "intensity", 3.5, Sharing::EditAll);
    set("Tube", "color", glm::dvec3(1, 0.5, 0.25));
    saved();
    const Json before = Json::parse(original_);
    Json after = json();
    EXPECT_EQ(after["extensions"]["KHR_lights_punctual"]["lights"][2]["intensity"], 3.5);
    EXPECT_EQ(after["extensions"]["KHR_lights_punctual"]["lights"][3]["color"], Json({1, 0.5, 0.25}));
    after["extensions"]["KHR_lights_punctual"]["lights"][2]["intensity"] = 40.25;
    after["extensions"]["KHR_lights_punctual"]["lights"][3].erase("color");
    EXPECT_EQ(after, before);
}

TEST_F(SaveTest, OneOfTwoUsersGetsItsOwnDefinition) {
    set("Spot two", "intensity", 9.0);
    const Scene after = saved();
    EXPECT_EQ(defOf(after, "Spot").intensity, 40.25);
    EXPECT_EQ(defOf(after, "Spot two").intensity, 9.0);
    const Json lights = json()["extensions"]["KHR_lights_punctual"]["lights"];
    ASSERT_EQ(lights.size(), 5u);
    EXPECT_EQ(lights[4]["extensions"], lights[2]["extensions"])
        << "what the definition had stays with the copy";
}

TEST_F(SaveTest, UndoToTheStartAndRedoToTheEnd) {
    set("Point", "intensity", 12.5);
    set("Spot", "type", LightType::Rect);
    apply(addLight(scene(), session_->ids(), LightDef{}, Trs{{1, 2, 3}}, "new"));
    apply(duplicateLight(scene(), session_->ids(), lightNamed(scene(), "Rect")));
    apply(deleteLight(scene(), lightNamed(scene(), "Disk")));
    apply(deleteGroup(scene(), 2));
    saved();
    const std::string edited = readBytes(path_);
    EXPECT_NE(edited, original_);
    EXPECT_FALSE(session_->hasUnsavedChanges());
    while (session_->history().canUndo())
        ASSERT_FALSE(session_->undo());
    EXPECT_TRUE(session_->hasUnsavedChanges());
    saved();
    EXPECT_EQ(readBytes(path_), original_);
    while (session_->history().canRedo())
        ASSERT_FALSE(session_->redo());
    saved();
    EXPECT_EQ(readBytes(path_), edited);
}

TEST_F(SaveTest, AddedLightsOfEveryTypeComeBack) {
    int number = 0;
    for (const LightType type : {LightType::Directional, LightType::Sphere, LightType::Spot, LightType::Tube,
                                 LightType::Rect, LightType::Disk}) {
        LightDef def;
        def.type = type;
        def.unit = type == LightType::Directional ? LightUnit::Lux : LightUnit::Candela;
        def.intensity = 12.5 + number;
        def.color = {1, 0.5, 0.1};
        def.radiusM = type == LightType::Tube ? 0.1 : 0.0;
        def.innerConeRad = def.outerConeRad = 0.5; // which the validator wants apart
        apply(addLight(scene(), session_->ids(), def, Trs{{1, 2, 3}, {0.8, 0.6, 0, 0}, {1, 2, 3}},
                       "new " + std::to_string(number), number == 2 ? 0 : -1));
        ++number;
    }
    const Scene before = scene(), after = saved();
    ASSERT_EQ(after.lights.size(), 13u);
    for (const LightNode& light : after.lights) {
        const std::string& name = after.nodes[light.node].name;
        if (!name.starts_with("new")) continue;
        const LightDef &was = defOf(before, name), &is = after.lightDefs[light.def];
        EXPECT_EQ(is.type, was.type) << name;
        EXPECT_EQ(is.intensity, was.intensity) << name;
        EXPECT_EQ(is.unit, was.unit) << name;
        EXPECT_EQ(is.color, was.color) << name;
        EXPECT_EQ(is.radiusM, was.radiusM) << name;
        if (is.type == LightType::Rect) {
            EXPECT_NEAR(is.widthM * is.heightM, 1.0, 1e-12);
        }
    }
    EXPECT_EQ(after.nodes[std::as_const(after).lights[9].node].parent, 0);
}

TEST_F(SaveTest, DeletingTakesReferencesAndUnusedDefinitions) {
    for (const char* name : {"Sun", "Point", "Rect", "Disk"})
        apply(deleteLight(scene(), lightNamed(scene(), name)));
    const Scene after = saved();
    EXPECT_EQ(after.lights.size(), 3u);
    EXPECT_EQ(after.nodes.size(), scene().nodes.size()) << "nodes stay";
    EXPECT_EQ(defOf(after, "Spot two").intensity, 40.25);
    Json now = json();
    EXPECT_EQ(now["extensions"]["KHR_lights_punctual"]["lights"].size(), 2u);
    EXPECT_FALSE(now["extensions"].contains("EXT_lights_area"));
    EXPECT_EQ(now["extensionsUsed"], Json({"KHR_lights_punctual"}));
    for (const char* name : {"Spot", "Spot two", "Tube"})
        apply(deleteLight(scene(), lightNamed(scene(), name)));
    EXPECT_TRUE(saved().lights.empty());
    now = json();
    EXPECT_FALSE(now.contains("extensions"));
    EXPECT_FALSE(now.contains("extensionsUsed"));
    EXPECT_EQ(now["nodes"][5]["extras"]["kilolux"], Json({{"strange", 7}}))
        << "what is no light's property stays";
}

TEST_F(SaveTest, GroupsBookmarksAndExposure) {
    LightGroup group;
    group.name = "Rim";
    group.tint = {0.5, 1, 1};
    apply(addGroup(session_->ids(), group));
    const std::uint64_t rim = scene().groups.read().back().id;
    set("Rect", "group", rim);
    apply(setField(scene(), EditTarget::Group, 1, "name", std::string("Main")).value());
    Camera camera;
    camera.name = "Side";
    camera.worldFromCamera = matrixFrom({{5, 1, 0}, {0.8, 0, 0.6, 0}});
    apply(addBookmark(session_->ids(), camera));
    apply(setField(scene(), EditTarget::Scene, 0, "exposureEv100", EditValue()).value());
    const Scene after = saved();
    ASSERT_EQ(after.groups.size(), 3u);
    EXPECT_EQ(std::as_const(after).groups[0].name, "Main");
    EXPECT_EQ(std::as_const(after).groups[2].tint.x, 0.5);
    const auto groupOf = [&](const char* name) {
        return after.lights[findLight(after, lightNamed(after, name))].group;
    };
    EXPECT_EQ(groupOf("Rect"), 3u);
    EXPECT_EQ(groupOf("Tube"), 1u);
    EXPECT_EQ(groupOf("Sun"), 0u);
    EXPECT_FALSE(after.hasExposure);
    ASSERT_EQ(after.bookmarks.size(), 2u);
    EXPECT_EQ(after.bookmarks[0].name, "Front");
    EXPECT_EQ(after.bookmarks[0].yfovRad, 0.7);
    EXPECT_NEAR(after.bookmarks[1].worldFromCamera[2][0], 0.96, 1e-12);
    EXPECT_EQ(json()["scenes"][0]["extras"]["kilolux"]["groups"][0]["note"], "kept");
}

TEST_F(SaveTest, FilesWithoutLightsScenesOrNodes) {
    GltfBuilder empty;
    open(empty);
    LightDef def;
    apply(addLight(scene(), session_->ids(), def, Trs{}, "first"));
    apply(setField(scene(), EditTarget::Scene, 0, "exposureEv100", 3.0).value());
    const Scene after = saved();
    ASSERT_EQ(after.lights.size(), 1u);
    EXPECT_EQ(after.exposureEv100, 3.0);
    ASSERT_FALSE(session_->undo());
    ASSERT_FALSE(session_->undo());
    saved();
    EXPECT_EQ(readBytes(path_), original_);
}

TEST_F(SaveTest, LightsOfOtherScenesKeepTheirDefinition) {
    GltfBuilder builder;
    builder.addPunctualLight({{"type", "point"}, {"intensity", 4}}, {{"name", "here"}});
    builder.addLightNode(0, {{"name", "elsewhere"}});
    builder.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
    open(builder);
    set("here", "intensity", 8.0);
    EXPECT_EQ(defOf(saved(), "here").intensity, 8.0);
    const Json now = json();
    EXPECT_EQ(now["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"], 4);
    EXPECT_EQ(now["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"], 0);
}

TEST_F(SaveTest, BinaryPartStaysByteForByte) {
    open(everyLight(), true);
    const std::size_t jsonBytes = *reinterpret_cast<const std::uint32_t*>(original_.data() + 12);
    set("Sun", "name", std::string("Sun with a longer name"));
    saved();
    const std::string now = readBytes(path_);
    const std::size_t newJsonBytes = *reinterpret_cast<const std::uint32_t*>(now.data() + 12);
    EXPECT_EQ(now.substr(20 + newJsonBytes), original_.substr(20 + jsonBytes));
    EXPECT_EQ(*reinterpret_cast<const std::uint32_t*>(now.data() + 8), now.size());
    EXPECT_EQ(newJsonBytes % 4, 0u);
}

TEST_F(SaveTest, OtherProgramsChangesAreNotOverwrittenUnasked) {
    set("Sun", "muted", true);
    EXPECT_FALSE(session_->changedOnDisk());
    folder_.write("scene.gltf", original_ + " ");
    EXPECT_TRUE(session_->changedOnDisk());
    const auto error = session_->save();
    ASSERT_TRUE(error);
    EXPECT_NE(error->message.find("another program"), std::string::npos);
    EXPECT_EQ(readBytes(path_), original_ + " ");
    EXPECT_FALSE(session_->save(Overwriting::Anything));
    EXPECT_FALSE(session_->changedOnDisk());
}

TEST_F(SaveTest, SavingElsewhereTakesTheResourcesAlong) {
    set("Sun", "muted", true);
    std::filesystem::create_directory(folder_.path() / "there");
    const std::filesystem::path there = folder_.path() / "there" / "copy.gltf";
    const auto error = session_->saveAs(there);
    ASSERT_FALSE(error) << error->message;
    const auto scene = importGltf(there);
    ASSERT_TRUE(scene) << scene.error();
    EXPECT_EQ(triangleCount(scene.value()), 1u);
    EXPECT_EQ(session_->path(), there);
    EXPECT_EQ(readBytes(path_), original_);
    EXPECT_TRUE(session_->saveAs(folder_.path() / "x.glb")) << "another container";
    folder_.write("other/scene.bin", "something else");
    EXPECT_TRUE(session_->saveAs(folder_.path() / "other" / "copy.gltf")) << "would mean another file";
    EXPECT_EQ(readBytes(folder_.path() / "other" / "scene.bin"), "something else");
}

} // namespace
} // namespace kilolux
