// The baseline with shadow maps: it has the light of rays where shadows are simple, penumbrae as wide as the
// source makes them, and draws again only what has changed.
#include "renderer/document/animation.h"
#include "renderer/shadow_maps.h"
#include "tests/image/loop/loop_kit.h"

#include <algorithm>
#include <cmath>

namespace kilolux::test {
namespace {

RenderOptions mapOptions(const char* method, int frames, const std::vector<std::string>& settings = {}) {
    RenderOptions options = smallOptions(64, 48, settings);
    options.method = method;
    options.frames = frames;
    options.settings.exposureEv100 = {false, 6.0};
    return options;
}

double luminanceAt(const Picture& picture, std::size_t pixel) {
    return luminanceOf(
        glm::dvec3(picture.rgb[pixel * 3], picture.rgb[pixel * 3 + 1], picture.rgb[pixel * 3 + 2]));
}

struct Difference {
    double ofMean = 0.0;     // relative
    double otherShare = 0.0; // of the pixels: more than a tenth off
};

Difference differenceOf(const Picture& tested, const Picture& wanted) {
    double sum = 0.0, sumWanted = 0.0;
    std::size_t other = 0;
    const std::size_t pixels = wanted.rgb.size() / 3;
    for (std::size_t i = 0; i < pixels; ++i) {
        const double a = luminanceAt(tested, i), b = luminanceAt(wanted, i);
        sum += a;
        sumWanted += b;
        other += std::abs(a - b) > 0.1 * b + 1e-3;
    }
    return {sum / sumWanted - 1.0, double(other) / double(pixels)};
}

// A renderer that shows one of the scene's lights at a time.
class OneByOne {
  public:
    OneByOne(const Scene& scene, const RenderOptions& options)
        : scene_(withIds(scene)), loop_(scene_, options) {}

    Picture lit(std::size_t light, int frames) {
        std::vector<LightNode>& lights = scene_.lights.write();
        for (std::size_t i = 0; i < lights.size(); ++i)
            lights[i].muted = i != light;
        loop_.renderer().setLights(scene_);
        loop_.frames(frames - 1);
        return loop_.next();
    }
    FrameStatistics statistics() { return loop_.renderer().statistics(); }

  private:
    Scene scene_;
    Loop loop_;
};

bool hasMaps(const FrameStatistics& s) {
    const bool memory = std::any_of(s.gpuMemory.begin(), s.gpuMemory.end(),
                                    [](const MemoryCause& cause) { return cause.cause == "shadow maps"; });
    const bool pass = std::any_of(s.passes.begin(), s.passes.end(),
                                  [](const PassTiming& timing) { return timing.name == "shadow_maps"; });
    EXPECT_EQ(memory, pass);
    return memory;
}

// Lights of every type over the stage: a box and a ball on a floor. Other methods have nothing of the maps.
TEST(ShadowMaps, HaveTheLightOfRays) {
    std::vector<LightCase> cases = lightCases();
    for (const LightCase& shaped : shapedLights())
        cases.push_back(shaped);
    const Scene scene = stageScene(cases);
    OneByOne rays(scene, mapOptions("split", 1, {"raysPerLight=16"})),
        maps(scene, mapOptions("shadow-maps", 1));
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const Difference d = differenceOf(maps.lit(i, 3), rays.lit(i, 1));
        std::printf("%-10s mean %+.2f %%, other than by rays: %.2f %% of the pixels\n", cases[i].name.c_str(),
                    100.0 * d.ofMean, 100.0 * d.otherShare);
        EXPECT_LT(std::abs(d.ofMean), 0.015) << cases[i].name;
        EXPECT_LT(d.otherShare, 0.07) << cases[i].name;
    }
    EXPECT_TRUE(hasMaps(maps.statistics()));
    EXPECT_FALSE(hasMaps(rays.statistics()));
}

// Lights 2 m above a floor, all in one place, and the half space x < 0 hidden at a height of 1 m: each light
// comes in over a strip about x = 0 that is as wide as the light, since both distances are equal.
Scene halfHidden(const std::vector<LightDef>& lights, bool hidden) {
    SceneBuilder b;
    const int grey = b.material({0.5, 0.5, 0.5}, 0.0, 1.0);
    b.quad(floorAt({0, 0, 0}), 8, 8, grey);
    if (hidden) b.quad(floorAt({-2, 1, 0}), 4, 8, grey);
    for (const LightDef& def : lights)
        b.light(def, lookingAlong({0, 2, 0}, {0, -1, 0}));
    b.scene.cameras.push_back(cameraLooking({0, 0.9, 0.5}, {0, 0, 0}, 1.2));
    return std::move(b.scene);
}

// Width of the part of the middle row in which between a fifth and four fifths of the light are seen, m.
double penumbraM(const Picture& shadowed, const Picture& lit) {
    int between = 0;
    for (int x = 0; x < lit.width; ++x) {
        const std::size_t pixel = std::size_t(lit.height / 2 * lit.width + x);
        const double visible = luminanceAt(shadowed, pixel) / luminanceAt(lit, pixel);
        between += visible > 0.2 && visible < 0.8;
    }
    return between * 2.0 * std::tan(0.6) * std::hypot(0.9, 0.5) / lit.height;
}

TEST(ShadowMaps, PenumbraIsAsWideAsTheSourceMakesIt) {
    struct Source {
        LightType type;
        double widthM;
        double between; // of it, from a fifth to four fifths of its area
    };
    constexpr Source kSources[] = {{LightType::Rect, 0.2, 0.6},
                                   {LightType::Rect, 0.5, 0.6},
                                   {LightType::Rect, 0.8, 0.6},
                                   {LightType::Sphere, 0.5, 0.492},
                                   {LightType::Sphere, 0.0, 0.0}};
    std::vector<LightDef> lights;
    for (const Source& source : kSources) {
        lights.push_back(lightDef(source.type, 1000.0, LightUnit::Candela));
        lights.back().rangeM = 50.0;
        if (source.type == LightType::Rect) lights.back().widthM = lights.back().heightM = source.widthM;
        if (source.type == LightType::Sphere) lights.back().radiusM = 0.5 * source.widthM;
    }
    // With few samples the search misses what hides little of the light, and the lit side's edge is narrower.
    RenderOptions options = mapOptions("shadow-maps", 1, {"shadowSamples=64"});
    options.width = 128;
    OneByOne hidden(halfHidden(lights, true), options), open(halfHidden(lights, false), options);
    constexpr double kPixelM = 0.029;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const Source& source = kSources[i];
        EXPECT_NEAR(penumbraM(hidden.lit(i, 4), open.lit(i, 1)), source.between * source.widthM,
                    0.06 * source.widthM + kPixelM)
            << source.widthM;
    }
}

