// Editing several lights at once: typed and dragged values, shared definitions, places, groups, and lights as
// text.
#include "renderer/document/light_words.h"
#include "tests/unit/edits/edits_kit.h"
#include "ui/light_actions.h"
#include "ui/light_fields.h"
#include "ui/light_place.h"

namespace kilolux {
namespace {

using test::defOf;
using test::lightNamed;
using Ids = std::vector<std::uint64_t>;

class LightEdits : public ::testing::Test {
  protected:
    void SetUp() override {
        session_ = test::openSession(test::everyLight().writeBinary(folder_));
        ASSERT_TRUE(session_);
    }
    const Scene& scene() const { return session_->scene(); }
    std::uint64_t id(const char* name) const { return lightNamed(scene(), name); }
    Ids ids(std::initializer_list<const char*> names) const {
        Ids result;
        for (const char* name : names)
            result.push_back(id(name));
        std::sort(result.begin(), result.end());
        return result;
    }
    // The message when it was refused.
    std::string apply(const Result<Edits>& edits) {
        if (!edits) return edits.error();
        const std::optional<Error> error = session_->apply("Test", edits.value());
        return error ? error->message : "";
    }
    const LightField& field(const char* label) const {
        for (const LightField& each : lightFields())
            if (std::string_view(each.label) == label) return each;
        ADD_FAILURE() << label;
        return lightFields()[0];
    }
    std::string type(const Ids& lights, const char* label, const char* text,
                     Sharing sharing = Sharing::MakeUnique) {
        const LightField& row = field(label);
        const Result<ValueEntry> entry = parseEntry(text, row.quantity);
        if (!entry) return entry.error();
        return apply(editsForEntry(scene(), scene(), lights, row, entry.value(), sharing));
    }

