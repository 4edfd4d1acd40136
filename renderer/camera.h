// From a document camera to what a frame needs: rays per pixel and the clip matrix, both relative to an
// anchor near the camera, so that scenes far from the origin keep their precision.
#pragma once

#include "renderer/document/scene.h"
#include "renderer/settings.h"
#include "shaders/shared/frame.h"

#include <glm/glm.hpp>

namespace kilolux {

// A camera that shows the whole scene from a corner in a picture of this shape (width / height), for files
// without one. Named "derived".
Camera derivedCamera(const Scene& scene, double aspect);

// The point that GPU positions are relative to: the camera's position rounded to a coarse grid, so that it
// moves in steps; the origin itself while the camera is within half a step of it. A step is about half the
// scene's extent, at most 256 m: a stage of centimetres keeps its digits a hundred metres from the origin.
glm::dvec3 anchorFor(const Camera& camera, const Bounds& scene);

// Fills camera rays, matrices and sizes. `jitterPx` moves the sample position within the pixel, in pixels.
// Pictures of another shape than the camera's keep its vertical field of view. `aspect`: width / height of
// the picture that is shown, where the rendered pixels are fewer and their counts rounded; 0 takes theirs.
void setCamera(shared::FrameConstants& frame, const Camera& camera, const glm::dvec3& anchor, int widthPx,
               int heightPx, glm::dvec2 jitterPx, double aspect = 0.0);

// Conservative, for culling: false only if all corners of a box lie outside one side of the clip volume.
bool boxMayBeSeen(const glm::dmat4& clipFromWorld, const glm::dvec3& lower, const glm::dvec3& upper);

// Sub-pixel offset of the i-th progressive sample, in pixels about the centre, distributed as the filter
// (filter importance sampling): the plain mean of samples is then the filtered picture. The same for every
// seed: pictures of as many frames have the same edges, and what differs between them is light.
glm::dvec2 filterOffset(PixelFilter filter, std::uint32_t index);

} // namespace kilolux
