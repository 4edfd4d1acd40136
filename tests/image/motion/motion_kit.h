// Frame-by-frame rendering for the tests of motion and history: a renderer whose targets are read after every
// frame, cameras with pixels of a known size, and scenes small enough to say what must come out.
#pragma once

#include "renderer/document/animation.h"
#include "tests/image/image_kit.h"
#include "tests/image/image_scenes.h"

namespace kilolux::test {

// The stochastic method with jitter off, white noise and the compute G-buffer; then `settings`.
RenderOptions stochasticOptions(int width, int height, const std::vector<std::string>& settings = {});

class FrameRig {
  public:
    FrameRig(const Scene& scene, RenderOptions options);

    // Renders the next frame and reads its targets. Messages of the validation layer and unclean targets fail
    // the test.
    FrameTargets frame();
    FrameTargets partialFrame(); // the same of a frame that does not fill its targets: not held to be clean
    void frames(int count);      // without reading them
    Picture picture() const { return renderer_->picture(); }
    Renderer& renderer() { return *renderer_; }

  private:
    std::unique_ptr<Renderer> renderer_;
};

// A channel of a float target, in the target's own layout.
float valueAt(const FrameTargets& targets, const std::string& name, std::size_t pixel, int channel);
// A word of an integer target, layer 0. `wordsPerPixel` as its format has.
std::uint32_t wordAt(const FrameTargets& targets, const std::string& name, std::size_t pixel, int word,
                     int wordsPerPixel);
bool isMissed(const FrameTargets& targets, std::size_t pixel); // SAMPLE_MISSED

// Mean luminance of a picture.
double meanLuminance(const Picture& picture);
// Sum of |a - b| over the sum of b, luminance.
double relativeDifference(const Picture& a, const Picture& b);

// Orthographic, looking along `direction`, pixels of `pixelM` metres in pictures `heightPx` high.
Camera orthographicCamera(const glm::dvec3& from, const glm::dvec3& direction, double pixelM, int heightPx);
// Moved by whole pixels of such a camera: to the right and down in the picture.
Camera movedByPixels(const Camera& camera, double pixelM, glm::dvec2 px);

// The slots on a visible list, unpacked by the tests' own arithmetic.
std::vector<std::uint32_t> slotsOfTile(const std::vector<glm::uvec2>& lists, std::size_t tile);
// A list of one entry, seen in the frame before in all quarters, in place of a tile's own.
void setOneEntry(std::vector<glm::uvec2>& lists, std::size_t tile, std::uint32_t slot);

// A matt floor, 40 x 40 m about the origin at y = 0, without lights.
SceneBuilder bareFloor();

} // namespace kilolux::test
