// Structure of the glTF import: nodes, cameras, URIs, limits, and the one message for what cannot be opened.
#include "tests/unit/document/gltf_builder.h"

#include <cmath>

namespace kilolux::test {
namespace {

TEST(GltfStructure, MirroredAndNonUniformScalesStayInTheNodes) {
    GltfBuilder builder;
    builder.addTriangle({{"scale", {-2, 3, 1}}});
    builder.json["nodes"].push_back({{"children", {0}}, {"translation", {10, 0, 0}}});
    const Scene scene = builder.import();
    EXPECT_LT(glm::determinant(glm::dmat3(scene.nodes[0].worldFromNode)), 0.0);
    const Bounds bounds = worldBounds(scene);
    EXPECT_EQ(bounds.min, glm::dvec3(8, 0, 0));
    EXPECT_EQ(bounds.max, glm::dvec3(10, 3, 0));
    EXPECT_EQ(scene.meshes[0]->primitives[0].normals[0], glm::vec3(0, 0, 1)) << "not baked";
}

TEST(GltfStructure, RotationMatrixAndTranslationCompose) {
    GltfBuilder builder;
    const double half = std::sqrt(0.5);
    builder.addNode({{"rotation", {0, 0, half, half}}, {"translation", {1, 2, 3}}, {"children", {1}}});
    builder.addNode({{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1}}});
    const Scene scene = builder.import();
    const glm::dvec3 origin(scene.nodes[1].worldFromNode[3]); // 5 along X, turned to Y
    EXPECT_NEAR(glm::distance(origin, glm::dvec3(1, 7, 3)), 0.0, 1e-12);
    EXPECT_EQ(scene.nodes[1].parent, 0);
}

TEST(GltfStructure, OnlyTheDefaultSceneIsVisible) {
    GltfBuilder builder;
    builder.addTriangle();
    builder.addTriangle();
    builder.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
    builder.json["scene"] = 1;
    const Scene scene = builder.import();
    EXPECT_FALSE(scene.nodes[0].visible);
    EXPECT_TRUE(scene.nodes[1].visible);
    EXPECT_EQ(triangleCount(scene), 1u);
}

TEST(GltfStructure, CyclesAndSecondParentsAreRefused) {
    GltfBuilder cycle;
    cycle.addNode({{"children", {1}}});
    cycle.addNode({{"children", {0}}});
    EXPECT_EQ(cycle.refusal(),
              "scene.gltf: /nodes/0: expected a tree, the node is its own ancestor or below one that is");
    GltfBuilder self;
    self.addNode({{"children", {0}}});
    EXPECT_NE(self.refusal(), "opened");
    GltfBuilder twoParents;
    twoParents.addNode({{"children", {2}}});
    twoParents.addNode({{"children", {2}}});
    twoParents.addNode(Json::object());
    EXPECT_NE(twoParents.refusal().find("one parent for each node"), std::string::npos);
}

TEST(GltfStructure, ALongChainOfNodesNeedsNoStack) {
    GltfBuilder builder;
    constexpr int kLength = 40000;
    for (int i = 0; i + 1 < kLength; ++i)
        builder.addNode({{"children", {i + 1}}, {"translation", {1, 0, 0}}});
    builder.addNode(Json::object());
    const Scene scene = builder.import();
    ASSERT_EQ(scene.nodes.size(), static_cast<std::size_t>(kLength));
    EXPECT_EQ(scene.nodes.back().worldFromNode[3].x, kLength - 1.0);
}

TEST(GltfStructure, CamerasAreRigidWhateverTheirParents) {
    GltfBuilder builder;
    builder.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}},
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 2}, {"ymag", 1}, {"znear", 0}, {"zfar", 10}}}}};
    builder.addNode({{"name", "wide"}, {"camera", 0}, {"scale", {-5, 5, 5}}, {"translation", {1, 2, 3}}});
    builder.addNode({{"name", "plan"}, {"camera", 1}});
    const Scene scene = builder.import();
    ASSERT_EQ(scene.cameras.size(), 2u);
    EXPECT_EQ(scene.cameras[0].name, "wide");
    EXPECT_DOUBLE_EQ(scene.cameras[0].yfovRad, 0.7);
    EXPECT_FALSE(scene.cameras[0].zfarM);
    EXPECT_NEAR(glm::determinant(glm::dmat3(scene.cameras[0].worldFromCamera)), 1.0, 1e-12);
    EXPECT_EQ(scene.cameras[0].worldFromCamera[3], glm::dvec4(1, 2, 3, 1));
    EXPECT_TRUE(scene.cameras[1].orthographic);
    EXPECT_DOUBLE_EQ(scene.cameras[1].xmagM, 2.0);
}

TEST(GltfStructure, UrisStayWithinTheFolder) {
    const TempFolder folder;
    folder.write("outside.bin", std::string(36, '\0'));
    folder.write("scene/sub/inside file.bin", std::string(36, '\0'));
    const auto refusal = [&](const char* uri) {
        GltfBuilder builder;
        builder.addTriangle();
        builder.json["buffers"] = {{{"uri", uri}, {"byteLength", 36}}};
        const auto scene = importGltf(folder.write("scene/scene.gltf", builder.json.dump()));
        return scene ? std::string("opened") : scene.error();
    };
    const std::string outside = (folder.path() / "outside.bin").string();
    for (const char* uri :
         {"../outside.bin", "%2e%2e/outside.bin", "sub/../../outside.bin", "..\\outside.bin",
          "sub%2F..%2F..%2Foutside.bin", outside.c_str(), "file:///etc/passwd", "http://localhost/x.bin",
          "C:\\x.bin", "sub/inside%00.bin", "", ".."}) {
        EXPECT_NE(refusal(uri).find("/buffers/0/uri: expected a path within the folder"), std::string::npos)
            << uri << ": " << refusal(uri);
    }
    for (const char* uri : {"sub/inside%20file.bin", "sub/inside file.bin", "./sub/../sub/inside file.bin"}) {
        EXPECT_EQ(refusal(uri), "opened") << uri;
    }
    EXPECT_NE(refusal("sub").find("expected a regular file"), std::string::npos);
    EXPECT_NE(refusal("missing.bin").find("not found"), std::string::npos);
}

