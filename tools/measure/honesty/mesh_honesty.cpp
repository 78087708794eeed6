#include "tools/measure/honesty/mesh_honesty.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "formats/parallel.h"
#include "tools/measure/honesty/screen.h"

namespace overlook::measure {
namespace {

// Corners of the cut in which every split is applied, in the world, three a face.
std::vector<glm::dvec3> finest_corners_m(const caveclod::Hierarchy& hierarchy) {
    std::vector<std::array<uint32_t, 3>> faces = hierarchy.face_positions;
    for (uint32_t split = 0; split < hierarchy.split_count(); ++split) {
        for (uint32_t i = hierarchy.moved_begin[split]; i < hierarchy.moved_begin[split + 1]; ++i) {
            uint32_t corner = hierarchy.moved[i];
            faces[corner / caveclod::kCorners][corner % caveclod::kCorners] = hierarchy.new_position(split);
        }
    }
    std::vector<glm::dvec3> corners;
    for (const auto& face : faces) {
        for (uint32_t position : face) corners.push_back(hierarchy.origin_m + glm::dvec3(hierarchy.positions_m[position]));
    }
    return corners;
}

// The greatest displacement of those of the places that are in the frame; below 0 if none is.
double most_px(const std::vector<glm::dvec3>& places_m, const NearestPoint& nearest, const Screen& screen) {
    std::vector<double> of_place(places_m.size(), -1);
    parallel_ranges(places_m.size(), 4096, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            std::optional<glm::dvec2> at = screen.at(places_m[i]);
            if (!at || !screen.is_in_frame(*at)) continue;
            std::optional<glm::dvec2> there = screen.at(nearest(places_m[i]));
            of_place[i] = there ? glm::distance(*at, *there) : std::numeric_limits<double>::infinity();
        }
    });
    return places_m.empty() ? -1 : *std::max_element(of_place.begin(), of_place.end());
}

}  // namespace

MeshHonesty::MeshHonesty(const caveclod::Hierarchy& hierarchy) {
    for (const glm::vec3& at : hierarchy.positions_m) places_m_.push_back(hierarchy.origin_m + glm::dvec3(at));
    source_ = std::make_unique<NearestPoint>(finest_corners_m(hierarchy));
}

Promises MeshHonesty::promises_of(std::span<const glm::dvec3> drawn_m, const view::Camera& camera, double error_px) const {
    Promises promises;
    if (drawn_m.empty()) return promises;
    Screen screen(camera);
    std::vector<glm::dvec3> middles_m;
    for (size_t i = 0; i < drawn_m.size(); i += 3) middles_m.push_back((drawn_m[i] + drawn_m[i + 1] + drawn_m[i + 2]) / 3.0);
    double most = std::max(most_px(places_m_, NearestPoint(drawn_m), screen), most_px(middles_m, *source_, screen));
    if (most < 0) return promises;
    promises.predicted_px.push_back(float(error_px));
    promises.measured_px.push_back(float(most));
    return promises;
}

}  // namespace overlook::measure
