#include "tools/measure/reference.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "formats/mapped_file.h"
#include "runtime/caveclod/draw_shaders.h"
#include "runtime/discrete/draw_shaders.h"
#include "runtime/gl/surface_shaders.h"
#include "runtime/terrain/draw_shaders.h"
#include "runtime/wang_ldi/draw_plants.h"
#include "tools/measure/capture.h"
#include "tools/measure/reference_cache.h"

namespace overlook::measure {
namespace {

std::string hash_of(const std::string& text) {
    return content_hash(std::as_bytes(std::span(text)));
}

std::string shaders_hash(const World& world) {
    namespace mesh = caveclod::shaders;
    namespace ground = terrain::shaders;
    std::string shared = std::string(gl::shaders::kEncoding) + gl::shaders::kUnmoved + gl::shaders::kShadedMain +
                         gl::shaders::kBackgroundVertex + gl::shaders::kBackgroundDirection;
    std::string ground_text = std::string(ground::kTerrainVertexInputs) + ground::kRasterCells + ground::kTerrainVertexMain +
                              ground::kAir + ground::kTerrainFragment + ground::kSkyRowFragment + ground::kSkyFragment;
    if (world.is_planted()) {
        return hash_of(shared + ground_text + wang_ldi::plant_look_text() + fmt::format("{} {}", kPlantError_px, kPlantsUpTo_m));
    }
    if (world.is_chain()) {
        return hash_of(shared + discrete::shaders::kItemInputs + discrete::shaders::kVertex + discrete::shaders::kItem +
                       discrete::shaders::kFragment + discrete::shaders::kDoor + discrete::shaders::kOnePictureMain);
    }
    if (world.is_mesh()) {
        return hash_of(shared + mesh::kMeshVertexInputs + mesh::kMeshVertexMain + mesh::kMeshFragment +
                       mesh::kBackgroundFragment);
    }
    return hash_of(shared + ground_text);
}

std::string bits_of(double number) {
    return fmt::format("{:016x} ", std::bit_cast<uint64_t>(number));
}

std::string bits_of(const view::Camera& camera) {
    std::string bits;
    for (double number : {camera.position_m.x, camera.position_m.y, camera.position_m.z, camera.heading_deg, camera.pitch_deg,
                          camera.fov_y_deg, camera.near_m}) {
        bits += bits_of(number);
    }
    return bits + fmt::format("{} {}\n", camera.width_px, camera.height_px);
}

// The camera of a picture with more pixels on every side, each as large as before.
view::Camera widened(view::Camera camera, uint32_t margin_px) {
    double focal_px = view::focal_px(camera);
    camera.width_px += 2 * margin_px;
    camera.height_px += 2 * margin_px;
    camera.fov_y_deg = 2 * std::atan(camera.height_px / (2 * focal_px)) * 180 / std::numbers::pi;
    return camera;
}

// The width of as few equal columns as make up `whole`, none wider than `most`; the last may be cut off by less than there are
// columns.
uint32_t even_share(uint32_t whole, uint32_t most) {
    uint32_t count = (whole + most - 1) / most;
    return (whole + count - 1) / count;
}

// Puts a part of a picture where it belongs; what reaches beyond the frame is left out.
void copy_into(Frame& frame, const ImageRgb8& part, uint32_t left_px, uint32_t top_px) {
    uint32_t columns = std::min(part.width, frame.width - left_px), rows = std::min(part.height, frame.height - top_px);
    for (uint32_t row = 0; row < rows; ++row) {
        const uint8_t* from = part.pixels.data() + size_t(row) * part.width * 3;
        std::copy_n(from, size_t(columns) * 3, frame.rgb.data() + (size_t(top_px + row) * frame.width + left_px) * 3);
    }
}

}  // namespace

Result<ReferenceRenderer> ReferenceRenderer::make(World& world, const gl::Renderer& renderer, uint32_t width_px,
                                                  uint32_t height_px, std::string cache_folder, uint32_t part_px) {
    Result<gl::Target> middle = gl::Target::make(width_px, height_px, 1);
    if (!middle) return tl::unexpected(middle.error());
    uint32_t part_width_px = even_share(width_px, part_px), part_height_px = even_share(height_px, part_px);
    Result<gl::Target> large = gl::Target::make(part_width_px * kSupersampling, part_height_px * kSupersampling, 1);
    if (!large) return tl::unexpected(large.error());

    ReferenceRenderer made(world, std::move(*large), std::move(*middle));
    made.cache_folder_ = std::move(cache_folder);
    made.identity_ = fmt::format("reference {} x {} in parts of {} x {}\n{}\n{}\n{}\n{}\n{}{}", kSupersampling, kSupersampling,
                                 part_width_px, part_height_px, world.content_hash, renderer.name, renderer.version,
                                 shaders_hash(world), bits_of(world.look.haze), bits_of(double(world.look.anisotropy)));
    return made;
}

Frame ReferenceRenderer::drawn(const view::Camera& camera) {
    ++drawn_count_;
    full_.draw(middle_, camera);
    Frame frame = captured(middle_, middle_, camera);
    view::Camera large_camera = camera;
    large_camera.width_px *= kSupersampling;
    large_camera.height_px *= kSupersampling;
    for (uint32_t top_px = 0; top_px < large_camera.height_px; top_px += large_.height_px()) {
        for (uint32_t left_px = 0; left_px < large_camera.width_px; left_px += large_.width_px()) {
            ImageRgb8 small = part_of(large_camera, {left_px, top_px, large_.width_px(), large_.height_px()});
            copy_into(frame, small, left_px / kSupersampling, top_px / kSupersampling);
        }
    }
    return frame;
}

Result<Frame> ReferenceRenderer::surroundings(const view::Camera& camera, uint32_t margin_px) {
    view::Camera wide = widened(camera, margin_px);
    Result<gl::Target> target = gl::Target::make(wide.width_px, wide.height_px, 1);
    if (!target) return tl::unexpected(target.error());
    full_.draw(*target, wide);
    Frame frame = captured(*target, *target, wide);
    std::fill(frame.rgb.begin(), frame.rgb.end(), uint8_t(0));
    return frame;
}

ImageRgb8 ReferenceRenderer::part_of(const view::Camera& large_camera, const view::Part& part) {
    full_.draw(large_, large_camera, part);
    return box_filtered(large_.read(), kSupersampling);
}

Result<Frame> ReferenceRenderer::frame(const view::Camera& camera) {
    if (cache_folder_.empty()) return drawn(camera);
    std::string moment = world_->is_chain() ? bits_of(world_->time_s) : "";
    std::string path = fmt::format("{}/{}.frame", cache_folder_, hash_of(identity_ + bits_of(camera) + moment));
    KeptFrame kept = read_kept(path, camera);
    if (kept.frame) {
        ++kept_count_;
        return std::move(*kept.frame);
    }
    if (kept.is_damaged) ++damaged_count_;
    Frame frame = drawn(camera);
    if (Result<void> written = keep(path, frame); !written) return tl::unexpected(written.error());
    return frame;
}

}  // namespace overlook::measure
