#include "tools/bake/wang_ldi/textures.h"

#include <algorithm>
#include <cmath>

#include "runtime/wang_ldi/random.h"
#include "tools/bake/wang_ldi/held_out.h"
#include "tools/bake/wang_ldi/texel_error.h"
#include "tools/bake/wang_ldi/texture_shape.h"
#include "tools/bake/wang_ldi/texture_walk.h"
#include "tools/bake/wang_ldi/textures_opacity.h"

namespace overlook::wang_ldi {
namespace {

constexpr uint64_t kEyeStream = 51, kHitStream = 53;
constexpr uint32_t kLightRaysShare = 16;
constexpr size_t kMostLines = 1 << 18;
constexpr uint32_t kLeastRaysPerEye = 256;
constexpr double kHitsOfCoarser = 8;

double luma_of(const glm::vec3& colour) {
    return 0.2126 * double(colour.r) + 0.7152 * double(colour.g) + 0.0722 * double(colour.b);
}

// What is seen over a square.
struct Sum {
    uint64_t hits = 0;
    glm::dvec3 colour{0}, normal{0};
    double height_m = 0, height_squared = 0;

    void add(const Sum& other) {
        hits += other.hits, colour += other.colour, normal += other.normal;
        height_m += other.height_m, height_squared += other.height_squared;
    }
};

class TextureSampler {
  public:
    TextureSampler(const Models& models, std::span<const TraceStage> stages, const TextureSet& set, uint32_t direction,
                   const Light& light, const TextureOptions& options);
    TextureSampled run();

  private:
    bool is_enough() const;
    void see(const TraceStage& stage);
    void add_hit(const TraceStage& stage, const rays::Ray& ray, const rays::Hit& hit, const glm::dvec3& at);
    void sum_up();
    std::vector<double> height_variances() const;
    DirectionalTexture encoded(std::span<const double> variances, const BoxShape& shape) const;
    void fill_unseen(DirectionalTexture& texture) const;
    void add_line(const rays::Ray& ray, const rays::Hit& hit);
    std::vector<double> shares_shown() const;

