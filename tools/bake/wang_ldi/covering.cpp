#include "tools/bake/wang_ldi/covering.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "runtime/wang_ldi/random.h"

namespace overlook::wang_ldi {
namespace {

constexpr uint64_t kPlaceStream = 51, kKeepStream = 52, kEyeStream = 53;
constexpr uint32_t kSide = 5, kPlaces = kSide * kSide, kOwnPlaces = 9;  // of a window; of its middle
constexpr double kWide_px = 3, kDeep_px = 2;                            // of a window; from a sample to both sides
constexpr uint32_t kMostOverEachOther = 31;                             // more count as so many
// A sample is kept in any case where so many of its own places are met; or fewer, but so many of the whole window.
constexpr uint8_t kOwnMet = 4, kOwnMetAmongMany = 2, kManyMet = 6;
// To both sides: what the middle eye of so wide a wedge sees of a thing tells of what others do. Into a wider one so many look.
constexpr double kWidestWedge_rad = M_PI / 3;
constexpr uint32_t kEyesOfWide = 16;
constexpr size_t kAtOnce = 256;  // samples whose rays are shot together

// Places of a window, in pixels across the line of sight; those of its middle first.
struct Places {
    std::array<double, kPlaces> right, up;

    Places(uint64_t seed, const Sample& sample) {
        Random random(hash_of(seed, kPlaceStream, sample.pixel, sample.layer));
        size_t own = 0, other = kOwnPlaces;
        for (uint32_t j = 0; j < kSide; ++j)
            for (uint32_t i = 0; i < kSide; ++i) {
                bool is_own = std::min(i, j) > 0 && std::max(i, j) + 1 < kSide;
                size_t at = is_own ? own++ : other++;
                right[at] = kWide_px * ((i + random.next_unit()) / kSide - 0.5);
                up[at] = kWide_px * ((j + random.next_unit()) / kSide - 0.5);
            }
    }
};

// Where a sample is drawn, and how the eye looks at it.
struct Sight {
    glm::dvec3 at_m, along, right, up;
    double splat_px = 1;  // how wide it is drawn, in pixels of the image
};

class Coverer {
  public:
    Coverer(std::span<const TraceStage> stages, const Wedge& wedge, double focal_px, const std::vector<Sample>& samples,
            uint64_t seed)
        : stages_(stages),
          wedge_(wedge),
          focal_px_(focal_px),
          samples_(samples),
          seed_(seed),
          shift_(hash_of(seed, kKeepStream, 0, 0)),
          pixel_m_(wedge.tile_m / wedge.side_px) {
        Wedge part = wedge;
        uint32_t eyes = wedge.half_width_rad > kWidestWedge_rad ? kEyesOfWide : 1;
        for (uint32_t eye = 0; eye < eyes; ++eye) {
            part.heading_rad = wedge.heading_rad + ((2 * eye + 1.0) / eyes - 1) * wedge.half_width_rad;
            eyes_m_.push_back(middle_eye_m(part));
        }
        first_.resize(size_t(wedge.side_px) * wedge.side_px + 1);
        for (const Sample& sample : samples) ++first_[sample.pixel + 1];
        for (size_t p = 1; p < first_.size(); ++p) first_[p] += first_[p - 1];
        met_.resize(samples.size());
    }
    std::vector<Sample> kept() {
        for (size_t from = 0; from < samples_.size(); from += kAtOnce) look(from, std::min(from + kAtOnce, samples_.size()));
        std::vector<Sample> kept;
        for (size_t s = 0; s < samples_.size(); ++s)
            if (is_solid(s) || spread_of(samples_[s]) < share_of(s)) kept.push_back(samples_[s]);
        return kept;
    }

