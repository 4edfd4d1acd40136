// Import of animations: what files may hold, the one warning for each thing that they may not, and the files
// of the public corpora, posed at several times.
#include "renderer/document/animation.h"
#include "tests/unit/document/gltf_builder.h"

#include <cmath>

namespace kilolux::test {
namespace {

namespace fs = std::filesystem;

// A triangle, node 0, whose animation 0 is added channel by channel.
class AnimatedBuilder : public GltfBuilder {
  public:
    AnimatedBuilder() { addTriangle({{"translation", {1, 2, 3}}}); }

    int addTimes(const std::vector<float>& timesS) {
        return addAccessor(timesS, Component::Float, "SCALAR", timesS.size());
    }
    int addVec4(const std::vector<float>& data) {
        return addAccessor(data, Component::Float, "VEC4", data.size() / 4);
    }
    Json& animation() { return json["animations"][0]; }
    // Returns the channel.
    Json& animate(int node, const char* path, int input, int output, const char* interpolation = nullptr) {
        Json sampler = {{"input", input}, {"output", output}};
        if (interpolation) sampler["interpolation"] = interpolation;
        animation()["samplers"].push_back(sampler);
        animation()["channels"].push_back(
            {{"sampler", animation()["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
        return animation()["channels"].back();
    }
    // The usual one: along X from 0 to 4 within 2 s.
    Json& slide(int node = 0) {
        const int times = addTimes({0, 2}), positions = addVec3({0, 0, 0, 4, 0, 0});
        return animate(node, "translation", times, positions);
    }
    Json& sampler(int index = 0) { return animation()["samplers"][index]; }

    // The only warning about the animation; the scene must open, and without the channel.
    std::string complaint() const {
        const Scene scene = import();
        EXPECT_TRUE(scene.animations.empty());
        std::string found = "none";
        for (const std::string& warning : scene.warnings) {
            if (!warning.starts_with("/animations")) continue;
            EXPECT_EQ(found, "none") << warning;
            found = warning;
        }
        return found;
    }
};

TEST(GltfAnimations, NodesLightsAndCamerasMove) {
    AnimatedBuilder builder;
    builder.addPunctualLight({{"type", "point"}}, {{"translation", {0, 5, 0}}});
    builder.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}};
    builder.addNode({{"camera", 0}, {"translation", {0, 0, 1}}});
    builder.json["nodes"][0]["children"] = {1, 2};
    builder.addNode({{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1}}});
    builder.slide();
    builder.animation()["name"] = "slide";
    Scene scene = builder.import();
    ASSERT_EQ(scene.animations.size(), 1u);
    EXPECT_EQ(scene.animations[0]->name, "slide");
    EXPECT_EQ(animationDurationS(scene), 2.0);
    EXPECT_EQ(movingNodes(scene), (std::vector<bool>{true, true, true, false}));
    EXPECT_EQ(scene.nodes[0].worldFromNode[3].x, 1.0) << "at rest until it is posed";
    poseScene(scene, 0.5);
    EXPECT_EQ(scene.nodes[0].worldFromNode[3], glm::dvec4(1, 0, 0, 1));
    EXPECT_EQ(scene.nodes[scene.lights[0].node].worldFromNode[3], glm::dvec4(1, 5, 0, 1));
    EXPECT_EQ(scene.cameras[0].worldFromCamera[3], glm::dvec4(1, 0, 1, 1));
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfAnimations, EveryInterpolationAndPathIsRead) {
    AnimatedBuilder builder;
    const int times = builder.addTimes({0, 1});
    const float half = std::sqrt(0.5f);
    builder.animate(0, "scale", times, builder.addVec3({1, 1, 1, 3, 3, 3}), "STEP");
    builder.animate(0, "rotation", times, builder.addVec4({0, 0, 0, 2, 0, 0, half, half}), "LINEAR");
    // Leaves with 4 m/s and arrives at rest.
    builder.animate(0, "translation", times,
                    builder.addVec3({0, 0, 0, 0, 0, 0, 4, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}), "CUBICSPLINE");
    Scene scene = builder.import();
    ASSERT_EQ(scene.animations[0]->channels.size(), 3u);
    poseScene(scene, 0.5);
    const double eighth = std::sqrt(0.5);
    EXPECT_LT(glm::distance(scene.nodes[0].worldFromNode[0], glm::dvec4(eighth, eighth, 0, 0)), 1e-7);
    EXPECT_NEAR(scene.nodes[0].worldFromNode[3].x, 4.0 * 0.125, 1e-12);
}

TEST(GltfAnimations, RotationsMayBeNormalizedIntegers) {
    const auto checkTurn = [&](int (*addOutput)(AnimatedBuilder&, const Json&), double tolerance) {
        AnimatedBuilder builder;
        builder.animate(0, "rotation", builder.addTimes({0, 1}), addOutput(builder, {{"normalized", true}}));
        Scene scene = builder.import();
        ASSERT_EQ(scene.animations.size(), 1u);
        poseScene(scene, 0.0);
        EXPECT_LT(glm::distance(scene.nodes[0].worldFromNode[0], glm::dvec4(0, 1, 0, 0)), tolerance);
    };
    checkTurn(
        [](AnimatedBuilder& b, const Json& more) {
            return b.addAccessor<std::int8_t>({0, 0, 90, 90, 0, 0, 0, 127}, Component::Byte, "VEC4", 2, more);
        },
        1e-12);
    checkTurn(
        [](AnimatedBuilder& b, const Json& more) {
            return b.addAccessor<std::uint8_t>({0, 0, 180, 180, 0, 0, 0, 255}, Component::UnsignedByte,
                                               "VEC4", 2, more);
        },
        1e-12);
    checkTurn(
        [](AnimatedBuilder& b, const Json& more) {
            return b.addAccessor<std::int16_t>({0, 0, 23170, 23170, 0, 0, 0, 32767}, Component::Short, "VEC4",
                                               2, more);
        },
        1e-12);
    checkTurn(
        [](AnimatedBuilder& b, const Json& more) {
            return b.addAccessor<std::uint16_t>({0, 0, 46341, 46341, 0, 0, 0, 65535},
                                                Component::UnsignedShort, "VEC4", 2, more);
        },
        1e-12);
}

TEST(GltfAnimations, ChannelsThatRepeatTheRestLeaveTheNodeStill) {
    AnimatedBuilder builder;
    const int times = builder.addTimes({0, 3});
    builder.animate(0, "translation", times, builder.addVec3({1, 2, 3, 1, 2, 3}));
    builder.animate(0, "scale", times,
                    builder.addVec3({0, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0}), "CUBICSPLINE");
    builder.addTriangle();
    builder.animate(1, "translation", builder.addTimes({0, 1}), builder.addVec3({0, 0, 0, 0, 0, 1e-3f}));
    const Scene scene = builder.import();
    EXPECT_EQ(movingNodes(scene), (std::vector<bool>{false, true}));
    EXPECT_EQ(scene.animations[0]->channels.size(), 1u);
    EXPECT_EQ(animationDurationS(scene), 3.0) << "which they count for all the same";
}

TEST(GltfAnimations, IdsCountFromOneInFileOrder) {
    AnimatedBuilder builder;
    builder.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}};
    for (int i = 0; i < 3; ++i) {
        builder.addPunctualLight({{"type", "point"}, {"name", std::to_string(i)}});
        builder.addNode({{"camera", 0}});
    }
    const Scene scene = builder.import();
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(scene.lights[i].id, i + 1);
        EXPECT_EQ(scene.lightDefs[scene.lights[i].def].name, std::to_string(i));
        EXPECT_EQ(scene.cameras[i].id, i + 1);
    }
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        EXPECT_EQ(scene.nodes[i].id, i + 1);
}

