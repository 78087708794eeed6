// The one source file of the bakers that knows Draco. Source: Khronos Group, "KHR_draco_mesh_compression", 2018.
#include <draco/compression/decode.h>

#include <exception>

#include "tools/bake/mesh/gltf_primitive.h"

namespace overlook::mesh::gltf {
namespace {

DracoMesh::Attribute values_of(const draco::PointAttribute& attribute, size_t vertex_count) {
    DracoMesh::Attribute read;
    read.width = uint32_t(std::clamp<int>(attribute.num_components(), 1, 4));
    read.values.resize(vertex_count * read.width);
    for (size_t i = 0; i < vertex_count; ++i) {
        const draco::AttributeValueIndex at = attribute.mapped_index(draco::PointIndex(uint32_t(i)));
        if (at.value() >= attribute.size()) continue;
        float values[4] = {};
        // Whole numbers of a type that is not normalized come as they are; glTF's accessor says whether to scale them.
        (void)attribute.ConvertValue<float>(at, int8_t(read.width), values);
        for (uint32_t k = 0; k < read.width; ++k) read.values[i * read.width + k] = values[k];
    }
    return read;
}

tl::expected<DracoMesh, std::string> decode(Bytes stream, std::span<const uint32_t> ids) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(stream.data()), stream.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) return tl::unexpected(decoded.status().error_msg_string());
    const draco::Mesh& mesh = *decoded.value();

    DracoMesh read;
    read.vertex_count = mesh.num_points();
    for (uint32_t f = 0; f < mesh.num_faces(); ++f) {
        const draco::Mesh::Face& face = mesh.face(draco::FaceIndex(f));
        read.faces.push_back({face[0].value(), face[1].value(), face[2].value()});
        for (const uint32_t i : read.faces.back())
            if (i >= read.vertex_count) return tl::unexpected(std::string("a face has a vertex that does not exist"));
    }
    for (const uint32_t id : ids) {
        const draco::PointAttribute* attribute = id == kNone ? nullptr : mesh.GetAttributeByUniqueId(id);
        if (id != kNone && !attribute) return tl::unexpected(fmt::format("there is no attribute {}", id));
        read.attributes.push_back(attribute ? values_of(*attribute, read.vertex_count) : DracoMesh::Attribute{});
    }
    return read;
}

}  // namespace

tl::expected<DracoMesh, std::string> decode_draco(Bytes stream, std::span<const uint32_t> ids) {
    try {
        return decode(stream, ids);
    } catch (const std::exception& problem) {
        return tl::unexpected(std::string(problem.what()));
    }
}

}  // namespace overlook::mesh::gltf
