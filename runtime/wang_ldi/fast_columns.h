// Rows of a prepared image painted on a canvas, many samples at a time.
#pragma once

#include <vector>

#include "runtime/wang_ldi/canvas.h"
#include "runtime/wang_ldi/prepared_ldi.h"
#include "runtime/wang_ldi/project_samples.h"
#include "runtime/wang_ldi/tile_painter.h"

namespace overlook::wang_ldi {

// What a thread needs to paint, kept from image to image.
struct FastTools {
    Canvas* canvas = nullptr;
    ProjectSamples project = nullptr;
    WarpCounts counts;
    std::vector<int32_t> pixels, sides;
    std::vector<float> depths_m;
    std::vector<uint32_t> shown;  // of each column of a row
    // Samples of a row, one after the other, that are shown; PreparedLdi::kPadding more.
    std::vector<uint32_t> places;
    std::vector<uint8_t> colours, splats;
};

template <Hiding hiding>
class FastColumns final : public Columns {
  public:
    // All must outlive this.
    FastColumns(const Eye& eye, const ImageSet& set, const PreparedLdi& ldi, uint32_t level, const SplatRule& rule,
                const glm::dvec2& south_west_m, FastTools& tools);

    void stand_on(const Plane& plane) override;
    void draw(uint32_t column, uint32_t row) override { draw_row(row, {column, column + 1}, nullptr); }
    // shown: for each column all bits or none; null: all are, which by order they must be.
    void draw_row(uint32_t row, const Span& columns, const uint32_t* shown);
    // False only if none of a row's samples can be in the picture.
    bool may_show(uint32_t row, const Span& columns) const;
    bool is_inside = false;  // the picture holds all of it, so that rows are not asked about

  private:
    bool may_be_seen(uint32_t row, const Span& columns, const glm::vec3& foot) const;
    // Samples of a row: as PreparedLdi has them, readable for kPadding more.
    struct Samples {
        const uint32_t* places;
        const uint8_t *colours, *splats;  // splats: null if there are none
        uint32_t count;

        Samples part(uint32_t from, uint32_t most) const {
            return {places + from, colours + from, splats == nullptr ? nullptr : splats + from, std::min(most, count - from)};
        }
    };
    Samples those_shown(uint32_t row, const Span& columns, const uint32_t* shown);
    void paint(const Samples& samples, const ProjectedCounts& counts);
    template <int side>
    void paint_even(const Samples& samples);
    void paint_uneven(const Samples& samples);
    void paint_towards(uint32_t row, const Span& columns);
    void paint_column(uint32_t column, uint32_t row, uint32_t begin);
    void paint_one(uint32_t projected, uint8_t colour);
    const uint32_t* first_of_row(uint32_t row) const { return ldi_.first.data() + size_t(row) * side_px; }

    const Eye& eye_;
    const PreparedLdi& ldi_;
    FastTools& tools_;
    ImageFrame frame_;
    RowFrame row_;
    int64_t eye_column_ = 0;
};

}  // namespace overlook::wang_ldi
