// Checked reading of accessors (glTF 2.0, section 3.6): every component type, normalized or not, interleaved,
// sparse. Values are gathered for chosen elements only, since primitives often share one accessor and use a
// part of it.
#pragma once

#include "renderer/document/gltf_model.h"

#include <array>

namespace kilolux::gltf {

class AccessorReader {
  public:
    // Fails at `place` where the accessor reaches outside its buffer or is not one of `types`
    // (TINYGLTF_TYPE_*).
    AccessorReader(ImportContext& context, const tinygltf::Model& model, int accessor,
                   std::initializer_list<int> types, std::string_view place);

    std::size_t count() const { return count_; }
    int components() const { return components_; }
    int componentType() const { return componentType_; }

    // One element as floats; normalized integers map to 0..1 or -1..1, others keep their value. `element` <
    // count().
    std::array<float, 4> readFloats(std::size_t element) const;
    // First component of an unsigned integer element.
    std::uint32_t readUnsigned(std::size_t element) const;

  private:
    struct Strided {
        const std::uint8_t* data = nullptr; // null reads as zero
        std::size_t stride = 0;
    };
    Strided checkedRange(ImportContext& context, const tinygltf::Model& model, int bufferView,
                         std::uint64_t offset, std::uint64_t count, std::size_t elementBytes,
                         bool mayInterleave, std::string_view place);
    void readSparse(ImportContext& context, const tinygltf::Model& model, const tinygltf::Accessor& accessor,
                    std::string_view place);
    const std::uint8_t* elementAt(std::size_t element) const;

    std::size_t count_ = 0;
    int components_ = 0;
    int componentType_ = 0;
    std::size_t componentBytes_ = 0;
    bool normalized_ = false;
    Strided base_;
    Strided sparseValues_;
    std::vector<std::uint32_t> sparseIndices_; // ascending
};

} // namespace kilolux::gltf
