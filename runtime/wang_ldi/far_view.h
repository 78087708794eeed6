// How a square of far ground looks to an eye: which part of the points that stand for it are drawn.
#pragma once

#include <cmath>
#include <limits>

#include "runtime/wang_ldi/far_images.h"
#include "runtime/wang_ldi/field.h"
#include "runtime/wang_ldi/in_picture.h"
#include "runtime/wang_ldi/tile_error.h"

namespace overlook::wang_ldi {

constexpr double kOverlap = 2.5;  // ground that is covered is covered by so many points, since they fall on each other

struct FarPlace {
    glm::dvec2 low_m, middle_m;
    double ground_m = 0;  // of its middle; not a number where there is none
    double side_m = 0;
};

// Of 2^rows_log2 equally opaque ones.
inline double behind_each_other(double opacity, uint32_t rows_log2) {
    double through = 1 - opacity;
    for (uint32_t n = 0; n < rows_log2; ++n) through *= through;
    return 1 - through;
}

// What holds wherever a block of far ground is looked at.
struct FarBlock {
    bool is_of_one = false;  // all its places show one rung, of textures or colours, and no other; else nothing is said
    Rung rung;
    double share_most = 1;  // of none is more drawn: of points of a texture as share_of, of colours as of one that is opaque

    // The binary logarithm of the tiles along a texel's side.
    uint32_t log2() const { return rung.stage == Stage::colour ? rung.level : 0; }
};

class FarView {
  public:
    // All must outlive this.
    FarView(const Eye& eye, const PictureBounds& bounds, const Field& field)
        : eye_(eye), bounds_(bounds), field_(field), ground_(field.parts().placement->ground()) {}

    FarPlace place_of(int64_t i, int64_t j, uint32_t log2) const {
        FarPlace place;
        Rect rect = field_.parts().placement->rect_of(i, j, int64_t(1) << log2);
        place.low_m = rect.low_m, place.middle_m = (rect.low_m + rect.high_m) / 2.0, place.side_m = rect.high_m.x - rect.low_m.x;
        place.ground_m = ground_.height_m(place.middle_m);
        return place;
    }

    Chosen chosen_at(const FarPlace& place) const {
        return field_.chosen(glm::dvec2(eye_.position_m) - place.middle_m, eye_.position_m.z - place.ground_m);
    }

    // Points are so wide at most.
    bool may_be_seen(const Rect& rect, const GroundRange& range, double widest_m) const {
        const ImageSet& images = *field_.parts().images;
        return bounds_.may_hold({rect.low_m, range.low_m + images.low_m}, {rect.high_m, range.high_m + images.high_m},
                                eye_.focal_px * widest_m);
    }

    // Whether the ground's near rim and its far rim are nearly one line in the picture.
    bool is_flat(const Rect& rect, const GroundRange& range) const {
        glm::dvec2 eye(eye_.position_m);
        double distance = glm::length(eye - glm::clamp(eye, rect.low_m, rect.high_m)), side_m = rect.high_m.x - rect.low_m.x;
        if (!(distance > side_m)) return false;
        double up = std::max(std::abs(eye_.position_m.z - range.low_m), std::abs(eye_.position_m.z - range.high_m)) / distance;
        return eye_.focal_px * (range.high_m - range.low_m + kDiagonal * side_m * up) <= kStrip_px * distance;
    }

    // How much of a picture's points are drawn: less where they are wider than what they stand for, which is less than a pixel
    // wide; more where the ground is seen from above.
    double share_of(const FarPicture& picture, const FarPlace& place, double rise) const {
        if (picture.samples.empty()) return 0;
        double texel_m = place.side_m / picture.side_px;
        return (1 + kOverlap * texel_m * rise / double(picture.high_m)) * shrunk(double(picture.wide_m), place);
    }
    double shrunk(double wide_m, const FarPlace& place) const {
        float depth_m = eye_.seen(glm::dvec3(place.middle_m, place.ground_m) - eye_.position_m).z;
        double wide_px = eye_.focal_px * wide_m / std::max(double(depth_m), double(eye_.near_m));
        double side_px = std::clamp(std::floor(wide_px + 0.5), 1.0, double(eye_.most_splat_px));
        return std::min(1.0, wide_px / side_px * (wide_px / side_px));
    }
    // How far a metre of ground away from the eye reaches up across its line of sight, 0..1.
    double rise_at(const FarPlace& place) const {
        glm::dvec2 away = place.middle_m - glm::dvec2(eye_.position_m);
        double distance = glm::length(away);
        if (distance <= place.side_m) return 1;
        double reach_m = place.side_m / 2, beyond_m = ground_.height_m(place.middle_m + away * (reach_m / distance));
        double slope = std::isnan(beyond_m) ? 0 : (beyond_m - place.ground_m) / reach_m;
        double line = (place.ground_m - eye_.position_m.z) / distance;
        return std::clamp((slope - line) / std::sqrt(1 + line * line), 0.0, 1.0);
    }

    // Of a rectangle and its ground's range.
    FarBlock block_of(const Rect& rect, const GroundRange& range, const FarImages& far) const {
        FarBlock block;
        if (!range.is_whole) return block;
        glm::dvec2 eye(eye_.position_m), nearest = glm::clamp(eye, rect.low_m, rect.high_m) - eye;
        glm::dvec2 farthest = glm::max(glm::abs(rect.low_m - eye), glm::abs(rect.high_m - eye));
        const Ladder& ladder = field_.ladder();
        Mix at_near = rungs_at(ladder, field_.distance_m(nearest, eye_.position_m.z - range.high_m));
        if (at_near.first != at_near.second) return block;
        if (rungs_at(ladder, field_.distance_m(farthest, eye_.position_m.z - range.low_m)) != at_near) return block;
        block.rung = ladder.rungs[at_near.first];
        block.is_of_one = block.rung.stage == Stage::texture || block.rung.stage == Stage::colour;
        if (block.is_of_one) block.share_most = share_most(block, least_depth_m(rect, range), far);
        return block;
    }

  private:
    double least_depth_m(const Rect& rect, const GroundRange& range) const {
        float least = std::numeric_limits<float>::infinity();
        for (int corner = 0; corner < 8; ++corner) {
            glm::dvec3 at(corner & 1 ? rect.high_m.x : rect.low_m.x, corner & 2 ? rect.high_m.y : rect.low_m.y,
                          corner & 4 ? range.high_m : range.low_m);
            least = std::min(least, eye_.seen(at - eye_.position_m).z);
        }
        return double(least);
    }
    // `shrunk` is no more than 1, nor than the square of so many pixels as a point is wide.
    double share_most(const FarBlock& block, double least_depth_m, const FarImages& far) const {
        constexpr double kMore = 1.0001;  // than rounding takes away
        double tile_m = field_.parts().images->tile_m, wide_m = std::ldexp(kDiagonal * tile_m, int(block.log2())), times = 1;
        if (block.rung.stage == Stage::texture) {
            uint32_t level = field_.texture_level(block.rung);
            double texel_m = tile_m / (far.side_px() >> level);
            wide_m = double(far.widest_m(level)), times = 1 + kOverlap * texel_m / double(far.least_high_m(level));
        }
        double wide_px = eye_.focal_px * wide_m / std::max(least_depth_m, double(eye_.near_m));
        return kMore * times * std::min(1.0, wide_px * wide_px);
    }

    const Eye& eye_;
    const PictureBounds& bounds_;
    const Field& field_;
    const Ground& ground_;
};

}  // namespace overlook::wang_ldi
