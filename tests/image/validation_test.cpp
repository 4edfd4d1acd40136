// Whole frames of every method under validation with a command buffer for each pass: only so are hazards
// between passes seen, and the last test shows that they would be.
#include "renderer/gpu/commands.h"
#include "tests/image/image_kit.h"
#include "tests/image/image_scenes.h"

#include <cstdlib>
#include <gmock/gmock.h>

namespace kilolux::test {
namespace {

class PassHazards : public ::testing::Test {
  protected:
    PassHazards() {
        const char* before = std::getenv("KILOLUX_VALIDATION");
        before_ = before ? before : "";
        setenv("KILOLUX_VALIDATION", "passes", 1);
    }
    ~PassHazards() override { setenv("KILOLUX_VALIDATION", before_.c_str(), 1); }

    // What went wrong, empty for nothing. The last frames are guided and reprojected.
    static std::string render(const std::string& method, const std::vector<std::string>& settings) {
        const Scene scene = stageScene(lightCases());
        RenderOptions options = smallOptions(48, 40, settings);
        options.method = method;
        options.frames = 3;
        Result<std::unique_ptr<Renderer>> renderer = Renderer::create(scene, options);
        if (!renderer) return renderer.error();
        const Result<Picture> picture = renderer.value()->render({});
        return picture ? "" : picture.error();
    }

  private:
    std::string before_;
};

TEST_F(PassHazards, NoneInAnyMethod) {
    for (const NamedChoice& method : Renderer::methods())
        EXPECT_EQ(render(std::string(method.name), {"jitter=true"}), "") << method.name;
}

TEST_F(PassHazards, NoneWithMoreRaysOrHalfResolution) {
    for (const char* mode : {"raysPerPixel=4", "raysPerPixel=0.25", "sampling=rooks", "renderScale=0.7"})
        EXPECT_EQ(render("stochastic", {mode}), "") << mode;
}

TEST_F(PassHazards, WouldBeSeen) {
    gpu::Commands::dropBarriersForTest = true;
    const std::string error = render("stochastic", {});
    gpu::Commands::dropBarriersForTest = false;
    EXPECT_THAT(error, ::testing::HasSubstr("SYNC-HAZARD"));
}

} // namespace
} // namespace kilolux::test