TEST(GltfAnimations, BrokenCurvesCostAWarningThatSaysWhy) {
    const auto slideComplaint = [](const std::vector<float>& timesS, const std::vector<float>& positions) {
        AnimatedBuilder builder;
        builder.animate(0, "translation", builder.addTimes(timesS), builder.addVec3(positions));
        return builder.complaint();
    };
    const float nan = std::nanf(""), infinity = HUGE_VALF;
    const std::string input = "/animations/0/samplers/0/input: ",
                      output = "/animations/0/samplers/0/output: ";
    const std::string leftOut = "; its channels are left out";
    EXPECT_EQ(slideComplaint({0, 1, 1}, std::vector<float>(9, 0)),
              input + "expected strictly increasing times, found 1 after 1 at 2" + leftOut);
    EXPECT_EQ(slideComplaint({-0.5f, 1}, std::vector<float>(6, 0)),
              input + "expected finite times from 0 up, found -0.5 at 0" + leftOut);
    EXPECT_EQ(slideComplaint({0, nan}, std::vector<float>(6, 0)),
              input + "expected finite times from 0 up, found nan at 1" + leftOut);
    EXPECT_EQ(slideComplaint({0, infinity}, std::vector<float>(6, 0)),
              input + "expected finite times from 0 up, found inf at 1" + leftOut);
    EXPECT_EQ(slideComplaint({0, 1}, {0, 0, 0, 0, nan, 0}),
              output + "expected finite numbers below 1e+18, found nan at 1" + leftOut);
    EXPECT_EQ(slideComplaint({0, 1}, {0, 0, 0, 0, 2e18f, 0}),
              output + "expected finite numbers below 1e+18, found 2e+18 at 1" + leftOut);
    EXPECT_EQ(slideComplaint({0, 1}, std::vector<float>(9, 0)),
              output + "expected 2 values, 1 for each of 2 keys, found 3" + leftOut);
}

