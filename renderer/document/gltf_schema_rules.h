// The part of the glTF 2.0 schema that the import uses: one table per kind of object.
#pragma once

#include <cstddef>
#include <limits>

namespace kilolux::gltf {

enum class Kind {
    Text,
    Flag,
    Number,       // finite, within min and max
    Integer,      // within min and max
    Index,        // into the top-level array `target`
    Numbers,      // `length` numbers
    UniqueIndices // different indices into the top-level array `target`
};
enum class Need { Optional, Required };
inline constexpr double kMaxBytes = 9007199254740992.0; // 2^53: larger integers are not exact in JSON
inline constexpr double kMaxInt = 2147483647.0;
inline constexpr double kMaxNumber = std::numeric_limits<double>::max();

struct Rule {
    const char* key;
    Kind kind;
    Need need = Need::Optional;
    const char* target = nullptr;
    double min = 0.0;
    double max = kMaxInt;
    std::size_t length = 0;
};

inline constexpr Rule kBufferRules[] = {
    {"byteLength", Kind::Integer, Need::Required, nullptr, 1.0, kMaxBytes},
    {"uri", Kind::Text},
};
inline constexpr Rule kBufferViewRules[] = {
    {"buffer", Kind::Index, Need::Required, "buffers"},
    {"byteOffset", Kind::Integer, Need::Optional, nullptr, 0.0, kMaxBytes},
    {"byteLength", Kind::Integer, Need::Required, nullptr, 1.0, kMaxBytes},
    {"byteStride", Kind::Integer, Need::Optional, nullptr, 4.0, 252.0},
    {"target", Kind::Integer},
};
inline constexpr Rule kAccessorRules[] = {
    {"bufferView", Kind::Index, Need::Optional, "bufferViews"},
    {"byteOffset", Kind::Integer, Need::Optional, nullptr, 0.0, kMaxBytes},
    {"componentType", Kind::Integer, Need::Required, nullptr, 5120.0, 5126.0},
    {"normalized", Kind::Flag},
    {"count", Kind::Integer, Need::Required, nullptr, 1.0, kMaxInt},
    {"type", Kind::Text, Need::Required},
};
inline constexpr Rule kSparseRules[] = {{"count", Kind::Integer, Need::Required, nullptr, 1.0, kMaxInt}};
inline constexpr Rule kSparseIndicesRules[] = {
    {"bufferView", Kind::Index, Need::Required, "bufferViews"},
    {"byteOffset", Kind::Integer},
    {"componentType", Kind::Integer, Need::Required, nullptr, 5121.0, 5125.0},
};
inline constexpr Rule kSparseValuesRules[] = {
    {"bufferView", Kind::Index, Need::Required, "bufferViews"},
    {"byteOffset", Kind::Integer},
};
inline constexpr Rule kPrimitiveRules[] = {
    {"indices", Kind::Index, Need::Optional, "accessors"},
    {"material", Kind::Index, Need::Optional, "materials"},
    {"mode", Kind::Integer, Need::Optional, nullptr, 0.0, 6.0},
};
inline constexpr Rule kNodeRules[] = {
    {"mesh", Kind::Index, Need::Optional, "meshes"},
    {"matrix", Kind::Numbers, Need::Optional, nullptr, -kMaxNumber, kMaxNumber, 16},
    {"translation", Kind::Numbers, Need::Optional, nullptr, -kMaxNumber, kMaxNumber, 3},
    {"rotation", Kind::Numbers, Need::Optional, nullptr, -kMaxNumber, kMaxNumber, 4},
    {"scale", Kind::Numbers, Need::Optional, nullptr, -kMaxNumber, kMaxNumber, 3},
    {"children", Kind::UniqueIndices, Need::Optional, "nodes"},
};
inline constexpr Rule kNodeReplaceableRules[] = {
    {"camera", Kind::Index, Need::Optional, "cameras"},
    {"name", Kind::Text},
};
inline constexpr Rule kNameRules[] = {{"name", Kind::Text}};
inline constexpr Rule kSceneRules[] = {{"nodes", Kind::UniqueIndices, Need::Optional, "nodes"}};
inline constexpr Rule kImageRules[] = {
    {"uri", Kind::Text},
    {"bufferView", Kind::Index, Need::Optional, "bufferViews"},
    {"mimeType", Kind::Text},
    {"name", Kind::Text},
};
inline constexpr Rule kTextureRules[] = {
    {"source", Kind::Index, Need::Optional, "images"},
    {"sampler", Kind::Index, Need::Optional, "samplers"},
    {"name", Kind::Text},
};
inline constexpr Rule kSamplerRules[] = {
    {"magFilter", Kind::Integer, Need::Optional, nullptr, 9728.0, 9729.0},
    {"minFilter", Kind::Integer, Need::Optional, nullptr, 9728.0, 9987.0},
    {"wrapS", Kind::Integer, Need::Optional, nullptr, 10497.0, 33648.0},
    {"wrapT", Kind::Integer, Need::Optional, nullptr, 10497.0, 33648.0},
};
inline constexpr Rule kMaterialRules[] = {
    {"name", Kind::Text},        {"emissiveFactor", Kind::Numbers, Need::Optional, nullptr, 0.0, 1.0, 3},
    {"alphaMode", Kind::Text},   {"alphaCutoff", Kind::Number, Need::Optional, nullptr, 0.0, kMaxNumber},
    {"doubleSided", Kind::Flag},
};
inline constexpr Rule kMetallicRoughnessRules[] = {
    {"baseColorFactor", Kind::Numbers, Need::Optional, nullptr, 0.0, 1.0, 4},
    {"metallicFactor", Kind::Number, Need::Optional, nullptr, 0.0, 1.0},
    {"roughnessFactor", Kind::Number, Need::Optional, nullptr, 0.0, 1.0},
};
inline constexpr Rule kTextureInfoRules[] = {
    {"index", Kind::Index, Need::Required, "textures"},
    {"texCoord", Kind::Integer, Need::Optional, nullptr, 0.0, 255.0},
    {"scale", Kind::Number, Need::Optional, nullptr, -kMaxNumber, kMaxNumber},
    {"strength", Kind::Number, Need::Optional, nullptr, 0.0, 1.0},
};
inline constexpr Rule kAnimationChannelRules[] = {{"sampler", Kind::Integer, Need::Required}};
inline constexpr Rule kAnimationTargetRules[] = {
    {"node", Kind::Index, Need::Optional, "nodes"},
    {"path", Kind::Text, Need::Required},
};
inline constexpr Rule kAnimationSamplerRules[] = {
    {"input", Kind::Index, Need::Required, "accessors"},
    {"output", Kind::Index, Need::Required, "accessors"},
    {"interpolation", Kind::Text},
};
inline constexpr Rule kCameraRules[] = {{"type", Kind::Text, Need::Required}, {"name", Kind::Text}};
inline constexpr double kTiny = std::numeric_limits<double>::min();
inline constexpr Rule kPerspectiveRules[] = {
    {"yfov", Kind::Number, Need::Required, nullptr, kTiny, 3.14159},
    {"znear", Kind::Number, Need::Required, nullptr, kTiny, kMaxNumber},
    {"zfar", Kind::Number, Need::Optional, nullptr, kTiny, kMaxNumber},
    {"aspectRatio", Kind::Number, Need::Optional, nullptr, kTiny, kMaxNumber},
};
inline constexpr Rule kOrthographicRules[] = {
    {"xmag", Kind::Number, Need::Required, nullptr, -kMaxNumber, kMaxNumber},
    {"ymag", Kind::Number, Need::Required, nullptr, -kMaxNumber, kMaxNumber},
    {"znear", Kind::Number, Need::Required, nullptr, 0.0, kMaxNumber},
    {"zfar", Kind::Number, Need::Required, nullptr, kTiny, kMaxNumber},
};

} // namespace kilolux::gltf
