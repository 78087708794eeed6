#include "runtime/lod_sprite/paper_sprite.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace overlook::lod_sprite::paper {

double shared_view(const view::Camera& key, const view::Camera& now) {
    constexpr int kSide = 16;
    view::Axes key_axes = view::axes_of(key), axes = view::axes_of(now);
    double key_focal = view::focal_px(key), focal = view::focal_px(now);
    int shared = 0;
    for (int i = 0; i < kSide * kSide; ++i) {
        double x_px = now.width_px * ((i % kSide + 0.5) / kSide - 0.5), y_px = now.height_px * ((i / kSide + 0.5) / kSide - 0.5);
        glm::dvec3 way = axes.forward + axes.right * (x_px / focal) + axes.up * (y_px / focal);
        double depth = glm::dot(way, key_axes.forward);
        bool is_wide = std::abs(glm::dot(way, key_axes.right)) * key_focal > depth * key.width_px / 2.0;
        bool is_high = std::abs(glm::dot(way, key_axes.up)) * key_focal > depth * key.height_px / 2.0;
        shared += depth > 0 && !is_wide && !is_high;
    }
    return double(shared) / (kSide * kSide);
}

Sprite::Sprite(const terrain::Terrain& terrain, const Options& options)
    : options_(options),
      diagonal_m_(std::hypot((terrain.shape.width - 1) * terrain.frame.metres_per_column,
                             (terrain.shape.height - 1) * terrain.frame.metres_per_row)),
      metric_(terrain, options.error),
      visible_(terrain, options.depth, options.new_triangles) {}

bool Sprite::is_jump(const view::Camera& now) const {
    const view::Camera& key = key_.camera();
    if (glm::length(now.position_m - key.position_m) > options_.jump.farthest_move * diagonal_m_) return true;
    return shared_view(key, now) < options_.jump.least_shared_view;
}

Decision Sprite::decide(const view::Camera& now, const terrain::Cut& low) {
    if (!has_key_ || now.width_px != key_.camera().width_px || now.height_px != key_.camera().height_px)
        return {KeyReason::first, {}};
    if (is_jump(now)) return {KeyReason::jump, {}};
    Decision decision{KeyReason::none, metric_.measure(key_.camera(), now, low)};
    if (!(decision.error.rms_px < options_.key_error_px)) decision.reason = KeyReason::error;
    return decision;
}

void Sprite::keep(const view::Camera& camera, std::span<const float> near_over_depth, const terrain::Cut& low) {
    key_.keep(camera, near_over_depth);
    visible_.start(key_, low);
    has_key_ = true;
}

std::span<const uint8_t> Sprite::flags(const terrain::Cut& low) {
    assert(has_key_);
    visible_.read(key_, low, flags_);
    counts_ = {};
    counts_.vertex_count = low.indices.size();
    if (options_.strips) {
        strips_.build(low, *options_.strips);
        counts_.lost_to_strips_count = strips_.take_from_mixed(flags_);
        counts_.vertex_count = strips_.vertex_count();
    }
    counts_.sprite_count = std::accumulate(flags_.begin(), flags_.end(), uint64_t(0));
    return flags_;
}

}  // namespace overlook::lod_sprite::paper
