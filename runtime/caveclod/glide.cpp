// Vertices on their way: Refinement's geomorphs.
#include <algorithm>
#include <array>

#include "runtime/caveclod/refine.h"
#include "runtime/caveclod/refine_frame.h"

namespace overlook::caveclod {

// Of the split in record_, which is applied: what each of its new vertices comes from.
void Refinement::find_sources(bool glides) {
    constexpr double kNowhere = -1e300, kSteps = 65535;
    sources_.clear(), inside_.clear();
    auto source_of = [&](uint32_t to, uint32_t owner) {
        for (size_t i = 0; i < sources_.size(); ++i)
            if (sources_[i].to() == to) return i;
        sources_.push_back({to | (glides ? GlideVertex::kGlides : 0), 0, {}, {owner, owner, owner}});
        inside_.push_back(kNowhere);
        return sources_.size() - 1;
    };
    for (const SplitRecord::Move& move : record_.moves) {
        size_t source = source_of(move.vertex, move.vertex_before);
        if (glides) continue;
        uint32_t face = move.corner / kCorners, corner = move.corner % kCorners;
        std::array<uint32_t, 3> from = {move.vertex_before, faces_.index_at(face * kCorners + (corner + 1) % 3),
                                        faces_.index_at(face * kCorners + (corner + 2) % 3)};
        if (std::max(from[1], from[2]) >= mesh_.glide_begin()) continue;  // on its way itself
        glm::dvec3 to_m = mesh_.vertex_m(move.vertex), a = mesh_.vertex_m(from[0]);
        glm::dvec3 ab = mesh_.vertex_m(from[1]) - a, ac = mesh_.vertex_m(from[2]) - a, normal = glm::cross(ab, ac);
        double area = glm::dot(normal, normal);
        if (area <= 0) continue;
        double b = glm::dot(glm::cross(to_m - a, ac), normal) / area, c = glm::dot(glm::cross(ab, to_m - a), normal) / area;
        double inside = std::min({1 - b - c, b, c});
        if (inside <= inside_[source]) continue;
        b = std::clamp(b, 0.0, 1.0), c = std::clamp(c, 0.0, 1 - b);
        inside_[source] = inside;
        sources_[source].from = from;
        sources_[source].weights = {uint16_t((1 - b - c) * kSteps), uint16_t(b * kSteps)};
    }
    for (uint32_t k = 0; k < record_.face_count; ++k)
        source_of(record_.faces[k].vertices[record_.faces[k].new_corner], record_.faces[k].vertices[0]);
}

// The split in record_ is applied: its corners at the new position are replaced by ones on their way.
void Refinement::start_glide(uint32_t split, bool is_collapsing, float share) {
    find_sources(mesh_.glides(split));
    for (GlideVertex& source : sources_) source.share = share;
    Glide glide;
    glide.split = split, glide.share = share, glide.is_collapsing = is_collapsing, glide.moves = mesh_.glides(split);
    glides_.add(glide, sources_, slots_);
    auto on_its_way = [&](uint32_t to) {
        size_t i = 0;
        while (sources_[i].to() != to) ++i;
        return mesh_.glide_begin() + slots_[i];
    };
    for (const SplitRecord::Move& move : record_.moves) faces_.set(move.corner, on_its_way(move.vertex));
    for (uint32_t k = 0; k < record_.face_count; ++k) {
        const SplitRecord::Face& face = record_.faces[k];
        faces_.set(face.face * kCorners + face.new_corner, on_its_way(face.vertices[face.new_corner]));
    }
    put(gliding_, split, true);
}

// At its own place from now on.
void Refinement::finish_glide(uint32_t split) {
    mesh_.decode(split, other_);
    for (const SplitRecord::Move& move : other_.moves) faces_.set(move.corner, move.vertex);
    for (uint32_t k = 0; k < other_.face_count; ++k) {
        const SplitRecord::Face& face = other_.faces[k];
        faces_.set(face.face * kCorners + face.new_corner, face.vertices[face.new_corner]);
    }
    glides_.remove(split);
    put(gliding_, split, false);
}

void Refinement::advance_glides(Frame& frame, double dt_s) {
    glides_.advance(frame.settings.glide_s > 0 ? float(dt_s / frame.settings.glide_s) : 1.0f, arrived_);
    for (const Glide& glide : arrived_) {
        finish_glide(glide.split);
        if (glide.is_collapsing) undo(frame, glide.split);
    }
}

}  // namespace overlook::caveclod
