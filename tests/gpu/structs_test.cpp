// Every struct of shaders/shared means the same to C++ and to shaders: C++ fills two of them with words that
// are all different, a shader lists the fields of the second by name, and the words must be those that C++
// finds there.
#include "tests/gpu/shaders/struct_fields.h"
#include "tests/gpu/support/gpu_fixture.h"

#include "shaders/shared/bvh.h"
#include "shaders/shared/frame.h"
#include "shaders/shared/geometry.h"
#include "shaders/shared/gpu_light.h"
#include "shaders/shared/probe.h"
#include "shaders/shared/resampling.h"
#include "shaders/shared/shadow_map.h"
#include "shaders/shared/views.h"

#include <bit>

namespace kilolux::test {
namespace {

using namespace shared;

// The words of fields, in the order in which they are put.
class FieldWords {
  public:
    void put(std::uint32_t x) { words.push_back(x); }
    void put(float x) { words.push_back(std::bit_cast<std::uint32_t>(x)); }
    template<int N, typename T>
    void put(const glm::vec<N, T, glm::defaultp>& v) {
        for (int i = 0; i < N; ++i)
            put(v[i]);
    }
    void put(const glm::mat4& m) {
        for (int i = 0; i < 4; ++i)
            put(m[i]);
    }
    void put(const GpuTextureRef& ref) {
#define PUT_REF(field) put(ref.field);
        FIELDS_GpuTextureRef(PUT_REF)
    }
    void put(const GridConstants& grid) {
#define PUT_GRID(field) put(grid.field);
        FIELDS_GridConstants(PUT_GRID)
    }
    void put(const SamplingConstants& sampling) {
#define PUT_SAMPLING(field) put(sampling.field);
        FIELDS_SamplingConstants(PUT_SAMPLING)
    }
    void put(const DenoisingConstants& denoising) {
#define PUT_DENOISING(field) put(denoising.field);
        FIELDS_DenoisingConstants(PUT_DENOISING)
    }
    std::vector<std::uint32_t> words;
};

class Structs : public GpuTest {
  protected:
    // `expected(second)` lists the fields of a struct. The words are numbers about 1, so that floats keep
    // them.
    template<typename Struct>
    void check(const std::string& name, std::vector<std::uint32_t> (*expected)(const Struct&)) {
        std::vector<std::uint32_t> bytes(2 * sizeof(Struct) / 4);
        for (std::size_t i = 0; i < bytes.size(); ++i)
            bytes[i] = 0x3f800000u + std::uint32_t(i) * 77u;
        Struct both[2];
        std::memcpy(static_cast<void*>(both), bytes.data(), sizeof(both));
        const std::vector<std::uint32_t> wanted = expected(both[1]);
        EXPECT_EQ(wanted.size(), sizeof(Struct) / 4)
            << "struct_fields.h does not list every field of " << name;
        for (const bool asUniform : {false, true}) {
            std::vector<std::string> defines{"STRUCT " + name, "STRUCT_FIELDS FIELDS_" + name};
            if (asUniform) defines.push_back("AS_UNIFORM");
            EXPECT_EQ(read(bytes, defines, wanted.size()), wanted)
                << name << (asUniform ? " in a uniform block" : "");
        }
    }

  private:
    std::vector<std::uint32_t> read(const std::vector<std::uint32_t>& bytes,
                                    const std::vector<std::string>& defines, std::size_t words) {
        gpu::ComputePass pass(resources(), "structs", {{"Source"}, {"Words", gpu::Access::Write}},
                              "../tests/gpu/shaders/structs.comp", defines);
        gpu::Buffer source(device(),
                           {"source", bytes.size() * 4,
                            VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT});
        gpu::Buffer target(device(), {"words", (words + 64) * 4});
        source.upload(bytes);
        gpu::Commands commands(device());
        pass.record(commands, {}, {{"Source", source}, {"Words", target}}, {1});
        commands.submitAndWait();
        std::vector<std::uint32_t> result = target.downloadAs<std::uint32_t>();
        const std::uint32_t count = result[0];
        result.erase(result.begin());
        result.resize(count);
        return result;
    }
};

#define PUT(field) fields.put(value.field);
#define STRUCT_TEST(Struct)                                                                                  \
    TEST_F(Structs, Struct) {                                                                                \
        check<shared::Struct>(#Struct, [](const shared::Struct& value) {                                     \
            FieldWords fields;                                                                               \
            FIELDS_##Struct(PUT) return fields.words;                                                        \
        });                                                                                                  \
    }

STRUCT_TEST(LightHot)
STRUCT_TEST(LightCold)
STRUCT_TEST(LightShaping)
STRUCT_TEST(FrameConstants)
STRUCT_TEST(GridConstants)
STRUCT_TEST(SamplingConstants)
STRUCT_TEST(DenoisingConstants)
STRUCT_TEST(ViewConstants)
STRUCT_TEST(ResamplingConstants)
STRUCT_TEST(ShadowMap)
STRUCT_TEST(LightPower)
STRUCT_TEST(LightTreeNode)
STRUCT_TEST(ProbeRequest)
STRUCT_TEST(ProbeSurface)
STRUCT_TEST(ProbeLight)
STRUCT_TEST(RayListHead)
STRUCT_TEST(InstanceRows)
STRUCT_TEST(GridCell)
STRUCT_TEST(GpuInstance)
STRUCT_TEST(GpuTextureRef)
STRUCT_TEST(GpuMaterial)
STRUCT_TEST(BvhNode)
STRUCT_TEST(BvhPair)
STRUCT_TEST(BvhEntry)
STRUCT_TEST(TraceInstance)
STRUCT_TEST(AlphaRecord)
STRUCT_TEST(AlphaTriangle)

} // namespace
} // namespace kilolux::test
