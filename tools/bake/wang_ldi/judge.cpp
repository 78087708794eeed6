#include "tools/bake/wang_ldi/judge.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "runtime/view/flip.h"
#include "runtime/view/picture_rays.h"
#include "runtime/wang_ldi/hole_fill.h"
#include "runtime/wang_ldi/random.h"
#include "tools/bake/wang_ldi/assemble.h"
#include "tools/bake/wang_ldi/picture_blocks.h"

namespace overlook::wang_ldi {
namespace {

constexpr uint64_t kViewStream = 31, kTruthStream = 32;

uint32_t code_of(const glm::vec3& colour) {
    return uint32_t(srgb_from_linear(colour.r)) | uint32_t(srgb_from_linear(colour.g)) << 8 |
           uint32_t(srgb_from_linear(colour.b)) << 16 | 0xff000000u;
}

bool is_within(const Warped& truth, uint32_t column, uint32_t row) {
    if (column == 0 || row == 0 || column + 1 >= truth.width_px || row + 1 >= truth.height_px) return false;
    for (uint32_t y = row - 1; y <= row + 1; ++y)
        for (uint32_t x = column - 1; x <= column + 1; ++x)
            if (truth.colours[size_t(y) * truth.width_px + x] == 0) return false;
    return true;
}

// Holes and depths; of the picture as it was drawn, and filled.
void compare_depths(const Warped& truth, const Warped& drawn, const Warped& filled, double pixel_m, Judgement& judgement) {
    for (uint32_t row = 0; row < truth.height_px; ++row)
        for (uint32_t column = 0; column < truth.width_px; ++column) {
            if (!is_within(truth, column, row)) continue;
            size_t p = size_t(row) * truth.width_px + column;
            ++judgement.pixels, judgement.holes_left += filled.colours[p] == 0;
            if (drawn.colours[p] == 0) {
                ++judgement.holes;
                continue;
            }
            double deeper = double(drawn.depth_m[p]) - double(truth.depth_m[p]);
            double slack = 0.02 * double(truth.depth_m[p]) + 2 * pixel_m;
            judgement.deeper += deeper > slack, judgement.nearer += -deeper > slack;
        }
}

// What is drawn, without what something else hides by more than a pixel of the level.
Warped unhidden(Warped drawn, const Truth& truth, double pixel_m) {
    for (size_t p = 0; p < drawn.colours.size(); ++p)
        if (double(drawn.depth_m[p]) + pixel_m >= double(truth.hidden_m[p])) drawn.colours[p] = 0;
    return drawn;
}

std::vector<float> flip_of(const Warped& drawn, const ImageRgb8& truth) {
    ImageRgb8 picture = picture_of(drawn);
    return view::flip_map({picture.width, picture.height, picture.pixels}, {truth.width, truth.height, truth.pixels});
}

void compare_pictures(const Truth& truth, const Warped& drawn, const Warped& filled, double pixel_m, Judgement& judgement) {
    ImageRgb8 right = picture_of(truth.tile);
    Warped shown = unhidden(filled, truth, pixel_m), shown_unfilled = unhidden(drawn, truth, pixel_m);
    std::vector<float> error = flip_of(shown, right), unfilled = flip_of(shown_unfilled, right);
    for (size_t p = 0; p < error.size(); ++p) {
        judgement.covered += truth.tile.colours[p] != 0, judgement.covered_filled += shown.colours[p] != 0;
        judgement.covered_drawn += shown_unfilled.colours[p] != 0;
        if (truth.tile.colours[p] == 0 && shown.colours[p] == 0) continue;
        ++judgement.error_pixels, judgement.errors.add(double(error[p]));
        judgement.error_sum += double(error[p]), judgement.unfilled_error_sum += double(unfilled[p]);
    }
}

}  // namespace

void Shares::add(double value) {
    ++counts[std::min(size_t(std::max(0.0, value) * kSteps), size_t(kSteps - 1))];
}

void Shares::add(const Shares& other) {
    for (size_t step = 0; step < kSteps; ++step) counts[step] += other.counts[step];
}

double Shares::percentile(double share) const {
    uint64_t all = 0, until = 0;
    for (uint64_t count : counts) all += count;
    for (size_t step = 0; step < kSteps && all > 0; ++step)
        if (until += counts[step]; double(until) >= share * double(all)) return (double(step) + 0.5) / kSteps;
    return 0;
}

void Judgement::add(const Judgement& other) {
    pixels += other.pixels, holes += other.holes, holes_left += other.holes_left;
    covered += other.covered, covered_drawn += other.covered_drawn, covered_filled += other.covered_filled;
    deeper += other.deeper, nearer += other.nearer, error_pixels += other.error_pixels;
    error_sum += other.error_sum, unfilled_error_sum += other.unfilled_error_sum, errors.add(other.errors);
}

Truth traced(const Models& models, const TraceStage& stage, const ImageSet& set, const view::Camera& camera, const Light& light,
             uint64_t seed) {
    Truth truth;
    truth.tile.clear(camera.width_px, camera.height_px);
    truth.hidden_m.assign(truth.tile.colours.size(), std::numeric_limits<float>::infinity());
    view::PictureRays sight(camera);
    std::vector<uint32_t> pixels = pixels_by_block(camera.width_px, camera.height_px);
    std::vector<rays::Ray> rays;  // distances along them are depths
    for (uint32_t p : pixels)
        rays.push_back({glm::vec3(sight.eye_m), glm::vec3(sight.through_pixel(p % camera.width_px, p / camera.width_px))});
    std::vector<rays::Hit> hits(rays.size());
    stage.scene.first_hits(rays, hits);
    for (size_t i = 0; i < hits.size(); ++i) {
        uint32_t p = pixels[i];
        if (hits[i].copy == rays::kNone) continue;
        glm::vec3 at = rays[i].from_m + hits[i].distance * rays[i].along;
        if (at.x < 0 || at.y < 0 || double(at.x) >= set.tile_m || double(at.y) >= set.tile_m) {
            truth.hidden_m[p] = hits[i].distance;
            continue;
        }
        Point point = point_of(models, stage.copies, hits[i], rays[i].along);
        glm::vec3 colour =
            set.has_normals ? point.albedo : lit(stage.scene, point, light, hash_of(seed, kTruthStream, int64_t(p), 0));
        truth.tile.colours[p] = code_of(colour), truth.tile.depth_m[p] = hits[i].distance;
    }
    return truth;
}

view::Camera view_of(const ImageSet& set, uint32_t level, uint32_t direction, const Judging& judging, uint32_t view) {
    Wedge wedge = wedge_of(set, level, direction);
    Random random(hash_of(judging.seed, kViewStream + view, level, direction));
    double heading = wedge.heading_rad + (2 * random.next_unit() - 1) * wedge.half_width_rad;
    double distance = wedge.nearest_m + (wedge.farthest_m - wedge.nearest_m) * random.next_unit();
    view::Camera camera;
    camera.position_m = {set.tile_m / 2 + distance * std::sin(heading), set.tile_m / 2 + distance * std::cos(heading),
                         wedge.eye_low_m + (wedge.eye_high_m - wedge.eye_low_m) * random.next_unit()};
    glm::dvec3 at(set.tile_m * random.next_unit(), set.tile_m * random.next_unit(),
                  set.low_m + (set.high_m - set.low_m) * random.next_unit());
    glm::dvec3 along = at - camera.position_m;
    camera.heading_deg = std::atan2(along.x, along.y) * 180 / M_PI;
    camera.pitch_deg = std::clamp(std::atan2(along.z, std::hypot(along.x, along.y)) * 180 / M_PI, -89.0, 89.0);
    camera.width_px = camera.height_px = judging.size_px, camera.near_m = 0.05;
    camera.fov_y_deg = 2 * std::atan(judging.size_px / (2 * set.cell.focal_px)) * 180 / M_PI;
    return camera;
}

uint32_t views_of(const ImageSet& set, const Which& which, uint32_t all, uint32_t tile_count) {
    if (which.context != 0 || which.tile >= tile_count) return 0;
    uint32_t pairs = uint32_t(set.levels.size()) * set.direction_count,
             pair = which.level * set.direction_count + which.direction;
    uint32_t of_pair = all / pairs + (pair < all % pairs ? 1 : 0);
    // The pair's k-th is of tile (k + pair) % tile_count.
    uint32_t first = (which.tile + tile_count - pair % tile_count) % tile_count;
    return of_pair <= first ? 0 : (of_pair - first - 1) / tile_count + 1;
}

Judgement judged(const Models& models, const TraceStage& stage, const ImageSet& set, const Which& which, const Ldi& ldi,
                 const Light& light, const Judging& judging) {
    Judgement judgement;
    Drawn drawn{&ldi, which.level, glm::dvec3(0), glm::dvec2(0), judging.splat_scale};
    double pixel_m = set.tile_m / set.levels[which.level].side_px;
    for (uint32_t view = 0; view < judging.views; ++view) {
        view::Camera camera = view_of(set, which.level, which.direction, judging, view);
        Warped picture;
        picture.clear(camera.width_px, camera.height_px);
        warp(camera, set, std::span(&drawn, 1), Hiding::by_order, picture);
        Warped filled = picture;
        fill_holes(filled);
        Truth truth = traced(models, stage, set, camera, light, hash_of(judging.seed, kTruthStream, view, 1));
        compare_depths(truth.tile, picture, filled, pixel_m, judgement);
        compare_pictures(truth, picture, filled, pixel_m, judgement);
    }
    return judgement;
}

}  // namespace overlook::wang_ldi