TEST(GltfStructure, BuffersMustBeAsLongAsTheySay) {
    GltfBuilder builder;
    builder.addTriangle();
    builder.json["buffers"] = {{{"uri", "scene.bin"}, {"byteLength", 1000}}};
    EXPECT_EQ(builder.refusal(),
              "scene.gltf: /buffers/0/byteLength: expected at most the 36 bytes that are there, found 1000");
}

TEST(GltfStructure, DataUrisAreDecoded) {
    GltfBuilder builder;
    builder.addTriangle();
    // 36 zero bytes; all corners coincide.
    builder.json["buffers"] = {
        {{"uri", "data:application/octet-stream;base64," + std::string(48, 'A')}, {"byteLength", 36}}};
    EXPECT_TRUE(hasWarning(builder.import(), "1 triangles without area"));
    builder.json["buffers"][0]["uri"] = "data:application/octet-stream;base64,A*AA";
    EXPECT_NE(builder.refusal().find("expected base64"), std::string::npos);
}

TEST(GltfStructure, RequiredExtensionsThatAreNotReadAreNamed) {
    for (const char* name : {"KHR_draco_mesh_compression", "KHR_texture_basisu", "ACME_unheard_of"}) {
        GltfBuilder builder;
        builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {name};
        EXPECT_NE(builder.refusal().find(name), std::string::npos);
    }
    GltfBuilder optional;
    optional.addTriangle();
    optional.json["extensionsUsed"] = {"ACME_unheard_of"};
    EXPECT_TRUE(hasWarning(optional.import(), "ACME_unheard_of"));
}

TEST(GltfStructure, BrokenJsonIsOneLine) {
    const TempFolder folder;
    const auto refusal = [&](const std::string& text) {
        const auto scene = importGltf(folder.write("scene.gltf", text));
        EXPECT_FALSE(scene);
        const std::string message = scene ? "" : scene.error();
        EXPECT_EQ(message.find('\n'), std::string::npos);
        EXPECT_LT(message.size(), 800u);
        return message;
    };
    refusal("");
    refusal("{");
    refusal("[]");
    refusal("{\"asset\": {\"version\": \"2.0\"}, \"a\": \"" + std::string(100000, 'x'));
    refusal("{\"asset\": {\"version\": \"2.0\"}, \"a\": 1e999}");
    refusal("{\"asset\": {\"version\": \"1.0\"}}");
    refusal("{\"asset\": {\"version\": \"2\n.0\"}}");
    EXPECT_NE(refusal(std::string(100000, '[')).find("nested levels"), std::string::npos);
    EXPECT_NE(importGltf(folder.path() / "missing.gltf").error().find("not found"), std::string::npos);
    EXPECT_NE(importGltf(folder.path()).error().find("regular file"), std::string::npos);
}

TEST(GltfStructure, WrongTypesOfPropertiesAreNamedByPointer) {
    GltfBuilder builder;
    builder.addTriangle();
    builder.json["nodes"][0]["mesh"] = "first";
    EXPECT_EQ(builder.refusal(),
              "scene.gltf: /nodes/0/mesh: expected an index under 1, the number of meshes, found \"first\"");
    builder.json["nodes"][0]["mesh"] = -1;
    EXPECT_NE(builder.refusal().find("/nodes/0/mesh"), std::string::npos);
    builder.json["nodes"][0]["mesh"] = 0.0; // an integer all the same
    EXPECT_EQ(builder.refusal(), "opened");
    builder.json["nodes"][0]["scale"] = {1, 2};
    EXPECT_EQ(builder.refusal(), "scene.gltf: /nodes/0/scale: expected an array of 3 finite numbers");
}

TEST(GltfStructure, TransformsThatOverflowAreRefused) {
    GltfBuilder builder;
    builder.addNode({{"scale", {1e15, 1, 1}}, {"children", {1}}});
    builder.addNode({{"scale", {1e15, 1, 1}}});
    EXPECT_EQ(builder.refusal(), "scene.gltf: /nodes/1: expected a finite transform in the world");
}

TEST(DocumentScene, WorldTransformsSurviveACycle) {
    Scene scene;
    scene.nodes.resize(3);
    scene.nodes[0].parent = 1;
    scene.nodes[1].parent = 0;
    scene.nodes[2].parent = 7; // out of range counts as no parent
    scene.nodes[2].localFromNode[3] = glm::dvec4(1, 2, 3, 1);
    updateWorldTransforms(scene);
    EXPECT_EQ(scene.nodes[2].worldFromNode[3], glm::dvec4(1, 2, 3, 1));
}

TEST(DocumentScene, WorldTransformsDoNotDependOnOrder) {
    Scene scene;
    scene.nodes.resize(3);
    scene.nodes[0].parent = 1; // parents come later
    scene.nodes[1].parent = 2;
    for (Node& node : scene.nodes)
        node.localFromNode[3] = glm::dvec4(1, 0, 0, 1);
    updateWorldTransforms(scene);
    EXPECT_EQ(scene.nodes[0].worldFromNode[3].x, 3.0);
    EXPECT_EQ(scene.nodes[2].worldFromNode[3].x, 1.0);
}

} // namespace
} // namespace kilolux::test
