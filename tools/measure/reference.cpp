#include "tools/measure/reference.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "formats/mapped_file.h"
#include "runtime/terrain/draw_shaders.h"
#include "tools/measure/capture.h"
#include "tools/measure/reference_cache.h"
#include "tools/measure/terrain_method.h"

namespace overlook::measure {
namespace {

std::string hash_of(const std::string& text) {
    return content_hash(std::as_bytes(std::span(text)));
}

std::string shaders_hash() {
    return hash_of(std::string(terrain::shaders::kTerrainVertex) + terrain::shaders::kAir + terrain::shaders::kTerrainFragment +
                   terrain::shaders::kShadedMain + terrain::shaders::kSkyVertex + terrain::shaders::kSkyFragment);
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

}  // namespace

Result<ReferenceRenderer> ReferenceRenderer::make(World& world, const gl::Renderer& renderer, uint32_t width_px,
                                                  uint32_t height_px, std::string cache_folder) {
    Result<gl::Target> large = gl::Target::make(width_px * kSupersampling, height_px * kSupersampling, 1);
    if (!large) return impossible("the reference is drawn at {} times the size: {}", kSupersampling, large.error().message);
    Result<gl::Target> middle = gl::Target::make(width_px, height_px, 1);
    if (!middle) return tl::unexpected(middle.error());

    ReferenceRenderer made(std::move(*large), std::move(*middle));
    made.full_ = make_full_method(world);
    made.cache_folder_ = std::move(cache_folder);
    made.identity_ =
        fmt::format("reference {} x {}\n{}\n{}\n{}\n{}\n{}{}", kSupersampling, kSupersampling, world.content_hash, renderer.name,
                    renderer.version, shaders_hash(), bits_of(world.look.haze), bits_of(double(world.look.anisotropy)));
    return made;
}

Frame ReferenceRenderer::drawn(const view::Camera& camera) {
    ++drawn_count_;
    full_->decide(camera, 0);
    full_->draw(middle_);
    Frame frame = captured(middle_, middle_, camera);
    view::Camera large_camera = camera;
    large_camera.width_px *= kSupersampling;
    large_camera.height_px *= kSupersampling;
    full_->decide(large_camera, 0);
    full_->draw(large_);
    frame.rgb = box_filtered(large_.read(), kSupersampling).pixels;
    return frame;
}

Result<Frame> ReferenceRenderer::surroundings(const view::Camera& camera, uint32_t margin_px) {
    view::Camera wide = widened(camera, margin_px);
    Result<gl::Target> target = gl::Target::make(wide.width_px, wide.height_px, 1);
    if (!target) return tl::unexpected(target.error());
    full_->decide(wide, 0);
    full_->draw(*target);
    Frame frame = captured(*target, *target, wide);
    std::fill(frame.rgb.begin(), frame.rgb.end(), uint8_t(0));
    return frame;
}

Result<Frame> ReferenceRenderer::frame(const view::Camera& camera) {
    if (cache_folder_.empty()) return drawn(camera);
    std::string path = fmt::format("{}/{}.frame", cache_folder_, hash_of(identity_ + bits_of(camera)));
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
