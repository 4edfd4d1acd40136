#include "renderer/pass_statistics.h"

#include "shaders/shared/features.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fstream>
#include <numeric>
#include <sstream>
#include <time.h>
#include <unistd.h>

namespace kilolux {

namespace {

struct FeatureText {
    int id;
    std::string_view name;
    std::string_view whyOff;
};

constexpr std::array<FeatureText, shared::FEATURE_COUNT> kFeatures{
    {{shared::FEATURE_ALPHA_MASK, "AlphaMask", "no material tests alpha"},
     {shared::FEATURE_TEXTURES, "Textures", "no material has a texture"},
     {shared::FEATURE_MOVING_INSTANCES, "MovingInstances", "nothing moves"},
     {shared::FEATURE_BARN_DOORS, "BarnDoors", "no rectangle light has any"},
     {shared::FEATURE_IES_PROFILES, "IesProfiles", "no light has one"},
     {shared::FEATURE_LIGHT_FUNCTIONS, "LightFunctions", "no light has one"},
     {shared::FEATURE_LIGHT_CHANNELS, "LightChannels", "every light reaches every mesh"},
     {shared::FEATURE_DOME, "Dome", "no light from all around"},
     {shared::FEATURE_BACKGROUND, "Background", "no dome is seen behind the scene"},
     {shared::FEATURE_FILL, "Fill", "no plain ambient light"},
     {shared::FEATURE_CHANNEL_SHADOWS, "ChannelShadows", "every mesh casts every light's shadow"},
     {shared::FEATURE_TEXTURED_LIGHTS, "TexturedLights", "no rectangle light has a picture"},
#define KILOLUX_TYPE(UPPER, Name, place) {shared::FEATURE_##UPPER##_LIGHTS, #Name "Lights", "no such light"},
     KX_LIGHT_TYPES(KILOLUX_TYPE)
#undef KILOLUX_TYPE
    }};

double percentile(std::vector<double> values, double share) {
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    return values[std::min(values.size() - 1, std::size_t(share * double(values.size())))];
}

constexpr double kMiB = 1024.0 * 1024.0;

} // namespace

void describeFeatures(const gpu::SpecValues& features, FrameStatistics& statistics) {
    for (const FeatureText& feature : kFeatures) {
        const auto found = features.find(std::uint32_t(feature.id));
        if (found == features.end() || found->second) {
            statistics.featuresOn.emplace_back(feature.name);
        } else {
            statistics.featuresOff.push_back(fmt::format("{}: {}", feature.name, feature.whyOff));
        }
    }
}

std::vector<std::size_t> runCounts(const gpu::PassTimes& times) {
    std::vector<std::size_t> counts;
    for (const gpu::PassTimes::Entry& entry : times.entries())
        counts.push_back(entry.ms.size());
    return counts;
}

FrameTimes frameTimes(const gpu::PassTimes& times, const std::vector<std::size_t>& countsBefore) {
    FrameTimes result;
    // A pass may run several times a frame (pyramid levels): its time is their sum.
    for (std::size_t i = 0; i < times.entries().size(); ++i) {
        const gpu::PassTimes::Entry& entry = times.entries()[i];
        const std::size_t before = i < countsBefore.size() ? countsBefore[i] : 0;
        if (entry.ms.size() == before) continue; // it did not run
        const double sum = std::accumulate(entry.ms.begin() + std::ptrdiff_t(before), entry.ms.end(), 0.0);
        result.emplace_back(entry.name, sum);
    }
    return result;
}

void describePasses(const std::deque<FrameTimes>& frames, const std::vector<std::string_view>& lighting,
                    FrameStatistics& statistics) {
    statistics.frameMs = statistics.directLightingMs = 0.0;
    if (frames.empty()) return;
    // In the order of the frame that has most of them: some passes run now and then.
    const FrameTimes& order = *std::max_element(
        frames.begin(), frames.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
    for (const auto& [name, unused] : order) {
        std::vector<double> values;
        for (const FrameTimes& frame : frames)
            for (const auto& [pass, ms] : frame)
                if (pass == name) values.push_back(ms);
        const double median = percentile(values, 0.5);
        const double perFrameMs = median * double(values.size()) / double(frames.size());
        statistics.passes.push_back({name, median, percentile(values, 0.95), perFrameMs});
        statistics.frameMs += perFrameMs;
        if (std::find(lighting.begin(), lighting.end(), name) != lighting.end())
            statistics.directLightingMs += perFrameMs;
    }
}

void describeMemory(const gpu::MemoryAllocator& memory, FrameStatistics& statistics) {
    for (const gpu::MemoryCauseBytes& cause : memory.causes()) {
        statistics.gpuMemory.push_back({cause.cause, double(cause.peak) / kMiB});
    }
    statistics.gpuMemoryPeakMiB = double(memory.peakBytes()) / kMiB;
}

double processAgeMs() {
    std::ifstream file("/proc/self/stat");
    std::string text((std::istreambuf_iterator<char>(file)), {});
    const std::size_t name = text.rfind(')');
    if (name == std::string::npos) return 0.0;
    std::istringstream fields(text.substr(name + 2));
    std::string field;
    for (int i = 3; i <= 22; ++i)
        fields >> field; // field 22 is the start time in clock ticks since boot
    timespec now{};
    clock_gettime(CLOCK_BOOTTIME, &now);
    const double startMs = std::atof(field.c_str()) * 1e3 / double(sysconf(_SC_CLK_TCK));
    return double(now.tv_sec) * 1e3 + double(now.tv_nsec) * 1e-6 - startMs;
}

} // namespace kilolux
