#include "tests/gpu/support/grid_rig.h"

#include "renderer/document/ies_profile.h"
#include "renderer/lights_cpp/ltc_table.h"
#include "tests/unit/accel/scene_kit.h"

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>
#include <stdexcept>

namespace kilolux::test {

namespace {

std::unique_ptr<GpuScene> uploaded(gpu::Device& device, const Scene& scene, const GridView& view,
                                   double exposureEv100) {
    [[maybe_unused]] static const bool bound = [] {
        useLtcTable(loadLtcTable(KILOLUX_SOURCE_DIR "/content/ltc_ggx.bin").value());
        return true;
    }();
    const Bounds bounds{glm::dvec3(-view.extentM), glm::dvec3(view.extentM)};
    Result<std::unique_ptr<GpuScene>> result =
        GpuScene::create(device, scene, anchorFor(view.camera, bounds), exposureEv100);
    if (!result) throw std::runtime_error(result.error());
    return std::move(result.value());
}

LightDef randomLight(const std::function<double(double, double)>& within, const LightCrowd& crowd) {
    LightDef def;
    constexpr LightType kTypes[] = {LightType::Sphere, LightType::Spot, LightType::Tube, LightType::Rect,
                                    LightType::Disk};
    def.type = kTypes[int(within(0.0, 5.0)) % 5];
    if (within(0.0, 100.0) < 1.0) def.type = LightType::Directional;
    def.intensity = 100.0;
    const double rangeM = crowd.spreadM * std::exp(within(std::log(1e-3), std::log(crowd.longestRange)));
    if (def.type != LightType::Directional && within(0.0, 20.0) >= 1.0) def.rangeM = rangeM;
    def.radiusM = def.lengthM = 0.01 * rangeM;
    def.widthM = def.heightM = 0.1 * rangeM;
    def.outerConeRad = std::exp(within(std::log(1e-3), std::log(glm::half_pi<double>())));
    def.innerConeRad = 0.7 * def.outerConeRad;
    return def;
}

// Light within 50 degrees of straight ahead (0) or behind (130 to 180), the same all about.
std::shared_ptr<const IesProfile> narrowProfile(double fromDeg) {
    auto profile = std::make_shared<IesProfile>();
    profile->horizontalDeg = {0.0};
    for (int i = 0; i <= 10; ++i) {
        profile->verticalDeg.push_back(fromDeg + 5.0 * i);
        profile->candela.push_back(100.0 + i);
    }
    return profile;
}

} // namespace

std::span<const std::uint32_t> GridLists::of(std::size_t cell) const {
    return std::span(indices).subspan(cells[cell].first, cells[cell].count);
}

GridRig::GridRig(GridPasses& passes, const Scene& scene, const GridView& view, double exposureEv100)
    : passes_(passes), device_(passes.resources.device()),
      scene_(uploaded(device_, scene, view, exposureEv100)),
      targets_(device_, std::uint32_t(view.widthPx), std::uint32_t(view.heightPx), TargetNeeds{}),
      grid_(device_, std::uint32_t(view.widthPx), std::uint32_t(view.heightPx), scene_->lightCount()) {
    setCamera(constants_, view.camera, scene_->anchor(), view.widthPx, view.heightPx, glm::dvec2(0.0));
    constants_.lightCount = scene_->lightCount();
    frameBuffer_ =
        gpu::Buffer(device_, {"frame", sizeof(shared::FrameConstants), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                              gpu::MemoryUse::HostWrite, "other"});
    counters_ =
        gpu::Buffer(device_, {"counters", shared::COUNTER_COUNT * 4, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                              gpu::MemoryUse::HostReadback, "other"});
    grid_.describe(constants_, view.extentM);
}

FrameContext GridRig::context(gpu::Commands& commands) {
    return {commands, *scene_, targets_, frameBuffer_, constants_, counters_, grid_, scene_->features()};
}

void GridRig::setDepths(const std::vector<float>& depthsM) {
    frameBuffer_.upload(std::as_bytes(std::span(&constants_, 1)));
    targets_.gDepth.upload(std::as_bytes(std::span(depthsM)));
    gpu::Commands commands(device_);
    FrameContext frame = context(commands);
    passes_.pyramid.record(frame);
    commands.submitAndWait();
}

void GridRig::submit(std::uint32_t threadLights) {
    constants_.grid.threadLights = threadLights;
    constants_.grid.capacity = std::uint32_t(grid_.indices().bytes() / 4);
    frameBuffer_.upload(std::as_bytes(std::span(&constants_, 1)));
    gpu::Commands commands(device_);
    FrameContext frame = context(commands);
    passes_.grid.record(frame);
    commands.submitAndWait();
}

GridLists GridRig::run(std::uint32_t threadLights) {
    submit(threadLights);
    return read();
}

GridLists GridRig::read() {
    GridLists lists;
    lists.cells = grid_.cells().downloadAs<shared::GridCell>();
    lists.indices = grid_.indices().downloadAs<std::uint32_t>();
    lists.use = grid_.finishFrame();
    return lists;
}

Scene crowdScene(const LightCrowd& crowd) {
    Scene scene = makeScene({makeBox(glm::dvec3(0.01 * crowd.spreadM))});
    std::mt19937 random(crowd.seed);
    const auto within = [&](double low, double high) {
        return low + (high - low) * std::uniform_real_distribution<double>(0.0, 1.0)(random);
    };
    for (int i = 0; i < crowd.count; ++i) {
        const glm::dquat turn =
            glm::normalize(glm::dquat(within(-1, 1), within(-1, 1), within(-1, 1), within(-1, 1) + 1e-3));
        Node node;
        node.worldFromNode = glm::mat4_cast(turn);
        node.worldFromNode[3] =
            glm::dvec4(crowd.spreadM * glm::dvec3(within(-1, 1), within(-1, 1), within(-1, 1)), 1.0);
        node.localFromNode = node.worldFromNode;
        scene.nodes.push_back(node);
        LightDef def = randomLight(within, crowd);
        if (def.type == LightType::Rect && i % 2 == 0) {
            for (int side = 0; side < 4; ++side)
                def.barnDoors[std::size_t(side)] = {glm::half_pi<double>() * ((i + 5 * side) % 17) / 17.0,
                                                    def.widthM * (0.2 + (i + side) % 5)};
        }
        if (i % 7 == 0 && def.type != LightType::Directional) {
            def.ies = narrowProfile(i % 2 == 0 ? 0.0 : 130.0);
            def.iesUse = i % 3 == 0 ? IesUse::Mask : IesUse::Shape;
        }
        scene.lightDefs.push_back(def);
        LightNode light;
        light.node = int(scene.nodes.size()) - 1;
        light.def = int(scene.lightDefs.size()) - 1;
        light.muted = within(0.0, 20.0) < 1.0;
        scene.lights.push_back(light);
    }
    return scene;
}

} // namespace kilolux::test
