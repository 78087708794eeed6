// How a square of far ground looks to an eye: which part of the points that stand for it are drawn.
#pragma once

#include <cmath>
#include <limits>
#include <optional>

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

// What is known of a block of far ground, wherever in it one looks.
struct FarBlock {
    bool is_planted = false;  // all of it
    bool is_of_one = false;   // all its places show one rung, of textures or colours, and no other; else nothing below is said
    uint32_t rung = 0;        // of Field::ladder
    uint32_t tiles_log2 = 0;  // the binary logarithm of the tiles along that rung's texels
    std::optional<uint32_t> direction;  // from which all are seen
    // Of no place is more drawn: of points of a texture as share_of, of a strip's colours as of opaque ones; of a square's less.
    double share_most = 1, square_share_most = 1;
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
        place.ground_m = ground_.height_m(place.middle_m, asked_);
        return place;
    }

    // But for its distance, where a block says the rest.
    Chosen chosen_at(const FarPlace& place, const FarBlock& block) const {
        if (block.is_of_one && block.direction) return {0, {block.rung, block.rung, 0}, {*block.direction, *block.direction, 0}};
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
        double reach_m = place.side_m / 2, beyond_m = ground_.height_m(place.middle_m + away * (reach_m / distance), asked_);
        double slope = std::isnan(beyond_m) ? 0 : (beyond_m - place.ground_m) / reach_m;
        double line = (place.ground_m - eye_.position_m.z) / distance;
        return std::clamp((slope - line) / std::sqrt(1 + line * line), 0.0, 1.0);
    }

    // Of a rectangle and its ground's range, from what is known of one that it is part of.
    FarBlock looked_closer(FarBlock block, const Rect& rect, const GroundRange& range, const FarImages& far) const {
        if (!range.is_whole) return block;
        Seen seen = seen_of(rect, range);
        if (!block.is_of_one) {
            const Ladder& ladder = field_.ladder();
            Mix at_near = rungs_at(ladder, field_.distance_m(seen.nearest_m, eye_.position_m.z - range.high_m));
            if (at_near.first != at_near.second) return block;
            if (rungs_at(ladder, field_.distance_m(seen.farthest_m, eye_.position_m.z - range.low_m)) != at_near) return block;
            const Rung& rung = ladder.rungs[at_near.first];
            if (rung.stage != Stage::texture && rung.stage != Stage::colour) return block;
            block.is_of_one = true, block.rung = at_near.first;
            block.tiles_log2 = rung.stage == Stage::colour ? rung.level : 0;
        }
        if (!block.direction) block.direction = direction_of(rect);
        take_shares(block, seen, far);
        return block;
    }

  private:
    struct Seen {
        glm::dvec2 nearest_m, farthest_m;  // along the ground
        double least_depth_m, most_rise;   // as rise_at says of places in it
    };
    Seen seen_of(const Rect& rect, const GroundRange& range) const {
        glm::dvec2 eye(eye_.position_m), nearest = glm::clamp(eye, rect.low_m, rect.high_m) - eye;
        float depth = std::numeric_limits<float>::infinity();
        for (int corner = 0; corner < 8; ++corner) {
            glm::dvec3 at(corner & 1 ? rect.high_m.x : rect.low_m.x, corner & 2 ? rect.high_m.y : rect.low_m.y,
                          corner & 4 ? range.high_m : range.low_m);
            depth = std::min(depth, eye_.seen(at - eye_.position_m).z);
        }
        double distance = glm::length(nearest), rise = 1;
        if (distance > rect.high_m.x - rect.low_m.x)
            rise = std::min(1.0, range.steepest + std::max(0.0, eye_.position_m.z - range.low_m) / distance);
        return {nearest, glm::max(glm::abs(rect.low_m - eye), glm::abs(rect.high_m - eye)), double(depth), rise};
    }
    // The one that all places of a rectangle are seen from, if it is one: one of all its corners, where it looks narrower than a
    // direction. With a little more fade than there is, so that rounding does not matter.
    std::optional<uint32_t> direction_of(const Rect& rect) const {
        constexpr double kMore = 1e-6;
        const ImageSet& images = *field_.parts().images;
        glm::dvec2 eye(eye_.position_m), middle = (rect.low_m + rect.high_m) / 2.0;
        double wide = glm::length(rect.high_m - rect.low_m) / 2, distance = glm::length(eye - middle);
        if (!(wide < distance * std::sin(M_PI / std::max(images.direction_count, 2u)))) return std::nullopt;
        std::optional<uint32_t> one;
        for (int corner = 0; corner < 4; ++corner) {
            glm::dvec2 at(corner & 1 ? rect.high_m.x : rect.low_m.x, corner & 2 ? rect.high_m.y : rect.low_m.y);
            Mix mix = directions_at(images, eye - at, field_.options().direction_fade_share + kMore);
            if (mix.first != mix.second || mix.first != one.value_or(mix.first)) return std::nullopt;
            one = mix.first;
        }
        return one;
    }
    // `shrunk` is no more than 1, nor than the square of so many pixels as a point is wide.
    void take_shares(FarBlock& block, const Seen& seen, const FarImages& far) const {
        constexpr double kMore = 1.0001;  // than rounding takes away
        const Rung& rung = field_.ladder().rungs[block.rung];
        double tile_m = field_.parts().images->tile_m, breadth = block.direction ? far.breadth(*block.direction) : kDiagonal;
        double side_m = std::ldexp(tile_m, int(block.tiles_log2)), times = 1, times_square = 1, wide_m = breadth * side_m;
        if (rung.stage == Stage::texture) {
            uint32_t level = field_.texture_level(rung);
            double texel_m = tile_m / (far.side_px() >> level);
            wide_m = breadth * texel_m, times = 1 + kOverlap * texel_m * seen.most_rise / double(far.least_high_m(level));
        } else {
            // Of the narrowest, whose share of its width is greatest.
            double high_m = 2 * double(far.most_half_m()) + kOverlap * side_m * seen.most_rise;
            times_square = std::min(1.0, high_m / (block.direction ? wide_m : side_m));
        }
        double wide_px = eye_.focal_px * wide_m / std::max(seen.least_depth_m, double(eye_.near_m));
        block.share_most = kMore * times * std::min(1.0, wide_px * wide_px);
        block.square_share_most = block.share_most * times_square;
    }

    const Eye& eye_;
    const PictureBounds& bounds_;
    const Field& field_;
    const Ground& ground_;
    mutable Ground::Asked asked_;  // a view is of one thread
};

}  // namespace overlook::wang_ldi