    const Models& models_;
    std::span<const TraceStage> stages_;
    const TextureSet& set_;
    Wedge wedge_;
    Light light_;
    TextureOptions options_;
    std::vector<Sum> sums_;    // of all pictures' texels
    std::vector<Line> lines_;  // every line_step_-th that reaches the tile, at most kMostLines
    uint64_t line_step_ = 1;
    LinesByDistance ends_;  // all that do, and how many end in it
    std::vector<rays::Hit> found_;
    Eye eye_;
    HeldOut held_out_;
    std::vector<HeldOut::Met> met_;  // of the finest picture's texels
    TexelErrors errors_;             // likewise
    uint32_t rays_per_eye_;          // one a texel: more would meet the same leaves
    uint64_t reaching_ = 0, rays_ = 0, eyes_ = 0;
};

TextureSampler::TextureSampler(const Models& models, std::span<const TraceStage> stages, const TextureSet& set,
                               uint32_t direction, const Light& light, const TextureOptions& options)
    : models_(models),
      stages_(stages),
      set_(set),
      wedge_(far_wedge_of(set, direction)),
      light_(light),
      options_(options),
      sums_(texture_texels(set.side_px)),
      ends_(wedge_),
      met_(size_t(set.side_px) * set.side_px),
      errors_(met_.size()),
      rays_per_eye_(
          std::clamp(set.side_px * set.side_px, std::min(kLeastRaysPerEye, options.rays_per_eye), options.rays_per_eye)) {
    light_.sun_rays = std::max(1u, light.sun_rays / kLightRaysShare);
    light_.sky_rays = std::max(1u, light.sky_rays / kLightRaysShare);
}

void TextureSampler::add_hit(const TraceStage& stage, const rays::Ray& ray, const rays::Hit& hit, const glm::dvec3& at) {
    double per_m = set_.side_px / set_.tile_m;
    auto along = [&](double place) { return std::min(size_t(place * per_m), size_t(set_.side_px - 1)); };
    size_t texel = along(at.y) * set_.side_px + along(at.x);
    Point point = point_of(models_, stage.copies, hit, ray.along);
    glm::vec3 colour = set_.has_normals
                           ? point.albedo
                           : lit(stage.scene, point, light_, hash_of(options_.seed, kHitStream, int64_t(held_out_.hits()), 0));
    Sum& sum = sums_[texel];
    double height_m = at.z - set_.low_m;
    held_out_.meet(met_[texel], eyes_), errors_.add(texel, eyes_, luma_of(colour)), ++sum.hits;
    sum.colour += glm::dvec3(colour), sum.normal += glm::dvec3(point.normal);
    sum.height_m += height_m, sum.height_squared += height_m * height_m;
}

void TextureSampler::see(const TraceStage& stage) {
    set_eye(wedge_, hash_of(options_.seed, kEyeStream, 0, 0), eyes_, rays_per_eye_, eye_);
    found_.resize(eye_.rays.size());
    stage.scene.first_hits(eye_.rays, found_);
    for (size_t i = 0; i < found_.size(); ++i) {
        const rays::Ray& ray = eye_.rays[i];
        add_line(ray, found_[i]);
        if (found_[i].copy == rays::kNone) continue;
        glm::dvec3 at = glm::dvec3(ray.from_m) + double(found_[i].distance) * glm::dvec3(ray.along);
        if (at.x < 0 || at.y < 0 || at.x >= set_.tile_m || at.y >= set_.tile_m) continue;
        add_hit(stage, ray, found_[i], at);
    }
    rays_ += eye_.rays.size(), ++eyes_;
}

// A sight line reaches the tile if nothing stands before it.
void TextureSampler::add_line(const rays::Ray& ray, const rays::Hit& hit) {
    glm::dvec2 over = over_tile(glm::dvec3(ray.from_m), glm::dvec3(ray.along), set_.tile_m);
    if (over.x >= over.y || (hit.copy != rays::kNone && double(hit.distance) < over.x)) return;
    ++reaching_, ends_.add(ray.from_m, hit.copy != rays::kNone && double(hit.distance) < over.y ? 1 : 0);
    if (reaching_ % line_step_ == 0) lines_.push_back({ray.from_m, ray.along});
    if (lines_.size() < kMostLines) return;
    for (size_t i = 0; i < kMostLines / 2; ++i) lines_[i] = lines_[2 * i + 1];
    lines_.resize(kMostLines / 2), line_step_ *= 2;
}

bool TextureSampler::is_enough() const {
    if (rays_ >= options_.most_rays) return true;
    if (held_out_.hits() == 0) return held_out_.is_of_nothing(eyes_, options_.least_eyes);
    if (eyes_ < options_.least_eyes || !held_out_.is_within(options_.unseen_goal)) return false;
    return errors_.standard_error() * double(held_out_.hits()) <= options_.error_goal * errors_.luma();
}

// Coarser pictures from finer ones: sums, so nothing is rounded between.
void TextureSampler::sum_up() {
    for (uint32_t level = 1; level < texture_levels(set_.side_px); ++level) {
        size_t fine = texture_level_at(set_.side_px, level - 1), at = texture_level_at(set_.side_px, level);
        uint32_t side = set_.side_px >> level;
        for (uint32_t row = 0; row < 2 * side; ++row)
            for (uint32_t column = 0; column < 2 * side; ++column)
                sums_[at + size_t(row / 2) * side + column / 2].add(sums_[fine + size_t(row) * 2 * side + column]);
    }
}

// Of heights about each texel's mean. A few hits do not tell how far a texel's reach up and down, and a box too low would be
// opaque: the coarser texel's variance counts as kHitsOfCoarser of them.
std::vector<double> TextureSampler::height_variances() const {
    std::vector<double> variances(sums_.size(), 0);
    for (uint32_t level = texture_levels(set_.side_px); level-- > 0;) {
        size_t at = texture_level_at(set_.side_px, level), coarse = texture_level_at(set_.side_px, level + 1);
        uint32_t side = set_.side_px >> level;
        for (uint32_t t = 0; t < side * side; ++t) {
            const Sum& sum = sums_[at + t];
            if (sum.hits == 0) continue;
            double hits = double(sum.hits), mean_m = sum.height_m / hits;
            double squares = std::max(0.0, sum.height_squared - hits * mean_m * mean_m);
            double known = side == 1 ? squares / hits : variances[coarse + size_t(t / side / 2) * (side / 2) + t % side / 2];
            variances[at + t] = (squares + kHitsOfCoarser * known) / (hits + kHitsOfCoarser);
        }
    }
    return variances;
}

DirectionalTexture TextureSampler::encoded(std::span<const double> variances, const BoxShape& shape) const {
    DirectionalTexture texture;
    double step_m = (set_.high_m - set_.low_m) / 255;
    auto code = [](double value, double least) { return uint8_t(std::clamp(std::round(value), least, 255.0)); };
    for (size_t t = 0; t < sums_.size(); ++t) {
        const Sum& sum = sums_[t];
        texture.colours.push_back({}), texture.heights.push_back({});
        if (set_.has_normals) texture.normals.push_back({});
        if (sum.hits == 0) continue;
        auto hits = double(sum.hits);
        for (int c = 0; c < 3; ++c) texture.colours.back()[size_t(c)] = srgb_from_linear(float(sum.colour[c] / hits));
        double deviation_m = std::sqrt(variances[t]), middle_m = sum.height_m / hits + shape.raised * deviation_m;
        texture.heights.back() = {code(middle_m / step_m, 0), code(shape.half_height * deviation_m / step_m, 1)};
        for (int axis = 0; axis < 3 && set_.has_normals; ++axis)
            texture.normals.back()[size_t(axis)] = int8_t(std::lround(127 * std::clamp(sum.normal[axis] / hits, -1.0, 1.0)));
    }
    return texture;
}

// From the coarsest down.
void TextureSampler::fill_unseen(DirectionalTexture& texture) const {
    for (uint32_t level = texture_levels(set_.side_px) - 1; level-- > 0;) {
        size_t at = texture_level_at(set_.side_px, level), coarse = texture_level_at(set_.side_px, level + 1);
        uint32_t side = set_.side_px >> level;
        for (uint32_t t = 0; t < side * side; ++t) {
            if (sums_[at + t].hits > 0) continue;
            size_t from = coarse + size_t(t / side / 2) * (side / 2) + t % side / 2;
            texture.colours[at + t] = texture.colours[from], texture.colours[at + t][3] = 0;
            texture.heights[at + t] = texture.heights[from];
            if (set_.has_normals) texture.normals[at + t] = texture.normals[from];
        }
    }
}

std::vector<double> TextureSampler::shares_shown() const {
    std::vector<double> shown(sums_.size());
    for (size_t t = 0; t < sums_.size(); ++t) shown[t] = double(sums_[t].hits) / double(reaching_);
    return shown;
}

TextureSampled TextureSampler::run() {
    while (!is_enough()) see(stages_[eyes_ % stages_.size()]);
    sum_up();
    std::vector<double> variances = height_variances(), shown = shares_shown();
    auto with = [&](const BoxShape& shape) { return encoded(variances, shape); };
    TextureSampled made;
    uint64_t hits = held_out_.hits();
    made.texture = with(hits > 0 ? chosen_shape(set_, wedge_, lines_, shown, ends_, with) : BoxShape());
    made.texture.unseen_share = float(held_out_.unseen_share());
    made.texture.standard_error = float(std::min(errors_.standard_error(), 1.0));
    if (hits > 0) choose_opacity(set_, lines_, shown, made.texture);
    fill_unseen(made.texture);
    made.rays = rays_, made.hits = hits, made.eyes = eyes_;
    return made;
}

}  // namespace

TextureSet texture_set_of(const ImageSet& images, uint32_t side_px) {
    TextureSet set;
    set.side_px = side_px, set.tile_m = images.tile_m, set.low_m = images.low_m, set.high_m = images.high_m;
    set.nearest_m = images.cell.farthest_m * (1 - double(images.level_fade)), set.farthest_m = kFarTimes * images.cell.farthest_m;
    set.direction_fade = images.direction_fade;
    set.eye_low_m = images.cell.eye_low_m, set.eye_high_m = images.cell.eye_high_m;
    set.tile_count = images.tile_count, set.direction_count = images.direction_count;
    set.context_count = images.context_count, set.has_normals = images.has_normals;
    return set;
}

Wedge far_wedge_of(const TextureSet& set, uint32_t direction) {
    Wedge wedge;
    wedge.tile_m = set.tile_m, wedge.low_m = set.low_m, wedge.high_m = set.high_m, wedge.side_px = set.side_px;
    wedge.nearest_m = set.nearest_m, wedge.farthest_m = set.farthest_m;
    wedge.eye_low_m = set.eye_low_m, wedge.eye_high_m = set.eye_high_m;
    double step_rad = 2 * M_PI / set.direction_count;
    wedge.heading_rad = direction * step_rad, wedge.half_width_rad = (0.5 + double(set.direction_fade)) * step_rad;
    return wedge;
}

TextureSampled texture_of(const Models& models, std::span<const TraceStage> stages, const TextureSet& set, uint32_t direction,
                          const Light& light, const TextureOptions& options) {
    return TextureSampler(models, stages, set, direction, light, options).run();
}

}  // namespace overlook::wang_ldi
