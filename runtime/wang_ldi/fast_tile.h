// An item of a field painted on a canvas.
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "runtime/wang_ldi/far_painter.h"
#include "runtime/wang_ldi/fast_columns.h"
#include "runtime/wang_ldi/fast_warp.h"
#include "runtime/wang_ldi/in_picture.h"

namespace overlook::wang_ldi {

// What is the same for all items of a picture. All must outlive it.
struct FastScene {
    Eye eye;
    PictureBounds bounds;
    const Field& field;
    const FieldList& list;
    const PreparedAt& image_at;
    const FarImages* far;
    double highest_step_m;  // of any level
};

// Which coarse cells of a tile show which rung, looked up once for all of its rows.
class TileFades {
  public:
    void begin(uint64_t tile, uint32_t coarser_px);
    // Writes all bits for each of a row's columns that is shown, none for the others. first: of the row, as Ldi::first; columns
    // without a sample are not decided.
    void mask(const Columns& columns, uint32_t row, const Span& span, const uint32_t* first, std::vector<uint32_t>& shown);

  private:
    const uint8_t* rungs_of_row(uint32_t row, uint32_t side_px);

    uint64_t tile_ = 0;
    uint32_t coarser_px_ = 1;
    std::vector<uint8_t> by_rung_;  // [coarser_px, coarser_px]; empty until they are asked for
};

template <Hiding hiding>
class FastTile {
  public:
    FastTile(const FastScene& scene, FastTools& tools)
        : scene_(scene), tools_(tools), brush_(scene.eye, CanvasTarget<hiding>(*tools.canvas), tools.counts) {
        if (scene.far != nullptr) far_.emplace(scene.eye, scene.bounds, scene.field, *scene.far, brush_);
    }

    void draw(const Item& item);

  private:
    using Painting = Brush<CanvasTarget<hiding>>;
    void choose(const Item& item, const glm::dvec2& corner_m);
    void draw_half(const Item& item, const Half& half, const glm::dvec2& eye_share);
    void draw_rows(FastColumns<hiding>& columns, const Piece& piece, const glm::dvec2& eye_share);

    const FastScene& scene_;
    FastTools& tools_;
    Painting brush_;
    TileFades fades_;
    std::deque<FastColumns<hiding>> images_;  // of the item that is drawn
    std::optional<FarPainter<Painting>> far_;
    std::deque<FarColumns<Painting>> textures_;
    std::vector<Columns*> all_;
};

}  // namespace overlook::wang_ldi
