// Edits against the document: every field there and back, objects that appear and disappear, garbage refused.
#include "renderer/document/edit_json.h"
#include "renderer/document/edit_rules.h"
#include "tests/unit/edits/edits_kit.h"

#include <limits>

namespace kilolux {
namespace {

using namespace test;

// Everything that edits can change, exactly.
std::string fingerprint(const Scene& scene) {
    Json json;
    for (const LightNode& light : scene.lights)
        json["lights"].push_back(toJson(light));
    for (const LightDef& def : scene.lightDefs)
        json["defs"].push_back(toJson(def));
    for (const Node& node : scene.nodes)
        json["nodes"].push_back(toJson(node));
    for (const LightGroup& group : scene.groups)
        json["groups"].push_back(toJson(group));
    for (const Camera& bookmark : scene.bookmarks)
        json["bookmarks"].push_back(toJson(bookmark));
    for (const EditField& field : editFields())
        if (field.target == EditTarget::Scene) json[field.name] = valueToJson(field.get(scene, 0));
    return json.dump();
}

std::vector<std::uint64_t> targetsOf(const Scene& scene, EditTarget target) {
    std::vector<std::uint64_t> ids;
    switch (target) {
    case EditTarget::Light:
    case EditTarget::Definition:
        for (const LightNode& light : scene.lights)
            ids.push_back(light.id);
        break;
    case EditTarget::Group:
        return {1, 2};
    case EditTarget::Bookmark:
        return {1};
    case EditTarget::Node:
    case EditTarget::Scene:
        return {0};
    }
    return ids;
}

TEST(Edits, EveryFieldThereAndBackAndForth) {
    const Scene start = everyLight().import();
    ASSERT_EQ(start.lights.size(), 7u);
    ASSERT_EQ(start.groups.size(), 2u);
    ASSERT_EQ(start.bookmarks.size(), 1u);
    std::mt19937 random(3);
    for (const EditField& field : editFields()) {
        const EditTarget target = field.target == EditTarget::Definition ? EditTarget::Light : field.target;
        int accepted = 0;
        for (const std::uint64_t id : targetsOf(start, field.target)) {
            Scene scene = start;
            const std::uint64_t own = field.target == EditTarget::Definition
                                          ? std::uint64_t(scene.lights.read()[findLight(scene, id)].def)
                                          : id;
            const EditValue value = otherValue(field, field.get(scene, own), random);
            const Result<Edits> edits = setField(scene, target, id, field, value);
            ASSERT_TRUE(edits) << field.name << ": " << edits.error();
            if (applyEdits(scene, edits.value())) continue; // does not suit this type of light
            ++accepted;
            const std::uint64_t now = field.target == EditTarget::Definition
                                          ? std::uint64_t(scene.lights.read()[findLight(scene, id)].def)
                                          : id;
            EXPECT_TRUE(sameValue(field.get(scene, now), value)) << field.name;
            const std::string after = fingerprint(scene);
            EXPECT_NE(after, fingerprint(start)) << field.name;
            ASSERT_FALSE(revertEdits(scene, edits.value())) << field.name;
            EXPECT_EQ(fingerprint(scene), fingerprint(start)) << field.name;
            ASSERT_FALSE(applyEdits(scene, edits.value())) << field.name;
            EXPECT_EQ(fingerprint(scene), after) << field.name;
        }
        EXPECT_GE(accepted, 1) << field.name;
    }
}

TEST(Edits, EveryEditComesBackFromJson) {
    const Scene start = everyLight().import();
    std::mt19937 random(5);
    for (const EditField& field : editFields()) {
        const std::uint64_t id = targetsOf(start, field.target).front();
        const std::uint64_t own = field.target == EditTarget::Definition ? 1 : id;
        const Edit edit{field.target, own, &field, field.get(start, own),
                        otherValue(field, field.get(start, own), random)};
        Edit back;
        const auto error = fromJson(Json::parse(toJson(edit).dump()), back);
        ASSERT_FALSE(error) << field.name << ": " << error->message;
        EXPECT_EQ(back.field, edit.field);
        EXPECT_EQ(back.id, edit.id);
        EXPECT_TRUE(sameValue(back.before, edit.before)) << field.name;
        EXPECT_TRUE(sameValue(back.after, edit.after)) << field.name;
    }
}

TEST(Edits, GarbageIsRefusedAndChangesNothing) {
    Scene scene = everyLight().import();
    const std::string before = fingerprint(scene);
    const double inf = std::numeric_limits<double>::infinity(), nan = std::nan("");
    Trs badTrs;
    badTrs.translation.x = nan;
    Trs flat;
    flat.rotation = glm::dquat(0, 0, 0, 0);
    const EditValue garbage[] = {nan,
                                 inf,
                                 -inf,
                                 -1e300,
                                 1e300,
                                 "\xFF\xFE",
                                 std::string(20000, 'a'),
                                 glm::dvec3(-1.0),
                                 glm::dvec3(nan),
                                 glm::dmat4(nan),
                                 glm::dmat4(0.0),
                                 badTrs,
                                 flat,
                                 std::uint64_t{999},
                                 Whole<LightNode>()};
    for (const EditField& field : editFields()) {
        const std::uint64_t id = targetsOf(scene, field.target).front();
        const std::uint64_t own = field.target == EditTarget::Definition ? 1 : id;
        for (const EditValue& value : garbage) {
            const Edit edit{field.target, own, &field, field.get(scene, own), value};
            const bool refused = applyEdits(scene, std::vector{edit}).has_value();
            EXPECT_TRUE(refused) << field.name << ", garbage " << &value - garbage;
        }
    }
    EXPECT_EQ(fingerprint(scene), before);
}

TEST(Edits, RulesOfTheWholeDefinition) {
    Scene scene = everyLight().import();
    const auto refusal = [&](const char* light, const char* field, EditValue value) {
        const auto edits =
            setField(scene, EditTarget::Light, lightNamed(scene, light), field, std::move(value));
        if (!edits) return edits.error();
        const auto error = applyEdits(scene, edits.value());
        return error ? error->message : std::string("taken");
    };
    EXPECT_NE(refusal("Spot", "innerConeRad", 0.6).find("expected up to outerConeRad 0.5"),
              std::string::npos);
    EXPECT_NE(refusal("Tube", "radiusM", 0.0).find("expected at least 0.001"), std::string::npos);
    EXPECT_NE(refusal("Point", "unit", LightUnit::Nit).find("type sphere"), std::string::npos);
    EXPECT_NE(refusal("Point", "intensity", -5.0).find("from 0 to"), std::string::npos);
    EXPECT_NE(refusal("Point", "nothing", 1.0).find("'nothing'"), std::string::npos);
    EXPECT_EQ(refusal("Spot", "outerConeRad", 0.2), "taken");
    EXPECT_EQ(defOf(scene, "Spot").innerConeRad, 0.2) << "the inner cone follows";
    EXPECT_EQ(refusal("Point", "type", LightType::Directional), "taken");
    EXPECT_EQ(defOf(scene, "Point").unit, LightUnit::Lux);
}

TEST(Edits, SharedDefinitionsBecomeUniqueUnlessAsked) {
    Scene scene = everyLight().import();
    const std::uint64_t spot = lightNamed(scene, "Spot");
    auto edits = setField(scene, EditTarget::Light, spot, "intensity", 7.0);
    ASSERT_TRUE(edits);
    Scene unique = scene;
    ASSERT_FALSE(applyEdits(unique, edits.value()));
    EXPECT_EQ(defOf(unique, "Spot").intensity, 7.0);
    EXPECT_EQ(defOf(unique, "Spot two").intensity, 40.25);
    edits = setField(scene, EditTarget::Light, spot, "intensity", 7.0, Sharing::EditAll);
    ASSERT_TRUE(edits);
    ASSERT_FALSE(applyEdits(scene, edits.value()));
    EXPECT_EQ(defOf(scene, "Spot two").intensity, 7.0);
}

TEST(Edits, AddingDuplicatingAndDeletingKeepIdentityThroughUndo) {
    Scene scene = everyLight().import();
    EditIds ids(scene);
    std::vector<Edits> done;
    std::vector<std::string> states{fingerprint(scene)};
    const auto step = [&](Edits edits) {
        ASSERT_FALSE(edits.empty());
        const auto error = applyEdits(scene, edits);
        ASSERT_FALSE(error) << error->message;
        done.push_back(std::move(edits));
        states.push_back(fingerprint(scene));
    };
    LightDef def;
    def.type = LightType::Rect;
    step(addLight(scene, ids, def, Trs{{1, 2, 3}}, "new", 0));
    step(duplicateLight(scene, ids, lightNamed(scene, "Spot")));
    step(deleteLight(scene, lightNamed(scene, "Point")));
    step(makeUnique(scene, lightNamed(scene, "Spot two")));
    LightGroup group;
    group.name = "Rim";
    step(addGroup(ids, group));
    step(setField(scene, EditTarget::Light, lightNamed(scene, "new"), "group", scene.groups.read().back().id)
             .value());
    step(deleteGroup(scene, scene.groups.read().back().id));
    step(addBookmark(ids, Camera{}));
    step(deleteBookmark(scene, 1));
    step(deleteLight(scene, lightNamed(scene, "new")));
    for (std::size_t i = done.size(); i-- > 0;) {
        ASSERT_FALSE(revertEdits(scene, done[i])) << i;
        EXPECT_EQ(fingerprint(scene), states[i]) << i;
    }
    for (std::size_t i = 0; i < done.size(); ++i) {
        ASSERT_FALSE(applyEdits(scene, done[i])) << i;
        EXPECT_EQ(fingerprint(scene), states[i + 1]) << i;
    }
}

TEST(Edits, NothingRefersToWhatIsGone) {
    Scene scene = everyLight().import();
    EditIds ids(scene);
    const Edits group = deleteGroup(scene, 1);
    EXPECT_TRUE(applyEdits(scene, std::vector{group.back()})) << "without taking its members out";
    LightGroup twin;
    twin.name = "Key";
    EXPECT_TRUE(applyEdits(scene, addGroup(ids, twin))) << "a name that is taken";
    Edits light = addLight(scene, ids, LightDef{}, Trs{}, "x");
    EXPECT_TRUE(applyEdits(scene, std::vector{light[2]})) << "a light without its node";
    // All or nothing: the last edit of three is bad.
    Edits broken = light;
    broken[2].id += 1;
    const std::string before = fingerprint(scene);
    EXPECT_TRUE(applyEdits(scene, broken));
    EXPECT_EQ(fingerprint(scene), before);
}

TEST(CopyOnWriteArrays, CopiesShareUntilOneIsWritten) {
    Scene scene = everyLight().import();
    const Scene copy = scene;
    EXPECT_TRUE(scene.lights.sharesWith(copy.lights));
    const auto edits = setField(scene, EditTarget::Light, 1, "muted", true);
    ASSERT_FALSE(applyEdits(scene, edits.value()));
    EXPECT_FALSE(scene.lights.sharesWith(copy.lights));
    EXPECT_TRUE(scene.lightDefs.sharesWith(copy.lightDefs));
    EXPECT_TRUE(scene.nodes.sharesWith(copy.nodes));
    EXPECT_FALSE(copy.lights[0].muted);
}

} // namespace
} // namespace kilolux
