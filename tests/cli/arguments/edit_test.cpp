// kilolux edit --do: lists of edits, what is told about wrong ones, and the files that come out.
#include "tests/cli/run_program.h"

#include <fstream>
#include <nlohmann/json.hpp>

namespace kilolux {
namespace {

using Json = nlohmann::json;

class EditCommand : public ProgramTest {
  protected:
    void SetUp() override {
        ProgramTest::SetUp();
        Json scene = {{"asset", {{"version", "2.0"}}}, {"extensionsUsed", {"KHR_lights_punctual"}}};
        scene["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 10}},
                                                                {{"type", "spot"}, {"spot", Json::object()}}};
        for (const auto& [name, light] : {std::pair{"Lamp", 0}, std::pair{"Twin", 1}, std::pair{"Twin", 1}})
            scene["nodes"].push_back(
                {{"name", name}, {"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}});
        scene["scenes"] = {{{"nodes", {0, 1, 2}}}};
        original_ = scene.dump(2) + "\n";
        write("s.gltf", original_);
    }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
    }
    ProgramRun edit(const Json& script, const std::vector<std::string>& more = {}) const {
        write("e.json", script.dump());
        std::vector<std::string> arguments{"edit", "s.gltf", "--do", "e.json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }
    void expectRefused(const Json& script, const std::vector<std::string>& parts) const {
        write("e.json", script.dump());
        expectRefusal(2, {"edit", "s.gltf", "--do", "e.json"}, parts);
        EXPECT_EQ(readText(folder_ / "s.gltf"), original_) << script;
    }
    Json saved(const std::string& name = "s.gltf") const { return Json::parse(readText(folder_ / name)); }

    std::string original_;
};

TEST_F(EditCommand, SetsAddsDuplicatesDeletesAndUndoes) {
    const ProgramRun result =
        edit({{"edits",
               {{{"light", "Lamp"}, {"set", {{"intensity", 800}, {"unit", "lm"}, {"temperatureK", 2700}}}},
                {{"do", "add"}, {"group", "Key"}, {"set", {{"exposureEv", 1}}}},
                {{"do", "add"},
                 {"light", "Window"},
                 {"set",
                  {{"type", "rect"},
                   {"widthM", 2},
                   {"unit", "nit"},
                   {"intensity", 5000},
                   {"translation", {0, 2, -3}},
                   {"group", "Key"}}}},
                {{"do", "duplicate"}, {"light", "Lamp"}, {"set", {{"name", "Copy"}, {"muted", true}}}},
                {{"light", "Twin"}, {"all", true}, {"set", {{"rangeM", 4}}}},
                {{"do", "delete"}, {"light", {{"node", 1}}}},
                {{"do", "add"}, {"bookmark", "View"}},
                {{"set", {{"exposureEv100", 9}}}},
                {{"do", "delete"}, {"light", "*"}},
                {{"do", "undo"}}}}},
             {"-o", "out.gltf"});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(readText(folder_ / "s.gltf"), original_);
    const Json out = saved("out.gltf");
    ASSERT_EQ(out["nodes"].size(), 5u);
    EXPECT_EQ(out["nodes"][0]["extras"]["kilolux"],
              Json({{"intensity", 800.0}, {"unit", "lm"}, {"temperatureK", 2700.0}}));
    EXPECT_FALSE(out["nodes"][1].contains("extensions"));
    EXPECT_EQ(out["nodes"][3]["translation"], Json({0, 2, -3}));
    EXPECT_EQ(out["extensions"]["EXT_lights_area"]["lights"][0]["intensity"], 5000);
    EXPECT_EQ(out["nodes"][4]["name"], "Copy");
    EXPECT_EQ(out["nodes"][4]["extensions"]["KHR_lights_punctual"]["light"], 0) << "a duplicate shares";
    EXPECT_EQ(out["scenes"][0]["extras"]["kilolux"]["exposureEv100"], 9);
    EXPECT_EQ(out["scenes"][0]["extras"]["kilolux"]["groups"][0]["name"], "Key");
    EXPECT_EQ(out["scenes"][0]["extras"]["kilolux"]["bookmarks"][0]["name"], "View");
}

TEST_F(EditCommand, InPlaceAndNothingToDo) {
    EXPECT_EQ(edit(Json::array()).exitCode, 0);
    EXPECT_EQ(readText(folder_ / "s.gltf"), original_);
    EXPECT_EQ(edit({{{"light", "Lamp"}, {"set", {{"intensity", 11}}}}}).exitCode, 0);
    std::string expected = original_;
    expected.replace(expected.find("\"intensity\": 10"), 15, "\"intensity\": 11.0");
    EXPECT_EQ(readText(folder_ / "s.gltf"), expected);
}

TEST_F(EditCommand, WrongListsAreToldTheirPlace) {
    expectRefused({{{"light", "Lamp"}, {"set", {{"intensity", -5}}}}},
                  {"e.json: /0: ", "light 'Lamp', intensity: expected a number from 0 to"});
    expectRefused({{{"light", "Lamp"}, {"set", {{"intensity", "x"}}}}},
                  {"/0/set/intensity", "expected a number"});
    expectRefused({{{"light", "Lamp"}, {"set", {{"brightness", 5}}}}},
                  {"/0/set/brightness", "kilolux edit --list"});
    expectRefused({{{"light", "Lamp"}, {"set", {{"color", {1, 2}}}}}},
                  {"/0/set/color", "expected 3 numbers"});
    expectRefused({{{"light", "Lamp"}, {"set", {{"rotation", {1, 2}}}}}},
                  {"/0/set/rotation", "rotation: expected 4 numbers"});
    expectRefused({{{"light", "Lamp"}, {"set", {{"type", "laser"}}}}},
                  {"/0/set/type", "directional, sphere, spot"});
    expectRefused({{{"light", "Lamp"}, {"set", {{"unit", "nit"}}}}}, {"/0", "'Lamp'", "unit: expected"});
    expectRefused({{{"light", "Lamp"}, {"set", {{"group", "none"}}}}}, {"/0/set/group", "name of a group"});
    expectRefused({{{"light", "lost"}, {"set", Json::object()}}}, {"/0/light", "found \"lost\""});
    expectRefused({{{"light", "Twin"}, {"set", Json::object()}}}, {"/0/light", "found 2", "\"all\": true"});
    expectRefused({{"edits", {{{"do", "explode"}}}}}, {"/edits/0/do", "expected one of set, add"});
    expectRefused({{{"do", "undo"}}}, {"/0/do", "nothing to undo"});
    expectRefused({{{"lihgt", "Lamp"}}}, {"/0/lihgt", "expected one of do, light"});
    expectRefused({{{"light", "Lamp"}}}, {"/0", "expected 'set'"});
    expectRefused(5, {"expected an array of edits"});
    // The first step is good: still nothing is saved.
    expectRefused({{{"light", "Lamp"}, {"set", {{"muted", true}}}}, {{"do", "delete"}}}, {"/1"});
}

TEST_F(EditCommand, WrongFilesAndArguments) {
    write("bad.json", "{\"edits\": [");
    write("e.json", "[]");
    expectRefusal(2, {"edit", "s.gltf", "--do", "bad.json"}, {"bad.json", "expected valid JSON"});
    expectRefusal(2, {"edit", "s.gltf", "--do", "none.json"}, {"none.json", "cannot read"});
    expectRefusal(2, {"edit", "none.gltf", "--do", "e.json"}, {"none.gltf"});
    expectRefusal(2, {"edit", "--do", "e.json"}, {"expected a scene"});
    expectRefusal(3, {"edit", "s.gltf", "--do", "e.json", "-o", "out.glb"}, {"out.glb", "ends in .gltf"});
    expectRefusal(3, {"edit", "s.gltf", "--do", "e.json", "-o", "no/such/out.gltf"}, {"no/such/out.gltf"});
    expectRefusal(2, {"edit", "s.gltf", "-o", "x.gltf"}, {"--do"});
}

TEST_F(EditCommand, ListNamesEveryFieldAsTextAndJson) {
    const ProgramRun text = run({"edit", "--list"}), json = run({"edit", "--list", "--json"});
    EXPECT_EQ(text.exitCode, 0);
    const Json list = Json::parse(json.out);
    EXPECT_GE(list["fields"].size(), 28u);
    for (const Json& field : list["fields"]) {
        EXPECT_NE(text.out.find("\n  " + field["name"].get<std::string>() + " "), std::string::npos) << field;
        EXPECT_NE(field["help"], "") << field;
        EXPECT_EQ(field["kind"] == "number" || field["kind"] == "number or null", field.contains("min"))
            << field;
    }
}

} // namespace
} // namespace kilolux
