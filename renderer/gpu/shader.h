// GLSL to SPIR-V at run time (glslang), with a disk cache, and what the SPIR-V says about itself
// (SPIRV-Cross): bindings by name, push constants, specialization constants, workgroup size.
#pragma once

#include "renderer/document/result.h"
#include "vk.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace kilolux::gpu {

enum class ShaderStage { Compute, Vertex, Fragment };

// One resource that a shader declares. Its name is the GLSL variable's, or the block's for buffers.
struct ShaderBinding {
    std::string name;
    VkDescriptorType type = VK_DESCRIPTOR_TYPE_MAX_ENUM;
    std::uint32_t binding = 0; // assigned by name order, the same in all stages of a pipeline
    bool reads = false;
    bool writes = false;
    std::uint32_t dimension = 0; // spv::Dim of an image
    bool arrayed = false;
    bool integer = false;                  // an integer image
    VkFormat format = VK_FORMAT_UNDEFINED; // of a storage image
};

struct SpecConstant {
    std::string name;
    std::uint32_t id = 0;
};

struct ShaderCode {
    std::string name; // file, for messages
    ShaderStage stage = ShaderStage::Compute;
    std::vector<std::uint32_t> spirv;
    std::vector<ShaderBinding> bindings;
    std::vector<SpecConstant> constants;
    std::uint32_t pushBytes = 0;
    std::uint32_t localSize[3] = {1, 1, 1};
};

// Where the GLSL lives: $KILOLUX_SHADERS, else the folder the program was built from.
std::filesystem::path shaderDirectory();

// Compiles shaders/<file> with the given "#define NAME VALUE" lines. The error holds the compiler's words
// with file and line. Results are kept in cacheDirectory() by a hash of the expanded source.
Result<ShaderCode> compileShader(const std::string& file, const std::vector<std::string>& defines = {});
// The same from text, for tests; `name` ends in .comp, .vert or .frag.
Result<ShaderCode> compileShaderText(const std::string& name, const std::string& source);

// Gives equal names in all stages one binding number, in the SPIR-V as well.
void assignBindings(const std::vector<ShaderCode*>& stages);

} // namespace kilolux::gpu
