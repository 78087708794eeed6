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
    double column = std::floor(at.x * per_m), row = std::floor(at.y * per_m), layer = std::floor((at.z - wedge.low_m) * per_m);
    if (column < 0 || row < 0 || column >= wedge.side_px || row >= wedge.side_px || layer < 0) return false;
    cube = (uint64_t(row) * wedge.side_px + uint64_t(column)) << kLayersLog2 | uint64_t(layer);
    return layer < (1u << kLayersLog2);
}

// What was met in a cube so far.
struct Cube {
    double height_sum_m = 0;
    glm::vec3 albedo_sum{0}, normal_sum{0};
    HeldOut::Met met;
    uint32_t looks = 0;
    uint64_t place = 0;
    // Of what was looked at the place that faces its eye most: the rim of a leaf is little of what is seen.
    float facing = -1;
    rays::Hit best;
    uint32_t stage = 0;
    glm::vec3 seen_along{0};
};

class Sampler {
  public:
    Sampler(const Models& models, const Wedge& wedge) : models_(models), wedge_(wedge) {}
    void shoot(std::span<const TraceStage> stages, size_t stage, const Eye& eye);
    const HeldOut& held_out() const { return held_out_; }
    uint64_t rays() const { return rays_; }
    Sampled take();

  private:
    void keep(std::span<const TraceStage> stages, size_t stage, const rays::Ray& ray, const rays::Hit& hit);

    const Models& models_;
    const Wedge& wedge_;
    CubeTable table_;
    std::vector<Cube> cubes_;
    std::vector<rays::Hit> found_;
    HeldOut held_out_;
    uint64_t rays_ = 0, eyes_ = 0;
};

void Sampler::keep(std::span<const TraceStage> stages, size_t stage, const rays::Ray& ray, const rays::Hit& hit) {
    glm::dvec3 at = glm::dvec3(ray.from_m) + double(hit.distance) * glm::dvec3(ray.along);
    uint64_t place = 0;
    if (!cube_of(wedge_, at, place)) return;
    uint32_t number = table_.number_of(place);
    if (number == cubes_.size()) {
        cubes_.emplace_back();
        cubes_.back().place = place;
    }
    Cube& cube = cubes_[number];
    held_out_.meet(cube.met, eyes_);
    cube.height_sum_m += at.z - wedge_.low_m;
    if (cube.looks == kMostLooks) return;
    Point point = point_of(models_, stages[stage].copies, hit, ray.along);
    ++cube.looks, cube.albedo_sum += point.albedo, cube.normal_sum += point.normal;
    float facing = -glm::dot(point.face, ray.along);
    if (facing <= cube.facing) return;
    cube.facing = facing, cube.best = hit, cube.stage = uint32_t(stage), cube.seen_along = ray.along;
}

void Sampler::shoot(std::span<const TraceStage> stages, size_t stage, const Eye& eye) {
    found_.resize(eye.rays.size());
    stages[stage].scene.first_hits(eye.rays, found_);
    for (size_t i = 0; i < found_.size(); ++i)
        if (found_[i].copy != rays::kNone) keep(stages, stage, eye.rays[i], found_[i]);
    rays_ += eye.rays.size(), ++eyes_;
}

Sampled Sampler::take() {
    std::sort(cubes_.begin(), cubes_.end(), [](const Cube& a, const Cube& b) { return a.place < b.place; });
    Sampled made;
    made.rays = rays_, made.hits = held_out_.hits(), made.eyes = eyes_, made.unseen_share = held_out_.unseen_share();
    made.samples.reserve(cubes_.size());
    for (const Cube& cube : cubes_) {
        Sample sample;
        sample.pixel = uint32_t(cube.place >> kLayersLog2), sample.met = cube.met.count;
        sample.layer = uint32_t(cube.place & ((1u << kLayersLog2) - 1));
        sample.height_m = float(cube.height_sum_m / cube.met.count), sample.albedo = cube.albedo_sum / float(cube.looks);
        float length = glm::length(cube.normal_sum);
        sample.normal = length > 1e-6f ? cube.normal_sum / length : -glm::normalize(cube.seen_along);
        sample.hit = cube.best, sample.stage = cube.stage, sample.seen_along = cube.seen_along;
        made.samples.push_back(sample);
    }
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
            glm::dvec3 at = glm::dvec3(one.rays[i].from_m) + double(found[i].distance) * glm::dvec3(one.rays[i].along);
            uint64_t cube = 0;
            if (found[i].copy == rays::kNone || !cube_of(wedge, at, cube)) continue;
            ++hits, unseen += known.find(cube) == CubeTable::kNone;
        }
        shot += one.rays.size();
    }
    return hits == 0 ? 0 : double(unseen) / double(hits);
}

}  // namespace overlook::wang_ldi
