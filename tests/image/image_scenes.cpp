#include "tests/image/image_scenes.h"

#include "renderer/document/ies_profile.h"
#include "tests/unit/accel/scene_kit.h"

namespace kilolux::test {

namespace {

using glm::dvec3;

LightCase sized(std::string name, LightType type, double intensity, LightUnit unit, const glm::dmat4& place,
                const std::function<void(LightDef&)>& change) {
    LightCase result{std::move(name), lightDef(type, intensity, unit), place};
    result.def.color = {1.0, 0.6, 0.35};
    change(result.def);
    return result;
}

std::vector<LightCase> makeLightCases() {
    const glm::dmat4 above = lookingAlong({-0.7, 2.4, 0.4}, {0.3, -1.0, -0.1});
    const glm::dmat4 sun = lookingAlong({0, 5, 0}, {0.4, -1.0, -0.35});
    std::vector<LightCase> cases;
    const auto add = [&](std::string name, LightType type, double intensity, LightUnit unit,
                         const glm::dmat4& place, const std::function<void(LightDef&)>& change) {
        cases.push_back(sized(std::move(name), type, intensity, unit, place, change));
    };
    add("rect", LightType::Rect, 3000, LightUnit::Lumen, above, [](LightDef& d) {
        d.widthM = 1.2;
        d.heightM = 0.5;
    });
    add("disk", LightType::Disk, 5000, LightUnit::Nit, above, [](LightDef& d) { d.widthM = 0.7; });
    add("sphere", LightType::Sphere, 2000, LightUnit::Lumen, above, [](LightDef& d) {
        d.radiusM = 0.25;
        d.rangeM = 6.0;
    });
    add("tube", LightType::Tube, 2500, LightUnit::Lumen, above, [](LightDef& d) {
        d.radiusM = 0.06;
        d.lengthM = 1.1;
    });
    add("spot", LightType::Spot, 800, LightUnit::Candela, above, [](LightDef& d) {
        d.radiusM = 0.1;
        d.innerConeRad = 0.35;
        d.outerConeRad = 0.7;
    });
    add("sun", LightType::Directional, 400, LightUnit::Lux, sun,
        [](LightDef& d) { d.angularDiameterRad = glm::radians(6.0); });
    add("point", LightType::Sphere, 300, LightUnit::Candela, above, [](LightDef& d) { d.rangeM = 5.0; });
    add("spotPoint", LightType::Spot, 2000, LightUnit::Lumen, above, [](LightDef&) {});
    add("sunPoint", LightType::Directional, 400, LightUnit::Lux, sun, [](LightDef&) {});
    return cases;
}

} // namespace

void PrintTo(const LightCase& light, std::ostream* out) {
    *out << light.name;
}

const std::vector<LightCase>& lightCases() {
    static const std::vector<LightCase> cases = makeLightCases();
    return cases;
}

std::vector<LightCase> shapedLights() {
    auto profile = std::make_shared<IesProfile>();
    profile->horizontalDeg = {0.0, 90.0, 180.0};
    for (int i = 0; i <= 16; ++i)
        profile->verticalDeg.push_back(5.0 * i);
    for (int row = 0; row < 3; ++row) {
        for (int i = 0; i <= 16; ++i)
            profile->candela.push_back((16 - i) * (8.0 + 4.0 * row) * (1.0 + 0.5 * std::cos(i)));
    }
    std::vector<LightCase> lights{lightCases()[0], lightCases()[2], lightCases()[4], lightCases()[3],
                                  lightCases()[5]};
    lights[0].def.barnDoors = {{{0.3, 0.5}, {0.9, 0.4}, {0.2, 0.6}, {1.2, 0.3}}};
    lights[0].def.penumbraScale = 0.5;
    for (std::size_t i = 1; i < 4; ++i) {
        lights[i].def.ies = profile;
        lights[i].def.iesUse = i == 2 ? IesUse::Mask : IesUse::Shape;
        lights[i].def.iesMultiplier = 4.0;
        lights[i].worldFromLight = lookingAlong({1.5 - double(i), 2.2, 0.2 * double(i)}, {0.1, -1.0, 0.2});
    }
    lights[2].def.function = {
        .kind = LightFunctionKind::Grid, .scale = 0.3, .angleRad = 0.4, .softness = 0.5};
    lights[4].def.function = {
        .kind = LightFunctionKind::Blinds, .scale = 0.7, .softness = 0.6, .strength = 0.8};
    return lights;
}

std::vector<LightCase> pictureLights() {
    const std::shared_ptr<const Image> picture = makeImage([](int x, int y) {
        const glm::dvec4 colors[] = {
            {1, 0.1, 0.05, 1}, {0.1, 1, 0.2, 1}, {0.05, 0.2, 1, 1}, {0.02, 0.02, 0.02, 1}};
        return colors[(x < 128 ? 0 : 1) + (y < 128 ? 0 : 2)];
    });
    std::vector<LightCase> lights{lightCases()[0], lightCases()[0]};
    for (LightCase& light : lights) {
        light.def.color = {1.0, 0.9, 0.8};
        light.def.sourceImage = picture;
        light.def.rangeM = 12.0;
    }
    lights[0].name = "picture";
    lights[0].def.heightM = 1.0;
    lights[0].worldFromLight = lookingAlong({-1.2, 1.5, 0.6}, {0.4, -1.0, -0.3});
    lights[1].name = "pictureBetweenDoors";
    lights[1].worldFromLight = lookingAlong({1.3, 2.2, 0.2}, {-0.2, -1.0, 0.1});
    lights[1].def.barnDoors = {{{0.3, 0.5}, {0.9, 0.4}, {0.2, 0.6}, {1.2, 0.3}}};
    lights[1].def.function = {.kind = LightFunctionKind::Grid, .scale = 0.4, .softness = 0.5};
    return lights;
}

glm::dmat4 floorAt(const dvec3& position) {
    return glm::rotate(glm::translate(glm::dmat4(1.0), position), -0.5 * oracle::kPi, dvec3(1, 0, 0));
}

Scene stageScene(const std::vector<LightCase>& lights) {
    SceneBuilder b;
    const int matt = b.material({0.7, 0.5, 0.3}, 0.0, 0.9), glossy = b.material({0.2, 0.4, 0.6}, 0.0, 0.3),
              metal = b.material({0.9, 0.7, 0.4}, 1.0, 0.45), ball = b.material({0.6, 0.6, 0.65}, 0.0, 0.5);
    b.quad(floorAt({-1.5, 0, 0}), 3, 6, matt);
    b.quad(floorAt({1.5, 0, 0}), 3, 6, glossy);
    b.quad(lookingAlong({0, 1.5, -2.5}, {0, 0, -1}), 6, 3, metal);
    addPrimitive(b, makeBox({0.25, 0.25, 0.25}), Shading::Flat,
                 glm::translate(glm::dmat4(1.0), dvec3(-0.4, 0.75, 0.3)), matt);
    addPrimitive(b, makeSphere(16, 24, 0.4), Shading::Round,
                 glm::translate(glm::dmat4(1.0), dvec3(0.8, 0.45, -0.3)), ball);
    for (const LightCase& light : lights)
        b.light(light.def, light.worldFromLight);
    b.scene.cameras.push_back(cameraLooking({0.3, 2.3, 4.6}, {0, 0.6, -0.4}));
    return std::move(b.scene);
}

Scene placedScene(Scene scene, double scale, const dvec3& offsetM) {
    const glm::dmat4 change = glm::scale(glm::translate(glm::dmat4(1.0), offsetM), dvec3(scale));
    for (Node& node : scene.nodes) {
        node.localFromNode = node.worldFromNode = change * node.worldFromNode;
    }
    for (Camera& camera : scene.cameras) {
        camera.worldFromCamera[3] = change * camera.worldFromCamera[3];
        camera.znearM *= scale;
    }
    for (LightDef& def : scene.lightDefs) {
        const bool byArea = def.unit == LightUnit::Lumen || def.unit == LightUnit::Candela;
        if (byArea) def.intensity *= scale * scale;
        for (double* lengthM : {&def.radiusM, &def.lengthM, &def.widthM, &def.heightM})
            *lengthM *= scale;
        if (def.rangeM) *def.rangeM *= scale;
    }
    return scene;
}

int addPrimitive(SceneBuilder& builder, const Primitive& primitive, Shading shading,
                 const glm::dmat4& worldFromNode, int material) {
    Primitive p = primitive;
    p.material = material;
    p.normals.clear();
    if (shading == Shading::Flat) {
        p.positions.clear();
        for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
            const auto corner = [&](std::size_t k) { return primitive.positions[primitive.indices[i + k]]; };
            const glm::vec3 face = glm::normalize(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
            for (std::size_t k = 0; k < 3; ++k) {
                p.positions.push_back(corner(k));
                p.normals.push_back(face);
                p.indices[i + k] = std::uint32_t(i + k);
            }
        }
    } else {
        for (const glm::vec3& position : p.positions)
            p.normals.push_back(glm::normalize(position));
    }
    p.boundsMin = p.boundsMax = p.positions.front();
    for (const glm::vec3& position : p.positions) {
        p.boundsMin = glm::min(p.boundsMin, position);
        p.boundsMax = glm::max(p.boundsMax, position);
    }
    Mesh mesh;
    mesh.primitives.push_back(std::move(p));
    builder.scene.meshes.push_back(std::make_shared<Mesh>(std::move(mesh)));
    const int node = builder.node(worldFromNode);
    builder.scene.nodes[std::size_t(node)].mesh = int(builder.scene.meshes.size()) - 1;
    return node;
}

Camera cameraLooking(const dvec3& from, const dvec3& to, double yfovRad) {
    Camera camera;
    camera.name = "test";
    camera.yfovRad = yfovRad;
    camera.worldFromCamera = lookingAlong(from, to - from);
    return camera;
}

std::shared_ptr<const Image> makeImage(const std::function<glm::dvec4(int, int)>& texel) {
    auto image = std::make_shared<Image>();
    image->name = "made";
    image->width = image->height = 256;
    for (int y = 0; y < 256; ++y) {
        for (int x = 0; x < 256; ++x) {
            const glm::dvec4 value = texel(x, y);
            for (int c = 0; c < 4; ++c)
                image->rgba8.push_back(std::uint8_t(value[c] * 255.0 + 0.5));
        }
    }
    return image;
}

} // namespace kilolux::test
