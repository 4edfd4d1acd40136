// The document: everything a person can open, edit and save, as a value in double precision.
// Meshes and images are shared and immutable; nodes and lights are plain arrays, copied on write by the
// editor. Lengths are metres, angles radians, +Y up, right-handed; lights and cameras look down local -Z.
#pragma once

#include "renderer/document/copy_on_write.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace kilolux {

// ---------------------------------------------------------------------------------------------------------
// Images and materials

enum class ColorSpace { Srgb, Linear };

// Row-major, top row first. `rgba8` holds 4 bytes a pixel, or `rgbaF32` 4 floats a pixel (HDR); never both.
struct Image {
    std::string name; // URI or name in the file, for messages
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba8;
    std::vector<float> rgbaF32;
};

enum class WrapMode : std::uint8_t { Repeat, ClampToEdge, MirroredRepeat };

// A use of an image by a material: KHR_texture_transform included (uv' = offset + R(rotation) * scale * uv).
struct TextureRef {
    int image = -1; // into Scene::images; -1 means none
    int texCoord = 0;
    WrapMode wrapS = WrapMode::Repeat;
    WrapMode wrapT = WrapMode::Repeat;
    bool nearestFilter = false;
    glm::dvec2 offset{0.0};
    glm::dvec2 scale{1.0};
    double rotationRad = 0.0;
};

enum class AlphaMode : std::uint8_t { Opaque, Mask, Blend };

struct Material {
    std::string name;
    glm::dvec4 baseColorFactor{1.0};
    TextureRef baseColor; // sRGB
    double metallicFactor = 1.0;
    double roughnessFactor = 1.0;
    TextureRef metallicRoughness; // linear, G roughness, B metallic
    TextureRef normal;            // linear, tangent space
    double normalScale = 1.0;
    glm::dvec3 emissiveNit{0.0}; // emissiveFactor x KHR_materials_emissive_strength; 1 means 1 cd/m2
    TextureRef emissive;         // sRGB
    AlphaMode alphaMode = AlphaMode::Opaque;
    double alphaCutoff = 0.5;
    bool doubleSided = false;
    double transmission = 0.0; // KHR_materials_transmission factor
};

// ---------------------------------------------------------------------------------------------------------
// Geometry

// A triangle list. Attributes are per vertex and either empty or as long as `positions`; normals and tangents
// are unit length after import (generated where the file has none). Triangles wind counter-clockwise.
struct Primitive {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec4> tangents; // xyz, w = handedness
    std::vector<glm::vec2> uv0;
    std::vector<glm::vec2> uv1;
    std::vector<glm::vec4> colors; // linear RGBA
    std::vector<std::uint32_t> indices;
    int material = -1; // into Scene::materials; -1 is the default material
    glm::vec3 boundsMin{0.0f};
    glm::vec3 boundsMax{0.0f};
};

struct Mesh {
    std::string name;
    std::vector<Primitive> primitives;
};

// ---------------------------------------------------------------------------------------------------------
// Lights

enum class LightType : std::uint8_t { Directional, Sphere, Spot, Tube, Rect, Disk };

// What the typed intensity value means. The typed pair is what is kept when size or cone changes.
enum class LightUnit : std::uint8_t { Lumen, Candela, Lux, Nit, Ev100 };

// A flap hinged to one edge of a rectangle light.
struct BarnDoor {
    // From the beam to the flap: 0 stands straight ahead (-Z), pi/2 is open, in the plane of the light.
    double angleRad = 1.57079632679489661923;
    double lengthM = 0.0; // 0 is without a flap
    bool operator==(const BarnDoor&) const = default;
};
// As seen from behind the light, which looks along -Z: local -X, +X, +Y, -Y. A flap is as wide as its edge.
enum class BarnDoorSide : std::uint8_t { Left, Right, Top, Bottom };

struct IesProfile; // ies_profile.h

// What a photometric profile does. Shape: the light emits as the profile says, in place of the type's own
// distribution (Lambert, cone). Mask: it multiplies that distribution, 1 at the profile's maximum.
enum class IesUse : std::uint8_t { None, Shape, Mask };

