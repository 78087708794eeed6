#include "tools/bake/caveclod/simplify_passes.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "formats/parallel.h"

namespace overlook::caveclod {
namespace {

constexpr size_t kPositionGrain = 2048, kFanGrain = 64;
// A pass takes from the cheapest this share of all candidates; those measured worse than kWorst times its limit wait.
constexpr double kShareOfPass = 0.4, kWorst = 2.5;
// Below this share of the mesh's size errors are rounding, and all the same.
constexpr double kLeastLimitShare = 1e-8;
constexpr double kForbidden_m = std::numeric_limits<double>::infinity();

bool prepare(const WorkingMesh& mesh, uint32_t gone, uint32_t kept, Fan& fan) {
    Star star;
    if (!gather_star(mesh, gone, star)) return false;
    uint32_t at = uint32_t(std::find(star.link.begin(), star.link.begin() + star.count + 1, kept) - star.link.begin());
    return fan_of(star, gone, at, fan);
}

}  // namespace

Passes::Passes(WorkingMesh& mesh, SimplifyReport& report)
    : mesh_(mesh), report_(report), quadrics_(make_quadrics(mesh)), map_(make_surface_map(mesh)) {
    face_count_ = mesh.face_count();
    glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
    for (const glm::vec3& p : mesh.positions_m) low = glm::min(low, p), high = glm::max(high, p);
    limit_m_ = kLeastLimitShare * double(glm::length(high - low));
    size_t position_count = mesh.some_corner.size();
    for (uint32_t p = 0; p < position_count; ++p)
        if (mesh.is_alive(p) && mesh.kind[p] != PositionKind::rigid) alive_.push_back(p);
    candidates_.resize(position_count);
    is_stale_.assign(position_count, 1);
    touched_in_.assign(position_count, 0);
    target_in_.assign(position_count, 0);
}

bool Passes::run(uint64_t least_face_count, CollapseLog& log) {
    ++pass_;
    find_candidates();
    raise_limit();
    if (queue_.empty() || face_count_ <= least_face_count) return false;
    select(least_face_count);
    measure();
    decide(log);
    provide_crossings();
    apply();
    std::erase_if(alive_, [&](uint32_t p) { return !mesh_.is_alive(p); });
    ++report_.pass_count;
    return true;
}

void Passes::find_candidates() {
    parallel_ranges(alive_.size(), kPositionGrain, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            uint32_t p = alive_[i];
            if (is_stale_[p] == 0) continue;
            candidates_[p] = find_candidate(mesh_, quadrics_, p);
            is_stale_[p] = 0;
        }
    });
}

// The queue holds the candidates within the limit, cheapest first.
void Passes::raise_limit() {
    queue_.clear();
    for (uint32_t p : alive_)
        if (candidates_[p].kept != kNone) queue_.emplace_back(float(candidates_[p].cost_m), p);
    if (queue_.empty()) return;
    auto bound = queue_.begin() + ptrdiff_t(double(queue_.size() - 1) * kShareOfPass);
    std::nth_element(queue_.begin(), bound, queue_.end());
    limit_m_ = std::max(limit_m_, double(bound->first));
    std::erase_if(queue_, [&](const auto& entry) { return double(entry.first) > limit_m_; });
    std::sort(queue_.begin(), queue_.end());
}

// Collapses of one pass share no face, and none changes the star of a position that another collapses into: so each stays allowed
// whichever of the others are made.
bool Passes::claim(uint32_t gone, uint32_t kept) {
    if (touched_in_[gone] == pass_ || touched_in_[kept] == pass_ || target_in_[gone] == pass_) return false;
    Star star;
    if (!gather_star(mesh_, gone, star)) return false;
    uint32_t count = star.count + uint32_t(!star.is_closed);
    for (uint32_t i = 0; i < count; ++i)
        if (target_in_[star.link[i]] == pass_) return false;
    for (uint32_t i = 0; i < count; ++i) touched_in_[star.link[i]] = pass_;
    for (uint32_t i = 0; i < star.count; ++i) map_.fan_of_face[star.corner[i] / kCorners] = next_fan_;
    touched_in_[gone] = pass_;
    target_in_[kept] = pass_;
    ++next_fan_;
    return true;
}