    test::TempFolder folder_;
    std::unique_ptr<EditSession> session_;
};

TEST_F(LightEdits, EveryFieldOfTheDefinitionHasARow) {
    for (const EditField& each : editFields()) {
        if (each.target != EditTarget::Definition || each.kind == FieldKind::Text ||
            each.kind == FieldKind::Type || each.kind == FieldKind::Unit || each.kind == FieldKind::Color)
            continue;
        const auto rows = lightFields();
        EXPECT_TRUE(std::any_of(rows.begin(), rows.end(), [&](const LightField& row) {
            return std::string_view(row.field) == each.name;
        })) << each.name;
    }
}

TEST_F(LightEdits, TypingSetsAndArithmeticChangesEach) {
    const Ids two = ids({"Point", "Tube"});
    EXPECT_EQ(type(two, "Intensity", "800 lm"), "");
    EXPECT_EQ(defOf(scene(), "Point").intensity, 800.0);
    EXPECT_EQ(defOf(scene(), "Tube").unit, LightUnit::Lumen);
    EXPECT_EQ(type(ids({"Tube"}), "Intensity", "*2"), "");
    EXPECT_EQ(defOf(scene(), "Tube").intensity, 1600.0);
    EXPECT_TRUE(commonValue(scene(), two, "intensity").mixed);
    EXPECT_FALSE(commonValue(scene(), two, "unit").mixed);
    EXPECT_EQ(type(two, "Intensity", "+10 %"), "");
    EXPECT_NEAR(defOf(scene(), "Point").intensity, 880.0, 1e-9);
    EXPECT_NEAR(defOf(scene(), "Tube").intensity, 1760.0, 1e-9);
    EXPECT_EQ(type(two, "Temperature", "2700"), "");
    EXPECT_EQ(type(two, "Temperature", "none"), "");
    EXPECT_FALSE(defOf(scene(), "Tube").temperatureK);
}

TEST_F(LightEdits, WhatDoesNotFitIsRefusedWhole) {
    const Ids two = ids({"Sun", "Point"});
    const double before = defOf(scene(), "Point").intensity;
    EXPECT_NE(type(two, "Intensity", "5 lm").find("light 'Sun'"), std::string::npos);
    EXPECT_EQ(defOf(scene(), "Point").intensity, before);
    EXPECT_NE(type(ids({"Point"}), "Source radius", "-1"), "");
    EXPECT_NE(type(ids({"Point"}), "Source radius", "none"), "");
    EXPECT_NE(type(ids({"Point"}), "Temperature", "*2"), ""); // has none
    EXPECT_NE(type(ids({"Spot"}), "Inner cone", "80"), "");   // wider than the outer one
    EXPECT_EQ(session_->history().steps(), 0u);
}

TEST_F(LightEdits, DraggingClampsAndStartsFromTheBeginning) {
    const Scene start = scene();
    const Ids spot = ids({"Spot"});
    for (const double offset : {0.1, 0.3, 5.0}) {
        const ValueEntry entry{ValueEntry::How::Add, offset, {}};
        EXPECT_EQ(apply(editsForEntry(scene(), start, spot, field("Inner cone"), entry, Sharing::MakeUnique,
                                      OutOfRange::Clamp)),
                  "");
    }
    EXPECT_EQ(defOf(scene(), "Spot").innerConeRad, defOf(scene(), "Spot").outerConeRad);
    const ValueEntry little{ValueEntry::How::Add, 0.01, {}};
    EXPECT_EQ(apply(editsForEntry(scene(), start, spot, field("Inner cone"), little, Sharing::MakeUnique,
                                  OutOfRange::Clamp)),
              "");
    EXPECT_NEAR(defOf(scene(), "Spot").innerConeRad, 0.26, 1e-12);
}

TEST_F(LightEdits, SharedDefinitions) {
    EXPECT_EQ(othersSharing(scene(), ids({"Spot"})), 1);
    EXPECT_EQ(othersSharing(scene(), ids({"Spot", "Spot two"})), 0);
    // All that share it are selected: it stays one, and is changed once.
    EXPECT_EQ(type(ids({"Spot", "Spot two"}), "Intensity", "*2"), "");
    EXPECT_EQ(defOf(scene(), "Spot two").intensity, 80.5);
    EXPECT_EQ(othersSharing(scene(), ids({"Spot"})), 1);
    EXPECT_EQ(type(ids({"Spot"}), "Intensity", "*2", Sharing::EditAll), "");
    EXPECT_EQ(defOf(scene(), "Spot two").intensity, 161.0);
    EXPECT_EQ(type(ids({"Spot"}), "Intensity", "7"), "");
    EXPECT_EQ(defOf(scene(), "Spot").intensity, 7.0);
    EXPECT_EQ(defOf(scene(), "Spot two").intensity, 161.0);
}

TEST_F(LightEdits, PlacesAreTypedInTheWorld) {
    EXPECT_EQ(apply(editsForPosition(scene(), scene(), ids({"Point", "Rect"}), 1,
                                     parseEntry("2.3", Quantity::Length).value())),
              "");
    EXPECT_EQ(positionOf(scene(), id("Point")), glm::dvec3(1, 2.3, 3)); // to the last digit
    EXPECT_EQ(positionOf(scene(), id("Rect")), glm::dvec3(0, 2.3, 0));
    const ValueEntry angle = parseEntry("30", Quantity::Angle).value();
    EXPECT_EQ(apply(editsForAngle(scene(), scene(), ids({"Spot two"}), 0, angle, glm::dvec3(0.0))), "");
    const glm::dvec3 euler = eulerFrom(rotationOf(scene(), id("Spot two")));
    EXPECT_NEAR(euler.x, glm::radians(30.0), 1e-9);
    EXPECT_NEAR(euler.y, 2.0 * std::asin(0.6), 1e-9);
}

TEST(Euler, EveryRotationComesBack) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(-3.0, 3.0);
    for (int i = 0; i < 2000; ++i) {
        glm::dvec3 angles(uniform(random), uniform(random), uniform(random));
        if (i % 10 == 0) angles.y = i % 20 == 0 ? glm::half_pi<double>() : -glm::half_pi<double>();
        const glm::dquat rotation = quatFrom(angles);
        // The poles are ill-conditioned: there the angles of one rotation differ, its effect does not.
        EXPECT_LT(glm::distance(angles, eulerFrom(rotation, angles)), i % 10 == 0 ? 1e-4 : 1e-6) << i;
        const glm::dquat back = quatFrom(eulerFrom(rotation));
        EXPECT_GT(std::abs(glm::dot(rotation, back)), 1.0 - 1e-9) << i;
    }
}

TEST_F(LightEdits, MotionsReachLightsBelowTurnedParents) {
    test::GltfBuilder builder = test::everyLight();
    const int child = builder.addLightNode(0, {{"name", "Child"}, {"translation", {0, 0, 1}}});
    const int arm = builder.addNode({{"name", "Arm"},
                                     {"translation", {5, 0, 0}},
                                     {"rotation", {0, 0.7071067811865476, 0, 0.7071067811865476}},
                                     {"scale", {2, 2, 2}},
                                     {"children", {child}}});
    builder.json["scenes"][0]["nodes"].push_back(arm);
    session_ = test::openSession(builder.writeBinary(folder_));
    ASSERT_TRUE(session_);
    const glm::dvec3 before = positionOf(scene(), id("Child"));
    const glm::dvec3 dirBefore = -axesOf(scene(), id("Child"))[2];
    RigidMotion motion;
    motion.rotation = glm::angleAxis(0.5, glm::dvec3(0, 0, 1));
    motion.translationWs = {0.25, -1, 3};
    const Scene start = scene();
    for (int step = 0; step < 2; ++step) // from the start each time
        EXPECT_EQ(apply(editsForMotion(scene(), start, ids({"Child", "Point"}), motion)), "");
    EXPECT_LT(
        glm::distance(positionOf(scene(), id("Child")), motion.rotation * before + motion.translationWs),
        1e-6);
    EXPECT_LT(glm::distance(-axesOf(scene(), id("Child"))[2], motion.rotation * dirBefore), 1e-6);
    EXPECT_LT(glm::distance(positionOf(scene(), id("Point")),
                            motion.rotation * glm::dvec3(1, 2, 3) + motion.translationWs),
              1e-12);
}

TEST_F(LightEdits, AddingDuplicatingMutingDeletingUndo) {
    const std::size_t lights = scene().lights.size();
    for (const auto& word : kLightTypeWords) {
        const LightPlace place{{0, 3, 0}, glm::normalize(glm::dvec3(0, -1, 0.2))};
        const Edits edits = addLightAt(scene(), session_->ids(), word.type, place);
        ASSERT_EQ(apply(edits), "") << word.name;
        const Ids made = newLights(edits);
        ASSERT_EQ(made.size(), 1u);
        EXPECT_LT(glm::distance(-axesOf(scene(), made[0])[2], place.dirWs), 1e-9) << word.name;
        EXPECT_LT(glm::distance(positionOf(scene(), made[0]), place.pointWs), 0.5);
    }
    Result<Edits> copies = duplicateLights(scene(), session_->ids(), ids({"Spot", "Spot two", "Point"}));
    ASSERT_EQ(apply(copies), "");
    const Ids made = newLights(copies.value());
    EXPECT_EQ(made.size(), 3u);
    EXPECT_EQ(scene().lights.size(), lights + 9);
    EXPECT_EQ(defOf(scene(), "Point 2").rangeM, 5.5);
    EXPECT_EQ(defOf(scene(), "Spot 2").intensity, 40.25);
    EXPECT_FALSE(allMuted(scene(), made));
    EXPECT_EQ(apply(muteLights(scene(), made, true)), "");
    EXPECT_TRUE(allMuted(scene(), made));
    EXPECT_EQ(apply(deleteLights(scene(), made)), "");
    EXPECT_EQ(scene().lights.size(), lights + 6);
    while (session_->history().canUndo())
        ASSERT_FALSE(session_->undo());
    EXPECT_EQ(scene().lights.size(), lights);
}

TEST_F(LightEdits, GroupsAreMadeAndDissolved) {
    Result<Edits> edits = groupLights(scene(), session_->ids(), ids({"Spot", "Rect"}), "Key");
    ASSERT_EQ(apply(edits), "");
    EXPECT_EQ(scene().groups.size(), 3u);
    EXPECT_EQ(scene().groups.back().name, "Key 2"); // 'Key' is taken
    const std::uint64_t group = scene().groups.back().id;
    EXPECT_EQ(membersOf(scene(), group), ids({"Spot", "Rect"}));
    EXPECT_EQ(apply(assignGroup(scene(), ids({"Point"}), group)), "");
    EXPECT_EQ(membersOf(scene(), group).size(), 3u);
    EXPECT_EQ(apply(deleteGroup(scene(), group)), "");
    EXPECT_EQ(scene().groups.size(), 2u);
}

TEST_F(LightEdits, TextCarriesLightsToAnotherWindow) {
    const Ids copied = ids({"Spot", "Spot two", "Tube", "Rect"});
    const std::string text = lightsToText(scene(), copied);
    const test::TempFolder otherFolder;
    test::GltfBuilder empty;
    empty.addTriangle({{"name", "floor"}});
    auto other = test::openSession(empty.writeBinary(otherFolder));
    ASSERT_TRUE(other);
    const Result<Edits> edits = lightsFromText(other->scene(), other->ids(), text);
    ASSERT_TRUE(edits) << edits.error();
    ASSERT_FALSE(other->apply("Paste", edits.value()));
    EXPECT_EQ(newLights(edits.value()).size(), 4u);
    EXPECT_EQ(lightsToText(other->scene(), newLights(edits.value())), text);
    EXPECT_EQ(other->scene().lightDefs.size(), 3u); // the spots share one
    ASSERT_EQ(other->scene().groups.size(), 1u);
    EXPECT_EQ(other->scene().groups[0].intensity, 2.0);
    // Into the same window: names of their own, the group that is there.
    const Result<Edits> again = lightsFromText(other->scene(), other->ids(), text);
    ASSERT_FALSE(other->apply("Paste", again.value()));
    EXPECT_EQ(other->scene().groups.size(), 1u);
    EXPECT_NE(lightNamed(other->scene(), "Spot 2"), 0u);
    ASSERT_FALSE(other->save());
}

TEST_F(LightEdits, GarbageOnTheClipboardIsOneMessage) {
    const std::string good = lightsToText(scene(), ids({"Spot"}));
    const std::string cases[] = {
        "",
        "\n\n",
        "hello",
        "{}",
        "[1,2",
        "null",
        "42",
        "{\"kilolux\":1}",
        "\xff\xff",
        good + "rubbish",
        good.substr(0, good.size() / 2),
        std::string(100'000, '['),
        "{\"kilolux\":\"light\",\"transform\":{\"translation\":[0,0]}}",
        "{\"kilolux\":\"light\",\"transform\":{},\"definition\":{\"type\":\"moon\"}}",
        "{\"kilolux\":\"light\",\"transform\":{},\"name\":3,\"definition\":{}}",
        "{\"kilolux\":\"light\",\"transform\":{},\"definitionOfLine\":0}"};
    for (const std::string& text : cases) {
        const Result<Edits> edits = lightsFromText(scene(), session_->ids(), text);
        ASSERT_FALSE(edits) << text.substr(0, 60);
        EXPECT_FALSE(edits.error().empty());
        EXPECT_LT(edits.error().size(), 250u);
    }
    // What has the form but breaks a rule is refused when it is applied.
    const Result<Edits> broken = lightsFromText(
        scene(), session_->ids(),
        R"({"kilolux":"light","transform":{},"definition":{"type":"tube","radiusM":-3,"intensity":1e300}})");
    EXPECT_TRUE(!broken || session_->apply("Paste", broken.value()));
    EXPECT_EQ(session_->history().steps(), 0u);
}

TEST_F(LightEdits, SoloMutesTheOthersOfACopy) {
    const Scene solo = withSolo(scene(), ids({"Spot"}));
    for (const LightNode& light : solo.lights)
        EXPECT_EQ(light.muted, light.id != id("Spot"));
    EXPECT_FALSE(scene().lights[0].muted);
    EXPECT_TRUE(withSolo(scene(), Ids{999}).lights.sharesWith(scene().lights)); // gone: no solo
}

TEST(Colors, TextAndSrgb) {
    EXPECT_EQ(parseColor("1 0.5 0.25").value(), glm::dvec3(1, 0.5, 0.25));
    EXPECT_EQ(parseColor("0.5").value(), glm::dvec3(0.5));
    EXPECT_LT(glm::distance(parseColor("#ff8000").value(), glm::dvec3(1.0, 0.21586, 0.0)), 1e-5);
    for (const char* text :
         {"", "1 2", "#12345", "#gggggg", "red", "-1 0 0", "1 2 3 4", "nan 0 0", "#ffffff 1"})
        EXPECT_FALSE(parseColor(text)) << text;
    const glm::dvec3 color(0.001, 0.3, 1.0);
    EXPECT_LT(glm::distance(linearFromSrgb(srgbFromLinear(color)), color), 1e-12);
}

} // namespace
} // namespace kilolux