// A mask that the light shines through. It is laid over the plane 1 m ahead: p = (x, y) / |z| of a direction
// in the light's own frame, for a directional light metres about its node. Turned by `angleRad` and divided
// by `scale` this gives the pattern's coordinates, in which it repeats every 1. Light is multiplied with 1 -
// strength * (1 - pattern).
enum class LightFunctionKind : std::uint8_t { None, Image, Grid, Blinds, Caustics, Flicker };
struct LightFunction {
    LightFunctionKind kind = LightFunctionKind::None;
    std::string imageUri;               // luminance of an image
    std::shared_ptr<const Image> image; // what the URI names; null where it cannot be read
    double scale = 1.0;
    double angleRad = 0.0;
    double softness = 0.1; // of a pattern's edges, 0 hard to 1
    double strength = 1.0; // 0 to 1
    double seed = 0.0;     // caustics and flicker: which of them
    double speed = 1.0;    // caustics and flicker: of their motion; 0 stands still
};

// A light definition, shared by any number of light nodes, as in KHR_lights_punctual.
struct LightDef {
    std::string name;
    LightType type = LightType::Sphere;
    double intensity = 1.0; // in `unit`
    LightUnit unit = LightUnit::Candela;
    glm::dvec3 color{1.0};              // linear Rec. 709 tint; luminance is not normalized (glTF's rule)
    std::optional<double> temperatureK; // multiplies the tint when present
    std::optional<double> rangeM;       // smooth window; absent means derived by the renderer
    double radiusM = 0.0;               // sphere, spot and tube; 0 on sphere and spot is a point
    double lengthM = 0.0;      // tube: distance between the centres of its two end caps, along local X
    double widthM = 1.0;       // rectangle: local X; disk: diameter
    double heightM = 1.0;      // rectangle: local Y
    double innerConeRad = 0.0; // spot, half angle
    double outerConeRad = 0.78539816339744830962; // spot, half angle, at most pi/2
    double angularDiameterRad = 0.0;              // directional
    std::array<BarnDoor, 4> barnDoors{};          // rectangle; by BarnDoorSide
    // Photometric profile of any light with a place. The URI is relative to the scene's folder, a data URI,
    // or
    // '#/...' into the scene's file.
    std::string iesUri;
    std::shared_ptr<const IesProfile> ies; // what the URI names; null where it cannot be read
    IesUse iesUse = IesUse::None;
    bool iesIntensity = true;                 // Shape: the profile's candela in place of `intensity`
    double iesMultiplier = 1.0;               // of the profile's candela
    std::string sourceUri;                    // rectangle: picture on its face, top towards +Y
    std::shared_ptr<const Image> sourceImage; // null where it cannot be read
    LightFunction function;
    double exposureEv = 0.0;    // a factor on all that the light emits, 2^exposureEv
    double rayEndBiasM = 0.0;   // shadow rays stop this far before the light (mission L7)
    double penumbraScale = 1.0; // of the source's size as shadows see it; shading keeps the true size
    std::uint8_t channels = 1;  // bits; the light reaches meshes that share one with it
    bool channelsCast = true;   // meshes that it does not reach cast its shadow
    std::string pointer; // JSON pointer of the definition in the source file; empty when made by the tool
};

// A node that carries a light. One node never carries two.
struct LightNode {
    // Names the light for edits, light slots and whatever remembers it from frame to frame: the import counts
    // from 1 in file order, sorting, undo and redo keep it, and no two lights of a scene share one. 0 is a
    // light made in memory that nobody has named yet.
    std::uint64_t id = 0;
    int node = -1; // into Scene::nodes: its world transform places the light
    int def = -1;  // into Scene::lightDefs
    bool muted = false;
    std::uint64_t group = 0; // LightGroup::id; 0 is none
};

// Lights that are dimmed, tinted and muted together.
struct LightGroup {
    std::uint64_t id = 0;    // among groups, as LightNode::id
    std::string name;        // not empty, no two groups of a scene share one
    double intensity = 1.0;  // factor on every member
    double exposureEv = 0.0; // a second factor, 2^exposureEv
    glm::dvec3 tint{1.0};    // a third one, per channel, linear Rec. 709
    bool muted = false;
};

// ---------------------------------------------------------------------------------------------------------
// Cameras, nodes, scene

