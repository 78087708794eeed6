#include "tools/bake/wang_ldi/sample.h"

#include <algorithm>
#include <cmath>

#include "tools/bake/wang_ldi/cube_table.h"
#include "tools/bake/wang_ldi/held_out.h"

namespace overlook::wang_ldi {
namespace {

constexpr uint32_t kLayersLog2 = 24;  // of cubes above each other
constexpr uint32_t kMostLooks = 4;    // of what is met in a cube, so many first ones are looked at: its colour and normal

constexpr uint32_t kLeastRaysPerEye = 1024;

// The cube that a place is in; false outside of the tile.
bool cube_of(const Wedge& wedge, const glm::dvec3& at, uint64_t& cube) {
    double per_m = wedge.side_px / wedge.tile_m;
    double column = at.x * per_m, row = at.y * per_m, layer = (at.z - wedge.low_m) * per_m;
    bool is_inside = column >= 0 && row >= 0 && column < wedge.side_px && row < wedge.side_px && layer >= 0 &&
                     layer < double(1u << kLayersLog2);
    if (!is_inside) return false;
    // Not below 0: towards 0 is down.
    cube = uint64_t(uint32_t(row) * wedge.side_px + uint32_t(column)) << kLayersLog2 | uint64_t(uint32_t(layer));
    return true;
}

glm::dvec3 place_of(const rays::Ray& ray, const rays::Hit& hit) {
    return glm::dvec3(ray.from_m) + double(hit.distance) * glm::dvec3(ray.along);
}

// What was met in a cube so far: what each hit asks for,
struct Count {
    double height_sum_m = 0;
    HeldOut::Met met;
    uint32_t looks = 0;
};
// and what the first of them look like.
struct Seen {
    glm::vec3 albedo_sum{0}, normal_sum{0};
    // Of what was looked at the place that faces its eye most: the rim of a leaf is little of what is seen.
    float facing = -1;
    rays::Hit best;
    uint32_t stage = 0;
    glm::vec3 seen_along{0};
};

// Of what an eye met, a hit in the tile.
struct Met {
    uint32_t ray = 0, number = 0;  // of the cube
    uint64_t place = 0;            // likewise
    double height_m = 0;
};

class Sampler {
  public:
    Sampler(const Models& models, const Wedge& wedge) : models_(models), wedge_(wedge) {}
    void shoot(std::span<const TraceStage> stages, size_t stage, const Eye& eye);
    const HeldOut& held_out() const { return held_out_; }
    uint64_t rays() const { return rays_; }
    Sampled take() const;

  private:
    void find_met(const Eye& eye);
    void keep(const TraceStage& of, size_t stage, const Eye& eye, const Met& met);
    Sample sample_of(uint32_t number) const;

    static constexpr size_t kAhead = 8;  // hits whose cubes are on their way from memory

