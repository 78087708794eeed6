#include "runtime/wang_ldi/splat_lists.h"

#include <algorithm>
#include <deque>
#include <optional>

#include "runtime/wang_ldi/far_painter.h"
#include "runtime/wang_ldi/in_picture.h"
#include "runtime/wang_ldi/list_parts.h"
#include "runtime/wang_ldi/tile_painter.h"

namespace overlook::wang_ldi {
namespace {

// What a FarPainter paints, as it comes.
class PointBrush {
  public:
    static constexpr bool kIsByDepth = true;
    explicit PointBrush(std::vector<SplatPoint>& points) : points_(&points) {}
    void splat(const glm::vec3& at, float wide, uint32_t colour) { points_->push_back({at, wide, colour}); }

  private:
    std::vector<SplatPoint>* points_;
};

class ListMaker {
  public:
    ListMaker(const view::Camera& camera, const Field& field, const FieldList& list, const PreparedAt& image_at,
              const FarImages* far, uint32_t finer, SplatLists& made)
        : eye_(camera, finer),
          bounds_(camera),
          field_(field),
          list_(list),
          image_at_(image_at),
          highest_step_m_(highest_step_m(*field.parts().images)),
          made_(made),
          brush_(made.points) {
        if (far != nullptr) far_.emplace(eye_, bounds_, field, list, *far, brush_);
    }

    void add(const Item& item) {
        double side_m = field_.parts().images->tile_m * double(int64_t(1) << item.tiles_log2);
        glm::dvec2 corner_m = field_.parts().placement->rect_of(item.i, item.j).low_m;
        if (!bounds_.may_hold({corner_m, item.low_m}, {corner_m + side_m, item.high_m + highest_step_m_},
                              eye_.focal_px * widest_splat_m(field_, list_, item)))
            return;
        if (item.half_count == 0) {
            if (far_ && item.texels_px > 0) far_->draw(item);
            return;
        }
        if (far_) far_->begin(item);
        for (const Shown& shown : list_.shown_of(item)) {
            const Rung& rung = field_.ladder().rungs[shown.rung];
            if (rung.stage == Stage::ldi)
                add_image(item, shown, rung.level, corner_m);
            else if (rung.stage != Stage::geometry && far_)
                far_->draw_shown(shown);
        }
    }

  private:
    void add_image(const Item& item, const Shown& shown, uint32_t level, const glm::dvec2& corner_m) {
        uint64_t index = field_.image_of(item, shown);
        const PreparedLdi* image = image_at_(index);
        made_.images_missing += image == nullptr;
        if (image == nullptr || image->sample_count() == 0) return;
        const ImageSet& images = *field_.parts().images;
        ImageFrame frame(eye_, images, images.levels[level], !image->splats.empty(), {1, field_.options().widens_splats},
                         corner_m);
        uint64_t number = Field::fade_number(item.i, item.j);
        SplatDraw draw;
        draw.first_plane = uint32_t(made_.planes.size()), draw.sample_count = image->sample_count();
        draw.side_px = image->side_px, draw.pieces = 1u << item.pieces_log2;
        draw.rung_from = shown.by_rung.from, draw.rung_to = shown.by_rung.to;
        draw.direction_from = shown.by_direction.from, draw.direction_to = shown.by_direction.to;
        draw.number_low = uint32_t(number), draw.number_high = uint32_t(number >> 32);
        draw.coarser_px = item.coarser_px, draw.has_splats = !image->splats.empty();
        draw.up = {frame.up, frame.step_m}, draw.pixel = {frame.pixel_m, 0, 0, 0};
        made_.planes.resize(made_.planes.size() + size_t(2) * draw.pieces * draw.pieces);
        for (const Half& half : list_.halves_of(item)) {
            frame.stand_on(eye_, half.plane);
            size_t place = draw.first_plane + 2 * (size_t(half.row) * draw.pieces + half.column) + half.half;
            made_.planes[place] = {
                {frame.corner, frame.splat}, {frame.east, 0}, {frame.north, half.diagonal == Diagonal::falling ? 1 : 0}};
        }
        made_.draws.push_back(draw), made_.images.push_back(index);
    }

    Eye eye_;
    PictureBounds bounds_;
    const Field& field_;
    const FieldList& list_;
    const PreparedAt& image_at_;
    double highest_step_m_;
    SplatLists& made_;
    PointBrush brush_;
    std::optional<FarPainter<PointBrush>> far_;
};

}  // namespace

SplatLists splat_lists_of(const view::Camera& camera, const Field& field, const FieldList& list, const PreparedAt& image_at,
                          const FarImages* far, uint32_t finer) {
    SplatLists made;
    ListMaker maker(camera, field, list, image_at, far, finer, made);
    for (const Item& item : list.items) maker.add(item);
    return made;
}

std::vector<uint32_t> splat_words(const PreparedLdi& image) {
    std::vector<uint32_t> words;
    words.reserve(size_t(2) * image.sample_count() + image.palette.size());
    for (uint32_t row = 0; row < image.side_px; ++row)
        for (uint32_t s = image.first[size_t(row) * image.side_px]; s < image.first[size_t(row + 1) * image.side_px]; ++s) {
            words.push_back(image.places[s]);
            words.push_back(row | uint32_t(image.colours[s]) << 16 | uint32_t(image.splats.empty() ? 0 : image.splats[s]) << 24);
        }
    words.insert(words.end(), image.palette.begin(), image.palette.end());
    return words;
}

}  // namespace overlook::wang_ldi
