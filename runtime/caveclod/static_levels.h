// Levels of detail of a mesh that are chosen for the whole of it: what every engine has, to compare refinement with.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/caveclod/mesh.h"
#include "runtime/view/camera.h"

namespace overlook::caveclod {

// Faces that change no more: three vertices each, by surface.
struct StaticFaces {
    std::vector<std::vector<uint32_t>> by_surface;
    double error_m = 0;  // the bound of what is drawn
    uint64_t triangle_count() const;
};

// The coarsest cut whose bound is at most error_m; every split applied if that is less than the finest. O(splits).
StaticFaces faces_within(const Mesh& mesh, double error_m);

// Every level has at most half the triangles of the finer one, down to the coarsest cut.
class StaticLevels {
  public:
    explicit StaticLevels(const Mesh& mesh);

    size_t size() const { return levels_.size(); }
    const StaticFaces& operator[](size_t level) const { return levels_[level]; }  // 0 is the finest
    // The coarsest level that keeps error_px over the whole mesh: by its sphere, as engines choose. 0 if none does.
    size_t chosen(const view::Camera& camera, double error_px) const;
    // What that level may be off, in pixels.
    double error_px(size_t level, const view::Camera& camera) const;

  private:
    std::vector<StaticFaces> levels_;
    glm::dvec3 middle_m_{0};
    double radius_m_ = 0;
};

}  // namespace overlook::caveclod