struct Camera {
    std::uint64_t id = 0; // among cameras, as LightNode::id
    std::string name;
    bool orthographic = false;
    double yfovRad = 0.8;
    std::optional<double> aspect; // absent: the picture's
    double znearM = 0.01;
    std::optional<double> zfarM; // absent: infinite
    double xmagM = 1.0;          // orthographic half extents
    double ymagM = 1.0;
    glm::dmat4 worldFromCamera{1.0}; // rigid: scale removed
    int node = -1; // into Scene::nodes: poseScene() takes the camera along with it; -1 stands on its own
};

// A node's transform in parts: scaled first, then turned, then moved.
struct Trs {
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0}; // w, x, y, z; unit length
    glm::dvec3 scale{1.0};
};
glm::dmat4 matrixFrom(const Trs& trs);

struct Node {
    std::uint64_t id = 0; // among nodes, as LightNode::id
    std::string name;
    int parent = -1;
    glm::dmat4 localFromNode{1.0}; // parent from this
    // The same in parts, at rest: what poseScene() fills in where no animation speaks. Who moves an animated
    // node changes both. Absent where the file gives a matrix: such a node cannot be animated.
    std::optional<Trs> restTrs;
    glm::dmat4 worldFromNode{1.0}; // kept by updateWorldTransforms()
    int mesh = -1;
    std::uint8_t meshChannels = 1; // bits; lights that share one reach the mesh
    bool visible = true;           // reachable from the default scene
};

struct Animation; // animation.h

// Light from all around, without a place. Off where an intensity is 0.
struct Dome {
    std::string imageUri;               // latitude-longitude, the middle towards -Z; none: one colour
    std::shared_ptr<const Image> image; // null where it cannot be read
    glm::dvec3 color{1.0};              // linear Rec. 709; on the image as well
    double intensityNit = 0.0;          // of a white pixel with the value 1
    double rotationRad = 0.0;           // about +Y
    bool visible = true;                // behind the scene, where nothing else is
    // A plain ambient light, not shadowed, for context; stated wherever it is on.
    glm::dvec3 fillColor{1.0};
    double fillNit = 0.0;
};

class SceneFiles; // scene_files.h

struct Scene {
    std::filesystem::path sourcePath;
    std::vector<std::shared_ptr<const Image>> images;
    std::vector<Material> materials;
    std::vector<std::shared_ptr<const Mesh>> meshes;
    CopyOnWrite<Node> nodes; // in file order; parents may come later
    std::vector<Camera> cameras;
    CopyOnWrite<LightDef> lightDefs;
    CopyOnWrite<LightNode> lights; // by id, which is node order on load; the index is then the light's slot
    CopyOnWrite<LightGroup> groups;
    std::vector<Camera> bookmarks; // views that the user keeps; `node` is -1
    std::vector<std::shared_ptr<const Animation>> animations;
    Dome dome;
    // Where profiles and pictures of lights come from, shared by all copies of a document; null in memory.
    std::shared_ptr<SceneFiles> files;
    double exposureEv100 = 0.0; // from scene extras.kilolux.exposureEv100, else derived by the renderer
    bool hasExposure = false;
    std::vector<std::string> warnings; // what the import could not honour, one line each
};

// The corners of a flap in the light's own frame, metres: two at the hinge, then two at its free edge.
std::array<glm::dvec3, 4> barnDoorCorners(const LightDef& def, BarnDoorSide side);

// Recomputes every node's worldFromNode from the local transforms.
void updateWorldTransforms(Scene& scene);

// Products of two such transforms stay finite in single precision as well.
bool fitsSinglePrecision(const glm::dmat4& matrix);

// The frame of a node without its scale or mirroring: a camera looks down -Z with +Y up whatever its parents
// do.
glm::dmat4 rigidFrame(const glm::dmat4& worldFromNode);

// What the light's group multiplies its colour with; 1 without a group, 0 in a muted one.
glm::dvec3 groupFactor(const Scene& scene, const LightNode& light);

// Bounds of all visible geometry in metres; {0,0,0} twice for a scene without triangles.
struct Bounds {
    glm::dvec3 min{0.0};
    glm::dvec3 max{0.0};
};
Bounds worldBounds(const Scene& scene);

std::size_t triangleCount(const Scene& scene); // instances counted each

} // namespace kilolux
