// The light list: search, order, groups, and what clicks with Shift and Ctrl select.
#include "ui/light_list_model.h"

#include <gtest/gtest.h>

namespace kilolux {
namespace {

// Ids count from 1; intensities fall, distances from the origin rise.
Scene sceneOf(std::initializer_list<std::pair<const char*, LightType>> lights) {
    Scene scene;
    for (const auto& [name, type] : lights) {
        const std::size_t i = scene.lights.size();
        Node node;
        node.name = name;
        node.localFromNode[3] = glm::dvec4(0.0, 0.0, double(i), 1.0);
        scene.nodes.push_back(node);
        LightDef def;
        def.type = type;
        def.intensity = 100.0 - double(i);
        scene.lightDefs.push_back(def);
        LightNode light;
        light.id = i + 1;
        light.node = light.def = int(i);
        scene.lights.push_back(light);
    }
    updateWorldTransforms(scene);
    return scene;
}

std::string names(const Scene& scene, const LightListModel& model) {
    std::string text;
    for (const LightRow& row : model.rows()) {
        text += row.kind == LightRow::Kind::Group ? "[" + scene.groups[std::size_t(row.index)].name + "]"
                                                  : scene.nodes[std::size_t(row.index)].name;
        text += ' ';
    }
    return text;
}

TEST(LightListModel, SortsNumbersByValueAndKeepsTheFilesOrderOfEqualOnes) {
    const Scene scene = sceneOf({{"Lamp 10", LightType::Spot},
                                 {"lamp 2", LightType::Sphere},
                                 {"Arc", LightType::Spot},
                                 {"Lamp 2", LightType::Rect}});
    LightListModel model;
    LightListQuery query;
    EXPECT_TRUE(model.update(scene, 1, query));
    EXPECT_EQ(names(scene, model), "Lamp 10 lamp 2 Arc Lamp 2 ");
    query.order = LightOrder::Name;
    EXPECT_TRUE(model.update(scene, 1, query));
    EXPECT_EQ(names(scene, model), "Arc lamp 2 Lamp 2 Lamp 10 ");
    query.descending = true;
    model.update(scene, 1, query);
    EXPECT_EQ(names(scene, model), "Lamp 10 lamp 2 Lamp 2 Arc ");
    query = {};
    query.order = LightOrder::Intensity;
    model.update(scene, 1, query);
    EXPECT_EQ(names(scene, model), "Lamp 2 Arc lamp 2 Lamp 10 ");
    query.order = LightOrder::Type;
    model.update(scene, 1, query);
    EXPECT_EQ(names(scene, model), "lamp 2 Lamp 10 Arc Lamp 2 ");
    query.order = LightOrder::Distance;
    query.eyeWs = {0, 0, 3.2};
    model.update(scene, 1, query);
    EXPECT_EQ(names(scene, model), "Lamp 2 Arc lamp 2 Lamp 10 ");
}

TEST(LightListModel, IsMadeAnewOnlyWhenSomethingChanged) {
    const Scene scene = sceneOf({{"a", LightType::Spot}, {"b", LightType::Spot}});
    LightListModel model;
    LightListQuery query;
    EXPECT_TRUE(model.update(scene, 1, query));
    EXPECT_FALSE(model.update(scene, 1, query));
    query.eyeWs = {5, 0, 0}; // the camera flies, but nothing is sorted by it
    EXPECT_FALSE(model.update(scene, 1, query));
    query.order = LightOrder::Distance;
    EXPECT_TRUE(model.update(scene, 1, query));
    EXPECT_TRUE(model.update(scene, 2, query));
    query.search = "b";
    EXPECT_TRUE(model.update(scene, 2, query));
    EXPECT_EQ(model.shownLights(), 1);
}

TEST(LightListModel, SearchFindsAllWordsInNameTypeAndGroup) {
    Scene scene =
        sceneOf({{"Desk lamp", LightType::Spot}, {"Ceiling", LightType::Rect}, {"Lamp", LightType::Sphere}});
    scene.groups.push_back({7, "Key"});
    scene.lights[1].group = 7;
    LightListModel model;
    LightListQuery query;
    query.search = "LAMP spot";
    model.update(scene, 1, query);
    EXPECT_EQ(names(scene, model), "Desk lamp ");
    query.search = "key";
    model.update(scene, 1, query);
    EXPECT_EQ(names(scene, model), "[Key] Ceiling ");
    query.search = "";
    query.types = 1u << unsigned(LightType::Sphere) | 1u << unsigned(LightType::Rect);
    model.update(scene, 1, query);
    EXPECT_EQ(names(scene, model), "[Key] Ceiling Lamp ");
    query.search = "no such thing";
    model.update(scene, 1, query);
    EXPECT_EQ(model.rows().size(), 0u);
}

TEST(LightListModel, GroupsHoldTheirMembersAndFold) {
    Scene scene = sceneOf({{"a", LightType::Spot}, {"b", LightType::Spot}, {"c", LightType::Spot}});
    scene.groups.push_back({2, "Key"});
    scene.groups.push_back({3, "Empty"});
    scene.lights[0].group = 2;
    scene.lights[2].group = 2;
    LightListModel model;
    LightListQuery query;
    model.update(scene, 1, query);
    EXPECT_EQ(names(scene, model), "[Key] a c [Empty] b ");
    EXPECT_EQ(model.rows()[0].members, 2);
    EXPECT_EQ(model.rowOf(2), 4); // not the group of that id
    query.foldedGroups = {2};
    model.update(scene, 1, query);
    EXPECT_EQ(names(scene, model), "[Key] [Empty] b ");
    query.grouped = false;
    model.update(scene, 1, query);
    EXPECT_EQ(names(scene, model), "a b c ");
}

TEST(LightListModel, ClicksWithShiftAndCtrl) {
    Scene scene = sceneOf({{"a", LightType::Spot},
                           {"b", LightType::Spot},
                           {"c", LightType::Spot},
                           {"d", LightType::Spot},
                           {"e", LightType::Spot}});
    scene.groups.push_back({2, "Key"});
    scene.lights[3].group = 2;
    scene.lights[4].group = 2;
    LightListModel model;
    model.update(scene, 1, {});
    ASSERT_EQ(names(scene, model), "[Key] d e a b c ");
    using Ids = std::vector<std::uint64_t>;
    Ids selection;
    RowAnchor anchor;
    const auto click = [&](int row, bool shift, bool ctrl) {
        selection = selectionAfter(scene, model.rows(), selection, {row, shift, ctrl}, anchor);
        return selection;
    };
    EXPECT_EQ(click(4, false, false), Ids({2}));
    EXPECT_EQ(click(1, true, false), Ids({1, 2, 4, 5})); // upwards
    EXPECT_EQ(click(5, true, false), Ids({2, 3}));       // from the same anchor
    EXPECT_EQ(click(5, false, true), Ids({2}));
    EXPECT_EQ(click(3, false, true), Ids({1, 2}));
    EXPECT_EQ(click(5, true, true), Ids({1, 2, 3})); // adds a range
    EXPECT_EQ(click(0, false, false), Ids({4, 5}));  // a group's row is its members
    EXPECT_EQ(click(0, false, true), Ids({}));
    EXPECT_EQ(click(99, false, false), Ids({}));
}

TEST(LightListModel, TenThousandRows) {
    Scene scene;
    for (std::uint64_t i = 0; i < 10'000; ++i) {
        Node node;
        node.name = "Light " + std::to_string((i * 7919) % 10'000);
        scene.nodes.push_back(node);
        LightNode light;
        light.id = i + 1;
        light.node = int(i);
        light.def = 0;
        scene.lights.push_back(light);
    }
    scene.lightDefs.push_back({});
    LightListModel model;
    LightListQuery query;
    query.order = LightOrder::Name;
    model.update(scene, 1, query);
    ASSERT_EQ(model.rows().size(), 10'000u);
    const Scene& read = scene;
    for (std::size_t i = 0; i < 10'000; i += 1111)
        EXPECT_EQ(read.nodes[std::size_t(model.rows()[i].index)].name, "Light " + std::to_string(i));
}

} // namespace
} // namespace kilolux
