#include "tests/gl/lod_sprite_scene.h"

#include <limits>

#include "tools/bake/terrain.h"

namespace overlook::test {

terrain::Terrain walled_terrain(uint32_t side) {
    terrain::Terrain colours = flat_terrain(side);
    dem::Raster dem;
    dem.width = dem.height = side;
    dem.frame = colours.frame;
    dem.samples_are_integers = true;
    dem.source_name = "wall";
    dem.source_hash = std::string(32, '0');
    auto is_wall = [&](uint32_t row, uint32_t column) {
        return row >= side * 3 / 4 && row < side * 3 / 4 + 3 && column > side / 4 && column < side * 3 / 4;
    };
    for (uint32_t row = 0; row < side; ++row)
        for (uint32_t column = 0; column < side; ++column) dem.samples.push_back(is_wall(row, column) ? 120.f : 0.f);
    terrain::Terrain terrain = *terrain::bake(dem, {}, [](double) {});
    terrain.texture = colours.texture;
    for (uint32_t row = 0; row < side; ++row)
        for (uint32_t column = 0; column < side; ++column) {
            uint8_t* at = &terrain.texture.pixels[3 * (size_t(row) * side + column)];
            bool is_near_wall =
                row + 2 >= side * 3 / 4 && row < side * 3 / 4 + 5 && column + 2 > side / 4 && column < side * 3 / 4 + 2;
            at[0] = is_near_wall ? 220 : 30, at[1] = is_near_wall ? 30 : uint8_t(120 + row % 8 * 10), at[2] = 30;
        }
    return terrain;
}

SpriteScene::SpriteScene(terrain::Terrain seen, uint32_t samples)
    : terrain(std::move(seen)),
      refiner(terrain),
      ground(*terrain::Drawing::make(terrain)),
      surface(ground, look),
      painter(*lod_sprite::Painter::make(surface, kSlots)),
      samples_(samples) {
    options.low_error_px = kLow_px;
    options.most_slack_m = refiner.highest_m() - refiner.lowest_m();
    options.keys = {{0, 1}};
}

view::Camera SpriteScene::pose(double right_m) const {
    view::Camera camera = from_south(terrain, kWidth, kHeight);
    camera.position_m.x += right_m;
    camera.position_m.z = 330;
    camera.pitch_deg = -8;
    return camera;
}

terrain::Cut SpriteScene::cut(const view::Camera& at, double error_px) const {
    terrain::Cut made;
    refiner.cut_by_pixels(at, error_px, made);
    return made;
}

const gl::Target& SpriteScene::target_of(const view::Camera& at) {
    if (!target_ || target_->width_px() != at.width_px || target_->height_px() != at.height_px)
        target_ = *gl::Target::make(at.width_px, at.height_px, samples_);
    return *target_;
}

void SpriteScene::make_key(uint32_t slot, const view::Camera& frame, double guard, uint32_t scale) {
    make_key_of(slot, surface, frame, guard, scale);
}

void SpriteScene::make_key_of(uint32_t slot, gl::Surface& what, const view::Camera& frame, double guard, uint32_t scale) {
    view::Camera key = lod_sprite::key_camera(frame, guard);
    static_cast<terrain::CutSurface&>(what).take(cut(key, kFine_px));
    ASSERT_TRUE(painter.begin_key(slot, key, scale).has_value());
    painter.draw_into_key(slot, what);
    painter.finish_key(slot, what);
}

ImageRgb8 SpriteScene::full(const view::Camera& at) {
    const gl::Target& target = target_of(at);
    ground.draw(target, cut(at, kFine_px), at, look);
    return target.read();
}

ImageRgb8 SpriteScene::low(const view::Camera& at) {
    const gl::Target& target = target_of(at);
    ground.draw(target, cut(at, kLow_px), at, look);
    return target.read();
}

ImageRgb8 SpriteScene::sky(const view::Camera& at) {
    const gl::Target& target = target_of(at);
    ground.draw(target, {}, at, look);
    return target.read();
}

ImageRgb8 SpriteScene::novel(const view::Camera& at) {
    const gl::Target& target = target_of(at);
    surface.take(cut(at, kLow_px));
    EXPECT_TRUE(painter.draw(target, nullptr, surface, at, options).has_value());
    return target.read();
}

measure::Frame SpriteScene::frame_of(const ImageRgb8& image, const view::Camera& at) const {
    measure::Frame frame{image.width, image.height, image.pixels, {}, {}, at};
    for (float inverse : target_->read_depth()) {
        frame.depth_m.push_back(inverse > 0 ? float(at.near_m) / inverse : std::numeric_limits<float>::infinity());
        frame.ids.push_back(inverse > 0 ? 1 : measure::kBackground);
    }
    return frame;
}

}  // namespace overlook::test
