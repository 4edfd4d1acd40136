// Shader compilation and reflection, see shader.h.
#include "shader.h"

#include "device.h"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <map>
#include <mutex>
#include <set>
#include <spirv_cross/spirv_cross.hpp>
#include <sstream>

namespace kilolux::gpu {

namespace {

constexpr int kCacheVersion = 1;

// --- Source ----------------------------------------------------------------------------------------------

Result<std::string> readText(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) return Error{fmt::format("{}: cannot be read", path.string())};
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

// Pastes #include "..." (relative to the shader folder, or to the including file), once per file, keeping
// file and line for messages by #line.
Result<std::string> expandIncludes(const std::filesystem::path& path, std::set<std::filesystem::path>& seen) {
    Result<std::string> text = readText(path);
    if (!text) return text;
    seen.insert(std::filesystem::weakly_canonical(path));
    const std::string shown = path.lexically_relative(shaderDirectory()).generic_string();
    std::string result = fmt::format("#line 1 \"{}\"\n", shown);
    std::istringstream lines(text.value());
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        const std::size_t open = line.find('"');
        const std::size_t close = line.rfind('"');
        if (line.rfind("#include", 0) != 0 || open == close) {
            result += line + "\n";
            continue;
        }
        const std::string name = line.substr(open + 1, close - open - 1);
        std::filesystem::path included = path.parent_path() / name;
        if (!std::filesystem::exists(included)) included = shaderDirectory() / name;
        if (!std::filesystem::exists(included)) included = shaderDirectory().parent_path() / name;
        if (!std::filesystem::exists(included)) {
            return Error{fmt::format("{}:{}: no file '{}' to include", shown, number, name)};
        }
        if (!seen.contains(std::filesystem::weakly_canonical(included))) {
            Result<std::string> inner = expandIncludes(included, seen);
            if (!inner) return inner;
            result += inner.value();
        }
        result += fmt::format("#line {} \"{}\"\n", number + 1, shown);
    }
    return result;
}

ShaderStage stageOf(const std::string& name) {
    if (name.ends_with(".vert")) return ShaderStage::Vertex;
    if (name.ends_with(".frag")) return ShaderStage::Fragment;
    if (name.ends_with(".comp")) return ShaderStage::Compute;
    failContract("shader '" + name + "' is no .comp, .vert or .frag");
}

// --- Compilation -----------------------------------------------------------------------------------------

std::uint64_t hashText(const std::string& text) { // FNV-1a, 64 bits
    std::uint64_t hash = 14695981039346656037ull;
    for (const char c : text)
        hash = (hash ^ std::uint8_t(c)) * 1099511628211ull;
    return hash;
}

Result<std::vector<std::uint32_t>> toSpirv(const std::string& name, const std::string& source,
                                           ShaderStage stage) {
    static std::once_flag once;
    std::call_once(once, [] { glslang::InitializeProcess(); });
    const EShLanguage language = stage == ShaderStage::Compute  ? EShLangCompute
                                 : stage == ShaderStage::Vertex ? EShLangVertex
                                                                : EShLangFragment;
    glslang::TShader shader(language);
    const char* text = source.c_str();
    const char* textName = name.c_str();
    shader.setStringsWithLengthsAndNames(&text, nullptr, &textName, 1);
    shader.setEnvInput(glslang::EShSourceGlsl, language, glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_3);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_6);
    shader.setAutoMapBindings(true);
    shader.setAutoMapLocations(true);
    const EShMessages messages = EShMessages(EShMsgSpvRules | EShMsgVulkanRules);
    if (!shader.parse(GetDefaultResources(), 460, false, messages)) {
        return Error{fmt::format("{}: {}", name, shader.getInfoLog())};
    }
    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(messages) || !program.mapIO()) {
        return Error{fmt::format("{}: {}", name, program.getInfoLog())};
    }
    glslang::SpvOptions options;
    options.disableOptimizer = true; // drivers optimize, and names must stay for reflection
    std::vector<std::uint32_t> spirv;
    glslang::GlslangToSpv(*program.getIntermediate(language), spirv, &options);
    return spirv;
}

std::vector<std::uint32_t> readCache(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file) return {};
    std::vector<std::uint32_t> words(std::size_t(file.tellg()) / 4);
    file.seekg(0);
    file.read(reinterpret_cast<char*>(words.data()), std::streamsize(words.size() * 4));
    const bool valid = file && words.size() > 5 && words[0] == spv::MagicNumber;
    return valid ? words : std::vector<std::uint32_t>{};
}

void writeCache(const std::filesystem::path& path, const std::vector<std::uint32_t>& words) {
    std::filesystem::path partial = path;
    partial += fmt::format(".{}", std::uintptr_t(&words));
    std::ofstream(partial, std::ios::binary)
        .write(reinterpret_cast<const char*>(words.data()), std::streamsize(words.size() * 4));
    std::error_code error;
    std::filesystem::rename(partial, path, error);
}