    const Models& models_;
    const Wedge& wedge_;
    CubeTable table_;
    std::vector<uint64_t> places_;  // of all cubes met, as the next two
    std::vector<Count> counts_;
    std::vector<Seen> seen_;
    std::vector<rays::Hit> found_;
    std::vector<Met> met_;
    HeldOut held_out_;
    uint64_t rays_ = 0, eyes_ = 0;
};

// The hits in the tile, with the numbers of their cubes. Cubes lie all over memory: each step asks for what the next one needs.
void Sampler::find_met(const Eye& eye) {
    met_.clear();
    for (size_t i = 0; i < found_.size(); ++i) {
        if (found_[i].copy == rays::kNone) continue;
        glm::dvec3 at = place_of(eye.rays[i], found_[i]);
        Met met;
        if (!cube_of(wedge_, at, met.place)) continue;
        met.ray = uint32_t(i), met.height_m = at.z - wedge_.low_m;
        table_.fetch(met.place), met_.push_back(met);
    }
    for (Met& met : met_) {
        met.number = table_.number_of(met.place);
        if (met.number == places_.size()) places_.push_back(met.place);
    }
    counts_.resize(places_.size()), seen_.resize(places_.size());
}

void Sampler::keep(const TraceStage& of, size_t stage, const Eye& eye, const Met& met) {
    Count& count = counts_[met.number];
    held_out_.meet(count.met, eyes_);
    count.height_sum_m += met.height_m;
    if (count.looks == kMostLooks) return;
    ++count.looks;
    const rays::Hit& hit = found_[met.ray];
    const glm::vec3& along = eye.rays[met.ray].along;
    Point point = point_of(models_, of.copies, hit, along);
    Seen& seen = seen_[met.number];
    seen.albedo_sum += point.albedo, seen.normal_sum += point.normal;
    float facing = -glm::dot(point.face, along);
    if (facing <= seen.facing) return;
    seen.facing = facing, seen.best = hit, seen.stage = uint32_t(stage), seen.seen_along = along;
}

void Sampler::shoot(std::span<const TraceStage> stages, size_t stage, const Eye& eye) {
    found_.resize(eye.rays.size());
    stages[stage].scene.first_hits(eye.rays, found_);
    find_met(eye);
    for (size_t m = 0; m < met_.size(); ++m) {
        if (m + kAhead < met_.size()) __builtin_prefetch(&counts_[met_[m + kAhead].number], 1);
        keep(stages[stage], stage, eye, met_[m]);
    }
    rays_ += eye.rays.size(), ++eyes_;
}

Sample Sampler::sample_of(uint32_t number) const {
    const Count& count = counts_[number];
    const Seen& seen = seen_[number];
    Sample sample;
    sample.pixel = uint32_t(places_[number] >> kLayersLog2), sample.met = count.met.count;
    sample.layer = uint32_t(places_[number] & ((1u << kLayersLog2) - 1));
    sample.height_m = float(count.height_sum_m / count.met.count), sample.albedo = seen.albedo_sum / float(count.looks);
    float length = glm::length(seen.normal_sum);
    sample.normal = length > 1e-6f ? seen.normal_sum / length : -glm::normalize(seen.seen_along);
    sample.hit = seen.best, sample.stage = seen.stage, sample.seen_along = seen.seen_along;
    return sample;
}

Sampled Sampler::take() const {
    std::vector<std::pair<uint64_t, uint32_t>> by_place;
    by_place.reserve(places_.size());
    for (size_t number = 0; number < places_.size(); ++number) by_place.emplace_back(places_[number], uint32_t(number));
    std::sort(by_place.begin(), by_place.end());
    Sampled made;
    made.rays = rays_, made.hits = held_out_.hits(), made.eyes = eyes_, made.unseen_share = held_out_.unseen_share();
    made.samples.reserve(by_place.size());
    for (const auto& [place, number] : by_place) made.samples.push_back(sample_of(number));
    return made;
}

}  // namespace

uint32_t rays_per_eye(const Wedge& wedge, const SampleOptions& options) {
    if (options.fixed_rays > 0) return options.rays_per_eye;
    return std::clamp(4 * wedge.side_px * wedge.side_px, std::min(kLeastRaysPerEye, options.rays_per_eye), options.rays_per_eye);
}

Sampled sampled(const Models& models, std::span<const TraceStage> stages, const Wedge& wedge, const SampleOptions& options) {
    Sampler sampler(models, wedge);
    auto is_enough = [&](uint64_t eyes) {
        if (options.fixed_rays > 0) return sampler.rays() >= options.fixed_rays;
        if (sampler.rays() >= options.most_rays) return true;
        return (eyes >= options.least_eyes && sampler.held_out().is_within(options.unseen_goal)) ||
               sampler.held_out().is_of_nothing(eyes, options.least_eyes);
    };
    Eye one;
    for (uint64_t eye = 0; !is_enough(eye); ++eye) {
        set_eye(wedge, options.seed, eye, rays_per_eye(wedge, options), one);
        sampler.shoot(stages, eye % stages.size(), one);
    }
    return sampler.take();
}

double unseen_of_held_out(std::span<const TraceStage> stages, const Wedge& wedge, const Sampled& of, uint64_t rays,
                          uint64_t seed) {
    CubeTable known;
    double per_m = wedge.side_px / wedge.tile_m;
    for (const Sample& sample : of.samples)
        known.number_of(uint64_t(sample.pixel) << kLayersLog2 | uint64_t(std::floor(double(sample.height_m) * per_m)));
    uint64_t shot = 0, hits = 0, unseen = 0;
    std::vector<rays::Hit> found;
    Eye one;
    for (uint64_t eye = 0; shot < rays; ++eye) {
        set_eye(wedge, seed, eye, 1u << 14, one);
        const TraceStage& stage = stages[eye % stages.size()];
        found.resize(one.rays.size());
        stage.scene.first_hits(one.rays, found);
        for (size_t i = 0; i < found.size(); ++i) {
            uint64_t cube = 0;
            if (found[i].copy == rays::kNone || !cube_of(wedge, place_of(one.rays[i], found[i]), cube)) continue;
            ++hits, unseen += known.find(cube) == CubeTable::kNone;
        }
        shot += one.rays.size();
    }
    return hits == 0 ? 0 : double(unseen) / double(hits);
}

}  // namespace overlook::wang_ldi
