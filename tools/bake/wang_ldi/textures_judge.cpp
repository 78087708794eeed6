// A texture's boxes drawn over each other, beside what rays say.
#include <algorithm>
#include <cmath>

#include "runtime/wang_ldi/random.h"
#include "tools/bake/wang_ldi/texture_boxes.h"
#include "tools/bake/wang_ldi/textures.h"

namespace overlook::wang_ldi {
namespace {

constexpr uint64_t kViewStream = 61, kTruthStream = 62;
constexpr double kGrey = 0.2;  // linear, behind the tile
constexpr uint32_t kSide = 4;  // sight lines along a pixel's side

struct Pixel {
    Seen truth, drawn;
    uint32_t lines = 0;

    double error() const {
        auto luma = [&](const Seen& sum) {
            glm::dvec3 colour = (sum.colour + (lines - sum.coverage) * glm::dvec3(kGrey)) / double(lines);
            return overlook::srgb_from_linear(std::clamp(0.2126 * colour.r + 0.7152 * colour.g + 0.0722 * colour.b, 0.0, 1.0));
        };
        return std::abs(luma(truth) - luma(drawn));
    }
};

class TextureJudge {
  public:
    TextureJudge(const Models& models, const TraceStage& stage, const TextureSet& set, const DirectionalTexture& texture,
                 const Light& light)
        : models_(models), stage_(stage), set_(set), texture_(texture), light_(light) {}
    void add_view(const Wedge& wedge, double focal_px, const Judging& judging, uint32_t view);
    TextureJudgement result() const;

  private:
    void add_line(const rays::Ray& ray, const rays::Hit& hit, uint64_t seed, Pixel& pixel);

    const Models& models_;
    const TraceStage& stage_;
    const TextureSet& set_;
    const DirectionalTexture& texture_;
    const Light& light_;
    TextureJudgement sum_;
    uint64_t views_ = 0;  // that some sight line reaches the tile in
};

void TextureJudge::add_line(const rays::Ray& ray, const rays::Hit& hit, uint64_t seed, Pixel& pixel) {
    glm::dvec2 over = over_tile(glm::dvec3(ray.from_m), glm::dvec3(ray.along), set_.tile_m);
    if (over.x >= over.y) return;
    bool is_hit = hit.copy != rays::kNone;
    if (is_hit && double(hit.distance) < over.x) return;  // something stands before the tile
    ++pixel.lines;
    if (is_hit && double(hit.distance) < over.y) {
        Point point = point_of(models_, stage_.copies, hit, ray.along);
        pixel.truth.colour += glm::dvec3(set_.has_normals ? point.albedo : lit(stage_.scene, point, light_, seed));
        pixel.truth.coverage += 1;
    }
    Seen drawn = seen_along(set_, texture_, glm::dvec3(ray.from_m), glm::dvec3(ray.along), over);
    pixel.drawn.colour += drawn.colour, pixel.drawn.coverage += drawn.coverage;
}

void TextureJudge::add_view(const Wedge& wedge, double focal_px, const Judging& judging, uint32_t view) {
    Random random(hash_of(judging.seed, kViewStream, view, 0));
    double heading = wedge.heading_rad + (2 * random.next_unit() - 1) * wedge.half_width_rad;
    double distance = wedge.nearest_m * std::pow(wedge.farthest_m / wedge.nearest_m, random.next_unit());
    glm::dvec3 middle(wedge.tile_m / 2, wedge.tile_m / 2, (wedge.low_m + wedge.high_m) / 2);
    glm::dvec3 from(middle.x + distance * std::sin(heading), middle.y + distance * std::cos(heading),
                    wedge.eye_low_m + (wedge.eye_high_m - wedge.eye_low_m) * random.next_unit());
    glm::dvec3 forward = glm::normalize(middle - from), right = glm::normalize(glm::dvec3(forward.y, -forward.x, 0)),
               up = glm::cross(right, forward);
    double radius_px = focal_px * glm::length(glm::dvec2(wedge.tile_m, wedge.high_m - wedge.low_m)) / distance;
    auto side = uint32_t(std::clamp(std::ceil(radius_px), 1.0, double(judging.size_px)));
    std::vector<Pixel> pixels(size_t(side) * side);
    std::vector<rays::Ray> lines;
    for (uint32_t i = 0; i < side * side * kSide * kSide; ++i) {
        uint32_t column = i % (side * kSide), row = i / (side * kSide);
        double x = ((column + 0.5) / kSide - side / 2.0) / focal_px, y = (side / 2.0 - (row + 0.5) / kSide) / focal_px;
        lines.push_back({glm::vec3(from), glm::vec3(glm::normalize(forward + x * right + y * up))});
    }
    std::vector<rays::Hit> hits(lines.size());
    stage_.scene.first_hits(lines, hits);
    for (uint32_t i = 0; i < lines.size(); ++i) {
        uint32_t column = i % (side * kSide) / kSide, row = i / (side * kSide) / kSide;
        add_line(lines[i], hits[i], hash_of(judging.seed, kTruthStream, view, i), pixels[size_t(row) * side + column]);
    }
    double truth = 0, drawn = 0, reaching = 0;
    for (const Pixel& pixel : pixels) {
        truth += pixel.truth.coverage, drawn += pixel.drawn.coverage, reaching += pixel.lines;
        if (pixel.truth.coverage == 0 && pixel.drawn.coverage == 0) continue;
        ++sum_.pixels, sum_.mean_error += pixel.error();
    }
    if (reaching > 0) ++views_, sum_.coverage += truth / reaching, sum_.drawn_coverage += drawn / reaching;
}

TextureJudgement TextureJudge::result() const {
    TextureJudgement mean = sum_;
    double views = std::max(1.0, double(views_));
    mean.coverage /= views, mean.drawn_coverage /= views, mean.mean_error /= std::max(1.0, double(mean.pixels));
    return mean;
}

}  // namespace

TextureJudgement judged_texture(const Models& models, const TraceStage& stage, const TextureSet& set,
                                const DirectionalTexture& texture, uint32_t direction, double focal_px, const Light& light,
                                const Judging& judging) {
    TextureJudge judge(models, stage, set, texture, light);
    for (uint32_t view = 0; view < judging.views; ++view) judge.add_view(far_wedge_of(set, direction), focal_px, judging, view);
    return judge.result();
}

}  // namespace overlook::wang_ldi