TEST(ShadowMaps, AlphaMaskedMaterialsCast) {
    SceneBuilder b;
    b.scene = stageScene({lightCases()[6]}); // a point
    const int mask = b.material({0.5, 0.6, 0.3}, 0.0, 0.7);
    Material& material = b.scene.materials[std::size_t(mask)];
    material.alphaMode = AlphaMode::Mask;
    material.doubleSided = true;
    b.scene.images.push_back(
        makeImage([](int x, int) { return glm::dvec4(0.7, 0.8, 0.6, x % 128 < 64 ? 1.0 : 0.0); }));
    material.baseColor.image = int(b.scene.images.size()) - 1;
    b.quad(lookingAlong({0.0, 1.3, 0.6}, {0.1, -1.0, 0}), 2.0, 2.0, mask);
    const Picture wanted = renderScene(b.scene, mapOptions("split", 1)).picture;
    EXPECT_LT(differenceOf(renderScene(b.scene, mapOptions("shadow-maps", 1)).picture, wanted).otherShare,
              0.05);
}

TEST(ShadowMaps, OnlyWhatChangedIsDrawnAgain) {
    Scene scene = withIds(stageScene({lightCases()[0], lightCases()[2], lightCases()[4]}));
    Loop loop(scene, mapOptions("shadow-maps", 1));
    const auto drawnBy = [&](auto&& change) {
        const std::size_t before = loop.renderer().statistics().shadowMaps.drawn;
        change();
        loop.renderer().setLights(scene);
        loop.frames(2);
        return loop.renderer().statistics().shadowMaps.drawn - before;
    };
    const std::size_t first = drawnBy([] {}), all = loop.renderer().statistics().shadowMaps.faces;
    EXPECT_EQ(first, all);
    EXPECT_EQ(drawnBy([] {}), 0u);
    EXPECT_EQ(drawnBy([&] { scene.lightDefs.write()[0].color = {1, 0, 0}; }), 0u) << "the same shadow";
    EXPECT_EQ(drawnBy([&] { scene.lights.write()[1].muted = true; }), 0u);
    EXPECT_EQ(drawnBy([&] { scene.lights.write()[1].muted = false; }), 0u);
    const std::size_t moved = drawnBy([&] {
        Node& node = scene.nodes.write()[std::size_t(scene.lights[1].node)];
        node.localFromNode[3].x += 0.2;
        node.worldFromNode[3].x += 0.2;
    });
    EXPECT_GT(moved, 0u);
    EXPECT_LT(moved, all);
}

