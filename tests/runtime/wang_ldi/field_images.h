// Fields with images of something, for tests of what is drawn of them: mounds of turf, their tops and flanks, alike in all
// levels.
#pragma once

#include <cmath>
#include <random>

#include "formats/wang_ldi.h"
#include "runtime/wang_ldi/warp_field.h"
#include "tests/runtime/wang_ldi/field_ground.h"
#include "tests/runtime/wang_ldi/field_parts.h"

namespace overlook::wang_ldi {

struct Mound {
    glm::dvec2 middle_m;
    double radius_m, height_m;

    double at(const glm::dvec2& at_m) const {
        glm::dvec2 off = (at_m - middle_m) / radius_m;
        return height_m * (1 - glm::dot(off, off));
    }
};
inline std::vector<Mound> mounds_of(uint32_t tile) {
    std::mt19937 random(tile + 1);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Mound> mounds;
    for (int n = 0; n < 14; ++n) {
        double radius = 0.12 + 0.2 * unit(random);
        mounds.push_back({{radius + (2 - 2 * radius) * unit(random), radius + (2 - 2 * radius) * unit(random)},
                          radius,
                          0.3 + 1.3 * unit(random)});
    }
    return mounds;
}

// The mounds' skin over a flat floor, filled where it is steep; red says the mound, green the level, blue the direction.
inline Ldi mounds_image(const ImageSet& set, const Which& which) {
    const Level& level = set.levels[which.level];
    double pixel_m = set.tile_m / level.side_px;
    auto mounds = mounds_of(which.tile);
    auto top = [&](const glm::dvec2& at_m) {
        std::pair<double, uint8_t> highest{0, 0};
        for (size_t m = 0; m < mounds.size(); ++m)
            if (double z = mounds[m].at(at_m); z > highest.first) highest = {z, uint8_t(m + 1)};
        return highest;
    };
    Ldi ldi;
    ldi.side_px = level.side_px, ldi.first = {0};
    for (uint32_t row = 0; row < level.side_px; ++row)
        for (uint32_t column = 0; column < level.side_px; ++column) {
            glm::dvec2 at_m = pixel_m * (glm::dvec2(column, row) + 0.5);
            auto [highest, mound] = top(at_m);
            double lowest = highest;
            for (auto [x, y] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
                lowest = std::min(lowest, top(at_m + pixel_m * glm::dvec2(x, y)).first);
            auto step_of = [&](double z) { return uint16_t(std::lround((z - set.low_m) / double(level.height_step_m))); };
            for (double z = lowest;; z += pixel_m) {
                uint16_t step = step_of(std::min(z, highest));
                bool is_new = ldi.heights.size() == ldi.first.back() || step > ldi.heights.back();
                if (is_new) ldi.heights.push_back(step), ldi.colours.push_back(mound);
                if (z >= highest) break;
            }
            ldi.first.push_back(ldi.sample_count());
        }
    for (uint32_t m = 0; m < 15; ++m)
        ldi.palette.push_back({uint8_t(20 + 15 * m), uint8_t(60 + 60 * which.level), uint8_t(30 * which.direction)});
    return ldi;
}

// A field whose images are all at hand.
struct DrawnField : TestField {
    std::vector<Ldi> ldis;

    explicit DrawnField(Ground ground_, const PlacementOptions& planting = {}) : TestField(std::move(ground_), planting) {
        images.levels = {{96, 1, 0.01f, 1.5f}, {64, 6, 0.01f, 1.5f}, {40, 10, 0.02f, 1.5f}};
        images.cell.farthest_m = 30;
        sample_counts.clear();
        for (uint64_t i = 0; i < images.ldi_count(); ++i) {
            ldis.push_back(mounds_image(images, which_of(images, i)));
            sample_counts.push_back(ldis.back().sample_count());
        }
    }
    ImageAt all() const {
        return [this](uint64_t index) { return &ldis[index]; };
    }
    // To the horizon, with images up to 30 m.
    FieldOptions far_options() const {
        FieldOptions options = options_to_horizon(images, 415.7, 0, far().side_px());
        options.ladder.texture_from_m = 30;
        return options;
    }
    FarImages far() const { return FarImages(textures_of_images(images, all())); }
};

inline Warped empty_picture(const view::Camera& camera) {
    Warped picture;
    picture.clear(camera.width_px, camera.height_px);
    return picture;
}

}  // namespace overlook::wang_ldi