// --- Reflection ------------------------------------------------------------------------------------------

VkFormat formatOf(spv::ImageFormat format) {
    switch (format) {
    case spv::ImageFormatRgba32f:
        return VK_FORMAT_R32G32B32A32_SFLOAT;
    case spv::ImageFormatRgba16f:
        return VK_FORMAT_R16G16B16A16_SFLOAT;
    case spv::ImageFormatR32f:
        return VK_FORMAT_R32_SFLOAT;
    case spv::ImageFormatRg32f:
        return VK_FORMAT_R32G32_SFLOAT;
    case spv::ImageFormatRg16f:
        return VK_FORMAT_R16G16_SFLOAT;
    case spv::ImageFormatR16f:
        return VK_FORMAT_R16_SFLOAT;
    case spv::ImageFormatR11fG11fB10f:
        return VK_FORMAT_B10G11R11_UFLOAT_PACK32;
    case spv::ImageFormatRgba8:
        return VK_FORMAT_R8G8B8A8_UNORM;
    case spv::ImageFormatRg8:
        return VK_FORMAT_R8G8_UNORM;
    case spv::ImageFormatRg8Snorm:
        return VK_FORMAT_R8G8_SNORM;
    case spv::ImageFormatRg16Snorm:
        return VK_FORMAT_R16G16_SNORM;
    case spv::ImageFormatR8:
        return VK_FORMAT_R8_UNORM;
    case spv::ImageFormatRgba32ui:
        return VK_FORMAT_R32G32B32A32_UINT;
    case spv::ImageFormatRg32ui:
        return VK_FORMAT_R32G32_UINT;
    case spv::ImageFormatR32ui:
        return VK_FORMAT_R32_UINT;
    case spv::ImageFormatRgba8ui:
        return VK_FORMAT_R8G8B8A8_UINT;
    case spv::ImageFormatR16ui:
        return VK_FORMAT_R16_UINT;
    default:
        return VK_FORMAT_UNDEFINED;
    }
}