  private:
    // Kept in any case: counted as if all places of its window were met.
    bool is_solid(size_t sample) const { return met_[sample] == kPlaces; }
    glm::dvec3 place_m(const Sample& sample) const {
        return {(sample.pixel % wedge_.side_px + 0.5) * pixel_m_, (sample.pixel / wedge_.side_px + 0.5) * pixel_m_,
                wedge_.low_m + double(sample.height_m)};
    }
    // The one that it faces most: a leaf of which an eye sees the edge alone is whole for others.
    const glm::dvec3& facing_eye_m(const Sample& sample) const {
        glm::dvec3 normal(sample.normal), at_m = place_m(sample);
        auto facing = [&](const glm::dvec3& eye_m) {
            glm::dvec3 way = eye_m - at_m;
            return std::abs(glm::dot(way, normal)) / std::sqrt(glm::dot(way, way));
        };
        return *std::max_element(eyes_m_.begin(), eyes_m_.end(),
                                 [&](const glm::dvec3& a, const glm::dvec3& b) { return facing(a) < facing(b); });
    }
    // Any, so that many samples are looked at from all sides.
    const glm::dvec3& any_eye_m(const Sample& sample) const {
        return eyes_m_[hash_of(seed_, kEyeStream, sample.pixel, sample.layer) % eyes_m_.size()];
    }
    Sight sight_of(const Sample& sample, const glm::dvec3& eye_m) const {
        Sight sight;
        sight.at_m = place_m(sample);
        glm::dvec3 way = sight.at_m - eye_m;
        double distance_m = std::sqrt(glm::dot(way, way)), wide_px = focal_px_ * pixel_m_ / distance_m;
        sight.along = way / distance_m, sight.splat_px = std::max(1.0, std::floor(wide_px + 0.5)) / wide_px;
        glm::dvec3 level(sight.along.y, -sight.along.x, 0);
        double length = std::sqrt(glm::dot(level, level));
        sight.right = length > 1e-9 ? level / length : glm::dvec3(1, 0, 0);
        sight.up = glm::cross(sight.right, sight.along);
        return sight;
    }

    // Counts what rays meet in the windows of samples from..to.
    void look(size_t from, size_t to) {
        shoot(from, to, 0, kOwnPlaces, true);
        std::array<uint8_t, kAtOnce> own{};
        for (size_t s = from; s < to; ++s) {
            own[s - from] = met_[s];
            if (met_[s] >= kOwnMet) met_[s] = kPlaces;
        }
        bool is_seen_by_one = eyes_m_.size() == 1;
        for (size_t s = from; s < to; ++s)
            if (!is_seen_by_one && !is_solid(s)) met_[s] = 0;
        shoot(from, to, is_seen_by_one ? kOwnPlaces : 0, kPlaces, false);
        for (size_t s = from; s < to; ++s)
            if (own[s - from] >= kOwnMetAmongMany && met_[s] >= kManyMet) met_[s] = kPlaces;
    }
    void shoot(size_t from, size_t to, size_t first_place, size_t last_place, bool is_facing) {
        for (uint32_t stage = 0; stage < stages_.size(); ++stage) {
            rays_.clear(), of_.clear();
            for (size_t s = from; s < to; ++s)
                if (samples_[s].stage == stage && !is_solid(s))
                    add_rays(s, first_place, last_place, is_facing ? facing_eye_m(samples_[s]) : any_eye_m(samples_[s]));
            hits_.resize(rays_.size());
            stages_[stage].scene.first_hits(rays_, hits_);
            for (size_t r = 0; r < rays_.size(); ++r) met_[of_[r]] += is_in_tile(rays_[r], hits_[r]);
        }
    }
    void add_rays(size_t s, size_t first_place, size_t last_place, const glm::dvec3& eye_m) {
        Sight sight = sight_of(samples_[s], eye_m);
        Places places(seed_, samples_[s]);
        for (size_t place = first_place; place < last_place; ++place) {
            glm::dvec3 aside = places.right[place] * sight.right + places.up[place] * sight.up - kDeep_px * sight.along;
            rays_.push_back(
                {glm::vec3(sight.at_m + pixel_m_ * aside), glm::vec3(sight.along), 0, float(2 * kDeep_px * pixel_m_)});
            of_.push_back(s);
        }
    }
    bool is_in_tile(const rays::Ray& ray, const rays::Hit& hit) const {
        if (hit.copy == rays::kNone) return false;
        glm::vec3 at = ray.from_m + hit.distance * ray.along;
        return at.x >= 0 && at.y >= 0 && double(at.x) < wedge_.tile_m && double(at.y) < wedge_.tile_m;
    }

