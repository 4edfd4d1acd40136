// The rays of a probe as lines, see probe_panel.h.
#include "ui/probe_panel.h"

namespace kilolux {

std::vector<ProbeLine> probeLines(const Probe& probe, int perLight) {
    std::vector<ProbeLine> lines;
    for (auto light = probe.lights.rbegin(); light != probe.lights.rend(); ++light) {
        const int rays = int(light->rays.size());
        for (int i = 0; i < std::min(perLight, rays); ++i) {
            const ProbeRay& ray = light->rays[std::size_t(i * rays / std::min(perLight, rays))];
            lines.push_back({probe.positionWs, ray.pointWs, ray.visible, light->id});
        }
    }
    return lines;
}

} // namespace kilolux
