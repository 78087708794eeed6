#include "tools/bake/caveclod/simplify_passes.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>

#include "formats/parallel.h"
#include "tools/bake/caveclod/stopwatch.h"
#include "tools/bake/caveclod/thickness.h"

namespace overlook::caveclod {
namespace {

constexpr size_t kPositionGrain = 2048, kCheckGrain = 512;
// What is known of a position's candidate; kNext: it was refused, and the next dearer one is wanted
// (where seams move).
constexpr uint8_t kNothing = 0, kGuess = 1, kNext = 2, kAllowed = 3;
// A collapse out of order holds all that comes after it at its error, so where the limit is above this share of the mesh's size,
// and few faces are left, a pass is choosier.
constexpr double kCoarseShare = 1e-3;
// Below this share of the mesh's size errors are rounding, and all the same.
constexpr double kLeastLimitShare = 1e-8;
// The queue keeps costs as float: what waited must not miss its limit by their rounding.
constexpr double kFloatAllowance = 1 + 1e-6;
constexpr double kForbidden_m = std::numeric_limits<double>::infinity();

// The first 16 bits of a cost (not negative): costs within one percent are alike.
uint32_t step_of(float cost_m) {
    return std::bit_cast<uint32_t>(cost_m) >> 16;
}

float float_at_least(double value) {
    float rounded = float(value);
    return double(rounded) < value ? std::nextafter(rounded, std::numeric_limits<float>::infinity()) : rounded;
}

SourceParts parts_of(const WorkingMesh& mesh) {
    std::vector<std::array<uint32_t, 3>> faces;
    faces.reserve(mesh.face_count());
    for (const WorkingFace& face : mesh.faces) faces.push_back({face.position[0], face.position[1], face.position[2]});
    return SourceParts(mesh.positions_m, faces);
}

}  // namespace

Passes::Passes(WorkingMesh& mesh, const SimplifyOptions& options, SimplifyReport& report)
    : mesh_(mesh),
      seams_(options.seams),
      report_(report),
      source_({}, {}),
      refused_(mesh.some_corner.size()),
      slack_m_(turn_slack_m(mesh.positions_m)),
      face_error_m_(mesh.face_count(), 0.0f) {
    parallel_ranges(3, 1, [&](size_t part, size_t) {
        if (part == 0) source_ = parts_of(mesh);
        if (part == 1) quadrics_ = make_quadrics(mesh);
        if (part == 2) map_ = make_surface_map(mesh);
    });
    face_count_ = mesh.face_count();
    glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
    for (const glm::vec3& p : mesh.positions_m) low = glm::min(low, p), high = glm::max(high, p);
    size_m_ = double(glm::length(high - low));
    limit_m_ = kLeastLimitShare * size_m_;
    if (options.keeps_thin) find_thin_things();
    size_t position_count = mesh.some_corner.size();
    for (uint32_t p = 0; p < position_count; ++p)
        if (mesh.is_alive(p) && mesh.kind[p] != PositionKind::rigid) alive_.push_back(p);
    candidates_.resize(position_count);
    known_.assign(position_count, kNothing);
    refused_by_.assign(position_count, Hindrance::turned);
    touched_in_.assign(position_count, 0);
    target_in_.assign(position_count, 0);
}

void Passes::find_thin_things() {
    std::vector<float> thickness_m = thickness_of_positions(mesh_, source_, slack_m_, kThinnestShare * size_m_);
    for (size_t p = 0; p < thickness_m.size(); ++p) map_.may_lose_m[p] = float(kMostThinning) * thickness_m[p];
}

bool Passes::run(uint64_t least_face_count, CollapseLog& log) {
    ++pass_;
    find_queue();
    if (limit_m_ == kForbidden_m || face_count_ <= least_face_count) return false;
    select(least_face_count);
    measure();
    decide(log);
    provide_crossings();
    apply();
    std::erase_if(alive_, [&](uint32_t p) { return !mesh_.is_alive(p); });
    ++report_.pass_count;
    return true;
}

Hindrance Passes::hindrance_of(uint32_t position) const {
    Hindrance rule = caveclod::hindrance_of(mesh_, position);
    return rule == Hindrance::turned ? refused_by_[position] : rule;
}

Passes::Choosiness Passes::choosiness() const {
    constexpr Choosiness kFine{0.5, 2.5}, kCoarse{0.25, 1};
    return limit_m_ > kCoarseShare * size_m_ ? kCoarse : kFine;
}

void Passes::find_queue() {
    Stopwatch watch(report_.candidates_s);
    guess_candidates();
    raise_limit();
    check_candidates();
}

void Passes::guess_candidates() {
    parallel_ranges(alive_.size(), kPositionGrain, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            uint32_t p = alive_[i];
            if (known_[p] != kNothing) continue;
            candidates_[p] = guess_candidate(mesh_, quadrics_, p);
            known_[p] = kGuess;
        }
    });
}

