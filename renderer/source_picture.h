// The picture of a rectangle light, from the document's image to what lights/picture.glsl reads.
#pragma once

#include "renderer/document/scene.h"
#include "renderer/lights_cpp/light_tables.h"

namespace kilolux {

// Linear light at 256 x 256: sRGB bytes are decoded, floats are taken as they are; interpolated where the
// image is smaller, averaged where it is larger. What is not finite or negative is black, and no value is
// above the largest half float.
SourcePicture makeSourcePicture(const Image& image);

// The picture of a light that has one, made once for as long as the document's image lives; null without.
std::shared_ptr<const SourcePicture> sourcePictureOf(const LightDef& def);

// What a light's picture leaves of its light, by channel; 1 without.
glm::dvec3 pictureMean(const LightDef& def);

} // namespace kilolux
