#include "tools/measure/paper/fsi/easel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace overlook::measure::paper::fsi {
namespace {

constexpr uint32_t kGap_px = 4;
constexpr double kPhaseStep = 1.0 / 16;

// PAINT: as enum class Paint.
constexpr char kEaselMain[] = R"(
vec3 as_animated(Item item) {
    vec3 v = (surface.relative_m - item.place_m) / item.scale;
    return vec3(item.cosine * v.x + item.sine * v.y, item.cosine * v.y - item.sine * v.x, v.z);
}
vec3 shaded(vec3 own) {
    vec3 normal = normalize(cross(dFdx(surface.relative_m), dFdy(surface.relative_m)));
    return own * (0.4 + 0.6 * abs(dot(normal, normalize(vec3(-0.5, -0.7, 0.6)))));
}
void main() {
    Item item = own_item();
    vec3 own = own_colour(item.is_plain);
    vec3 at_m = PAINT == 2 ? as_animated(item) : surface.rest_m;
    if (item.show == 1u && visibility_of(item, at_m) > item.share) discard;
    if (PAINT == 1) own = shaded(item.show == 0u ? vec3(0.6) : item.level == item.change ? vec3(0.8, 0.05, 0.04) : vec3(0.05, 0.1, 0.8));
    if (PAINT == 3) own = vec3(1.0);
    if (PAINT == 4) own = vec3(item.show == 4u ? 1.0 : 0.0);
    colour = vec4(encoded(own), 1.0);
}
)";

}  // namespace

Result<std::unique_ptr<Easel>> Easel::make(const discrete::Chain& chain, uint32_t width_px, uint32_t height_px,
                                           uint32_t samples) {
    Result<gl::Target> target = gl::Target::make(width_px, height_px, samples);
    if (!target) return tl::unexpected(target.error());
    std::unique_ptr<Easel> made(new Easel(chain, std::move(*target)));
    Result<discrete::Drawing> drawing = discrete::Drawing::make(made->chain_);
    if (!drawing) return tl::unexpected(drawing.error());
    made->drawing_.emplace(std::move(*drawing));
    return made;
}

Result<ImageRgb8> Easel::paint(const discrete::FrameList& frame, std::span<const discrete::Placement> placements,
                               const view::Camera& camera, double clip_s, Paint paint) {
    Result<gl::Program> program = drawing_->program("easel", fmt::format("#define PAINT {}\n", int(paint)), kEaselMain);
    if (!program) return tl::unexpected(program.error());
    discrete::DrawList list = discrete::draw_list(drawing_->layout(), chain_, frame, placements, camera, clip_s);
    buffers_.fill(list);
    target_.bind();
    const GLfloat farthest = 0, black[4] = {0, 0, 0, 1};
    glClearBufferfv(GL_DEPTH, 0, &farthest);
    glClearBufferfv(GL_COLOR, 0, black);
    drawing_->draw_calls(*program, buffers_, list, list.whole_calls, {});
    if (paint == Paint::translucent) {
        for (const discrete::ListedCalls& calls : discrete::translucent_calls(std::vector<const discrete::DrawList*>{&list}))
            drawing_->draw_calls(*program, buffers_, list, calls.calls, {});
    } else if (paint != Paint::mask) {
        drawing_->draw_background(camera, {});
    }
    target_.resolve();
    return target_.read();
}

view::Camera Easel::camera_at(const discrete::Placement& placement, double share) const {
    view::Camera camera;
    camera.width_px = target_.width_px(), camera.height_px = target_.height_px();
    camera.fov_y_deg = 40;
    double radius_m = chain_.radius_m * placement.scale;
    double away_m = radius_m / (share * std::tan(camera.fov_y_deg * std::numbers::pi / 360));
    camera.near_m = 0.01 * away_m;
    camera.position_m = placement.at(chain_.middle_m) - glm::dvec3(0, away_m, 0);
    return camera;
}

double away_m(const Easel& easel, const view::Camera& camera, const discrete::Placement& placement) {
    return glm::length(placement.at(easel.chain().middle_m) - camera.position_m);
}

Result<Midway> midway(Easel& easel, discrete::Variant variant, uint32_t change, double distance_m,
                      std::span<const discrete::Placement> placements, const view::Camera& camera, double phase) {
    discrete::FrameOptions options = discrete::defaults_of(variant);
    options.select.criterion = discrete::Criterion::distance;
    options.select.distance_m = distance_m / std::exp2(double(change));
    options.select.refine_share = 1;
    auto frames = discrete::FrameDrawer::make(easel.drawing(), placements, options);
    if (!frames) return tl::unexpected(frames.error());
    double nearest_m = distance_m;
    for (const discrete::Placement& one : placements) nearest_m = std::min(nearest_m, away_m(easel, camera, one));
    view::Camera behind = camera;
    behind.position_m -= (0.01 * distance_m + 2 * (distance_m - nearest_m)) * view::axes_of(camera).forward;
    (*frames)->decide(behind, 0, 0);
    Midway found{{}, {}, {placements.begin(), placements.end()}, camera, {}};
    for (double reached = 0; reached < phase;) {
        found.older = std::move(found.newer);
        (*frames)->decide(camera, kPhaseStep * options.fade_s, 0);
        found.newer = (*frames)->director().frame();
        if (Result<discrete::FrameCounts> drawn = (*frames)->draw(easel.target(), {}); !drawn)
            return tl::unexpected(drawn.error());
        reached = found.newer.fading.empty() ? 1 : found.newer.fading.front().transition.phase + 1e-9;
    }
    found.picture = easel.target().read();
    return found;
}

ImageRgb8 montage(const std::vector<std::vector<ImageRgb8>>& rows) {
    const ImageRgb8& first = rows.front().front();
    auto columns = uint32_t(rows.front().size()), row_count = uint32_t(rows.size());
    ImageRgb8 all{columns * (first.width + kGap_px) - kGap_px, row_count * (first.height + kGap_px) - kGap_px, {}};
    all.pixels.assign(size_t(3) * all.width * all.height, 255);
    for (uint32_t row = 0; row < row_count; ++row)
        for (uint32_t column = 0; column < columns; ++column)
            for (uint32_t y = 0; y < first.height; ++y) {
                auto from = rows[row][column].pixels.begin() + std::ptrdiff_t(3) * y * first.width;
                size_t to = (size_t(row) * (first.height + kGap_px) + y) * all.width + size_t(column) * (first.width + kGap_px);
                std::copy(from, from + std::ptrdiff_t(3) * first.width, all.pixels.begin() + std::ptrdiff_t(3 * to));
            }
    return all;
}

ImageRgb8 put_together(const ImageRgb8& a, const ImageRgb8& mask_a, const ImageRgb8& b, const ImageRgb8& mask_b) {
    ImageRgb8 out = a;
    for (size_t i = 0; i < out.pixels.size(); ++i) {
        double in_a = mask_a.pixels[i] / 255.0, in_b = mask_b.pixels[i] / 255.0, weights = in_a + in_b;
        double mean = weights > 0 ? (in_a * a.pixels[i] + in_b * b.pixels[i]) / weights : a.pixels[i];
        out.pixels[i] = uint8_t(std::lround(std::max(in_a, in_b) * mean + (1 - std::max(in_a, in_b)) * b.pixels[i]));
    }
    return out;
}

}  // namespace overlook::measure::paper::fsi
