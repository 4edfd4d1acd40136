// Geometry of the glTF import: every way a file can store a triangle gives the triangle it means.
#include "tests/unit/document/gltf_builder.h"

#include <limits>

namespace kilolux::test {
namespace {

const Primitive& onlyPrimitive(const Scene& scene) {
    static const Primitive kNone;
    EXPECT_EQ(scene.meshes.size(), 1u);
    if (scene.meshes.empty() || scene.meshes[0]->primitives.empty()) {
        ADD_FAILURE() << "no primitive";
        return kNone;
    }
    return scene.meshes[0]->primitives[0];
}

// Corner positions in triangle order, whatever the vertex numbering.
std::vector<glm::vec3> corners(const Primitive& primitive) {
    std::vector<glm::vec3> result;
    for (const std::uint32_t index : primitive.indices)
        result.push_back(primitive.positions[index]);
    return result;
}

const std::vector<float> kSquare = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};

TEST(GltfGeometry, FlatNormalsWhereNoneAreGiven) {
    GltfBuilder builder;
    builder.addTriangle();
    const Scene scene = builder.import();
    const Primitive& primitive = onlyPrimitive(scene);
    ASSERT_EQ(primitive.normals.size(), 3u);
    EXPECT_EQ(primitive.normals[0], glm::vec3(0, 0, 1));
    EXPECT_EQ(primitive.boundsMax, glm::vec3(1, 1, 0));
}

TEST(GltfGeometry, TheBinaryContainerHoldsTheSame) {
    GltfBuilder builder;
    builder.addTriangle();
    const TempFolder folder;
    const auto scene = importGltf(builder.writeBinary(folder));
    ASSERT_TRUE(scene) << scene.error();
    EXPECT_EQ(triangleCount(scene.value()), 1u);
}

TEST(GltfGeometry, FlatNormalsSplitSharedVertices) {
    GltfBuilder builder;
    builder.addMesh({{"attributes", {{"POSITION", builder.addVec3({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1})}}},
                     {"indices", builder.addIndices({0, 1, 2, 0, 3, 1})}});
    const Scene scene = builder.import();
    const Primitive& primitive = onlyPrimitive(scene);
    ASSERT_EQ(primitive.positions.size(), 6u);
    EXPECT_EQ(primitive.normals[primitive.indices[0]], glm::vec3(0, 0, 1));
    EXPECT_EQ(primitive.normals[primitive.indices[3]], glm::vec3(0, 1, 0));
}

TEST(GltfGeometry, StripsAndFansBecomeLists) {
    for (const int mode : {5, 6}) {
        GltfBuilder builder;
        // As a strip 0 1 2 3, as a fan around 0 with the square's corners in turn.
        const std::vector<float> fan = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
        builder.addMesh(
            {{"attributes", {{"POSITION", builder.addVec3(mode == 5 ? kSquare : fan)}}}, {"mode", mode}});
        const Scene scene = builder.import();
        const Primitive& primitive = onlyPrimitive(scene);
        ASSERT_EQ(primitive.indices.size(), 6u) << mode;
        // Both triangles keep facing +Z: the strip's second is turned around.
        for (const glm::vec3& normal : primitive.normals)
            EXPECT_EQ(normal, glm::vec3(0, 0, 1)) << mode;
    }
}

TEST(GltfGeometry, PointsAndLinesAreLeftOutWithAWarning) {
    GltfBuilder builder;
    builder.addMesh({{"attributes", {{"POSITION", builder.addVec3(kSquare)}}}, {"mode", 1}});
    const Scene scene = builder.import();
    EXPECT_EQ(triangleCount(scene), 0u);
    EXPECT_TRUE(hasWarning(scene, "points and lines"));
}

TEST(GltfGeometry, SparseValuesReplaceTheBase) {
    GltfBuilder builder;
    const int positions = builder.addVec3({0, 0, 0, 1, 0, 0, 0, 1, 0});
    const int indices = builder.addView(std::vector<std::uint16_t>{1});
    const int values = builder.addView(std::vector<float>{5, 0, 0});
    builder.json["accessors"][positions]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
        {"values", {{"bufferView", values}}}};
    builder.addMesh({{"attributes", {{"POSITION", positions}}}});
    const Scene scene = builder.import();
    EXPECT_EQ(corners(onlyPrimitive(scene))[1], glm::vec3(5, 0, 0));
}

