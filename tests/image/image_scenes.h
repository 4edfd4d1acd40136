// Small scenes made in code for the image tests: a stage with matt, glossy and metallic surfaces, a ball and
// a box that cast shadows, and one light of each kind above it.
#pragma once

#include "tests/unit/oracle/scene_builder.h"

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace kilolux::test {

using oracle::lightDef;
using oracle::lookingAlong;
using oracle::SceneBuilder;

// A light, named for messages, and where it hangs over the stage.
struct LightCase {
    std::string name;
    LightDef def;
    glm::dmat4 worldFromLight{1.0};
};

void PrintTo(const LightCase& light, std::ostream* out);

// One of each type, and the ones without extent: point, spot without radius, sun without diameter.
const std::vector<LightCase>& lightCases();

// Doors, with shadows of half the source; profiles as shape and mask; light functions.
std::vector<LightCase> shapedLights();

// Rectangles with a picture of four colours: low over the stage, and higher between doors behind a mask.
std::vector<LightCase> pictureLights();

// The stage lit by the given lights. Its camera is scene.cameras[0].
Scene stageScene(const std::vector<LightCase>& lights);

// A node whose quads lie flat and look up, width along x, height along z.
glm::dmat4 floorAt(const glm::dvec3& position);

// All of a scene moved, and scaled about the origin first: lengths by `scale`, candela and lumen by its
// square, so that illuminance and luminance stay.
Scene placedScene(Scene scene, double scale, const glm::dvec3& offsetM);

// Flat: corners get their face's normal and are split for it. Round: normals point away from the local
// origin.
enum class Shading { Flat, Round };

// Adds `primitive`, normals and bounds made, under a node of its own; returns the node.
int addPrimitive(SceneBuilder& builder, const Primitive& primitive, Shading shading,
                 const glm::dmat4& worldFromNode, int material);

Camera cameraLooking(const glm::dvec3& from, const glm::dvec3& to, double yfovRad = 0.8);

// RGBA8 from a function of the texel; 256 x 256, which the renderer keeps as it is.
std::shared_ptr<const Image> makeImage(const std::function<glm::dvec4(int, int)>& texel);

} // namespace kilolux::test
