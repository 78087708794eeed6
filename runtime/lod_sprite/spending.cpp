#include "runtime/lod_sprite/spending.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace overlook::lod_sprite {
namespace {

constexpr double kCoarseShare = 0.5;
constexpr double kBand = 0.025;     // of the budget: what is not worth beginning a key for
constexpr double kBindsFrom = 0.8;  // of the budget
constexpr double kEarly = 0.7;      // of the time that a key may take: made within it, keys' errors come down again

view::ErrorBudget coarse_budget(double triangles) {
    return {kCoarseShare * triangles, 1, false};
}

}  // namespace

Spending::Spending(double triangles)
    : triangles_(triangles), keyed_(coarse_budget(triangles)), unkeyed_(coarse_budget(triangles)) {}

void Spending::set_triangles(double triangles) {
    triangles_ = triangles;
    keyed_.set_budget(coarse_budget(triangles));
    unkeyed_.set_budget(coarse_budget(triangles));
    if (!is_limited()) keys_coarser_ = 1;
}

bool Spending::coarse_done(bool has_key, uint64_t triangles) {
    coarse_triangles_ = triangles;
    (has_key ? keyed_ : unkeyed_).frame_done(double(triangles));
    return !is_limited() || double(triangles) <= kCoarseShare * triangles_;
}

// A key's triangles are taken to fall as its error grows.
void Spending::plan_key(uint64_t expected, uint32_t most_frames) {
    if (!is_limited()) return;
    double share = double(frames_for(expected)) / most_frames;
    if (share > 1) keys_coarser_ *= share;
    if (share < kEarly) keys_coarser_ = std::max(1.0, keys_coarser_ * share / kEarly);
}

uint32_t Spending::frames_for(uint64_t expected) const {
    return uint32_t(std::clamp(std::ceil(double(expected) / double(std::max<uint64_t>(left(0), 1))), 1.0, 1e6));
}

uint64_t Spending::left(uint64_t spent) const {
    if (!is_limited()) return std::numeric_limits<uint64_t>::max();
    double rest = triangles_ - double(coarse_triangles_) - double(spent);
    return rest > 0 ? uint64_t(rest) : 0;
}

bool Spending::is_much_left(uint64_t spent) const {
    return is_limited() && double(left(spent)) > kBand * triangles_;
}

bool Spending::binds(uint64_t key_triangles, double life_frames) const {
    if (!is_limited()) return false;
    double wanted = double(coarse_triangles_) + double(key_triangles) / std::max(life_frames, 1.0);
    return coarser(true) > 1 || keys_coarser_ > 1 || wanted >= kBindsFrom * triangles_;
}

}  // namespace overlook::lod_sprite
