// EXT_meshopt_compression: buffer views whose bytes are decoded by meshoptimizer, whose decoders are made for
// files that cannot be trusted. The views' own buffers are then placeholders.
#include "renderer/document/gltf_context.h"

#include <meshoptimizer.h>

namespace kilolux::gltf {

namespace {

std::uint64_t integerOf(const Json& object, const char* key, std::uint64_t min, std::uint64_t max,
                        const std::string& place) {
    const auto it = object.find(key);
    const bool isOptional = min == 0;
    if (it == object.end() && isOptional) return 0;
    if (it == object.end() || !it->is_number_unsigned() || it->get<std::uint64_t>() < min ||
        it->get<std::uint64_t>() > max) {
        fail(fmt::format("{}/{}", place, key), "expected an integer from {} to {}", min, max);
    }
    return it->get<std::uint64_t>();
}

void applyFilter(const std::string& filter, Bytes& bytes, std::size_t count, std::size_t stride,
                 const std::string& place) {
    if (filter == "NONE") return;
    const bool fits = filter == "OCTAHEDRAL"    ? stride == 4 || stride == 8
                      : filter == "QUATERNION"  ? stride == 8
                      : filter == "EXPONENTIAL" ? stride % 4 == 0
                                                : false;
    if (!fits) fail(place + "/filter", "expected a filter that suits the stride {}", stride);
    if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(bytes.data(), count, stride);
    if (filter == "QUATERNION") meshopt_decodeFilterQuat(bytes.data(), count, stride);
    if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(bytes.data(), count, stride);
}

Bytes decodeView(ImportContext& context, const Json& extension, const std::string& place) {
    const std::uint64_t buffer = integerOf(extension, "buffer", 0, UINT32_MAX, place);
    if (buffer >= context.buffers.size()) {
        fail(place + "/buffer", "expected an index under {}, the number of buffers", context.buffers.size());
    }
    const auto available = context.buffers[buffer].bytes;
    const std::uint64_t offset = integerOf(extension, "byteOffset", 0, available.size(), place);
    const std::uint64_t length = integerOf(extension, "byteLength", 1, available.size() - offset, place);
    const std::uint64_t stride = integerOf(extension, "byteStride", 1, 256, place);
    const std::uint64_t count = integerOf(extension, "count", 1, INT32_MAX, place);
    context.chargeGeometry(count * stride, place);
    Bytes bytes(count * stride);
    const auto source = available.subspan(offset, length);
    const Json mode = extension.value("mode", Json()), filter = extension.value("filter", Json("NONE"));
    int result = -1;
    if (mode == "ATTRIBUTES" && stride % 4 == 0) {
        result = meshopt_decodeVertexBuffer(bytes.data(), count, stride, source.data(), source.size());
    } else if (mode == "TRIANGLES" && (stride == 2 || stride == 4) && count % 3 == 0) {
        result = meshopt_decodeIndexBuffer(bytes.data(), count, stride, source.data(), source.size());
    } else if (mode == "INDICES" && (stride == 2 || stride == 4)) {
        result = meshopt_decodeIndexSequence(bytes.data(), count, stride, source.data(), source.size());
    } else {
        fail(place, "expected mode ATTRIBUTES, TRIANGLES or INDICES with a stride and count that suit it");
    }
    if (result != 0) fail(place, "expected data compressed by meshoptimizer, found damaged data");
    if (!filter.is_string()) fail(place + "/filter", "expected a string");
    applyFilter(filter, bytes, count, stride, place);
    return bytes;
}

} // namespace

void decodeCompressedViews(ImportContext& context) {
    const auto views = context.json.find("bufferViews");
    for (std::size_t i = 0; views != context.json.end() && i < views->size(); ++i) {
        const auto extensions = (*views)[i].find("extensions");
        if (extensions == (*views)[i].end() || !extensions->is_object()) continue;
        const auto extension = extensions->find("EXT_meshopt_compression");
        if (extension == extensions->end()) continue;
        context.reach("Reading buffers", 0.35);
        const std::string place = fmt::format("/bufferViews/{}/extensions/EXT_meshopt_compression", i);
        if (!extension->is_object()) fail(place, "expected an object");
        context.decodedViews[static_cast<int>(i)] = decodeView(context, *extension, place);
    }
}

} // namespace kilolux::gltf
