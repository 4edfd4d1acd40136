// The command line without a device: help, lists, and what each wrong argument is told.
#include "tests/cli/run_program.h"

#include <nlohmann/json.hpp>
#include <regex>
#include <set>

namespace kilolux {
namespace {

using Arguments = ProgramTest;

std::set<std::string> namesIn(const nlohmann::json& list) {
    std::set<std::string> names;
    for (const nlohmann::json& entry : list)
        names.insert(entry["name"].get<std::string>());
    return names;
}

TEST_F(Arguments, HelpGoesToStdoutAndNamesTheWay) {
    const ProgramRun help = run({"--help"});
    EXPECT_EQ(help.exitCode, 0);
    EXPECT_EQ(help.err, "");
    EXPECT_NE(help.out.find("kilolux render SCENE.glb -o OUT.png"), std::string::npos);
    EXPECT_NE(help.out.find("Exit codes"), std::string::npos);
    const ProgramRun render = run({"render", "--help"});
    EXPECT_EQ(render.exitCode, 0);
    for (const char* option : {"--output", "--size", "--frames", "--seed", "--method", "--view", "--camera",
                               "--set", "--stats", "--dump", "--list", "--json", "--verbose", "Examples:"})
        EXPECT_NE(render.out.find(option), std::string::npos) << option;
}

TEST_F(Arguments, HelpExamplesUseNamesThatExist) {
    const std::string help = run({"render", "--help"}).out;
    const nlohmann::json list = nlohmann::json::parse(run({"--list", "--json"}).out);
    const std::pair<const char*, std::set<std::string>> options[] = {
        {"--method ([a-z][^ \n]*)", namesIn(list["methods"])},
        {"--view ([a-z][^ \n]*)", namesIn(list["views"])},
        {"--set ([a-z][^ =\n]*)=", namesIn(list["settings"])},
    };
    for (const auto& [pattern, names] : options) {
        const std::regex expression(pattern);
        const std::sregex_iterator first(help.begin(), help.end(), expression);
        EXPECT_NE(first, std::sregex_iterator()) << pattern;
        for (std::sregex_iterator it = first; it != std::sregex_iterator(); ++it)
            EXPECT_TRUE(names.contains((*it)[1])) << it->str();
    }
}

TEST_F(Arguments, VersionIsOneLine) {
    const ProgramRun result = run({"--version"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_TRUE(std::regex_match(result.out, std::regex("kilolux [0-9]+\\.[0-9]+\\.[0-9]+\n"))) << result.out;
}

TEST_F(Arguments, ListTellsTheSameAsTextAndJson) {
    const ProgramRun text = run({"--list"});
    const ProgramRun json = run({"--list", "--json"});
    EXPECT_EQ(text.exitCode, 0);
    EXPECT_EQ(json.exitCode, 0);
    EXPECT_EQ(run({"render", "--list"}).out, text.out);
    EXPECT_EQ(run({"render", "--list", "--json"}).out, json.out);
    const nlohmann::json list = nlohmann::json::parse(json.out);
    EXPECT_TRUE(namesIn(list["methods"]).contains("all-lights"));
    EXPECT_GE(list["views"].size(), 1u);
    EXPECT_TRUE(namesIn(list["settings"]).contains("exposureEv100"));
    EXPECT_TRUE(namesIn(list["presets"]).contains("draft"));
    for (const char* kind : {"methods", "views", "presets", "settings"})
        for (const nlohmann::json& entry : list[kind]) {
            EXPECT_NE(entry["help"], "") << entry;
            EXPECT_NE(text.out.find("\n  " + entry["name"].get<std::string>() + " "), std::string::npos)
                << entry;
        }
}

TEST_F(Arguments, WithoutADisplayItSaysWhatToDo) {
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    expectRefusal(3, {}, {"cannot open a window", "kilolux render SCENE.glb -o OUT.png"});
    expectRefusal(3, {"edit"}, {"cannot open a window"});
    expectRefusal(3, {"a.glb"}, {"cannot open a window"});
}

TEST_F(Arguments, UnknownWordsGetTheNearest) {
    expectRefusal(2, {"rendr"}, {"'rendr'", "did you mean 'render'?"});
    expectRefusal(2, {"--lst"}, {"'--lst'", "did you mean '--list'?"});
    expectRefusal(2, {"rendr", "scene.glb"}, {"'rendr'", "did you mean 'render'?"});
    expectRefusal(2, {"render", "a.glb", "--frame", "2"},
                  {"did you mean '--frames'?", "kilolux render --help"});
    expectRefusal(2, {"render", "a.glb", "b.glb"}, {"'b.glb'"});
    expectRefusal(2, {"render", "a.glb", "--camra", "x"}, {"did you mean '--camera'?"});
}

TEST_F(Arguments, MissingParts) {
    expectRefusal(2, {"render"}, {"SCENE is missing"});
    expectRefusal(2, {"render", ""}, {"SCENE is missing"});
    expectRefusal(2, {"render", "--json"}, {"--list"});
    expectRefusal(2, {"render", "a.glb", "-o"}, {"--output"});
    expectRefusal(2, {"render", "a.glb", "--set"}, {"--set"});
}

TEST_F(Arguments, NumbersOutOfRange) {
    for (const char* size : {"10", "x", "10x", "x10", "10x10x10", "0x10", "10x0", "-5x10", "16385x1",
                             "16384x16384", "99999999999x1", "1e3x2", " 8x8", "8x8 ", "8*8"})
        expectRefusal(2, {"render", "a.glb", std::string("--size=") + size},
                      {"--size '" + std::string(size) + "'"});
    for (const char* frames : {"0", "-1", "1000001", "2.5", "many", "99999999999999999999"})
        expectRefusal(2, {"render", "a.glb", std::string("--frames=") + frames}, {"--frames", "1000000"});
    for (const char* seed : {"-1", "4294967296", "x"})
        expectRefusal(2, {"render", "a.glb", std::string("--seed=") + seed}, {"--seed", "4294967295"});
}

TEST_F(Arguments, UnknownNamesListTheChoices) {
    const nlohmann::json list = nlohmann::json::parse(run({"--list", "--json"}).out);
    for (const auto& [option, kind] :
         {std::pair{"method", "methods"}, std::pair{"view", "views"}, std::pair{"preset", "presets"}}) {
        std::vector<std::string> parts{"unknown " + std::string(option) + " 'zzzzzzzz'"};
        for (const std::string& name : namesIn(list[kind]))
            parts.push_back(name);
        expectRefusal(2, {"render", scene("cornell"), "--" + std::string(option), "zzzzzzzz"}, parts);
    }
    expectRefusal(2, {"render", scene("cornell"), "--camera", "fromt"}, {"did you mean 'front'?", "close"});
}

TEST_F(Arguments, SettingsAreCheckedBeforeTheScene) {
    expectRefusal(2, {"render", "missing.glb", "--set", "jiter=on"}, {"did you mean 'jitter'?"});
    expectRefusal(2, {"render", "missing.glb", "--set", "raysPerPixel=99"}, {"0.25 to 16"});
    expectRefusal(2, {"render", "missing.glb", "--set", "jitter=on", "--set", "toneMap=x"}, {"neutral|none"});
}

TEST_F(Arguments, OutputsAreCheckedBeforeTheScene) {
    expectRefusal(2, {"render", "missing.glb", "-o", "a.jpg"}, {"'a.jpg'", ".png, .exr or .hdr"});
    expectRefusal(2, {"render", "missing.glb", "-o", "a.png", "--half"}, {"--half"});
    expectRefusal(3, {"render", "missing.glb", "-o", "none/a.png"},
                  {"'none/a.png'", "'none' does not exist"});
    expectRefusal(3, {"render", "missing.glb", "--stats", "none/a.json"}, {"'none/a.json'"});
    std::ofstream(folder_ / "plain") << "x";
    expectRefusal(3, {"render", "missing.glb", "-o", "plain/a.png"}, {"'plain/a.png'"});
    expectRefusal(3, {"render", "missing.glb", "--dump", "plain/targets"}, {"'plain/targets'"});
    std::filesystem::create_directory(folder_ / "b.png");
    expectRefusal(3, {"render", "missing.glb", "-o", "b.png"}, {"'b.png'", "folder"});
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 2)
        << "probing must leave nothing";
}

TEST_F(Arguments, NothingOverwritesTheScene) {
    const std::filesystem::path copy = folder_ / "scene.glb";
    std::filesystem::copy_file(scene("cornell"), copy);
    expectRefusal(2, {"render", "scene.glb", "--stats", copy.string()}, {"overwrite"});
    expectRefusal(2, {"render", "scene.glb", "-o", "a.png", "--stats", "./a.png"}, {"overwrite"});
    EXPECT_EQ(readText(copy), readText(scene("cornell")));
}

TEST_F(Arguments, ScenesThatCannotBeOpened) {
    std::ofstream(folder_ / "empty.glb");
    std::ofstream(folder_ / "text.gltf") << "hello";
    std::ofstream(folder_ / "version.gltf") << R"({"asset":{"version":"9.9"}})";
    std::ofstream(folder_ / "torn.glb") << readText(scene("cornell")).substr(0, 1000);
    std::filesystem::create_directory(folder_ / "folder.gltf");
    for (const char* name :
         {"missing.glb", "empty.glb", "text.gltf", "version.gltf", "torn.glb", "folder.gltf"}) {
        expectRefusal(2, {"render", name, "-o", "out.png"}, {name});
        EXPECT_FALSE(std::filesystem::exists(folder_ / "out.png")) << name;
    }
}

TEST_F(Arguments, HostileNamesStayOnOneLineAndOutOfTheTerminal) {
    expectRefusal(2, {"render", "a\n\x1b[31mb.glb", "-o", "a.png"}, {"?[31mb.glb"});
    expectRefusal(2, {"render", "a.glb", "-o", "x\ny.jpg"}, {"x y.jpg"});
    expectRefusal(2, {"render", std::string(5000, 'a') + ".glb", "-o", "a.png"}, {"aaaa"});
}

} // namespace
} // namespace kilolux
