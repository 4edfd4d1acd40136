#include "renderer/lights_cpp/light_tables.h"

#include <cassert>

namespace kilolux {

namespace {
thread_local const LightTables* bound = nullptr;
} // namespace

BindLightTables::BindLightTables(const LightTables& tables) : before_(bound) {
    bound = &tables;
}

BindLightTables::~BindLightTables() {
    bound = before_;
}

const LightTables& boundLightTables() {
    assert(bound);
    return *bound;
}

} // namespace kilolux
