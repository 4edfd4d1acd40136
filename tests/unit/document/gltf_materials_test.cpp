// Materials, texture references, images and tangents of the glTF import.
#include "tests/unit/document/gltf_builder.h"

#include <OpenImageIO/imageio.h>
#include <cmath>

namespace kilolux::test {
namespace {

// A picture of one colour as a file in the folder.
void writePng(const TempFolder& folder, const std::string& name, int width, int height,
              std::vector<std::uint8_t> pixel) {
    auto output = OIIO::ImageOutput::create("png");
    OIIO::ImageSpec spec(width, height, static_cast<int>(pixel.size()), OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    ASSERT_TRUE(output && output->open((folder.path() / name).string(), spec));
    std::vector<std::uint8_t> pixels;
    for (int i = 0; i < width * height; ++i)
        pixels.insert(pixels.end(), pixel.begin(), pixel.end());
    ASSERT_TRUE(output->write_image(OIIO::TypeDesc::UINT8, pixels.data()));
    output->close();
}

Scene importFrom(const TempFolder& folder, const GltfBuilder& builder) {
    auto scene = importGltf(builder.write(folder));
    if (!scene) ADD_FAILURE() << scene.error();
    return scene ? scene.value() : Scene{};
}

TEST(GltfMaterials, FactorsModesAndExtensions) {
    GltfBuilder builder;
    builder.json["materials"] = {
        {{"name", "lamp"},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"metallicFactor", 0.5}, {"roughnessFactor", 0.25}}},
         {"emissiveFactor", {1, 0.5, 0}},
         {"alphaMode", "MASK"},
         {"alphaCutoff", 0.3},
         {"doubleSided", true},
         {"extensions",
          {{"KHR_materials_emissive_strength", {{"emissiveStrength", 200}}},
           {"KHR_materials_transmission", {{"transmissionFactor", 0.7}}}}}},
        Json::object(),
        {{"alphaMode", "BLEND"}, {"extensions", {{"KHR_materials_unlit", Json::object()}}}}};
    const Scene scene = builder.import();
    ASSERT_EQ(scene.materials.size(), 3u);
    const Material& lamp = scene.materials[0];
    EXPECT_EQ(lamp.name, "lamp");
    EXPECT_EQ(lamp.baseColorFactor, glm::dvec4(0.1, 0.2, 0.3, 0.4));
    EXPECT_EQ(lamp.metallicFactor, 0.5);
    EXPECT_EQ(lamp.roughnessFactor, 0.25);
    EXPECT_EQ(lamp.emissiveNit, glm::dvec3(200, 100, 0));
    EXPECT_EQ(lamp.alphaMode, AlphaMode::Mask);
    EXPECT_EQ(lamp.alphaCutoff, 0.3);
    EXPECT_TRUE(lamp.doubleSided);
    EXPECT_EQ(lamp.transmission, 0.7);
    EXPECT_EQ(scene.materials[1].metallicFactor, 1.0) << "glTF's default";
    EXPECT_EQ(scene.materials[2].alphaMode, AlphaMode::Blend);
    EXPECT_EQ(scene.materials[2].metallicFactor, 0.0);
    EXPECT_TRUE(hasWarning(scene, "unlit"));
}