TEST(GltfAnimations, CurvesOfTheWrongKindCostAWarning) {
    const std::string input = "/animations/0/samplers/0/input: ",
                      output = "/animations/0/samplers/0/output: ";
    const std::string leftOut = "; its channels are left out";
    const auto complaint = [](auto change) {
        AnimatedBuilder builder;
        change(builder);
        return builder.complaint();
    };
    using Builder = AnimatedBuilder&;
    EXPECT_EQ(complaint([](Builder b) { b.slide(), b.sampler()["interpolation"] = "CUBIC"; }),
              "/animations/0/samplers/0/interpolation: expected LINEAR, STEP or CUBICSPLINE, found 'CUBIC'" +
                  leftOut);
    EXPECT_EQ(complaint([](Builder b) { b.slide(), b.sampler()["interpolation"] = "CUBICSPLINE"; }),
              output + "expected 6 values, 3 for each of 2 keys, found 2" + leftOut);
    EXPECT_EQ(complaint([](Builder b) {
                  b.animate(0, "scale", b.addTimes({0}), b.addVec3(std::vector<float>(9, 1)), "CUBICSPLINE");
              }),
              input + "expected at least 2 keys for CUBICSPLINE, found 1" + leftOut);
    EXPECT_EQ(complaint([](Builder b) { b.slide()["target"]["path"] = "rotation"; }),
              output + "expected an accessor of VEC4, accessors/2 is VEC3" + leftOut);
    EXPECT_EQ(complaint([](Builder b) { b.slide(), b.sampler()["input"] = b.sampler()["output"]; }),
              input + "expected an accessor of SCALAR, accessors/2 is VEC3" + leftOut);
    EXPECT_EQ(complaint([](Builder b) {
                  b.slide(), b.sampler()["input"] = b.addIndices({0, 1});
              }),
              input + "expected floats" + leftOut);
    EXPECT_EQ(complaint([](Builder b) {
                  b.animate(0, "scale", b.addTimes({0}),
                            b.addAccessor<std::uint16_t>({1, 1, 1, 0}, Component::UnsignedShort, "VEC3", 1));
              }),
              output + "expected floats" + leftOut);
    EXPECT_EQ(complaint([](Builder b) {
                  b.animate(0, "rotation", b.addTimes({0}),
                            b.addAccessor<std::int16_t>({0, 0, 0, 1}, Component::Short, "VEC4", 1));
              }),
              output + "expected floats or normalized integers of 8 or 16 bits" + leftOut);
    EXPECT_EQ(complaint([](Builder b) {
                  b.animate(0, "rotation", b.addTimes({0, 1}), b.addVec4({0, 0, 0, 1, 0, 0, 0, 0}));
              }),
              output + "expected unit quaternions, found length 0 at 1" + leftOut);
    EXPECT_NE(complaint([](Builder b) {
                  b.slide(), b.json["accessors"][2]["byteOffset"] = 8;
              }).find("/animations/0/samplers/0/output (accessors/2): expected"),
              std::string::npos);
    EXPECT_NE(complaint([](Builder b) {
                  b.slide();
                  for (const int i : {1, 2}) {
                      b.json["accessors"][i].erase("bufferView");
                      b.json["accessors"][i]["count"] = 2000000000;
                  }
              }).find("/animations/0/samplers/0: expected at most"),
              std::string::npos);
}

