// Primitives of glTF files. Source: glTF 2.0 Specification, sections 3.7.2 (attributes) and 3.7.2.1 (modes).

#include "formats/srgb.h"
#include "tools/bake/mesh/gltf_primitive.h"

#include <algorithm>

namespace overlook::mesh::gltf {
namespace {

constexpr uint32_t kStrip = 5, kFan = 6;

// The other set of texture coordinates: the first that is not the material's.
std::string other_uv_name(uint32_t uv_set) {
    return uv_set == 0 ? "TEXCOORD_1" : "TEXCOORD_0";
}

// What an accessor's whole numbers are divided by.
double greatest_of(const Accessor& accessor) {
    if (!accessor.is_normalized) return 1;
    switch (accessor.component) {
        case Component::int8:
            return 127;
        case Component::uint8:
            return 255;
        case Component::int16:
            return 32767;
        case Component::uint16:
            return 65535;
        default:
            return 1;
    }
}

// Triangle i of a list, strip or fan, wound as the first.
Corners triangle(std::span<const uint32_t> indices, uint32_t mode, size_t i) {
    if (mode == kStrip)
        return i % 2 == 0 ? Corners{indices[i], indices[i + 1], indices[i + 2]}
                          : Corners{indices[i + 1], indices[i], indices[i + 2]};
    if (mode == kFan) return {indices[i + 1], indices[i + 2], indices[0]};
    return {indices[3 * i], indices[3 * i + 1], indices[3 * i + 2]};
}

size_t triangle_count(size_t index_count, uint32_t mode) {
    if (mode == kStrip || mode == kFan) return index_count < 3 ? 0 : index_count - 2;
    return index_count / 3;
}

}  // namespace

glm::dvec4 PrimitiveReader::Source::operator[](size_t i) const {
    if (elements) return (*elements)[i];
    glm::dvec4 values(0, 0, 0, 1);
    for (uint32_t k = 0; k < decoded->width; ++k)
        values[int(k)] = std::max(double(decoded->values[i * decoded->width + k]) / greatest, is_normalized ? -1.0 : -HUGE_VAL);
    return values;
}

Result<void> PrimitiveReader::open_plain(const Primitive& primitive, Sources& sources) {
    const uint32_t uv_set = primitive.material == kNone ? 0 : document_.materials[primitive.material].uv_set;
    struct Wanted {
        std::string name;
        Source& source;
        uint32_t least, most;
    };
    for (const Wanted& wanted : {Wanted{"POSITION", sources.position, 3, 3}, Wanted{"NORMAL", sources.normal, 3, 3},
                                 Wanted{fmt::format("TEXCOORD_{}", uv_set), sources.uv, 2, 2},
                                 Wanted{other_uv_name(uv_set), sources.uv2, 2, 2}, Wanted{"COLOR_0", sources.colour, 3, 4}}) {
        const uint32_t index = find(primitive.attributes, wanted.name);
        if (index == kNone) continue;
        Result<Elements> elements = accessors_.attribute(index, wanted.least, wanted.most);
        if (!elements) return tl::unexpected(elements.error());
        if (&wanted.source == &sources.position)
            sources.vertex_count = elements->size();
        else if (elements->size() < sources.vertex_count)
            continue;  // too short to have one for each vertex: as if it were not there
        wanted.source.elements = std::move(*elements);
    }
    return {};
}

Result<void> PrimitiveReader::open_draco(const Primitive& primitive, const std::string& place, Sources& sources) {
    const Result<Bytes> stream = buffers_.view(primitive.draco->view);
    if (!stream) return tl::unexpected(stream.error());
    const uint32_t uv_set = primitive.material == kNone ? 0 : document_.materials[primitive.material].uv_set;
    const std::string names[] = {"POSITION", "NORMAL", fmt::format("TEXCOORD_{}", uv_set), other_uv_name(uv_set), "COLOR_0"};
    Source* const wanted[] = {&sources.position, &sources.normal, &sources.uv, &sources.uv2, &sources.colour};
    uint32_t ids[5];
    for (size_t i = 0; i < 5; ++i) ids[i] = find(primitive.draco->attributes, names[i]);
    auto decoded = decode_draco(*stream, ids);
    if (!decoded) return bad_input("{}: its Draco stream is broken: {}", place, decoded.error());
    draco_ = std::move(*decoded);
    sources.vertex_count = draco_.vertex_count;
    for (size_t i = 0; i < 5; ++i) {
        const uint32_t least = i == 2 || i == 3 ? 2 : 3;
        if (draco_.attributes[i].width < least) continue;
        const uint32_t accessor = find(primitive.attributes, names[i]);
        wanted[i]->decoded = &draco_.attributes[i];
        wanted[i]->greatest = accessor == kNone ? 1 : greatest_of(document_.accessors[accessor]);
        wanted[i]->is_normalized = accessor != kNone && document_.accessors[accessor].is_normalized;
    }
    return {};
}

Result<std::vector<uint32_t>> PrimitiveReader::read_indices(const Primitive& primitive, size_t vertex_count,
                                                            const std::string& place) {
    std::vector<uint32_t> indices;
    if (primitive.indices == kNone) {
        indices.resize(vertex_count);
        for (size_t i = 0; i < indices.size(); ++i) indices[i] = uint32_t(i);
        return indices;
    }
    const Result<Elements> elements = accessors_.indices(primitive.indices);
    if (!elements) return tl::unexpected(elements.error());
    indices.resize(elements->size());
    for (size_t i = 0; i < indices.size(); ++i) {
        indices[i] = elements->whole(i);
        if (indices[i] >= vertex_count)
            return bad_input("{}: index {} is {}, there are {} vertices; was the file cut short?", place, i, indices[i],
                             vertex_count);
    }
    return indices;
}

Result<Triangles> PrimitiveReader::read(const Primitive& primitive, const std::string& place) {
    Sources sources;
    Triangles triangles;
    triangles.material = primitive.material;
    const auto opened = primitive.draco ? open_draco(primitive, place, sources) : open_plain(primitive, sources);
    if (!opened) return tl::unexpected(opened.error());
    if (!sources.position.exists()) return triangles;  // glTF: nothing to draw
    if (sources.vertex_count >= kNone) return bad_input("{}: has {} vertices", place, sources.vertex_count);

    if (primitive.draco) {
        triangles.faces = std::move(draco_.faces);
    } else {
        const Result<std::vector<uint32_t>> indices = read_indices(primitive, sources.vertex_count, place);
        if (!indices) return tl::unexpected(indices.error());
        for (size_t i = 0; i < triangle_count(indices->size(), primitive.mode); ++i) {
            const Corners face = triangle(*indices, primitive.mode, i);
            const bool is_glue = primitive.mode >= kStrip && (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]);
            is_glue ? void(++triangles.glue_count) : triangles.faces.push_back(face);
        }
    }
    gather(sources, triangles);
    return triangles;
}

