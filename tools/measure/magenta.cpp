#include "tools/measure/magenta.h"

#include <cmath>

#include "tools/measure/full_geometry.h"
#include "tools/measure/methods.h"

namespace overlook::measure {
namespace {

constexpr std::array<uint8_t, 3> kMagenta{255, 0, 255};

// Not 0 where there is something else than the ground and the sky.
std::vector<uint8_t> planted_px(const gl::Target& target, const ImageRgb8& picture) {
    std::vector<float> depths = target.read_depth();
    std::vector<uint8_t> mask(depths.size());
    for (size_t p = 0; p < mask.size(); ++p)
        mask[p] = depths[p] > 0 && !std::equal(kMagenta.begin(), kMagenta.end(), picture.pixels.begin() + ptrdiff_t(3 * p));
    return mask;
}

// Not 0 where what the target shows stands in the cell.
std::vector<uint8_t> in_cell_px(const World& world, const view::Camera& camera, const gl::Target& target) {
    const wang_ldi::PlantedField& planted = world.planted->planted();
    const wang_ldi::Cell& cell = planted.images().set().cell;
    std::vector<float> depths = target.read_depth();
    std::vector<uint8_t> mask(depths.size());
    view::Axes axes = view::axes_of(camera);
    double focal_px = view::focal_px(camera), half_tile_m = planted.placement().tile_m() * std::sqrt(0.5);
    for (size_t p = 0; p < mask.size(); ++p) {
        if (!(depths[p] > 0)) continue;
        double right = (double(p % camera.width_px) + 0.5 - camera.width_px * 0.5) / focal_px;
        double up = (camera.height_px * 0.5 - double(p / camera.width_px) - 0.5) / focal_px;
        glm::dvec3 along = axes.forward + right * axes.right + up * axes.up;
        glm::dvec3 away_m = camera.near_m / double(depths[p]) * along;
        double ground_m = glm::length(glm::dvec2(away_m));
        // Whichever tile it is of, that one's middle is in the cell.
        mask[p] = ground_m - half_tile_m >= cell.nearest_m && ground_m + half_tile_m <= cell.farthest_m;
    }
    return mask;
}

}  // namespace

void paint_magenta(World& world) {
    world.planted->paint_ground(kMagenta);
    world.look.haze = 0;
}

Result<Magenta> gaps_over_magenta(World& magenta, const MethodSpec& spec, std::span<const view::Camera> cameras) {
    Result<gl::Target> target = gl::Target::make(cameras.front().width_px, cameras.front().height_px, 1);
    if (!target) return tl::unexpected(target.error());
    std::unique_ptr<Method> method = make_method(spec, magenta);
    FullGeometry full(magenta);
    const wang_ldi::PlantedField& planted = magenta.planted->planted();
    const wang_ldi::Cell& cell = planted.images().set().cell;
    Magenta found;
    uint64_t most = 0;
    for (uint32_t frame = 0; frame < cameras.size(); ++frame) {
        const view::Camera& camera = cameras[frame];
        full.draw(*target, camera);
        ImageRgb8 truth = target->read();
        std::vector<uint8_t> covered = planted_px(*target, truth), asked = in_cell_px(magenta, camera, *target);
        double above_m = camera.position_m.z - planted.ground().height_m(glm::dvec2(camera.position_m));
        if (!(above_m >= cell.eye_low_m && above_m <= cell.eye_high_m)) std::fill(asked.begin(), asked.end(), uint8_t(0));
        method->decide(camera, frame);
        method->draw(*target);
        ImageRgb8 picture = target->read();
        std::vector<uint8_t> shown = planted_px(*target, picture);
        Gaps in_cell = gaps_of(covered, shown, camera.width_px, asked);
        found.anywhere.add(gaps_of(covered, shown, camera.width_px)), found.in_cell.add(in_cell);
        if (frame > 0 && in_cell.gap_px <= most) continue;
        most = in_cell.gap_px, found.worst = std::move(picture), found.truth = std::move(truth);
    }
    return found;
}

}  // namespace overlook::measure
