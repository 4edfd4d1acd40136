// The oracle's scene and its public calls.
#include "renderer/reference/oracle.h"

#include "renderer/reference/oracle_dome.h"
#include "renderer/reference/oracle_estimate.h"
#include "renderer/reference/oracle_geometry.h"
#include "renderer/reference/oracle_random.h"

#include <bit>

namespace kilolux::oracle {

struct Oracle::State {
    explicit State(const Scene& scene) : geometry(scene) {}
    OracleGeometry geometry;
    std::vector<OracleLight> lights;
    std::unique_ptr<OracleDome> dome;
    bool domeVisible = false;
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
    state_->dome = OracleDome::make(scene.dome);
    state_->domeVisible = scene.dome.visible;
}

Oracle::~Oracle() = default;
Oracle::Oracle(Oracle&&) noexcept = default;

std::size_t Oracle::lightCount() const {
    return state_->lights.size() + (state_->dome ? 1 : 0);
}
const OracleLight& Oracle::light(std::size_t index) const {
    return state_->lights[index];
}

OraclePointResult Oracle::evaluatePoint(const OraclePoint& point, std::size_t lightIndex,
                                        const OracleOptions& options) const {
    const bool dome = lightIndex == state_->lights.size();
    if (!dome && (state_->lights[lightIndex].channels & point.channels) == 0) return {};
    const std::optional<std::uint8_t> shadowChannels =
        dome ? std::nullopt : state_->lights[lightIndex].shadowChannels;
    Occlusion occlusion;
    if (options.shadows)
        occlusion = [&](const glm::dvec3& directionWs, double lengthM) {
            return state_->geometry.occluded(point.positionWs, directionWs, lengthM, shadowChannels);
        };
    const std::uint64_t seed = seedOf(
        {options.seed, lightIndex, std::bit_cast<std::uint64_t>(point.positionWs.x),
         std::bit_cast<std::uint64_t>(point.positionWs.y), std::bit_cast<std::uint64_t>(point.positionWs.z)});
    if (dome)
        return state_->dome->estimate(point, occlusion, options.estimator, options.samplesPerLight, seed);
    return estimateLight(state_->lights[lightIndex], point, occlusion, options.estimator,
                         options.samplesPerLight, seed);
}

glm::dvec3 Oracle::backgroundNit(const glm::dvec3& directionWs) const {
    return state_->dome && state_->domeVisible ? state_->dome->radianceNit(directionWs) : glm::dvec3(0.0);
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