    double share_of(size_t s) const {
        Sight sight = sight_of(samples_[s], any_eye_m(samples_[s]));
        Places places(seed_, samples_[s]);
        std::array<uint32_t, kPlaces> covered{};
        std::array<bool, kPlaces> is_covered{};
        double reach = (kWide_px + sight.splat_px) / 2, half = sight.splat_px / 2;
        visit_near(samples_[s], int(std::ceil(std::max(reach, kDeep_px + 1))), [&](size_t t) {
            glm::dvec3 way = (place_m(samples_[t]) - sight.at_m) / pixel_m_;
            double right = glm::dot(way, sight.right), up = glm::dot(way, sight.up);
            if (std::abs(glm::dot(way, sight.along)) > kDeep_px || std::abs(right) > reach || std::abs(up) > reach) return;
            for (size_t p = 0; p < kPlaces; ++p) {
                bool covers = std::abs(right - places.right[p]) <= half && std::abs(up - places.up[p]) <= half;
                covered[p] += covers, is_covered[p] |= covers && is_solid(t);
            }
        });
        std::array<uint32_t, kMostOverEachOther + 1> covered_by{};
        uint32_t solid = 0;
        for (size_t p = 0; p < kPlaces; ++p) {
            solid += is_covered[p];
            if (!is_covered[p]) ++covered_by[std::min(covered[p], kMostOverEachOther)];
        }
        return share_covering(double(met_[s]) / kPlaces, covered_by, solid);
    }
    // Samples so many columns, rows and layers from one at most.
    template <class Visit>
    void visit_near(const Sample& of, int reach, const Visit& visit) const {
        int side = int(wedge_.side_px), column = int(of.pixel) % side, row = int(of.pixel) / side;
        for (int y = std::max(0, row - reach); y <= std::min(side - 1, row + reach); ++y)
            for (int x = std::max(0, column - reach); x <= std::min(side - 1, column + reach); ++x) {
                auto pixel = size_t(y) * size_t(side) + size_t(x);
                uint32_t lowest = of.layer - std::min(of.layer, uint32_t(reach));
                auto first = std::lower_bound(samples_.begin() + first_[pixel], samples_.begin() + first_[pixel + 1], lowest,
                                              [](const Sample& sample, uint32_t layer) { return sample.layer < layer; });
                for (size_t t = size_t(first - samples_.begin()); t < first_[pixel + 1]; ++t) {
                    if (samples_[t].layer > of.layer + uint32_t(reach)) break;
                    visit(t);
                }
            }
    }
    // 0 <= it < 1, far from each other for cubes near each other (as evenly_spread).
    double spread_of(const Sample& sample) const {
        constexpr uint64_t kColumn = 0xd1b54a32d192e801u, kRow = 0xabc98388fb8fa001u, kLayer = 0x8cb92ba72f3d8001u;
        uint64_t sum =
            shift_ + kColumn * (sample.pixel % wedge_.side_px) + kRow * (sample.pixel / wedge_.side_px) + kLayer * sample.layer;
        return double(sum >> 11) * 0x1p-53;
    }

    std::span<const TraceStage> stages_;
    const Wedge& wedge_;
    double focal_px_;
    const std::vector<Sample>& samples_;
    uint64_t seed_, shift_;
    std::vector<glm::dvec3> eyes_m_;
    double pixel_m_;
    std::vector<uint32_t> first_;  // [side_px^2 + 1], of each pixel's
    std::vector<uint8_t> met_;
    std::vector<rays::Ray> rays_;
    std::vector<rays::Hit> hits_;
    std::vector<size_t> of_;  // [rays], the sample
};

}  // namespace

double share_covering(double wanted, std::span<const uint32_t> covered_by, uint32_t solid) {
    constexpr int kSteps = 12;
    uint32_t all = solid;
    for (uint32_t count : covered_by) all += count;
    if (all == 0) return 1;
    auto covered = [&](double share) {
        double sum = solid, none = 1;
        for (uint32_t count : covered_by) sum += count * (1 - none), none *= 1 - share;
        return sum / all;
    };
    if (covered(1) <= wanted) return 1;
    double low = 0, high = 1;
    for (int step = 0; step < kSteps; ++step) {
        double middle = (low + high) / 2;
        (covered(middle) < wanted ? low : high) = middle;
    }
    return low;
}

Sampled covering(std::span<const TraceStage> stages, const Wedge& wedge, double focal_px, Sampled all, uint64_t seed) {
    all.samples = Coverer(stages, wedge, focal_px, all.samples, seed).kept();
    return all;
}

}  // namespace overlook::wang_ldi