// Takes the vertices that faces use, in the order of their use.
void PrimitiveReader::gather(const Sources& sources, Triangles& triangles) {
    number_.resize(std::max(number_.size(), sources.vertex_count));
    stamp_.resize(number_.size(), 0);
    ++current_stamp_;
    const glm::dmat3 uv_transform =
        triangles.material == kNone ? glm::dmat3(1) : document_.materials[triangles.material].uv_transform;
    const auto add = [&](uint32_t vertex) {
        triangles.positions.emplace_back(sources.position[vertex]);
        if (sources.normal.exists()) triangles.normals.emplace_back(glm::dvec3(sources.normal[vertex]));
        if (sources.uv.exists()) {
            const glm::dvec4 uv = sources.uv[vertex];
            triangles.uvs.emplace_back(glm::dvec2(uv_transform * glm::dvec3(uv.x, uv.y, 1)));
        }
        if (sources.uv2.exists()) triangles.uvs2.emplace_back(glm::dvec2(sources.uv2[vertex]));
        if (!sources.colour.exists()) return;
        const glm::dvec4 c = sources.colour[vertex];
        auto encoded = [](double linear) { return byte_from_unit(srgb_from_linear(std::clamp(linear, 0.0, 1.0))); };
        triangles.colours.push_back({encoded(c.r), encoded(c.g), encoded(c.b), byte_from_unit(c.a)});
    };
    for (Corners& face : triangles.faces)
        for (uint32_t& vertex : face) {
            if (stamp_[vertex] != current_stamp_) {
                stamp_[vertex] = current_stamp_;
                number_[vertex] = uint32_t(triangles.positions.size());
                add(vertex);
            }
            vertex = number_[vertex];
        }
}

}  // namespace overlook::mesh::gltf
