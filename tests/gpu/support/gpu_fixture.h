// A device per test program and validation mode; any validation message fails the test that caused it.
#pragma once

#include "renderer/gpu/pass.h"

#include <gtest/gtest.h>

namespace kilolux::test {

// The device shared by all tests of the program: core and synchronization validation on.
gpu::Device& validatedDevice();
gpu::PassResources& validatedResources();

class GpuTest : public ::testing::Test {
  protected:
    void SetUp() override { validatedDevice().takeValidationMessages(); }
    void TearDown() override { expectNoMessages(validatedDevice()); }
    static void expectNoMessages(gpu::Device& device) {
        for (const std::string& message : device.takeValidationMessages())
            ADD_FAILURE() << message;
    }
    gpu::Device& device() { return validatedDevice(); }
    gpu::PassResources& resources() { return validatedResources(); }
};

} // namespace kilolux::test
