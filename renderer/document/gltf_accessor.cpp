#include "renderer/document/gltf_accessor.h"

#include <algorithm>
#include <cstring>

namespace kilolux::gltf {

namespace {

std::size_t bytesOf(int componentType) {
    switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 2;
    default:
        return 4;
    }
}

int componentsOf(int type) {
    switch (type) {
    case TINYGLTF_TYPE_SCALAR:
        return 1;
    case TINYGLTF_TYPE_VEC2:
        return 2;
    case TINYGLTF_TYPE_VEC3:
        return 3;
    default:
        return 4;
    }
}

const char* typeName(int type) {
    switch (type) {
    case TINYGLTF_TYPE_SCALAR:
        return "SCALAR";
    case TINYGLTF_TYPE_VEC2:
        return "VEC2";
    case TINYGLTF_TYPE_VEC3:
        return "VEC3";
    case TINYGLTF_TYPE_VEC4:
        return "VEC4";
    default:
        return "a matrix";
    }
}

// Files guarantee no alignment.
template<typename T>
T load(const std::uint8_t* data) {
    T value;
    std::memcpy(&value, data, sizeof(T));
    return value;
}

float loadFloat(const std::uint8_t* data, int componentType, bool normalized) {
    switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: {
        const float value = load<std::int8_t>(data);
        return normalized ? std::max(value / 127.0f, -1.0f) : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: {
        const float value = *data;
        return normalized ? value / 255.0f : value;
    }
    case TINYGLTF_COMPONENT_TYPE_SHORT: {
        const float value = load<std::int16_t>(data);
        return normalized ? std::max(value / 32767.0f, -1.0f) : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: {
        const float value = load<std::uint16_t>(data);
        return normalized ? value / 65535.0f : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return static_cast<float>(load<std::uint32_t>(data));
    default:
        return load<float>(data);
    }
}

std::uint32_t loadUnsigned(const std::uint8_t* data, int componentType) {
    if (componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) return *data;
    if (componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) return load<std::uint16_t>(data);
    return load<std::uint32_t>(data);
}

bool isUnsigned(int componentType) {
    return componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
           componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

} // namespace

AccessorReader::AccessorReader(ImportContext& context, const tinygltf::Model& model, int accessorIndex,
                               std::initializer_list<int> types, std::string_view place) {
    const tinygltf::Accessor& accessor = model.accessors[accessorIndex];
    if (std::find(types.begin(), types.end(), accessor.type) == types.end()) {
        std::string expected;
        for (const int type : types)
            expected += (expected.empty() ? "" : " or ") + std::string(typeName(type));
        fail(place, "expected an accessor of {}, accessors/{} is {}", expected, accessorIndex,
             typeName(accessor.type));
    }
    count_ = accessor.count;
    components_ = componentsOf(accessor.type);
    componentType_ = accessor.componentType;
    componentBytes_ = bytesOf(componentType_);
    normalized_ = accessor.normalized;
    const std::string accessorPlace = fmt::format("{} (accessors/{})", place, accessorIndex);
    if (accessor.bufferView >= 0) {
        base_ = checkedRange(context, model, accessor.bufferView, accessor.byteOffset, count_,
                             componentBytes_ * components_, true, accessorPlace);
    }
    if (accessor.sparse.isSparse) readSparse(context, model, accessor, accessorPlace);
}

AccessorReader::Strided AccessorReader::checkedRange(ImportContext& context, const tinygltf::Model& model,
                                                     int bufferView, std::uint64_t offset,
                                                     std::uint64_t count, std::size_t elementBytes,
                                                     bool mayInterleave, std::string_view place) {
    const auto bytes = bufferViewBytes(context, bufferView, place);
    const std::size_t declared = mayInterleave ? model.bufferViews[bufferView].byteStride : 0;
    const std::uint64_t stride = declared > 0 ? declared : elementBytes;
    if (stride < elementBytes)
        fail(place, "expected a byteStride of at least {}, found {}", elementBytes, stride);
    // No overflow: stride is at most 252, count below 2^31, offset at most 2^53.
    const std::uint64_t end = offset + stride * (count - 1) + elementBytes;
    if (end > bytes.size()) {
        fail(place, "expected {} elements within the {} bytes of bufferViews/{}, they end at byte {}", count,
             bytes.size(), bufferView, end);
    }
    return {bytes.data() + offset, stride};
}

void AccessorReader::readSparse(ImportContext& context, const tinygltf::Model& model,
                                const tinygltf::Accessor& accessor, std::string_view place) {
    const auto& sparse = accessor.sparse;
    const auto count = static_cast<std::uint64_t>(sparse.count);
    const int indexType = sparse.indices.componentType;
    const std::string sparsePlace = fmt::format("{}, sparse", place);
    if (!isUnsigned(indexType))
        fail(sparsePlace, "expected indices of an unsigned type, found {}", indexType);
    const Strided indices = checkedRange(context, model, sparse.indices.bufferView,
                                         static_cast<std::uint64_t>(sparse.indices.byteOffset), count,
                                         bytesOf(indexType), false, sparsePlace);
    sparseValues_ = checkedRange(context, model, sparse.values.bufferView,
                                 static_cast<std::uint64_t>(sparse.values.byteOffset), count,
                                 componentBytes_ * components_, false, sparsePlace);
    context.chargeGeometry(count * sizeof(std::uint32_t), sparsePlace);
    sparseIndices_.resize(count);
    for (std::uint64_t i = 0; i < count; ++i) {
        sparseIndices_[i] = loadUnsigned(indices.data + i * indices.stride, indexType);
        if (sparseIndices_[i] >= count_ || (i > 0 && sparseIndices_[i] <= sparseIndices_[i - 1])) {
            fail(sparsePlace, "expected ascending indices under {}, found {} at {}", count_,
                 sparseIndices_[i], i);
        }
    }
}

const std::uint8_t* AccessorReader::elementAt(std::size_t element) const {
    if (!sparseIndices_.empty()) {
        const auto it = std::lower_bound(sparseIndices_.begin(), sparseIndices_.end(), element);
        if (it != sparseIndices_.end() && *it == element) {
            return sparseValues_.data +
                   static_cast<std::size_t>(it - sparseIndices_.begin()) * sparseValues_.stride;
        }
    }
    return base_.data ? base_.data + element * base_.stride : nullptr;
}

std::array<float, 4> AccessorReader::readFloats(std::size_t element) const {
    std::array<float, 4> values{};
    const std::uint8_t* data = elementAt(element);
    for (int i = 0; data && i < components_; ++i, data += componentBytes_) {
        values[i] = loadFloat(data, componentType_, normalized_);
    }
    return values;
}

std::uint32_t AccessorReader::readUnsigned(std::size_t element) const {
    const std::uint8_t* data = elementAt(element);
    return data ? loadUnsigned(data, componentType_) : 0;
}

} // namespace kilolux::gltf