TEST(GltfAnimations, BrokenChannelsCostAWarningThatSaysWhy) {
    const auto complaint = [](auto change) {
        AnimatedBuilder builder;
        change(builder, builder.slide());
        return builder.complaint();
    };
    using Builder = AnimatedBuilder&;
    const std::string channel = "/animations/0/channels/0";
    EXPECT_EQ(
        complaint([](Builder, Json& c) { c["sampler"] = 3; }),
        channel +
            "/sampler: expected an index under 1, the number of samplers, found 3; the channel is left out");
    EXPECT_EQ(complaint([](Builder, Json& c) { c["sampler"] = -1; }),
              channel + "/sampler: expected an integer of at least 0, found -1; ignored");
    EXPECT_EQ(complaint([](Builder, Json& c) { c.erase("sampler"); }),
              channel + ": expected the property 'sampler'; ignored");
    EXPECT_EQ(complaint([](Builder, Json& c) { c.erase("target"); }),
              channel + ": expected the property 'target'; ignored");
    EXPECT_EQ(complaint([](Builder, Json& c) { c["target"] = 0; }),
              channel + "/target: expected an object; ignored");
    EXPECT_EQ(complaint([](Builder, Json& c) { c = 0; }), channel + ": expected an object; ignored");
    EXPECT_EQ(complaint([](Builder, Json& c) { c["target"].erase("path"); }),
              channel + "/target: expected the property 'path'; ignored");
    EXPECT_EQ(complaint([](Builder, Json& c) { c["target"]["path"] = "colour"; }),
              channel +
                  "/target/path: expected translation, rotation, scale or weights, found 'colour'; ignored");
    EXPECT_EQ(complaint([](Builder, Json& c) { c["target"]["node"] = 9; }),
              channel + "/target/node: expected an index under 1, the number of nodes, found 9; ignored");
    EXPECT_EQ(complaint([](Builder, Json& c) { c["target"].erase("node"); }), "none");
    EXPECT_EQ(
        complaint([](Builder b, Json&) {
            b.json["nodes"][0] = {{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}};
        }),
        channel + "/target/node: expected a node without matrix, node 0 has one; the channel is left out");
    EXPECT_EQ(complaint([](Builder b, Json&) { b.sampler() = "s"; }),
              "/animations/0/samplers/0: expected an object; ignored");
    EXPECT_EQ(complaint([](Builder b, Json&) { b.sampler()["output"] = 99; }),
              "/animations/0/samplers/0/output: expected an index under 3, the number of accessors, found "
              "99; ignored");
    for (const char* key : {"channels", "samplers"}) {
        AnimatedBuilder builder;
        builder.slide();
        builder.animation().erase(key);
        EXPECT_EQ(builder.complaint(),
                  std::string("/animations/0: expected an array '") + key + "'; ignored");
    }
    GltfBuilder number;
    number.json["animations"] = {7};
    EXPECT_TRUE(hasWarning(number.import(), "/animations/0: expected an object; ignored"));
}