// The queue holds the candidates within the limit, in the order of their positions: neighbours are looked at one after the other.
void Passes::raise_limit() {
    costs_.clear(), queue_.clear();
    for (uint32_t p : alive_)
        if (candidates_[p].kept != kNone) costs_.push_back(float(candidates_[p].cost_m));
    if (costs_.empty()) limit_m_ = kForbidden_m;
    if (costs_.empty()) return;
    auto bound = costs_.begin() + ptrdiff_t(double(costs_.size() - 1) * choosiness().share_of_pass);
    std::nth_element(costs_.begin(), bound, costs_.end());
    limit_m_ = std::max(limit_m_, double(*bound));
    for (uint32_t p : alive_)
        if (candidates_[p].kept != kNone && double(float(candidates_[p].cost_m)) <= limit_m_)
            queue_.emplace_back(float(candidates_[p].cost_m), p);
}

// Only what this pass might take is looked at closely. Cheapest first then.
void Passes::check_candidates() {
    parallel_ranges(queue_.size(), kCheckGrain, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            uint32_t p = queue_[i].second;
            if (known_[p] == kAllowed) continue;
            candidates_[p] = find_candidate(mesh_, quadrics_, refused_, p, known_[p] == kNext ? candidates_[p].bare_cost_m : -1);
            known_[p] = kAllowed;
            queue_[i].first =
                candidates_[p].kept == kNone ? std::numeric_limits<float>::infinity() : float(candidates_[p].cost_m);
        }
    });
    std::erase_if(queue_, [&](const auto& entry) { return double(entry.first) > limit_m_; });
    sort_queue();
}

// By steps of cost, and by position within a step.
void Passes::sort_queue() {
    auto by_step = [](const auto& a, const auto& b) { return step_of(a.first) < step_of(b.first); };
    constexpr size_t kFew = 4096;
    if (queue_.size() < kFew) return std::stable_sort(queue_.begin(), queue_.end(), by_step);
    std::vector<uint32_t> begin((1u << 16) + 1, 0);
    for (const auto& entry : queue_) ++begin[step_of(entry.first) + 1];
    for (size_t step = 1; step < begin.size(); ++step) begin[step] += begin[step - 1];
    sorted_.resize(queue_.size());
    for (const auto& entry : queue_) sorted_[begin[step_of(entry.first)]++] = entry;
    std::swap(queue_, sorted_);
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
    return true;
}

void Passes::select(uint64_t least_face_count) {
    Stopwatch watch(report_.selection_s);
    chosen_.clear();
    uint64_t most = (face_count_ - least_face_count + 1) / 2;
    for (auto [cost, p] : queue_) {
        if (chosen_.size() >= most) break;
        if (!claim(p, candidates_[p].kept)) continue;
        Chosen& chosen = chosen_.emplace_back();
        chosen.gone = p, chosen.kept = candidates_[p].kept, chosen.fan = next_fan_++;
    }
    // Made in the order of positions, neighbours find one another's memory warm: several times faster than in the order of cost.
    std::sort(chosen_.begin(), chosen_.end(), [](const Chosen& a, const Chosen& b) { return a.gone < b.gone; });
    changes_.resize(std::max(changes_.size(), (chosen_.size() + kFanGrain - 1) / kFanGrain));
}

