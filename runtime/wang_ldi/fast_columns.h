// A prepared image painted on a canvas, many samples at a time.
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
    // Samples that are shown, one after the other, as SamplesOfRows; there is room for more than `count`.
    std::vector<uint32_t> places;
    std::vector<uint16_t> rows;
    std::vector<uint8_t> colours, splats;
    uint32_t count = 0;
};

template <Hiding hiding>
class FastColumns final : public Columns {
  public:
    // All must outlive this.
    FastColumns(const Eye& eye, const ImageSet& set, const PreparedLdi& ldi, uint32_t level, const SplatRule& rule,
                const glm::dvec2& south_west_m, FastTools& tools);

    void stand_on(const Plane& plane) override;
    void draw(uint32_t column, uint32_t row) override {
        if (may_show(row, {column, column + 1})) draw_row(row, {column, column + 1}, nullptr);
    }
    // Of a row that may_show something. shown: for each column all bits or none; null: all are, which by order they must be. By
    // depth some are kept until finish().
    void draw_row(uint32_t row, const Span& columns, const uint32_t* shown);
    // Before it stands on another plane, or another is drawn.
    void finish();
    // False only if none of a row's samples can be in the picture.
    bool may_show(uint32_t row, const Span& columns) const;
    bool is_inside = false;  // the picture holds all of it, so that rows are not asked about

  private:
    bool may_be_seen(uint32_t row, const Span& columns, const glm::vec3& foot) const;
    void make_room(size_t more);
    void add_all(uint32_t row, const Span& columns);
    void add_shown(uint32_t row, const Span& columns, const uint32_t* shown);
    SamplesOfRows kept(uint32_t from, uint32_t most) const;
    ProjectedCounts project(const SamplesOfRows& samples);
    void paint(const SamplesOfRows& samples, const ProjectedCounts& counts);
    template <int side>
    void paint_even(const SamplesOfRows& samples);
    void paint_uneven(const SamplesOfRows& samples);
    void paint_towards(uint32_t row, const Span& columns);
    void paint_column(uint32_t column, uint32_t row, uint32_t begin);
    void paint_one(uint32_t projected, uint8_t colour);
    const uint32_t* first_of_row(uint32_t row) const { return ldi_.first.data() + size_t(row) * side_px; }

    const Eye& eye_;
    const PreparedLdi& ldi_;
    FastTools& tools_;
    ImageFrame frame_;
    SampleFrame on_plane_;
    int64_t eye_column_ = 0;
};

}  // namespace overlook::wang_ldi