TEST(GltfGeometry, SparseWithoutABaseStartsFromZero) {
    GltfBuilder builder;
    const int indices = builder.addView(std::vector<std::uint8_t>{1, 2});
    const int values = builder.addView(std::vector<float>{1, 0, 0, 0, 1, 0});
    builder.json["accessors"].push_back({{"componentType", 5126},
                                         {"type", "VEC3"},
                                         {"count", 3},
                                         {"sparse",
                                          {{"count", 2},
                                           {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                           {"values", {{"bufferView", values}}}}}});
    builder.addMesh({{"attributes", {{"POSITION", 0}}}});
    const std::vector<glm::vec3> expected = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    EXPECT_EQ(corners(onlyPrimitive(builder.import())), expected);
}

TEST(GltfGeometry, SparseIndicesMustAscend) {
    GltfBuilder builder;
    const int positions = builder.addVec3({0, 0, 0, 1, 0, 0, 0, 1, 0});
    const int indices = builder.addView(std::vector<std::uint16_t>{2, 1});
    const int values = builder.addView(std::vector<float>{5, 0, 0, 5, 0, 0});
    builder.json["accessors"][positions]["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
        {"values", {{"bufferView", values}}}};
    builder.addMesh({{"attributes", {{"POSITION", positions}}}});
    EXPECT_NE(builder.refusal().find("expected ascending indices"), std::string::npos) << builder.refusal();
}

TEST(GltfGeometry, NormalizedAndPlainIntegersMapAsSpecified) {
    GltfBuilder builder;
    const Json normalized = {{"normalized", true}};
    // KHR_mesh_quantization: positions as plain shorts, texture coordinates as normalized bytes, colours as
    // shorts.
    const int positions = builder.addAccessor(
        std::vector<std::int16_t>{0, 0, 0, 0, 300, 0, 0, 0, 0, -300, 0, 0}, Component::Short, "VEC3", 3);
    builder.json["bufferViews"].back()["byteStride"] = 8;
    const int uv = builder.addAccessor(std::vector<std::uint8_t>{0, 51, 0, 0, 255, 0, 0, 0, 0, 0, 0, 0},
                                       Component::UnsignedByte, "VEC2", 3, normalized);
    builder.json["bufferViews"].back()["byteStride"] = 4;
    const int colors =
        builder.addAccessor(std::vector<std::uint16_t>{65535, 0, 0, 0, 65535, 0, 0, 0, 0, 0, 65535, 0},
                            Component::UnsignedShort, "VEC3", 3, normalized);
    builder.json["bufferViews"].back()["byteStride"] = 8;
    const int normals =
        builder.addAccessor(std::vector<std::int8_t>{0, 0, 127, 0, 0, 0, 127, 0, -128, 0, 0, 0},
                            Component::Byte, "VEC3", 3, normalized);
    builder.json["bufferViews"].back()["byteStride"] = 4;
    builder.addMesh(
        {{"attributes",
          {{"POSITION", positions}, {"TEXCOORD_0", uv}, {"COLOR_0", colors}, {"NORMAL", normals}}}});
    const Scene scene = builder.import();
    const Primitive& primitive = onlyPrimitive(scene);
    ASSERT_EQ(primitive.positions.size(), 3u);
    EXPECT_EQ(primitive.positions[1], glm::vec3(300, 0, 0));
    EXPECT_EQ(primitive.positions[2], glm::vec3(0, -300, 0));
    EXPECT_FLOAT_EQ(primitive.uv0[0].y, 0.2f);
    EXPECT_EQ(primitive.uv0[1], glm::vec2(1, 0));
    EXPECT_EQ(primitive.colors[0], glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(primitive.colors[2], glm::vec4(0, 0, 1, 1)) << "three channels, stride 8";
    EXPECT_EQ(primitive.normals[2], glm::vec3(-1, 0, 0));
}

TEST(GltfGeometry, InterleavedAttributesAndByteIndices) {
    GltfBuilder builder;
    // Position and texture coordinates side by side.
    const std::vector<float> data = {0, 0, 0, .25f, .5f, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    const int view = builder.addView(data, 20);
    builder.json["accessors"] = {
        {{"bufferView", view}, {"componentType", 5126}, {"type", "VEC3"}, {"count", 3}},
        {{"bufferView", view}, {"byteOffset", 12}, {"componentType", 5126}, {"type", "VEC2"}, {"count", 3}}};
    const int indices =
        builder.addAccessor(std::vector<std::uint8_t>{0, 2, 1}, Component::UnsignedByte, "SCALAR", 3);
    builder.addMesh({{"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}}, {"indices", indices}});
    const Scene scene = builder.import();
    const Primitive& primitive = onlyPrimitive(scene);
    const std::vector<glm::vec3> expected = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}};
    EXPECT_EQ(corners(primitive), expected);
    EXPECT_EQ(primitive.uv0[primitive.indices[0]], glm::vec2(.25f, .5f));
    EXPECT_EQ(primitive.normals[0], glm::vec3(0, 0, -1));
}

TEST(GltfGeometry, PrimitivesKeepOnlyTheVerticesTheyUse) {
    GltfBuilder builder;
    std::vector<float> many(3000, 0.0f);
    many[2991] = 1.0f; // vertex 997
    many[2995] = 1.0f; // vertex 998
    builder.addMesh({{"attributes", {{"POSITION", builder.addVec3(many)}}},
                     {"indices", builder.addIndices({999, 997, 998})}});
    EXPECT_EQ(onlyPrimitive(builder.import()).positions.size(), 3u);
}

TEST(GltfGeometry, DegenerateTrianglesAreLeftOutAndCounted) {
    GltfBuilder builder;
    builder.addMesh({{"attributes", {{"POSITION", builder.addVec3({0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0})}}},
                     {"indices", builder.addIndices({0, 1, 2, 0, 0, 1, 0, 1, 3})}});
    const Scene scene = builder.import();
    EXPECT_EQ(triangleCount(scene), 1u);
    EXPECT_TRUE(hasWarning(scene, "2 triangles without area"));
}

TEST(GltfGeometry, WrongNormalsAreRepaired) {
    GltfBuilder builder;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    builder.addMesh({{"attributes",
                      {{"POSITION", builder.addVec3({0, 0, 0, 1, 0, 0, 0, 1, 0})},
                       {"NORMAL", builder.addVec3({0, 0, 0, nan, 0, 0, 0, 0, 7})}}}});
    const Scene scene = builder.import();
    for (const glm::vec3& normal : onlyPrimitive(scene).normals)
        EXPECT_EQ(normal, glm::vec3(0, 0, 1));
}

TEST(GltfGeometry, UnusableGeometryIsRefusedWithItsPlace) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    {
        GltfBuilder builder;
        builder.addMesh({{"attributes", {{"POSITION", builder.addVec3({0, 0, 0, 1, nan, 0, 0, 1, 0})}}}});
        EXPECT_EQ(builder.refusal(),
                  "scene.gltf: /meshes/0/primitives/0/attributes/POSITION: expected coordinates "
                  "within 1e+09 m, vertex 1 has nan");
    }
    {
        GltfBuilder builder;
        builder.addMesh({{"attributes", {{"POSITION", builder.addVec3({0, 0, 0, 1, 0, 0, 0, 1, 0})}}},
                         {"indices", builder.addIndices({0, 1, 4000000000u})}});
        EXPECT_EQ(
            builder.refusal(),
            "scene.gltf: /meshes/0/primitives/0/indices: expected indices under 3, found 4000000000 at 2");
    }
    {
        GltfBuilder builder;
        builder.addTriangle();
        builder.json["accessors"][0]["count"] = 4;
        EXPECT_NE(builder.refusal().find("POSITION (accessors/0): expected 4 elements within the 36 bytes"),
                  std::string::npos)
            << builder.refusal();
    }
    {
        GltfBuilder builder;
        builder.addTriangle();
        builder.json["accessors"][0]["byteOffset"] = 9007199254740991;
        EXPECT_NE(builder.refusal().find("expected 3 elements within"), std::string::npos)
            << builder.refusal();
    }
    {
        GltfBuilder builder;
        builder.addTriangle();
        builder.json["bufferViews"][0]["byteLength"] = 1000000;
        EXPECT_NE(builder.refusal().find("within the 36 bytes of buffers/0"), std::string::npos)
            << builder.refusal();
    }
}

TEST(GltfGeometry, ScalesFromCentimetresToKilometres) {
    for (const double scale : {0.01, 1.0, 10000.0}) {
        GltfBuilder builder;
        builder.addTriangle({{"scale", {scale, scale, scale}}, {"translation", {scale, 0, 0}}});
        const Bounds bounds = worldBounds(builder.import());
        EXPECT_NEAR(bounds.max.x, 2.0 * scale, 1e-9 * scale);
        EXPECT_NEAR(bounds.min.x, scale, 1e-9 * scale);
    }
}

TEST(GltfGeometry, AccessorsWithoutDataCannotClaimMemory) {
    GltfBuilder builder;
    builder.json["accessors"] = {{{"componentType", 5126}, {"type", "VEC3"}, {"count", 2000000000}}};
    builder.addMesh({{"attributes", {{"POSITION", 0}}}});
    EXPECT_NE(builder.refusal().find("MiB of geometry"), std::string::npos) << builder.refusal();
}

} // namespace
} // namespace kilolux::test
