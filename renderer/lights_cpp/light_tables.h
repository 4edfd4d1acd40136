// What the light functions look up beyond the hot record: the shaping records that hot records point to.
// Bound for the calling thread, for kilolux::f32 and kilolux::f64 alike.
#pragma once

#include "shaders/shared/gpu_light.h"

#include <vector>

namespace kilolux {

struct LightTables {
    std::vector<shared::LightShaping> shapings;
};

// Binds the tables while it lives; the ones bound before return after it. `tables` must live as long.
class BindLightTables {
  public:
    explicit BindLightTables(const LightTables& tables);
    ~BindLightTables();
    BindLightTables(const BindLightTables&) = delete;
    BindLightTables& operator=(const BindLightTables&) = delete;

  private:
    const LightTables* before_;
};

const LightTables& boundLightTables(); // asserts that there are some

} // namespace kilolux
