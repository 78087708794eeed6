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

// Which places of a tile are shown, row by row.
class TileFades {
  public:
    void begin(uint64_t tile, uint32_t coarser_px) { tile_ = tile, coarser_px_ = coarser_px; }
    // Writes all bits for each of a row's columns in the span that is shown, none for the others.
    void mask(const Columns& columns, uint32_t row, const Span& span, std::vector<uint32_t>& shown);

  private:
    void mask_rungs(const Columns& columns, uint32_t row, const Span& span, uint32_t* shown);

    uint64_t tile_ = 0;
    uint32_t coarser_px_ = 1;
    // Of the images asked about last: which coarse cell each column lies in.
    uint32_t cells_ = 0;
    std::vector<uint32_t> cell_of_column_;
    std::vector<uint32_t> are_cells_shown_;  // of a row
};

template <Hiding hiding>
class FastTile {
  public:
    FastTile(const FastScene& scene, FastTools& tools)
        : scene_(scene), tools_(tools), brush_(scene.eye, CanvasTarget<hiding>(*tools.canvas), tools.counts) {
        if (scene.far != nullptr) far_.emplace(scene.eye, scene.bounds, scene.field, scene.list, *scene.far, brush_);
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
