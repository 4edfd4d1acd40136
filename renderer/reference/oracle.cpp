// The oracle's scene and its public calls.
#include "renderer/reference/oracle.h"

#include "renderer/reference/oracle_estimate.h"
#include "renderer/reference/oracle_geometry.h"
#include "renderer/reference/oracle_random.h"

#include <bit>

namespace kilolux::oracle {

struct Oracle::State {
    explicit State(const Scene& scene) : geometry(scene) {}
    OracleGeometry geometry;
    std::vector<OracleLight> lights;
};

Oracle::Oracle(const Scene& scene, const std::vector<double>& derivedRangesM)
    : state_(std::make_unique<State>(scene)) {
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const LightNode& node = scene.lights[i];
        const LightDef& def = scene.lightDefs[node.def];
        std::optional<double> rangeM = def.rangeM;
        if (!rangeM && i < derivedRangesM.size() && derivedRangesM[i] > 0.0) rangeM = derivedRangesM[i];
        OracleLight light = makeLight(def, scene.nodes[node.node].worldFromNode, rangeM);
        const glm::dvec3 factor = groupFactor(scene, node);
        light.intensityCd *= factor;
        light.illuminanceLux *= factor;
        light.radianceNit *= factor;
        light.muted = node.muted || !scene.nodes[node.node].visible;
        state_->lights.push_back(light);
    }
}

Oracle::~Oracle() = default;
Oracle::Oracle(Oracle&&) noexcept = default;

std::size_t Oracle::lightCount() const {
    return state_->lights.size();
}
const OracleLight& Oracle::light(std::size_t index) const {
    return state_->lights[index];
}

OraclePointResult Oracle::evaluatePoint(const OraclePoint& point, std::size_t lightIndex,
                                        const OracleOptions& options) const {
    const OracleLight& light = state_->lights[lightIndex];
    if ((light.channels & point.channels) == 0) return {};
    Occlusion occlusion;
    if (options.shadows)
        occlusion = [&](const glm::dvec3& directionWs, double lengthM) {
            return state_->geometry.occluded(point.positionWs, directionWs, lengthM, light.shadowChannels);
        };
    const std::uint64_t seed = seedOf(
        {options.seed, lightIndex, std::bit_cast<std::uint64_t>(point.positionWs.x),
         std::bit_cast<std::uint64_t>(point.positionWs.y), std::bit_cast<std::uint64_t>(point.positionWs.z)});
    return estimateLight(light, point, occlusion, options.estimator, options.samplesPerLight, seed);
}

std::optional<OracleHit> Oracle::tracePrimary(const glm::dvec3& originWs, const glm::dvec3& directionWs,
                                              double minDistanceM) const {
    return state_->geometry.nearest(originWs, directionWs, minDistanceM);
}

bool Oracle::occluded(const glm::dvec3& originWs, const glm::dvec3& directionWs, double lengthM,
                      std::optional<std::uint8_t> channels) const {
    return state_->geometry.occluded(originWs, directionWs, lengthM, channels);
}

} // namespace kilolux::oracle
