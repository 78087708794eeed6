// Vertices on their way: Refinement's geomorphs.
#include <algorithm>
#include <utility>

#include "runtime/caveclod/refine.h"
#include "runtime/caveclod/refine_frame.h"

namespace overlook::caveclod {

uint32_t Refinement::take_glide_slot(const GlideVertex& vertex) {
    if (free_glide_slots_.empty()) {
        glide_vertices_.push_back(vertex);
        return uint32_t(glide_vertices_.size() - 1);
    }
    uint32_t slot = free_glide_slots_.back();
    free_glide_slots_.pop_back();
    glide_vertices_[slot] = vertex;
    return slot;
}

// record_ is that of `split`, which is applied: its corners at the new position are replaced by gliding ones.
void Refinement::start_glide(uint32_t split, bool is_collapsing, float share) {
    mesh_.decode(split, record_);
    Glide glide{share, is_collapsing, {}};
    auto gliding = [&](uint32_t to, uint32_t from) {
        for (uint32_t slot : glide.slots)
            if (glide_vertices_[slot].to == to && glide_vertices_[slot].from == from) return mesh_.vertex_count() + slot;
        glide.slots.push_back(take_glide_slot({to, from, share}));
        return mesh_.vertex_count() + glide.slots.back();
    };
    for (const SplitRecord::Move& move : record_.moves) faces_.set(move.corner, gliding(move.vertex, move.vertex_before));
    for (uint32_t k = 0; k < record_.face_count; ++k) {
        const SplitRecord::Face& face = record_.faces[k];
        faces_.set(face.face * kCorners + face.new_corner, gliding(face.vertices[face.new_corner], face.vertices[0]));
    }
    put(gliding_, split, true);
    glides_.emplace(split, std::move(glide));
}

// At its own place from now on.
void Refinement::finish_glide(uint32_t split) {
    mesh_.decode(split, other_);
    for (const SplitRecord::Move& move : other_.moves) faces_.set(move.corner, move.vertex);
    for (uint32_t k = 0; k < other_.face_count; ++k) {
        const SplitRecord::Face& face = other_.faces[k];
        faces_.set(face.face * kCorners + face.new_corner, face.vertices[face.new_corner]);
    }
    auto glide = glides_.find(split);
    free_glide_slots_.insert(free_glide_slots_.end(), glide->second.slots.begin(), glide->second.slots.end());
    glides_.erase(glide);
    put(gliding_, split, false);
}

void Refinement::advance_glides(Frame& frame, double dt_s) {
    float step = frame.settings.glide_s > 0 ? float(dt_s / frame.settings.glide_s) : 1.0f;
    std::vector<std::pair<uint32_t, bool>> arrived;
    for (auto& [split, glide] : glides_) {
        glide.share = std::clamp(glide.share + (glide.is_collapsing ? -step : step), 0.0f, 1.0f);
        for (uint32_t slot : glide.slots) glide_vertices_[slot].share = glide.share;
        if (glide.share == (glide.is_collapsing ? 0.0f : 1.0f)) arrived.emplace_back(split, glide.is_collapsing);
    }
    std::sort(arrived.begin(), arrived.end());
    for (auto [split, is_collapsing] : arrived) {
        finish_glide(split);
        if (is_collapsing) undo(frame, split);
    }
}

}  // namespace overlook::caveclod
