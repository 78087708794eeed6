// S11 for methods that show pictures again: how far from its place each point of the ground is shown. The ground is painted with
// waves, whose phase tells from a pixel's colour which place it shows.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "formats/srgb.h"
#include "tools/measure/capture.h"
#include "tools/measure/numbers/percentiles.h"
#include "tools/measure/reuse_truth.h"
#include "tools/measure/stability/stage.h"
#include "tools/measure/terrain_method.h"

namespace overlook::measure {
namespace {

constexpr double kWave_cells = 8;
constexpr uint32_t kTexelsACell = 8, kMostTexels = 4096;
constexpr double kMiddle = 0.5, kSwing = 0.45;  // of the waves, in light: the renderer averages places so
constexpr double kReadable = 0.7;               // of the swing: less is a mixture of places
constexpr double kStep = 1.05;                  // depths of neighbours farther apart than that are an outline
constexpr uint32_t kFewest = 48;                // frames, so that keys take over
constexpr double kTurn = 2 * std::numbers::pi;

enum class Axis { columns, rows };

uint8_t byte_of(double light) {
    return uint8_t(std::lround(255 * srgb_from_linear(std::clamp(light, 0.0, 1.0))));
}

// Red and green are cosine and sine of a wave along an axis of the raster, blue is the share of its length.
ImageRgb8 waves(const terrain::Shape& shape, Axis axis) {
    uint32_t most = std::max(shape.width, shape.height), texels = std::clamp(kMostTexels / most, 1u, kTexelsACell);
    ImageRgb8 image{shape.width * texels, shape.height * texels, {}};
    image.pixels.reserve(size_t(image.width) * image.height * 3);
    double last = (axis == Axis::columns ? shape.width : shape.height) - 1;
    for (uint32_t y = 0; y < image.height; ++y)
        for (uint32_t x = 0; x < image.width; ++x) {
            double place = ((axis == Axis::columns ? x : y) + 0.5) / texels - 0.5, phase = kTurn * place / kWave_cells;
            image.pixels.insert(image.pixels.end(), {byte_of(kMiddle + kSwing * std::cos(phase)),
                                                     byte_of(kMiddle + kSwing * std::sin(phase)), byte_of(place / last)});
        }
    return image;
}

// The same ground, painted; the air in between is left out.
Result<World> painted(const World& world, Axis axis) {
    World made;
    made.name = world.name;
    made.content_hash = world.content_hash;
    made.terrain = std::make_unique<terrain::Terrain>(*world.terrain);
    made.terrain->texture = waves(made.terrain->shape, axis);
    made.refiner.emplace(*made.terrain);
    made.look = world.look;
    made.look.haze = 0;
    made.transform = world.transform;
    made.base = world.base;
    if (Result<void> uploaded = upload(made); !uploaded) return tl::unexpected(uploaded.error());
    return made;
}

// Which place along the axis a colour is of, cells; nearest to `near` among those with its phase where that is not far off.
// Nothing of a mixture.
std::optional<double> place_of(const uint8_t* rgb, double near, double last) {
    auto light = [&](int channel) { return linear_from_srgb_code(rgb[channel]); };
    double red = light(0) - kMiddle, green = light(1) - kMiddle;
    if (std::hypot(red, green) < kReadable * kSwing) return std::nullopt;
    double about = light(2) * last;
    // Blue knows the place within a cell or two, the phase within the wave.
    double from = std::abs(about - near) < kWave_cells / 4 ? near : about;
    double off = std::atan2(green, red) - kTurn * from / kWave_cells;
    return from + std::remainder(off, kTurn) / kTurn * kWave_cells;
}

double height_m(const terrain::Terrain& terrain, double column, double row) {
    uint32_t x = uint32_t(std::clamp(column, 0.0, terrain.shape.width - 2.0));
    uint32_t y = uint32_t(std::clamp(row, 0.0, terrain.shape.height - 2.0));
    double right = column - x, down = row - y;
    double upper = (1 - right) * terrain.height_m(x, y) + right * terrain.height_m(x + 1, y);
    double lower = (1 - right) * terrain.height_m(x, y + 1) + right * terrain.height_m(x + 1, y + 1);
    return (1 - down) * upper + down * lower;
}

// Is anything round the pixel much nearer or farther than it?
bool is_at_outline(const Frame& frame, uint32_t x, uint32_t y) {
    float least = frame.depth_m[size_t(y) * frame.width + x], most = least;
    for (uint32_t j = y == 0 ? 0 : y - 1; j <= std::min(y + 1, frame.height - 1); ++j)
        for (uint32_t i = x == 0 ? 0 : x - 1; i <= std::min(x + 1, frame.width - 1); ++i) {
            float depth = frame.depth_m[size_t(j) * frame.width + i];
            least = std::min(least, depth), most = std::max(most, depth);
        }
    return !(double(most) <= kStep * double(least));
}

// How far the place that a pixel shows is from the pixel, on the screen.
class Shear {
  public:
    explicit Shear(const terrain::Terrain& terrain) : terrain_(terrain) {}