TEST(GltfMaterials, TexturesWithSamplerAndTransform) {
    const TempFolder folder;
    writePng(folder, "base color.png", 4, 2, {10, 20, 30, 128});
    GltfBuilder builder;
    builder.json["images"] = {{{"uri", "base%20color.png"}}, {{"uri", "base color.png"}}};
    builder.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}};
    builder.json["textures"] = {{{"source", 0}, {"sampler", 0}}, {{"source", 1}}};
    builder.json["materials"] = {
        {{"pbrMetallicRoughness",
          {{"baseColorTexture",
            {{"index", 0},
             {"texCoord", 0},
             {"extensions",
              {{"KHR_texture_transform",
                {{"offset", {0.5, 0.25}}, {"rotation", 1.5}, {"scale", {2, 3}}, {"texCoord", 1}}}}}}},
           {"metallicRoughnessTexture", {{"index", 1}}}}}}};
    const Scene scene = importFrom(folder, builder);
    const TextureRef& ref = scene.materials[0].baseColor;
    EXPECT_EQ(ref.wrapS, WrapMode::ClampToEdge);
    EXPECT_EQ(ref.wrapT, WrapMode::MirroredRepeat);
    EXPECT_TRUE(ref.nearestFilter);
    EXPECT_EQ(ref.offset, glm::dvec2(0.5, 0.25));
    EXPECT_EQ(ref.scale, glm::dvec2(2, 3));
    EXPECT_EQ(ref.rotationRad, 1.5);
    EXPECT_EQ(ref.texCoord, 1);
    EXPECT_EQ(scene.materials[0].metallicRoughness.wrapS, WrapMode::Repeat);
    ASSERT_EQ(scene.images.size(), 1u) << "one file is one image, however it is spelled";
    EXPECT_EQ(ref.image, 0);
    EXPECT_EQ(scene.materials[0].metallicRoughness.image, 0);
    EXPECT_EQ(scene.images[0]->width, 4);
    EXPECT_EQ(scene.images[0]->height, 2);
    const std::vector<std::uint8_t> pixel(scene.images[0]->rgba8.begin(), scene.images[0]->rgba8.begin() + 4);
    EXPECT_EQ(pixel, (std::vector<std::uint8_t>{10, 20, 30, 128})) << "alpha is not multiplied in";
}

TEST(GltfMaterials, AMissingOrDamagedImageCostsAWarningOnly) {
    const TempFolder folder;
    folder.write("damaged.png", "\x89PNG\r\n\x1a\nnothing else");
    GltfBuilder builder;
    builder.addTriangle();
    builder.json["images"] = {{{"uri", "missing.png"}}, {{"uri", "damaged.png"}}, {{"uri", "../escape.png"}}};
    builder.json["textures"] = {{{"source", 0}}, {{"source", 1}}, {{"source", 2}}};
    builder.json["materials"] = {{{"normalTexture", {{"index", 0}}}},
                                 {{"normalTexture", {{"index", 1}}}},
                                 {{"normalTexture", {{"index", 2}}}},
                                 {{"normalTexture", {{"index", 99}}}}};
    const Scene scene = importFrom(folder, builder);
    for (const Material& material : scene.materials)
        EXPECT_EQ(material.normal.image, -1);
    EXPECT_TRUE(hasWarning(scene, "/images/0/uri"));
    EXPECT_TRUE(hasWarning(scene, "/images/1"));
    EXPECT_TRUE(hasWarning(scene, "within the folder"));
    EXPECT_TRUE(hasWarning(scene, "/materials/3/normalTexture/index"));
    EXPECT_EQ(triangleCount(scene), 1u);
}

// A square of two triangles with a normal map; u grows along `uAxis`, v (downwards in the picture) along
// `vAxis`.
Scene squareWithNormalMap(glm::vec2 uAxis, glm::vec2 vAxis) {
    const TempFolder folder;
    writePng(folder, "normal.png", 1, 1, {128, 128, 255});
    GltfBuilder builder;
    const std::vector<float> corners = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    std::vector<float> uv, normals;
    for (int i = 0; i < 4; ++i) {
        const glm::vec2 corner(corners[i * 3], corners[i * 3 + 1]);
        uv.insert(uv.end(), {glm::dot(corner, uAxis), glm::dot(corner, vAxis)});
        normals.insert(normals.end(), {0, 0, 2});
    }
    builder.json["images"] = {{{"uri", "normal.png"}}};
    builder.json["textures"] = {{{"source", 0}}};
    builder.json["materials"] = {{{"normalTexture", {{"index", 0}}}}};
    const Json attributes = {{"POSITION", builder.addVec3(corners)},
                             {"NORMAL", builder.addVec3(normals)},
                             {"TEXCOORD_0", builder.addVec2(uv)}};
    builder.addMesh(
        {{"attributes", attributes}, {"indices", builder.addIndices({0, 1, 2, 0, 2, 3})}, {"material", 0}});
    return importFrom(folder, builder);
}

