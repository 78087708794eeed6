// Draws single plants' triangles on a canvas.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/wang_ldi/brush.h"
#include "runtime/wang_ldi/canvas.h"
#include "runtime/wang_ldi/plant_fill.h"
#include "runtime/wang_ldi/plant_levels.h"
#include "runtime/wang_ldi/plant_light.h"
#include "runtime/wang_ldi/plant_shapes.h"

namespace overlook::wang_ldi {

class PlantPen {
  public:
    // All must outlive it.
    PlantPen(const view::Camera& camera, const PlantLight& light) : eye_(camera), light_(light) {}

    // item: of the list; shape: its model's. By depth.
    void draw(const PlantShape& shape, const PlantList& list, const discrete::Item& item, Canvas& canvas);

  private:
    // Of a vertex: which side of the picture it is behind, and that it cannot be brought there.
    enum Behind : uint8_t { kLeft = 1, kRight = 2, kAbove = 4, kBelow = 8, kNear = 16, kFar = 32 };
    // The light that a vertex sends, tinted, on the side of its normal and on the other.
    struct Lit {
        Four front{}, back{};
    };

    void stand(const discrete::Placement& placement);
    void place(const ShapeLevel& level);
    void draw_run(const ShapeLevel& level, const Skin& skin, uint32_t first_index, uint32_t index_count);
    void draw_triangle(const ShapeLevel& level, const Skin& skin, uint32_t index);
    void draw_cut(const ShapeLevel& level, const Skin& skin, uint32_t index);
    const Lit& lit(const ShapeLevel& level, uint32_t vertex);
    Four colour(const ShapeLevel& level, const Skin& skin, uint32_t index, int corner, bool sees_front);
    Four sent(const ShapeLevel& level, uint32_t vertex, const glm::vec3& normal) const;
    glm::vec3 stood(const glm::vec3& own) const;
    glm::vec3 seen(const ShapeLevel& level, uint32_t vertex) const;
    glm::vec3 face(const ShapeLevel& level, uint32_t index) const;
    Corner corner_at(const glm::vec3& seen, const std::array<float, 2>& uv) const;

    Eye eye_;
    const PlantLight& light_;
    PlantFill fill_;
    // Of the plant that is drawn.
    glm::mat3 turn_{1};  // from its own to what the eye sees, right and up times the focal length
    glm::vec3 foot_{0};  // as Eye::seen
    float cosine_ = 1, sine_ = 0, scale_ = 1;
    std::vector<int32_t> x_, y_;   // [vertices], as Corner
    std::vector<float> nearness_;  // [vertices]
    std::vector<uint8_t> behind_;  // [vertices]
    std::vector<Lit> lit_;         // [vertices]
    std::vector<uint8_t> is_lit_;  // [vertices]
};

}  // namespace overlook::wang_ldi
