// Fills FrameStatistics from the device's own accounts.
#pragma once

#include "renderer/gpu/pass.h"
#include "renderer/statistics.h"

#include <deque>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace kilolux {

// Fills featuresOn and featuresOff, with the reason why each of the latter is off.
void describeFeatures(const gpu::SpecValues& features, FrameStatistics& statistics);

// Milliseconds of a frame's passes, each name once.
using FrameTimes = std::vector<std::pair<std::string, double>>;
std::vector<std::size_t> runCounts(const gpu::PassTimes& times); // of each pass so far
FrameTimes frameTimes(const gpu::PassTimes& times, const std::vector<std::size_t>& countsBefore);

// Medians over the frames that a pass ran in. `lighting` names the passes that count as direct lighting.
void describePasses(const std::deque<FrameTimes>& frames, const std::vector<std::string_view>& lighting,
                    FrameStatistics& statistics);

// Fills gpuMemory, in the order in which the causes first asked for some, and the peak of all of it.
void describeMemory(const gpu::MemoryAllocator& memory, FrameStatistics& statistics);

// Milliseconds since the process was started, by the kernel's account; 0 where it has none.
double processAgeMs();

} // namespace kilolux
