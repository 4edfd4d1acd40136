// What frames cost, as tables of the report's page.
#pragma once

#include "renderer/bench/bench.h"

#include <string>

namespace kilolux::bench {

// The talk's stages, PlayStation 5 at 1080p, beside a method's passes here.
std::string stageTable(const MethodResult& method);

// Every pass of every method, and what the device's memory went to; folded away.
std::string passTable(const SceneResult& scene);

} // namespace kilolux::bench