TEST(GltfTangents, PointAlongUAndTheBitangentUpInThePicture) {
    const struct {
        glm::vec2 uAxis, vAxis;
    } kCases[] = {{{1, 0}, {0, -1}}, {{-1, 0}, {0, -1}}, {{0, 1}, {1, 0}}, {{3, 0}, {0, 0.5f}}};
    for (const auto& [uAxis, vAxis] : kCases) {
        const Scene scene = squareWithNormalMap(uAxis, vAxis);
        const Primitive& primitive = scene.meshes[0]->primitives[0];
        ASSERT_EQ(primitive.tangents.size(), 4u);
        for (std::size_t i = 0; i < 4; ++i) {
            const glm::vec3 tangent(primitive.tangents[i]);
            const glm::vec3 bitangent = glm::cross(primitive.normals[i], tangent) * primitive.tangents[i].w;
            EXPECT_NEAR(glm::distance(tangent, glm::vec3(glm::normalize(uAxis), 0)), 0.0, 1e-6);
            EXPECT_NEAR(glm::distance(bitangent, -glm::vec3(glm::normalize(vAxis), 0)), 0.0, 1e-6);
        }
    }
}

TEST(GltfTangents, AMirrorSeamSplitsItsVertices) {
    const TempFolder folder;
    writePng(folder, "normal.png", 1, 1, {128, 128, 255});
    GltfBuilder builder;
    // Two squares side by side; u runs to the seam x = 1 and back.
    const std::vector<float> positions = {0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0};
    const std::vector<float> uv = {0, 1, 1, 1, 0, 1, 0, 0, 1, 0, 0, 0};
    std::vector<float> normals;
    for (int i = 0; i < 6; ++i)
        normals.insert(normals.end(), {0, 0, 1});
    builder.json["images"] = {{{"uri", "normal.png"}}};
    builder.json["textures"] = {{{"source", 0}}};
    builder.json["materials"] = {{{"normalTexture", {{"index", 0}}}}};
    const Json attributes = {{"POSITION", builder.addVec3(positions)},
                             {"NORMAL", builder.addVec3(normals)},
                             {"TEXCOORD_0", builder.addVec2(uv)}};
    builder.addMesh({{"attributes", attributes},
                     {"indices", builder.addIndices({0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4})},
                     {"material", 0}});
    const Scene scene = importFrom(folder, builder);
    const Primitive& primitive = scene.meshes[0]->primitives[0];
    EXPECT_EQ(primitive.positions.size(), 8u);
    ASSERT_EQ(primitive.indices.size(), 12u);
    for (int corner = 0; corner < 12; ++corner) {
        const glm::vec4 tangent = primitive.tangents[primitive.indices[corner]];
        EXPECT_EQ(tangent, corner < 6 ? glm::vec4(1, 0, 0, 1) : glm::vec4(-1, 0, 0, -1)) << corner;
    }
}

TEST(GltfTangents, TangentsOfTheFileAreKept) {
    GltfBuilder builder;
    const int tangents = builder.addAccessor(std::vector<float>{2, 0, 1, -1, 2, 0, 1, -1, 2, 0, 1, -1},
                                             Component::Float, "VEC4", 3);
    builder.addMesh({{"attributes",
                      {{"POSITION", builder.addVec3({0, 0, 0, 1, 0, 0, 0, 1, 0})},
                       {"NORMAL", builder.addVec3({0, 0, 1, 0, 0, 1, 0, 0, 1})},
                       {"TANGENT", tangents}}}});
    const Scene scene = builder.import();
    EXPECT_EQ(scene.meshes[0]->primitives[0].tangents[0], glm::vec4(1, 0, 0, -1)) << "made perpendicular";
}

} // namespace
} // namespace kilolux::test
