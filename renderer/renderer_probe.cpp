// The probe: records its pass over what the last frame left, reads it back, and puts names to numbers.
#include "renderer/renderer_impl.h"

#include "renderer/document/light_units.h"
#include "renderer/document/light_words.h"
#include "renderer/readback.h"
#include "renderer/view_colors.h"
#include "shaders/shared/features.h"

#include <algorithm>
#include <fmt/format.h>

namespace kilolux {

namespace {

using namespace shared;

std::string_view listName(const ProbeLight& light) {
    if (!(light.flags & PROBE_CANDIDATE)) return "";
    constexpr std::string_view names[] = {"visible", "hidden", "directional", "dome"};
    return names[std::min(light.list, 3u)];
}

ProbedLight describeLight(const ProbeLight& raw, const glm::vec4* rays, const glm::dvec3& anchor) {
    ProbedLight light;
    light.reaches = raw.flags & PROBE_REACHES;
    light.inCell = raw.flags & PROBE_IN_CELL;
    light.listed = raw.flags & PROBE_LISTED;
    light.fresh = raw.flags & PROBE_FRESH;
    light.candidate = raw.flags & PROBE_CANDIDATE;
    light.list = listName(raw);
    light.areaMask = raw.cells;
    light.unseenFrames = raw.entry >> ENTRY_AGE_SHIFT & 15u;
    light.weight = double(raw.weight);
    light.probability = double(raw.probability);
    light.chosen = raw.chosen;
    light.chosenVisible = raw.chosenVisible;
    light.visibility = raw.rays > 0 ? double(raw.raysVisible) / double(raw.rays) : 0.0;
    light.irradianceLux = glm::dvec3(raw.irradianceLux);
    light.reflectedNit = glm::dvec3(raw.reflectedNit);
    light.lux = luminanceOf(light.irradianceLux) * light.visibility;
    light.nit = luminanceOf(light.reflectedNit) * light.visibility;
    for (std::uint32_t i = 0; i < PROBE_RAYS; ++i) {
        if (rays[i].w == float(RAY_NONE)) continue;
        light.rays.push_back({anchor + glm::dvec3(rays[i]), rays[i].w == float(RAY_VISIBLE)});
    }
    return light;
}

void sumUp(Probe& probe) {
    double squares = 0.0;
    for (const ProbedLight& light : probe.lights) {
        probe.lightsInRange += light.reaches;
        probe.lightsSeen += light.visibility > 0.0;
        probe.lux += light.lux;
        probe.nit += light.nit;
        squares += light.nit * light.nit;
    }
    for (ProbedLight& light : probe.lights)
        light.share = probe.nit > 0.0 ? light.nit / probe.nit : 0.0;
    probe.effectiveLights = squares > 0.0 ? probe.nit * probe.nit / squares : 0.0;
    std::stable_sort(probe.lights.begin(), probe.lights.end(),
                     [](const ProbedLight& a, const ProbedLight& b) {
                         return a.nit != b.nit ? a.nit > b.nit : a.weight > b.weight;
                     });
}

void describeSurface(const ProbeSurface& s, const glm::dvec3& anchor, Probe& probe) {
    probe.choosing = glm::ivec2(s.pixel);
    probe.surface = s.exists;
    probe.pictureNit = glm::dvec3(s.pictureNit);
    probe.viewValue = glm::dvec3(s.viewValue);
    if (!probe.surface) return;
    probe.depthM = double(s.depthM);
    probe.positionWs = anchor + glm::dvec3(s.positionWs);
    probe.normalWs = glm::dvec3(s.normalWs);
    probe.geometricNormalWs = glm::dvec3(s.geoNormalWs);
    probe.viewDirWs = glm::dvec3(s.viewDirWs);
    probe.baseColor = glm::dvec3(s.baseColor);
    probe.roughness = double(s.roughness);
    probe.metallic = double(s.metallic);
    probe.instance = s.instance;
    probe.triangle = s.primitive;
    probe.illuminanceLux = luminanceOf(glm::dvec3(s.irradianceLux));
    probe.hasTurn = s.hasTurn;
    probe.missed = s.missed;
    probe.candidates = s.candidates;
    probe.cellLights = s.cellLights;
    probe.stride = s.stride;
    probe.listLights = s.listLights;
    probe.listTile = glm::ivec2(s.listTile);
    probe.visibleWeight = double(s.sums.x);
    probe.hiddenWeight = double(s.sums.y);
    probe.directionalWeight = double(s.sums.z);
    probe.hiddenBudget = double(s.budgeted.x);
    probe.directionalBudget = double(s.budgeted.y);
    probe.domeWeight = double(s.sums.w);
    probe.domeBudget = double(s.budgeted.z);
}

} // namespace

Result<Probe> Renderer::Impl::probe(glm::ivec2 pixel, ProbeDepth depth) {
    if (pixel.x < 0 || pixel.y < 0 || pixel.x >= options.width || pixel.y >= options.height) {
        return Error{fmt::format("pixel {},{} lies outside the picture of {} x {}", pixel.x, pixel.y,
                                 options.width, options.height)};
    }
    // A grid that has grown gets its lists with the next frame, and grows again only with new lights.
    for (int i = 0; !frameStands && i < 3; ++i) {
        if (auto error = renderFrame()) return *error;
    }
    if (!frameStands) return Error{"there is no whole frame to look into"};
    const std::size_t slots = std::max(1u, constants.lightCount);
    const auto storage = [&](const char* name, std::size_t bytes) {
        return gpu::Buffer(
            device, {name, bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::MemoryUse::HostReadback, "probe"});
    };
    if (!probeLights || probeLights.bytes() < slots * sizeof(ProbeLight)) {
        probeSurface = storage("probeSurface", sizeof(ProbeSurface));
        probeLights = storage("probeLights", slots * sizeof(ProbeLight));
        probeRays = storage("probeRays", slots * PROBE_RAYS * sizeof(glm::vec4));
    }
    if (!passes->probe) passes->probe = std::make_unique<ProbePass>(resources, plan.tracer, plan.choices);
    gpu::Commands commands(device);
    FrameContext context{commands, *gpuScene, *targets,    frameBuffer, constants,    counterBuffer,
                         *grid,    used,      lists.get(), &noise,      rayList.get()};
    const glm::dvec2 step = glm::dvec2(constants.size) / glm::dvec2(constants.outputSize);
    const glm::ivec2 rendered =
        glm::min(glm::ivec2((glm::dvec2(pixel) + 0.5) * step), glm::ivec2(constants.size) - 1);
    const gpu::Image& shown = shownPicture(*targets, plan);
    const bool isView = plan.view != VIEW_FINAL;
    passes->probe->record(context, world, plan.stochastic() ? chosenFrom : nullptr,
                          {glm::uvec2(rendered), glm::uvec2(isView ? pixel : rendered), plan.stochastic(),
                           depth == ProbeDepth::Lights},
                          {shown, isView ? targets->viewValues : shown,
                           targets->denoisedDiffuse ? targets->denoisedDiffuse : targets->litDiffuse},
                          {probeSurface, probeLights, probeRays});
    commands.submitAndWait();
    return readProbe(pixel, depth);
}

Probe Renderer::Impl::readProbe(glm::ivec2 pixel, ProbeDepth depth) {
    Probe probe;
    probe.pixel = pixel;
    probe.exposureEv100 = exposureEv100;
    probe.view = statistics.view;
    const auto surface = probeSurface.downloadAs<ProbeSurface>();
    describeSurface(surface.front(), gpuScene->anchor(), probe);
    if (plan.view == VIEW_FINAL) probe.viewValue = probe.pictureNit;
    probe.stops = stopsFromGrey(luminanceOf(probe.pictureNit) * double(constants.exposure));
    if (!probe.surface) return probe;
    const Instance& instance = gpuScene->instances()[probe.instance];
    probe.node = scene.nodes[std::size_t(instance.node)].name;
    probe.mesh = scene.meshes[std::size_t(instance.mesh)]->name;
    if (instance.material >= 0) probe.material = scene.materials[std::size_t(instance.material)].name;
    if (depth == ProbeDepth::Surface) return probe;
    const auto lights = probeLights.downloadAs<ProbeLight>();
    const auto rays = probeRays.downloadAs<glm::vec4>();
    const auto add = [&](std::uint64_t id, const std::string& name, std::string_view type) {
        const std::uint32_t slot = gpuScene->slots().slotOf(id);
        if (slot >= constants.lightCount) return;
        const ProbeLight& raw = lights[slot];
        if (!(raw.flags & (PROBE_REACHES | PROBE_LISTED | PROBE_CANDIDATE))) return;
        ProbedLight light = describeLight(raw, &rays[slot * PROBE_RAYS], gpuScene->anchor());
        light.id = id;
        light.slot = slot;
        light.name = name;
        light.type = type;
        probe.lights.push_back(std::move(light));
    };
    for (const LightNode& node : scene.lights)
        add(node.id, scene.nodes[std::size_t(node.node)].name,
            wordOf(scene.lightDefs[std::size_t(node.def)].type));
    add(kDomeLightId, "dome", "dome");
    sumUp(probe);
    return probe;
}

} // namespace kilolux
