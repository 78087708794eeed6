// Triangles that rays are cast at.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <span>

#include "tools/bake/caveclod/triangle_tree.h"

namespace overlook::discrete {

// Whether a hit counts: the triangle, and the weights of its second and third corner.
using AcceptHit = std::function<bool(uint32_t triangle, float second, float third)>;

struct RayHit {
    static constexpr uint32_t kNone = 0xffffffff;
    uint32_t triangle = kNone;
    float second = 0, third = 0;  // weights of its corners
    double distance_m = 0;
};

// Embree's tree of boxes (I. Wald et al., Embree: A Kernel Framework for Efficient CPU Ray Tracing, 2014), built by one thread
// and without instructions that only some processors have, so that a ray hits the same everywhere. In floats about the triangles'
// middle: what it says is good for pictures, not for bounds. May be empty.
class RayScene {
  public:
    explicit RayScene(std::span<const caveclod::Triangle> triangles);
    RayScene(RayScene&&) noexcept;
    RayScene& operator=(RayScene&&) noexcept;
    ~RayScene();

    // The nearest accepted hit on the way from `from` along `direction` (of length 1), up to far_m. Any thread.
    RayHit first(const glm::dvec3& from, const glm::dvec3& direction, double far_m, const AcceptHit& accept) const;

  private:
    struct Trees;
    std::unique_ptr<Trees> trees_;
};

}  // namespace overlook::discrete
