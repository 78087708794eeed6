// One primitive of a glTF file as triangles.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "tools/bake/mesh/gltf_accessors.h"

namespace overlook::mesh::gltf {

// Vertices and triangles before any node places them. Attributes are as long as the positions, or empty. Only vertices that a
// triangle uses.
struct Triangles {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> uvs, uvs2;  // uvs: the set of the material's texture, transformed; uvs2: the first other set
    std::vector<std::array<uint8_t, 4>> colours;
    std::vector<Corners> faces;
    uint32_t material = kNone;
    uint64_t glue_count = 0;  // triangles of strips and fans with an index twice
};

// What a Draco stream holds. Attributes by vertex, in the order in which they were asked for: components as floats, or none.
struct DracoMesh {
    std::vector<Corners> faces;
    size_t vertex_count = 0;
    struct Attribute {
        uint32_t width = 0;
        std::vector<float> values;
    };
    std::vector<Attribute> attributes;
};

// Decodes KHR_draco_mesh_compression's stream. `ids` are the attributes' unique identifiers; kNone gives none. "normalized" is
// applied as glTF's accessor says, so whole numbers come as they are stored. Fails with a sentence.
tl::expected<DracoMesh, std::string> decode_draco(Bytes stream, std::span<const uint32_t> ids);

// Reads primitives of triangles. `place` names one in messages: "a.glb: mesh 0, primitive 2".
class PrimitiveReader {
  public:
    PrimitiveReader(const Document& document, Buffers& buffers, const std::string& name)
        : document_(document), buffers_(buffers), accessors_(document, buffers, name) {}

    Result<Triangles> read(const Primitive& primitive, const std::string& place);

  private:
    // Where the values of an attribute come from: an accessor, or a Draco stream.
    struct Source {
        std::optional<Elements> elements;
        const DracoMesh::Attribute* decoded = nullptr;
        bool is_normalized = false;
        double greatest = 1;

        bool exists() const { return elements || decoded; }
        glm::dvec4 operator[](size_t i) const;
    };
    struct Sources {
        Source position, normal, uv, uv2, colour;
        size_t vertex_count = 0;
    };

    Result<void> open_plain(const Primitive& primitive, Sources& sources);
    Result<void> open_draco(const Primitive& primitive, const std::string& place, Sources& sources);
    Result<std::vector<uint32_t>> read_indices(const Primitive& primitive, size_t vertex_count, const std::string& place);
    void gather(const Sources& sources, Triangles& triangles);

    const Document& document_;
    Buffers& buffers_;
    Accessors accessors_;
    DracoMesh draco_;
    std::vector<uint32_t> number_;  // by vertex, its number among those used, where stamp_ is current
    std::vector<uint32_t> stamp_;
    uint32_t current_stamp_ = 0;
};

}  // namespace overlook::mesh::gltf
