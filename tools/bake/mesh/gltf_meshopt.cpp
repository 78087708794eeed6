// The one source file of the bakers that knows meshoptimizer's decoders. Source: Khronos Group, "EXT_meshopt_compression", 2021.
#include <meshoptimizer.h>

#include "tools/bake/mesh/gltf_buffers.h"

namespace overlook::mesh::gltf {
namespace {

bool decode_stream(Bytes stream, const Compression& compression, void* to) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(stream.data());
    const size_t count = size_t(compression.count), stride = size_t(compression.stride);
    switch (compression.mode) {
        case CompressionMode::attributes:
            return meshopt_decodeVertexBuffer(to, count, stride, bytes, stream.size()) == 0;
        case CompressionMode::triangles:
            return meshopt_decodeIndexBuffer(to, count, stride, bytes, stream.size()) == 0;
        case CompressionMode::indices:
            return meshopt_decodeIndexSequence(to, count, stride, bytes, stream.size()) == 0;
    }
    return false;
}

}  // namespace

bool decode_meshopt(Bytes stream, const Compression& compression, std::span<std::byte> to) {
    if (!decode_stream(stream, compression, to.data())) return false;
    const size_t count = size_t(compression.count), stride = size_t(compression.stride);
    switch (compression.filter) {
        case CompressionFilter::none:
            break;
        case CompressionFilter::octahedral:
            meshopt_decodeFilterOct(to.data(), count, stride);
            break;
        case CompressionFilter::quaternion:
            meshopt_decodeFilterQuat(to.data(), count, stride);
            break;
        case CompressionFilter::exponential:
            meshopt_decodeFilterExp(to.data(), count, stride);
            break;
    }
    return true;
}

}  // namespace overlook::mesh::gltf