void Passes::record(const Chosen& chosen, const TurnedFan& prepared, CollapseLog& log) {
    const Fan& fan = prepared.fan;
    log.gone.push_back(chosen.gone);
    log.kept.push_back(chosen.kept);
    log.error_m.push_back(float_at_least(chosen.stated_m));
    report_.seam_error.include(chosen.seam_error);
    report_.greatest_seam_shift_m = std::max(report_.greatest_seam_shift_m, chosen.seam_shift_m);
    for (uint32_t i = 0; i < fan.count; ++i) {
        bool stays = i >= fan.first && i <= fan.last;
        report_.carried_count += stays && (prepared.turned[i] & kCarried) != 0;
        log.turns.push_back({fan.corner[i], mesh_.vertex(fan.corner[i]), stays ? prepared.turned[i] : kNone});
    }
    log.turn_begin.push_back(uint32_t(log.turns.size()));
}

void Passes::decide(CollapseLog& log) {
    Stopwatch watch(report_.selection_s);
    size_t made_before = log.gone.size();
    double least_waiting_m = kForbidden_m, most_m = most_allowed_m();
    for (size_t i = 0; i < chosen_.size(); ++i) {
        Chosen& chosen = chosen_[i];
        Candidate& candidate = candidates_[chosen.gone];
        chosen.is_made = !chosen.is_refused && chosen.worst_m <= most_m;
        if (chosen.turned_face != kNone) refused_.add(fans_[i].fan, chosen.turned_face);
        if (chosen.is_refused) {
            if (mesh_.seams_move)
                known_[chosen.gone] = kNext;
            else
                candidate = {kForbidden_m, kNone, 0};
            ++report_.refused_count;
            refused_by_[chosen.gone] = chosen.refused_by;
        } else if (!chosen.is_made) {
            candidate.cost_m = chosen.worst_m / choosiness().worst * kFloatAllowance;  // at such a limit it may be made
            least_waiting_m = std::min(least_waiting_m, candidate.cost_m);
            ++report_.postponed_count;
        } else {
            record(chosen, fans_[i], log);
            face_count_ -= fans_[i].fan.count - (fans_[i].fan.last + 1 - fans_[i].fan.first);
        }
    }
    // A pass in which all have to wait lets the first of them go in the next.
    if (log.gone.size() == made_before && least_waiting_m < kForbidden_m) limit_m_ = std::max(limit_m_, least_waiting_m);
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
    Stopwatch watch(report_.applying_s);
    parallel_ranges(chosen_.size(), kFanGrain, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const Chosen& chosen = chosen_[i];
            if (!chosen.is_made) continue;
            for (uint32_t f = fans_[i].fan.first; f <= fans_[i].fan.last; ++f)
                face_error_m_[fans_[i].fan.corner[f] / kCorners] = float_at_least(chosen.fan_error_m);
            apply_to_map(map_, mesh_, fans_[i].fan, chosen.measured, changes_[begin / kFanGrain]);
            apply_collapse(mesh_, fans_[i].fan, fans_[i].turned);
            quadrics_[chosen.kept].add(quadrics_[chosen.gone]);
            mark_around(fans_[i].fan);
        }
    });
}

// Costs change here, and what is allowed. The old cost serves as a guess until the pass comes to it and looks closely; only where
// nothing was allowed is a new one needed.
void Passes::forget(uint32_t position) {
    uint8_t least = candidates_[position].kept == kNone ? kNothing : kGuess;
    std::atomic_ref known(known_[position]);
    if (known.load(std::memory_order_relaxed) > least) known.store(least, std::memory_order_relaxed);
}

void Passes::mark_around(const Fan& fan) {
    Star star;
    for (uint32_t i = 0; i <= fan.count; ++i) forget(fan.link[i]);
    if (!gather_star(mesh_, fan.kept, star)) return;
    for (uint32_t i = 0; i < star.count + uint32_t(!star.is_closed); ++i) forget(star.link[i]);
}

}  // namespace overlook::caveclod
