#include "tools/measure/paper/wang_ldi/broken.h"

#include <algorithm>
#include <cmath>

#include "runtime/view/flip.h"
#include "runtime/view/picture_rays.h"
#include "runtime/wang_ldi/perspective_warp.h"

namespace overlook::measure::paper::wang {
namespace {

constexpr float kWrongDepth = 0.05f;

}  // namespace

Broken broken_of(const wang_ldi::Warped& truth, const wang_ldi::Warped& picture) {
    uint64_t shown = 0, holes = 0, wrong = 0;
    for (size_t p = 0; p < truth.colours.size(); ++p) {
        if (truth.colours[p] == 0) continue;
        ++shown;
        if (picture.colours[p] == 0)
            ++holes;
        else
            wrong += std::abs(picture.depth_m[p] - truth.depth_m[p]) > kWrongDepth * truth.depth_m[p];
    }
    double all = double(std::max<uint64_t>(1, shown));
    return {double(holes) / all, double(wrong) / all};
}

HoleCauses causes_of_holes(const view::Camera& camera, const wang_ldi::PerspectiveView& image, const wang_ldi::Warped& truth,
                           const wang_ldi::Warped& picture) {
    view::PictureRays there(camera), own(wang_ldi::camera_of(image));
    uint64_t shown = 0, hidden = 0, beyond = 0;
    for (uint32_t p = 0; p < truth.colours.size(); ++p) {
        shown += truth.colours[p] != 0;
        if (truth.colours[p] == 0 || picture.colours[p] != 0) continue;
        glm::dvec3 along = there.through_pixel(p % truth.width_px, p / truth.width_px);
        glm::dvec3 seen = own.seen(there.eye_m + double(truth.depth_m[p]) * along);
        bool is_within = seen.z >= image.near_m && seen.z <= image.far_m && seen.x >= 0 && seen.y >= 0 &&
                         seen.x < image.width_px && seen.y < image.height_px;
        ++(is_within ? hidden : beyond);
    }
    double all = double(std::max<uint64_t>(1, shown));
    return {double(hidden) / all, double(beyond) / all};
}

std::vector<double> errors_of(const wang_ldi::Warped& truth, const wang_ldi::Warped& picture) {
    ImageRgb8 right = wang_ldi::picture_of(truth), shown = wang_ldi::picture_of(picture);
    std::vector<float> map = view::flip_map({shown.width, shown.height, shown.pixels}, {right.width, right.height, right.pixels});
    std::vector<double> errors;
    for (size_t p = 0; p < map.size(); ++p)
        if (truth.colours[p] != 0 || picture.colours[p] != 0) errors.push_back(double(map[p]));
    return errors;
}

double differing_share(const wang_ldi::Warped& one, const wang_ldi::Warped& other) {
    uint64_t differing = 0;
    for (size_t p = 0; p < one.colours.size(); ++p) differing += one.colours[p] != other.colours[p];
    return double(differing) / double(std::max<size_t>(1, one.colours.size()));
}

}  // namespace overlook::measure::paper::wang
