#include "tests/gpu/support/gpu_fixture.h"

namespace kilolux::test {

namespace {

struct Shared {
    gpu::Device device{{.validation = gpu::Validation::On}};
    gpu::PassResources resources{device};
};
std::unique_ptr<Shared> instance;

// The device must go before main() returns: the validation layer's own statics do not outlive it.
class CloseDevice : public ::testing::Environment {
  public:
    void TearDown() override { instance.reset(); }
};
[[maybe_unused]] ::testing::Environment* const closeDevice =
    ::testing::AddGlobalTestEnvironment(new CloseDevice);

Shared& shared() {
    if (!instance) instance = std::make_unique<Shared>();
    return *instance;
}

} // namespace

gpu::Device& validatedDevice() {
    return shared().device;
}
gpu::PassResources& validatedResources() {
    return shared().resources;
}

} // namespace kilolux::test
