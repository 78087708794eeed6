#include "runtime/caveclod/mesh.h"

#include <algorithm>

#include "runtime/caveclod/mesh_record.h"

namespace overlook::caveclod {
namespace {

inline uint32_t get(const uint8_t*& at) {
    uint32_t value = *at & 127;
    for (uint32_t shift = 7; (*at++ & 128) != 0; shift += 7) value |= uint32_t(*at & 127) << shift;
    return value;
}

}  // namespace

void Mesh::decode_needs(uint32_t split, std::vector<uint32_t>& needs) const {
    const uint8_t* at = records_.data() + record_begin_[split] + 1;
    needs.clear();
    uint32_t last = split;
    for (uint32_t count = get(at); count > 0; --count) needs.push_back(last -= get(at));
}

void Mesh::decode_dependents(uint32_t split, std::vector<uint32_t>& dependents) const {
    const uint8_t* at = records_.data() + record_begin_[split] + 1;
    for (uint32_t count = get(at); count > 0; --count) get(at);
    dependents.clear();
    uint32_t last = split;
    for (uint32_t count = get(at); count > 0; --count) {
        last += get(at);
        if (last < split_count()) dependents.push_back(last);
    }
}

void Mesh::decode(uint32_t split, SplitRecord& record) const {
    const uint8_t* at = records_.data() + record_begin_[split];
    uint8_t head = *at++;
    record.needs.clear(), record.dependents.clear(), record.moves.clear();
    uint32_t last = split;
    for (uint32_t count = get(at); count > 0; --count) record.needs.push_back(last -= get(at));
    last = split;
    for (uint32_t count = get(at); count > 0; --count) {
        last += get(at);
        if (last < split_count()) record.dependents.push_back(last);  // else it is not there any more
    }

    uint32_t created = base_position_count_ + split, owner = created - get(at);
    uint32_t owner_vertex = vertex_begin(owner), new_vertex = vertex_begin(created);
    uint32_t first_face = base_face_count() + 2 * split - get(at), face = first_face;
    for (uint32_t count = get(at); count > 0; --count) {
        uint32_t coded = get(at), corner = coded % kCorners;
        face -= coded / kCorners;
        SplitRecord::Move move{face * kCorners + corner, new_vertex, owner_vertex};
        if ((head & kHasMoveWedges) != 0) move.vertex += get(at), move.vertex_before += get(at);
        record.moves.push_back(move);
    }
    record.face_count = head & kFaceCount;
    for (uint32_t k = 0; k < record.face_count; ++k) {
        SplitRecord::Face& added = record.faces[k];
        bool third_is_last = (head & kThirdIsLast << k) != 0;
        uint32_t third_vertex = vertex_begin(created - get(at));
        added.face = first_face + k;
        added.surface = surfaces_.size() > 1 ? get(at) : 0;
        added.new_corner = third_is_last ? 1 : 2;
        added.vertices = {owner_vertex, third_is_last ? new_vertex : third_vertex, third_is_last ? third_vertex : new_vertex};
        if ((head & kHasFaceWedges) != 0)
            for (uint32_t& vertex : added.vertices) vertex += get(at);
    }
}

void Mesh::grow(Mesh&& finer) {
    std::vector<Surface> surfaces = std::move(surfaces_);
    *this = std::move(finer);
    surfaces_ = std::move(surfaces);
}

void Mesh::shrink(const Extent& extent, float missing_error_m) {
    auto [split_count, face_count, vertex_count] = extent;
    auto cut = [](auto& vector, size_t size) {
        if (vector.size() <= size) return;
        vector.resize(size);
        vector.shrink_to_fit();
    };
    if (split_count < record_begin_.size()) cut(records_, record_begin_[split_count]);
    size_t position_count = size_t(base_position_count_) + split_count;
    cut(bounds_, split_count), cut(record_begin_, split_count), cut(glides_, (split_count + 63) / 64);
    cut(vertex_blocks_, (position_count + kRowBlock - 1) / kRowBlock);
    cut(vertex_rows_, position_count), cut(wide_rows_, position_count);
    cut(vertices_, vertex_count), cut(colours_, vertex_count);
    cut(roots_, size_t(std::lower_bound(roots_.begin(), roots_.end(), split_count) - roots_.begin()));
    split_limit_ = split_count, face_count_ = face_count;
    missing_error_m_ = missing_error_m, finest_error_m_ = std::max(finest_error_m_, missing_error_m);
}

glm::dvec3 Mesh::vertex_m(uint32_t vertex) const {
    const PackedVertex& packed = vertices_[vertex];
    uint32_t low_bits = grid_.position_bits > 16 ? grid_.position_bits - 16 : 0;
    glm::dvec3 steps;
    for (int axis = 0; axis < 3; ++axis)
        steps[axis] = double(uint32_t(packed.position[size_t(axis)]) << low_bits | (packed.position_low >> (4 * axis) & 15));
    return steps * position_step_m_;
}

Mesh::Bytes Mesh::bytes() const {
    auto of = [](const auto& vector) { return uint64_t(vector.size() * sizeof(vector[0])); };
    Bytes bytes;
    bytes.bounds = of(bounds_);
    bytes.records = of(record_begin_) + of(records_) + of(roots_);
    bytes.vertices = of(vertices_) + of(colours_) + of(vertex_blocks_) + of(vertex_rows_) + of(wide_rows_);
    bytes.base = of(base_faces_) + of(base_surfaces_);
    bytes.glides = of(glides_);
    return bytes;
}

}  // namespace overlook::caveclod
