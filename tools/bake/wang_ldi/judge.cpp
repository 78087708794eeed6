#include "tools/bake/wang_ldi/judge.h"

#include <algorithm>
#include <cmath>

#include "runtime/wang_ldi/random.h"
#include "tools/bake/wang_ldi/assemble.h"

namespace overlook::wang_ldi {
namespace {

constexpr uint64_t kViewStream = 31, kTruthStream = 32;

rays::Ray ray_of(const view::Camera& camera, const view::Axes& axes, uint32_t column, uint32_t row) {
    double focal = view::focal_px(camera);
    glm::dvec3 along = axes.forward + axes.right * ((column + 0.5 - camera.width_px * 0.5) / focal) +
                       axes.up * ((camera.height_px * 0.5 - row - 0.5) / focal);
    return {glm::vec3(camera.position_m), glm::vec3(along)};  // distances along it are depths
}

uint32_t code_of(const glm::vec3& colour) {
    return uint32_t(srgb_from_linear(colour.r)) | uint32_t(srgb_from_linear(colour.g)) << 8 |
           uint32_t(srgb_from_linear(colour.b)) << 16 | 0xff000000u;
}

double luma_of(uint32_t colour) {
    return (0.2126 * (colour & 0xff) + 0.7152 * (colour >> 8 & 0xff) + 0.0722 * (colour >> 16 & 0xff)) / 255;
}

bool is_within(const Warped& truth, uint32_t column, uint32_t row) {
    if (column == 0 || row == 0 || column + 1 >= truth.width_px || row + 1 >= truth.height_px) return false;
    for (uint32_t y = row - 1; y <= row + 1; ++y)
        for (uint32_t x = column - 1; x <= column + 1; ++x)
            if (truth.colours[size_t(y) * truth.width_px + x] == 0) return false;
    return true;
}

void compare(const Warped& truth, const Warped& drawn, double pixel_m, Judgement& judgement, std::vector<double>& errors) {
    for (uint32_t row = 0; row < truth.height_px; ++row)
        for (uint32_t column = 0; column < truth.width_px; ++column) {
            if (!is_within(truth, column, row)) continue;
            size_t p = size_t(row) * truth.width_px + column;
            ++judgement.pixels;
            if (drawn.colours[p] == 0) {
                ++judgement.holes;
                continue;
            }
            double deeper = double(drawn.depth_m[p]) - double(truth.depth_m[p]);
            double slack = 0.02 * double(truth.depth_m[p]) + 2 * pixel_m;
            judgement.deeper += deeper > slack, judgement.nearer += -deeper > slack;
            errors.push_back(std::abs(luma_of(drawn.colours[p]) - luma_of(truth.colours[p])));
        }
}

}  // namespace

Warped traced(const Models& models, const TraceStage& stage, const ImageSet& set, const view::Camera& camera, const Light& light,
              uint64_t seed) {
    Warped truth;
    truth.clear(camera.width_px, camera.height_px);
    view::Axes axes = view::axes_of(camera);
    std::vector<rays::Ray> rays;
    for (uint32_t p = 0; p < camera.width_px * camera.height_px; ++p)
        rays.push_back(ray_of(camera, axes, p % camera.width_px, p / camera.width_px));
    std::vector<rays::Hit> hits(rays.size());
    stage.scene.first_hits(rays, hits);
    for (size_t p = 0; p < hits.size(); ++p) {
        if (hits[p].copy == rays::kNone) continue;
        glm::vec3 at = rays[p].from_m + hits[p].distance * rays[p].along;
        if (at.x < 0 || at.y < 0 || double(at.x) >= set.tile_m || double(at.y) >= set.tile_m) continue;
        Point point = point_of(models, stage.copies, hits[p], rays[p].along);
        glm::vec3 colour =
            set.has_normals ? point.albedo : lit(stage.scene, point, light, hash_of(seed, kTruthStream, int64_t(p), 0));
        truth.colours[p] = code_of(colour), truth.depth_m[p] = hits[p].distance;
    }
    return truth;
}

view::Camera view_of(const ImageSet& set, uint32_t level, uint32_t direction, const Judging& judging, uint32_t view) {
    Wedge wedge = wedge_of(set, level, direction);
    Random random(hash_of(judging.seed, kViewStream + view, level, direction));
    double heading = wedge.heading_rad + (2 * random.next_unit() - 1) * wedge.half_width_rad;
    double distance = wedge.nearest_m + (wedge.farthest_m - wedge.nearest_m) * random.next_unit();
    glm::dvec3 middle(set.tile_m / 2, set.tile_m / 2, (set.low_m + set.high_m) / 2);
    view::Camera camera;
    camera.position_m = {middle.x + distance * std::sin(heading), middle.y + distance * std::cos(heading),
                         wedge.eye_low_m + (wedge.eye_high_m - wedge.eye_low_m) * random.next_unit()};
    glm::dvec3 along = middle - camera.position_m;
    camera.heading_deg = std::atan2(along.x, along.y) * 180 / M_PI;
    camera.pitch_deg = std::atan2(along.z, std::hypot(along.x, along.y)) * 180 / M_PI;
    camera.width_px = camera.height_px = judging.size_px, camera.near_m = 0.05;
    camera.fov_y_deg = 2 * std::atan(judging.size_px / (2 * set.cell.focal_px)) * 180 / M_PI;
    return camera;
}

Judgement judged(const Models& models, const TraceStage& stage, const ImageSet& set, const Which& which, const Ldi& ldi,
                 const Light& light, const Judging& judging) {
    Judgement judgement;
    std::vector<double> errors;
    Drawn drawn{&ldi, which.level, glm::dvec3(0), glm::dvec2(0), judging.splat_scale};
    double pixel_m = set.tile_m / set.levels[which.level].side_px;
    for (uint32_t view = 0; view < judging.views; ++view) {
        view::Camera camera = view_of(set, which.level, which.direction, judging, view);
        Warped picture;
        picture.clear(camera.width_px, camera.height_px);
        warp(camera, set, std::span(&drawn, 1), Hiding::by_order, picture);
        compare(traced(models, stage, set, camera, light, hash_of(judging.seed, kTruthStream, view, 1)), picture, pixel_m,
                judgement, errors);
    }
    if (errors.empty()) return judgement;
    for (double error : errors) judgement.mean_error += error / double(errors.size());
    size_t at = std::min(errors.size() - 1, errors.size() * 99 / 100);
    std::nth_element(errors.begin(), errors.begin() + long(at), errors.end());
    judgement.p99_error = errors[at];
    return judgement;
}

ImageRgb8 picture_of(const Warped& warped) {
    ImageRgb8 image{warped.width_px, warped.height_px, {}};
    for (uint32_t colour : warped.colours)
        for (int shift : {0, 8, 16}) image.pixels.push_back(colour == 0 ? 128 : uint8_t(colour >> shift & 0xff));
    return image;
}

}  // namespace overlook::wang_ldi