void addImages(const spirv_cross::Compiler& compiler,
               const spirv_cross::SmallVector<spirv_cross::Resource>& resources, bool storage,
               std::vector<ShaderBinding>& out) {
    for (const spirv_cross::Resource& resource : resources) {
        const spirv_cross::SPIRType& type = compiler.get_type(resource.type_id);
        const bool texels = type.image.dim == spv::DimBuffer;
        ShaderBinding binding;
        binding.name = compiler.get_name(resource.id);
        binding.type =
            storage ? (texels ? VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER : VK_DESCRIPTOR_TYPE_STORAGE_IMAGE)
                    : (texels ? VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER
                              : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
        binding.reads = !storage || !compiler.has_decoration(resource.id, spv::DecorationNonReadable);
        binding.writes = storage && !compiler.has_decoration(resource.id, spv::DecorationNonWritable);
        binding.dimension = std::uint32_t(type.image.dim);
        binding.arrayed = type.image.arrayed;
        const auto base = compiler.get_type(type.image.type).basetype;
        binding.integer = base == spirv_cross::SPIRType::UInt || base == spirv_cross::SPIRType::Int;
        binding.format = formatOf(type.image.format);
        out.push_back(binding);
    }
}

void addBuffers(const spirv_cross::Compiler& compiler,
                const spirv_cross::SmallVector<spirv_cross::Resource>& resources, VkDescriptorType type,
                std::vector<ShaderBinding>& out) {
    for (const spirv_cross::Resource& resource : resources) {
        ShaderBinding binding;
        binding.name = compiler.get_name(resource.base_type_id);
        binding.type = type;
        const spirv_cross::Bitset flags = type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER
                                              ? compiler.get_buffer_block_flags(resource.id)
                                              : spirv_cross::Bitset{};
        binding.reads = !flags.get(spv::DecorationNonReadable);
        binding.writes = type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER && !flags.get(spv::DecorationNonWritable);
        out.push_back(binding);
    }
}

void reflect(ShaderCode& code) {
    const spirv_cross::Compiler compiler(code.spirv);
    const spirv_cross::ShaderResources resources = compiler.get_shader_resources();
    addImages(compiler, resources.sampled_images, false, code.bindings);
    addImages(compiler, resources.separate_images, false, code.bindings);
    addImages(compiler, resources.storage_images, true, code.bindings);
    addBuffers(compiler, resources.uniform_buffers, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, code.bindings);
    addBuffers(compiler, resources.storage_buffers, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, code.bindings);
    for (const spirv_cross::Resource& resource : resources.acceleration_structures) {
        ShaderBinding binding;
        binding.name = compiler.get_name(resource.id);
        binding.type = VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR;
        binding.reads = true;
        code.bindings.push_back(binding);
    }
    for (const spirv_cross::Resource& resource : resources.push_constant_buffers) {
        code.pushBytes =
            std::uint32_t(compiler.get_declared_struct_size(compiler.get_type(resource.base_type_id)));
    }
    for (const spirv_cross::SpecializationConstant& constant : compiler.get_specialization_constants()) {
        code.constants.push_back({compiler.get_name(constant.id), constant.constant_id});
    }
    if (code.stage == ShaderStage::Compute) {
        for (std::uint32_t i = 0; i < 3; ++i) {
            code.localSize[i] = compiler.get_execution_mode_argument(spv::ExecutionModeLocalSize, i);
            if (code.localSize[i] == 0) {
                const std::uint32_t id =
                    compiler.get_execution_mode_argument(spv::ExecutionModeLocalSizeId, i);
                code.localSize[i] = id ? compiler.get_constant(id).scalar() : 1;
            }
        }
    }
}

// --- Bindings --------------------------------------------------------------------------------------------

// Visits every OpDecorate with its words.
template<typename Visitor>
void forEachDecoration(std::vector<std::uint32_t>& spirv, Visitor visit) {
    for (std::size_t i = 5; i < spirv.size();) {
        const std::uint32_t opcode = spirv[i] & 0xffffu, length = spirv[i] >> 16;
        if (opcode == spv::OpDecorate) visit(&spirv[i]);
        i += std::max(1u, length);
    }
}

Result<ShaderCode> finish(const std::string& name, std::string source,
                          const std::vector<std::string>& defines) {
    // Defines and extensions go right behind #version, which the language wants first.
    const std::size_t version = source.find("#version");
    if (version == std::string::npos) return Error{fmt::format("{}: no #version line", name)};
    const std::size_t after = source.find('\n', version) + 1;
    const int line = 1 + int(std::count(source.begin() + std::ptrdiff_t(source.find('\n') + 1),
                                        source.begin() + std::ptrdiff_t(after), '\n'));
    std::string head = "#extension GL_GOOGLE_cpp_style_line_directive : require\n"
                       "#extension GL_EXT_scalar_block_layout : require\n";
    for (const std::string& define : defines)
        head += "#define " + define + "\n";
    head += fmt::format("#line {}\n", line);
    // The "#line 1" that expandIncludes put first must follow #version too.
    source = source.substr(version, after - version) + head + source.substr(after);

    ShaderCode code;
    code.name = name;
    code.stage = stageOf(name);
    const std::filesystem::path directory = cacheDirectory();
    const std::filesystem::path cached =
        directory.empty()
            ? std::filesystem::path{}
            : directory / fmt::format("{:016x}-{}-{}.spv", hashText(source), source.size(), kCacheVersion);
    if (!cached.empty()) code.spirv = readCache(cached);
    if (code.spirv.empty()) {
        Result<std::vector<std::uint32_t>> spirv = toSpirv(name, source, code.stage);
        if (!spirv) return Error{spirv.error()};
        code.spirv = std::move(spirv.value());
        if (!cached.empty()) writeCache(cached, code.spirv);
    }
    reflect(code);
    return code;
}

} // namespace

std::filesystem::path shaderDirectory() {
    if (const char* folder = std::getenv("KILOLUX_SHADERS"); folder && *folder) return folder;
    return KILOLUX_SHADER_DIR;
}

Result<ShaderCode> compileShader(const std::string& file, const std::vector<std::string>& defines) {
    std::set<std::filesystem::path> seen;
    Result<std::string> source = expandIncludes(shaderDirectory() / file, seen);
    if (!source) return Error{source.error()};
    return finish(file, std::move(source.value()), defines);
}

Result<ShaderCode> compileShaderText(const std::string& name, const std::string& source) {
    return finish(name, "\n" + source, {});
}

void assignBindings(const std::vector<ShaderCode*>& stages) {
    std::set<std::string> names;
    for (const ShaderCode* stage : stages) {
        for (const ShaderBinding& binding : stage->bindings)
            names.insert(binding.name);
    }
    for (ShaderCode* stage : stages) {
        std::map<std::uint32_t, std::uint32_t> bindingOfId;
        const spirv_cross::Compiler compiler(stage->spirv);
        const auto nameOf = [&](std::uint32_t id) {
            const spirv_cross::SPIRType& type = compiler.get_type_from_variable(id);
            const bool block = type.basetype == spirv_cross::SPIRType::Struct;
            return block ? compiler.get_name(type.self) : compiler.get_name(id);
        };
        forEachDecoration(stage->spirv, [&](std::uint32_t* words) {
            if (words[2] != spv::DecorationBinding) return;
            const auto found = names.find(nameOf(words[1]));
            if (found == names.end()) failContract(stage->name + ": a binding without a name");
            words[3] = std::uint32_t(std::distance(names.begin(), found));
        });
        for (ShaderBinding& binding : stage->bindings) {
            binding.binding = std::uint32_t(std::distance(names.begin(), names.find(binding.name)));
        }
    }
}

} // namespace kilolux::gpu
