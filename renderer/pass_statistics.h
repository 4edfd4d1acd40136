// Fills FrameStatistics from the device's own accounts.
#pragma once

#include "renderer/gpu/pass.h"
#include "renderer/statistics.h"

#include <string_view>
#include <vector>

namespace kilolux {

void describeFeatures(const gpu::SpecValues& features, FrameStatistics& statistics);

// Medians over all frames. `lighting` names the passes that count as direct lighting.
void describePasses(const gpu::PassTimes& times, const std::vector<std::string_view>& lighting,
                    FrameStatistics& statistics);

void describeMemory(const gpu::MemoryAllocator& memory, FrameStatistics& statistics);

// Milliseconds since the process was started, by the kernel's account; 0 where it has none.
double processAgeMs();

} // namespace kilolux
