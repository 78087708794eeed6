#include "runtime/caveclod/static_levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "runtime/view/pixel_error.h"

namespace overlook::caveclod {
namespace {

constexpr uint32_t kNobody = ~0u;

// [S] errors of all splits, greatest first.
std::vector<float> sorted_errors(const Mesh& mesh) {
    std::vector<float> errors(mesh.split_count());
    for (uint32_t i = 0; i < mesh.split_count(); ++i) errors[i] = mesh.error_m(i);
    std::sort(errors.begin(), errors.end(), std::greater<>());
    return errors;
}

}  // namespace

uint64_t StaticFaces::triangle_count() const {
    uint64_t count = 0;
    for (const std::vector<uint32_t>& indices : by_surface) count += indices.size() / 3;
    return count;
}

StaticFaces faces_within(const Mesh& mesh, double error_m) {
    struct Face {
        uint32_t surface = kNobody;
        std::array<uint32_t, 3> vertices{};
    };
    std::vector<Face> faces(mesh.face_count());
    for (uint32_t face = 0; face < mesh.base_face_count(); ++face)
        faces[face] = {mesh.base_surface(face), mesh.base_faces()[face]};
    StaticFaces cut;
    cut.error_m = mesh.finest_error_m();
    SplitRecord record;
    for (uint32_t split = 0; split < mesh.split_count(); ++split) {
        // What a split needs has at least its error, so the set is closed.
        bool is_finest = error_m < mesh.finest_error_m();
        if (!is_finest && mesh.error_m(split) <= error_m) {
            cut.error_m = std::max<double>(cut.error_m, mesh.error_m(split));
            continue;
        }
        mesh.decode(split, record);
        for (const SplitRecord::Move& move : record.moves)
            faces[move.corner / kCorners].vertices[move.corner % kCorners] = move.vertex;
        for (uint32_t k = 0; k < record.face_count; ++k)
            faces[record.faces[k].face] = {record.faces[k].surface, record.faces[k].vertices};
    }
    cut.by_surface.resize(mesh.surface_count());
    for (const Face& face : faces) {
        if (face.surface == kNobody) continue;
        std::vector<uint32_t>& indices = cut.by_surface[face.surface];
        indices.insert(indices.end(), face.vertices.begin(), face.vertices.end());
    }
    return cut;
}

StaticLevels::StaticLevels(const Mesh& mesh) {
    std::vector<float> errors = sorted_errors(mesh);
    levels_.push_back(faces_within(mesh, -1));
    // Of half as many splits each; equal errors stand or fall together.
    for (size_t count = errors.size() / 2; !errors.empty(); count /= 2) {
        StaticFaces level = faces_within(mesh, std::max<double>(errors[count], mesh.finest_error_m()));
        if (2 * level.triangle_count() <= levels_.back().triangle_count() || count == 0) {
            if (level.triangle_count() < levels_.back().triangle_count()) levels_.push_back(std::move(level));
        }
        if (count == 0) break;
    }
    middle_m_ = (mesh.lowest_m() + mesh.highest_m()) / 2.0;
    radius_m_ = glm::distance(mesh.lowest_m(), mesh.highest_m()) / 2;
}

double StaticLevels::error_px(size_t level, const view::Camera& camera) const {
    view::SphereErrorBound bound(camera);
    return bound(bound.place_of(middle_m_ - camera.position_m), radius_m_, levels_[level].error_m);
}

size_t StaticLevels::chosen(const view::Camera& camera, double error_px) const {
    for (size_t level = levels_.size() - 1; level > 0; --level) {
        if (this->error_px(level, camera) <= error_px) return level;
    }
    return 0;
}

}  // namespace overlook::caveclod