    void add(const Frame& truth, const ImageRgb8& columns, const ImageRgb8& rows, const std::vector<uint8_t>& of_pixel) {
        view::Axes axes = view::axes_of(truth.camera);
        double focal_px = view::focal_px(truth.camera);
        for (uint32_t y = 0; y < truth.height; ++y)
            for (uint32_t x = 0; x < truth.width; ++x) {
                size_t at = size_t(y) * truth.width + x;
                bool is_shown_again = of_pixel[at] != 0 && (of_pixel[at] & (Sources::kOwn | Sources::kNear)) == 0;
                if (!is_shown_again || truth.ids[at] == kBackground || is_at_outline(truth, x, y)) continue;
                glm::dvec2 off_px{x + 0.5 - truth.width / 2.0, truth.height / 2.0 - y - 0.5};
                glm::dvec3 ray = axes.forward + (off_px.x * axes.right + off_px.y * axes.up) / focal_px;
                glm::dvec3 place_m = truth.camera.position_m + double(truth.depth_m[at]) * ray;
                std::optional<glm::dvec3> shown_m = shown(place_m, &columns.pixels[3 * at], &rows.pixels[3 * at]);
                if (!shown_m) {
                    ++mixed_px;
                    continue;
                }
                glm::dvec3 away_m = *shown_m - truth.camera.position_m;
                double depth_m = glm::dot(away_m, axes.forward);
                glm::dvec2 seen_px = focal_px * glm::dvec2(glm::dot(away_m, axes.right), glm::dot(away_m, axes.up)) / depth_m;
                errors_px.push_back(depth_m > 0 ? glm::length(seen_px - off_px) : std::numeric_limits<double>::infinity());
            }
    }

    std::vector<double> errors_px;
    uint64_t mixed_px = 0;

  private:
    std::optional<glm::dvec3> shown(const glm::dvec3& place_m, const uint8_t* columns, const uint8_t* rows) const {
        const terrain::Frame& frame = terrain_.frame;
        double column = place_m.x / frame.metres_per_column, row = -place_m.y / frame.metres_per_row;
        std::optional<double> shown_column = place_of(columns, column, terrain_.shape.width - 1);
        std::optional<double> shown_row = place_of(rows, row, terrain_.shape.height - 1);
        if (!shown_column || !shown_row) return std::nullopt;
        return glm::dvec3(*shown_column * frame.metres_per_column, -*shown_row * frame.metres_per_row,
                          height_m(terrain_, *shown_column, *shown_row));
    }

    const terrain::Terrain& terrain_;
};

}  // namespace

Result<Finding> shear_of(Stage& stage, const MethodSpec& spec, const scene::Flight& flight) {
    Stage some = stage;
    some.frames = stage.frames == 0 ? 0 : std::max(stage.frames, kFewest);
    std::vector<view::Camera> cameras = cameras_of(some, flight, Pick::in_row);
    Result<World> by_columns = painted(stage.world, Axis::columns), by_rows = painted(stage.world, Axis::rows);
    if (!by_columns) return tl::unexpected(by_columns.error());
    if (!by_rows) return tl::unexpected(by_rows.error());
    Result<gl::Target> target = gl::Target::make(stage.width_px, stage.height_px, 1);
    if (!target) return tl::unexpected(target.error());
    std::unique_ptr<Method> columns = stage.make(spec, *by_columns), rows = stage.make(spec, *by_rows);
    ReuseTruth truth(stage.world);
    Shear shear(*stage.world.terrain),
        reading(*stage.world.terrain);  // the second of full geometry: what the measure itself is off by
    terrain::Cut whole = full_cut(stage.world);
    auto drawn_whole = [&](World& world, const view::Camera& camera) {
        world.drawing->draw(*target, whole, camera, world.look);
        return target->read();
    };
    Finding finding;
    double worst_px = -1;
    for (uint32_t frame = 0; frame < cameras.size(); ++frame) {
        Result<ImageRgb8> along = draw_once(*columns, cameras[frame], frame, 1),
                          across = draw_once(*rows, cameras[frame], frame, 1);
        if (!along) return tl::unexpected(along.error());
        if (!across) return tl::unexpected(across.error());
        std::optional<Sources> sources = columns->sources(*target);
        if (!sources) continue;
        Result<Frame> full = truth.full_geometry(cameras[frame]);
        if (!full) return tl::unexpected(full.error());
        size_t before = shear.errors_px.size();
        shear.add(*full, *along, *across, sources->of_pixel);
        reading.add(*full, drawn_whole(*by_columns, cameras[frame]), drawn_whole(*by_rows, cameras[frame]), sources->of_pixel);
        for (size_t i = before; i < shear.errors_px.size(); ++i) {
            if (shear.errors_px[i] <= worst_px) continue;
            worst_px = shear.errors_px[i];
            finding.worst = Shot{frame, *along, {full->width, full->height, full->rgb}};
        }
        ++finding.frames;
    }
    if (shear.errors_px.empty() || reading.errors_px.empty())
        return impossible("{}: no pixel of this flight shows a picture again", label_of(spec));
    std::array<double, 3> shares = {0.5, 0.99, 0.999}, found{};
    for (size_t i = 0; i < shares.size(); ++i) found[i] = percentile(shear.errors_px, shares[i]);
    finding.figures["shear_error_px"] = worst_px;
    finding.sentence = fmt::format(
        "Of {} pixels that keys show, outlines apart, half are within {:.3f} px of where the ground that they show belongs, 99 % "
        "within {:.3f} px, 99.9 % within {:.3f} px, all within {:.3f} px; {} more show a mixture of places and could not be "
        "read. Full geometry, read in the same way, seems to be up to {:.3f} px off.",
        shear.errors_px.size(), found[0], found[1], found[2], worst_px, shear.mixed_px,
        *std::max_element(reading.errors_px.begin(), reading.errors_px.end()));
    return finding;
}

}  // namespace overlook::measure
