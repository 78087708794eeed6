// Draws single plants' triangles on a canvas.
#pragma once

#include <array>
#include <cstdint>

#include "runtime/discrete/select.h"
#include "runtime/wang_ldi/brush.h"
#include "runtime/wang_ldi/canvas.h"
#include "runtime/wang_ldi/plant_fill.h"
#include "runtime/wang_ldi/plant_light.h"
#include "runtime/wang_ldi/plant_shapes.h"
#include "runtime/wang_ldi/plant_sift.h"

namespace overlook::wang_ldi {

class PlantPen {
  public:
    // All must outlive it.
    PlantPen(const view::Camera& camera, const PlantLight& light) : eye_(camera), light_(light), loops_(best_plant_loops()) {}

    // Columns [left, right) of the picture are drawn from now on.
    void begin(Canvas& canvas, int left, int right) { canvas_ = &canvas, left_ = left, right_ = right; }
    // By depth; what is hidden by what is drawn already costs little. shape: its model's.
    void draw(const PlantShape& shape, uint32_t level, const discrete::Placement& placement, const Door& door);

  private:
    // The light that a vertex sends, tinted, on the side of its normal and on the other.
    struct Lit {
        Four front{}, back{};
    };

    // At a place p of the plant's own world along . p + offset: below 0 behind a side of what is drawn.
    struct Side {
        glm::vec3 along{0};
        float offset = 0;
    };

    void stand(const discrete::Placement& placement);
    bool may_be_seen(const ShapeBunch& bunch) const;
    bool is_hidden(const ShapeBunch& bunch) const;
    void draw_bunch(const Skin& skin, const ShapeBunch& bunch);
    PlacedVertices place(const ShapeBunch& bunch);
    void draw_triangle(const Skin& skin, uint32_t index);
    void draw_cut(const Skin& skin, uint32_t index);
    const Lit& lit(uint32_t vertex);
    Four colour(const Skin& skin, uint32_t index, int corner, bool sees_front);
    Four sent(uint32_t vertex, const glm::vec3& normal) const;
    glm::vec3 stood(const glm::vec3& own) const;
    glm::vec3 own_m(uint32_t vertex) const;
    glm::vec3 face(uint32_t index) const;
    // As near as can be to where it is seen, whatever rounding made of it.
    Corner corner_at(const glm::vec3& seen, const std::array<float, 2>& uv) const;

    Eye eye_;
    const PlantLight& light_;
    const PlantLoops& loops_;
    PlantFill fill_;
    Canvas* canvas_ = nullptr;
    int left_ = 0, right_ = 0;
    // Of the plant that is drawn.
    const ShapeLevel* level_ = nullptr;
    glm::mat3 turn_{1};  // from its own to what the eye sees, right and up times the focal length
    glm::vec3 foot_{0};  // as Eye::seen
    float cosine_ = 1, sine_ = 0, scale_ = 1;
    std::array<Side, 5> sides_;  // left, right, above, below, near
    // Of the bunch that is drawn.
    uint32_t first_vertex_ = 0;
    static constexpr size_t kMostVertices = 3 * kMostInBunch;
    std::array<int32_t, kMostVertices> x_{}, y_{};  // as Corner
    std::array<float, kMostVertices> nearness_{};
    std::array<int32_t, kMostVertices> behind_{};
    std::array<uint16_t, kMostInBunch> kept_{};
    std::array<uint8_t, kMostVertices> is_lit_{};
    std::array<Lit, kMostVertices> lit_{};
};

}  // namespace overlook::wang_ldi
