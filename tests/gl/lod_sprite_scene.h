// A terrain, a painter with keys of it, and the pictures to compare.
#pragma once

#include <gtest/gtest.h>

#include <optional>

#include "runtime/lod_sprite/draw.h"
#include "runtime/terrain/draw.h"
#include "tests/gl/fixture.h"
#include "tools/measure/frame.h"

namespace overlook::test {

// A plain in four colours with a red wall, 60 m high, from west to east across its south.
terrain::Terrain walled_terrain(uint32_t side);

struct SpriteScene {
    static constexpr uint32_t kWidth = 320, kHeight = 180, kSlots = 3;
    static constexpr double kLow_px = 10, kFine_px = 0.25;

    SpriteScene(terrain::Terrain seen, uint32_t samples);

    // Over the southern edge, so many metres to the right.
    view::Camera pose(double right_m) const;
    void make_key(uint32_t slot, const view::Camera& frame, double guard, uint32_t scale);
    void make_key_of(uint32_t slot, gl::Surface& what, const view::Camera& frame, double guard, uint32_t scale);

    ImageRgb8 full(const view::Camera& at);
    ImageRgb8 low(const view::Camera& at);
    ImageRgb8 sky(const view::Camera& at);
    ImageRgb8 novel(const view::Camera& at);  // with `options`
    // The picture drawn last, with its depths; ids 1 where there is ground. Of one sample a pixel.
    measure::Frame frame_of(const ImageRgb8& image, const view::Camera& at) const;

    terrain::Terrain terrain;
    terrain::Refiner refiner;
    terrain::DrawOptions look;
    terrain::Drawing ground;
    terrain::CutSurface surface;
    lod_sprite::Painter painter;
    lod_sprite::NovelOptions options;

  private:
    const gl::Target& target_of(const view::Camera& at);
    terrain::Cut cut(const view::Camera& at, double error_px) const;
    uint32_t samples_;
    std::optional<gl::Target> target_;
};

}  // namespace overlook::test
