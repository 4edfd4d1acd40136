// Skies for tests, and a ball alone under one.
#pragma once

#include "tests/image/image_scenes.h"

namespace kilolux::test {

// HDR, `width` x `width` / 2, from the radiance of a direction.
std::shared_ptr<const Image> panorama(int width,
                                      const std::function<glm::dvec3(const glm::dvec3&)>& radiance);

glm::dvec3 gradientSky(const glm::dvec3& dir); // smooth, brighter and bluer above, warm on one side
glm::dvec3 sunnySky(const glm::dvec3& dir);    // most of its light in a sun of 4 degrees

// A ball of rough dielectric with flat faces, nothing else and no light. Its camera is scene.cameras[0].
Scene ballScene();

} // namespace kilolux::test