void Passes::select(uint64_t least_face_count) {
    chosen_.clear();
    first_fan_ = next_fan_;
    uint64_t most = (face_count_ - least_face_count + 1) / 2;
    for (auto [cost, p] : queue_) {
        if (chosen_.size() >= most) break;
        if (claim(p, candidates_[p].kept)) chosen_.push_back({p, candidates_[p].kept, {}, false});
    }
    changes_.resize(std::max(changes_.size(), (chosen_.size() + kFanGrain - 1) / kFanGrain));
}

void Passes::measure() {
    parallel_ranges(chosen_.size(), kFanGrain, [&](size_t begin, size_t end) {
        MapChanges& changes = changes_[begin / kFanGrain];
        changes.splices.clear(), changes.added.clear();
        Fan fan;
        for (size_t i = begin; i < end; ++i) {
            prepare(mesh_, chosen_[i].gone, chosen_[i].kept, fan);
            chosen_[i].measured = measure_collapse(map_, mesh_, fan, first_fan_ + uint32_t(i), changes);
        }
    });
}

void Passes::record(const Chosen& chosen, const Fan& fan, const TurnedVertices& turned, CollapseLog& log) const {
    float error_m = float(chosen.measured.error_m);
    if (double(error_m) < chosen.measured.error_m) error_m = std::nextafter(error_m, std::numeric_limits<float>::infinity());
    log.gone.push_back(chosen.gone);
    log.kept.push_back(chosen.kept);
    log.error_m.push_back(error_m);
    for (uint32_t i = 0; i < fan.count; ++i) {
        bool stays = i >= fan.first && i <= fan.last;
        log.turns.push_back({fan.corner[i], mesh_.vertex[fan.corner[i]], stays ? turned[i] : kNone});
    }
    log.turn_begin.push_back(uint32_t(log.turns.size()));
}

void Passes::decide(CollapseLog& log) {
    Fan fan;
    TurnedVertices turned;
    for (Chosen& chosen : chosen_) {
        Candidate& candidate = candidates_[chosen.gone];
        chosen.is_made = chosen.measured.faces_its_source && chosen.measured.error_m <= kWorst * limit_m_;
        if (!chosen.measured.faces_its_source) {
            candidate = {kForbidden_m, kNone};
            ++report_.refused_count;
        } else if (!chosen.is_made) {
            candidate.cost_m = chosen.measured.error_m / kWorst;
            ++report_.postponed_count;
        } else {
            prepare(mesh_, chosen.gone, chosen.kept, fan);
            keeps_groups(mesh_, fan, turned);
            record(chosen, fan, turned, log);
            face_count_ -= fan.count - (fan.last + 1 - fan.first);
        }
    }
}

// Every block gets as many crossings as it adds before it starts, so that none has to ask while others work.
void Passes::provide_crossings() {
    for (size_t b = 0; b * kFanGrain < chosen_.size(); ++b) {
        MapChanges& changes = changes_[b];
        while (changes.spare.size() < changes.added.size()) {
            changes.spare.push_back(uint32_t(map_.crossings.size()));
            map_.crossings.emplace_back();
        }
    }
}

void Passes::apply() {
    parallel_ranges(chosen_.size(), kFanGrain, [&](size_t begin, size_t end) {
        Fan fan;
        TurnedVertices turned;
        for (size_t i = begin; i < end; ++i) {
            const Chosen& chosen = chosen_[i];
            if (!chosen.is_made) continue;
            prepare(mesh_, chosen.gone, chosen.kept, fan);
            keeps_groups(mesh_, fan, turned);
            apply_to_map(map_, mesh_, fan, chosen.measured, changes_[begin / kFanGrain]);
            apply_collapse(mesh_, fan, turned);
            quadrics_[chosen.kept].add(quadrics_[chosen.gone]);
            mark_around(chosen.kept);
        }
    });
}

void Passes::mark_around(uint32_t position) {
    Star star;
    if (!gather_star(mesh_, position, star)) return;
    is_stale_[position] = 1;
    for (uint32_t i = 0; i < star.count + uint32_t(!star.is_closed); ++i)
        std::atomic_ref(is_stale_[star.link[i]]).store(1, std::memory_order_relaxed);
}

}  // namespace overlook::caveclod