// Drawn for a light that stands where an animated box passes, and not for one in the far corner.
TEST(ShadowMaps, InstancesThatMoveAreDrawnWhereTheyAre) {
    SceneBuilder b;
    const int grey = b.material({0.5, 0.5, 0.5}, 0.0, 1.0);
    b.quad(floorAt({0, 0, 0}), 30, 30, grey);
    const int mover = b.quad(floorAt({-0.6, 1, 0}), 0.5, 0.5, grey);
    for (const double x : {0.0, 12.0}) {
        LightDef lamp = lightDef(LightType::Spot, 1000.0, LightUnit::Candela);
        lamp.rangeM = 4.0;
        lamp.outerConeRad = 0.6;
        b.light(lamp, lookingAlong({x, 2, 0}, {0, -1, 0}));
    }
    Animation slide;
    slide.durationS = 1.0;
    slide.channels = {{mover, AnimationPath::Translation, 0}};
    slide.samplers = {{Interpolation::Linear, {0.0, 1.0}, {{-0.6, 1, 0, 0}, {0.6, 1, 0, 0}}}};
    b.scene.nodes.write()[std::size_t(mover)].restTrs =
        Trs{{-0.6, 1, 0}, glm::angleAxis(-0.5 * glm::pi<double>(), glm::dvec3(1, 0, 0)), glm::dvec3(1.0)};
    b.scene.animations.push_back(std::make_shared<Animation>(slide));
    b.scene.cameras.push_back(cameraLooking({0, 3, 3}, {0, 0, 0}));
    const Scene scene = withIds(std::move(b.scene));
    const RenderOptions options = mapOptions("shadow-maps", 4, {"timeStepS=0.2", "timeS=0.1"});
    const Rendered last = renderScene(scene, options);
    EXPECT_EQ(last.statistics.shadowMaps.faces, 2u);
    // One while pipelines are compiled, the other in the first frame, then the first in every frame.
    EXPECT_EQ(last.statistics.shadowMaps.drawn, 5u);
    // The last frame's shadow is that of its own time.
    const Picture there = renderScene(scene, mapOptions("split", 1, {"timeS=0.7"})).picture;
    RenderOptions alone = options;
    alone.settings.picture = PictureChoice::Raw;
    EXPECT_LT(differenceOf(renderScene(scene, alone).picture, there).otherShare, 0.02);
}

// Halved until they fit, every face in a place of its own.
TEST(ShadowMaps, AreLaidOutWithoutOverlap) {
    const Scene scene = withIds(stageScene(lightCases()));
    std::vector<std::uint64_t> ids;
    for (const LightNode& light : scene.lights)
        ids.push_back(light.id);
    LightSlots slots;
    slots.update(makeGpuLights(scene, glm::dvec3(0.0), 6.0), ids, 0);
    const glm::dvec3 least(-5.0), most(5.0);
    const ShadowLayout roomy = layShadowMaps(slots, least, most, 256, std::size_t(1) << 30, 16384),
                       tight = layShadowMaps(slots, least, most, 256, std::size_t(1) << 20, 16384);
    EXPECT_EQ(roomy.sizePx, 256u);
    EXPECT_LE(std::size_t(tight.widthPx) * tight.heightPx * 4, std::size_t(1) << 20);
    EXPECT_LT(tight.sizePx, 256u);
    for (const ShadowLayout& layout : {roomy, tight}) {
        std::vector<int> uses(std::size_t(layout.widthPx) * layout.heightPx);
        for (const shared::ShadowMap& map : layout.maps) {
            for (std::uint32_t i = 0; i < std::uint32_t(std::popcount(map.faceMask)); ++i) {
                const glm::uvec2 corner = cornerOfShadowTile(layout, map, map.firstTile + i);
                ASSERT_LE(corner.x + map.tilePx, layout.widthPx);
                ASSERT_LE(corner.y + map.tilePx, layout.heightPx);
                for (std::uint32_t y = corner.y; y < corner.y + map.tilePx; ++y)
                    for (std::uint32_t x = corner.x; x < corner.x + map.tilePx; ++x)
                        ++uses[std::size_t(y) * layout.widthPx + x];
            }
        }
        EXPECT_LE(*std::max_element(uses.begin(), uses.end()), 1);
    }
}

} // namespace
} // namespace kilolux::test