TEST(GltfAnimations, MorphTargetsAndPointersAreToldOnce) {
    AnimatedBuilder builder;
    for (const char* path : {"weights", "weights", "pointer", "pointer"})
        builder.slide()["target"]["path"] = path;
    const Scene scene = builder.import();
    EXPECT_TRUE(scene.animations.empty());
    EXPECT_EQ(scene.warnings.size(), 2u);
    EXPECT_TRUE(
        hasWarning(scene, "/animations/0/channels/0/target: morph targets are shown in their rest pose"));
    EXPECT_TRUE(hasWarning(
        scene, "/animations/0/channels/2/target: only nodes are animated; 'pointer' is not played"));
    GltfBuilder still;
    still.addTriangle();
    still.json["meshes"][0]["primitives"][0]["targets"] = Json::array();
    still.json["skins"] = Json::array();
    EXPECT_TRUE(
        hasWarning(still.import(), "/meshes/0/primitives/0: morph targets are shown in their rest pose"));
    EXPECT_TRUE(hasWarning(still.import(), "skins are shown in their rest pose"));
}

TEST(GltfAnimations, ASecondChannelForTheSamePartIsLeftOut) {
    AnimatedBuilder builder;
    builder.slide();
    builder.slide();
    builder.json["animations"].push_back(builder.animation());
    builder.json["animations"][1]["channels"].erase(1);
    const Scene scene = builder.import();
    ASSERT_EQ(scene.animations.size(), 2u) << "two animations may move one node";
    EXPECT_EQ(scene.animations[0]->channels.size(), 1u);
    EXPECT_TRUE(hasWarning(scene,
                           "/animations/0/channels/1/target: expected one channel for the translation of "
                           "node 0, found a second; it is left out"));
    EXPECT_EQ(scene.warnings.size(), 1u);
}

TEST(GltfAnimations, AnimationsMustBeAnArray) {
    AnimatedBuilder builder;
    builder.json["animations"] = "walk";
    EXPECT_EQ(builder.refusal(), "scene.gltf: /animations: expected an array");
}

// Poses one file at several times: all finite, and only the nodes move that are said to. Returns whether any
// did.
bool checkPoses(const fs::path& file) {
    SCOPED_TRACE(file.string());
    auto opened = importGltf(file, {.loadImages = false});
    if (!opened) return false;
    Scene& scene = opened.value();
    const std::vector<Node> rest = scene.nodes;
    const std::vector<bool> moving = movingNodes(scene);
    bool anyMoved = false;
    for (const double share : {0.0, 0.13, 0.5, 0.77, 1.0, 3.3, -0.4}) {
        poseScene(scene, share * animationDurationS(scene));
        for (std::size_t i = 0; i < rest.size(); ++i) {
            const bool moved = scene.nodes[i].worldFromNode != rest[i].worldFromNode;
            EXPECT_TRUE(moving[i] || !moved) << "node " << i;
            EXPECT_TRUE(fitsSinglePrecision(scene.nodes[i].worldFromNode)) << "node " << i;
            anyMoved = anyMoved || moved;
        }
    }
    EXPECT_EQ(anyMoved, !scene.animations.empty());
    return anyMoved;
}

TEST(GltfAnimations, CorpusFilesMove) {
    const fs::path root = fs::path(KILOLUX_SOURCE_DIR) / "../shared/content";
    if (!fs::exists(root / "gltf")) GTEST_SKIP() << "no corpus beside the project";
    int count = 0;
    std::set<std::string> moved;
    for (const char* folder : {"gltf", "gltf_generator", "gltf_invalid"}) {
        if (!fs::exists(root / folder)) continue;
        for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
            const fs::path file = entry.path();
            if (!entry.is_regular_file() || (file.extension() != ".gltf" && file.extension() != ".glb"))
                continue;
            std::ifstream stream(file, std::ios::binary);
            const std::string bytes(std::istreambuf_iterator<char>(stream), {});
            if (bytes.find("\"animations\"") == std::string::npos) continue;
            if (checkPoses(file)) moved.insert(file.filename().string());
            ++count;
        }
    }
    for (const char* name : {"CesiumMan.glb", "Fox.glb"})
        EXPECT_TRUE(moved.contains(name)) << name;
    std::printf("%d files with animations, %zu move nodes\n", count, moved.size());
}

} // namespace
} // namespace kilolux::test
