#include "runtime/wang_ldi/warp_field.h"

#include <algorithm>
#include <memory>
#include <optional>

#include "formats/parallel.h"
#include "runtime/wang_ldi/far_painter.h"
#include "runtime/wang_ldi/in_picture.h"
#include "runtime/wang_ldi/list_parts.h"

namespace overlook::wang_ldi {
namespace {

template <Hiding hiding>
class FieldWarper {
    using Painting = Brush<PictureTarget<hiding>>;

  public:
    FieldWarper(const view::Camera& camera, const Field& field, const FieldList& list, const ImageAt& image_at,
                const FarImages* far, uint32_t finer, Warped& picture)
        : eye_(camera, finer),
          bounds_(camera),
          field_(field),
          list_(list),
          image_at_(image_at),
          highest_step_m_(highest_step_m(*field.parts().images)),
          brush_(eye_, PictureTarget<hiding>(picture), counts_) {
        if (far != nullptr) far_.emplace(eye_, bounds_, field, list, *far, brush_);
    }

    void draw(const Item& item) {
        double side_m = field_.parts().images->tile_m * double(int64_t(1) << item.tiles_log2);
        glm::dvec2 corner_m = field_.parts().placement->rect_of(item.i, item.j).low_m;
        if (!may_be_seen(item, corner_m, side_m)) return;
        glm::dvec2 eye_share = (glm::dvec2(eye_.position_m) - corner_m) / side_m;
        if (item.half_count == 0) {
            if (far_ && item.texels_px > 0) far_->draw(item);
            return;
        }
        draw_tile(item, corner_m, eye_share);
    }
    const WarpCounts& counts() const { return counts_; }

  private:
    bool may_be_seen(const Item& item, const glm::dvec2& corner_m, double side_m) const {
        double above_m = item.high_m + highest_step_m_;  // the highest sample may stand a step above
        return bounds_.may_hold({corner_m, item.low_m}, {corner_m + side_m, above_m},
                                eye_.focal_px * widest_splat_m(field_, list_, item));
    }

    void draw_tile(const Item& item, const glm::dvec2& corner_m, const glm::dvec2& eye_share) {
        const ImageSet& images = *field_.parts().images;
        std::vector<std::unique_ptr<Columns>> owners;
        if (far_) far_->begin(item);
        for (const Shown& shown : list_.shown_of(item)) {
            const Rung& rung = field_.ladder().rungs[shown.rung];
            if (rung.stage == Stage::ldi) {
                const Ldi* ldi = image_at_(field_.image_of(item, shown));
                counts_.images_missing += ldi == nullptr;
                if (ldi == nullptr) continue;
                owners.push_back(std::make_unique<ImageColumns<Painting>>(
                    eye_, images, *ldi, rung.level, SplatRule{1, field_.options().widens_splats}, corner_m, brush_));
            } else if (rung.stage != Stage::geometry && far_) {
                owners.push_back(std::make_unique<FarColumns<Painting>>(*far_, far_->picture(shown)));
            } else {
                continue;
            }
            owners.back()->by_rung = shown.by_rung, owners.back()->by_direction = shown.by_direction;
        }
        if (owners.empty()) return;
        std::vector<Columns*> all;
        for (auto& owner : owners) all.push_back(owner.get());
        TilePlaces places{Field::fade_number(item.i, item.j), item.coarser_px, eye_share};
        for (const Half& half : list_.halves_of(item)) {
            for (Columns* columns : all) columns->stand_on(half.plane);
            Piece piece{half.column, half.row, 1u << item.pieces_log2, false, half.half, half.diagonal};
            paint_piece(places, piece, all);
        }
    }

    Eye eye_;
    PictureBounds bounds_;
    const Field& field_;
    const FieldList& list_;
    const ImageAt& image_at_;
    double highest_step_m_;
    WarpCounts counts_;
    Painting brush_;
    std::optional<FarPainter<Painting>> far_;
};

// Of two pictures the one whose items come later in the list over the other.
template <Hiding hiding>
void lay_over(const Warped& later, Warped& picture) {
    size_t width = picture.width_px;
    PictureTarget<hiding> target(picture);
    parallel_ranges(picture.colours.size(), size_t(1) << 15, [&, target](size_t begin, size_t end) mutable {
        for (size_t p = begin; p < end; ++p) {
            if (later.colours[p] == 0) continue;
            target.put(int(p % width), int(p / width), later.depth_m[p], later.colours[p]);
        }
    });
}

template <Hiding hiding>
WarpCounts warp_list(const view::Camera& camera, const Field& field, const FieldList& list, const ImageAt& image_at,
                     const FarImages* far, uint32_t finer, Warped& picture) {
    std::vector<size_t> ends = parts_of(field, list, thread_count());
    std::vector<Warped> others(ends.size() - 1);
    std::vector<WarpCounts> counts(ends.size());
    parallel_ranges(ends.size(), 1, [&](size_t part, size_t) {
        if (part > 0) others[part - 1].clear(picture.width_px, picture.height_px);
        FieldWarper<hiding> warper(camera, field, list, image_at, far, finer, part > 0 ? others[part - 1] : picture);
        for (size_t i = part > 0 ? ends[part - 1] : 0; i < ends[part]; ++i) warper.draw(list.items[i]);
        counts[part] = warper.counts();
    });
    WarpCounts sum;
    for (const WarpCounts& part : counts) sum.add(part);
    for (const Warped& other : others) lay_over<hiding>(other, picture);
    return sum;
}

}  // namespace

WarpCounts warp_field(const view::Camera& camera, const Field& field, const FieldList& list, const ImageAt& image_at,
                      Hiding hiding, Warped& picture, const FarImages* far, uint32_t finer) {
    if (hiding == Hiding::by_order) return warp_list<Hiding::by_order>(camera, field, list, image_at, far, finer, picture);
    return warp_list<Hiding::by_depth>(camera, field, list, image_at, far, finer, picture);
}

}  // namespace overlook::wang_ldi
