#include "runtime/wang_ldi/placement.h"

#include <algorithm>
#include <cmath>

namespace overlook::wang_ldi {
namespace {

constexpr uint32_t kMostFairing_tiles = 8;
constexpr double kPainted = 0.5;

}  // namespace

PaintedMap::PaintedMap(const ImageRgb8& picture, const Rect& extent)
    : width_(picture.width), height_(picture.height), extent_(extent) {
    if (width_ == 0 || height_ == 0) return;
    for (size_t p = 0; p < size_t(width_) * height_; ++p)
        grey_.push_back(uint8_t((picture.pixels[3 * p] + picture.pixels[3 * p + 1] + picture.pixels[3 * p + 2] + 1) / 3));
    pyramid_ = Pyramid<Range>(width_, height_, [&](uint32_t column, uint32_t row) {
        uint8_t grey = grey_[size_t(row) * width_ + column];
        return Range{grey, grey};
    });
}

// Column and row, from the middle of the first pixel.
glm::dvec2 PaintedMap::pixel_of(const glm::dvec2& at_m) const {
    glm::dvec2 share = (at_m - extent_.low_m) / (extent_.high_m - extent_.low_m);
    glm::dvec2 pixel(share.x * width_ - 0.5, (1 - share.y) * height_ - 0.5);
    return glm::clamp(pixel, glm::dvec2(0), glm::dvec2(width_ - 1.0, height_ - 1.0));
}

double PaintedMap::at(const glm::dvec2& at_m) const {
    if (grey_.empty()) return 1;
    glm::dvec2 pixel = pixel_of(at_m);
    auto left = uint32_t(pixel.x), top = uint32_t(pixel.y);
    uint32_t right = std::min(left + 1, width_ - 1), bottom = std::min(top + 1, height_ - 1);
    double x = pixel.x - left, y = pixel.y - top;
    auto grey = [&](uint32_t column, uint32_t row) { return double(grey_[size_t(row) * width_ + column]); };
    double upper = grey(left, top) + x * (grey(right, top) - grey(left, top));
    double lower = grey(left, bottom) + x * (grey(right, bottom) - grey(left, bottom));
    return (upper + y * (lower - upper)) / 255;
}

PaintedMap::Range PaintedMap::bound(const Rect& rect) const {
    if (grey_.empty()) return {255, 255};
    glm::dvec2 first = pixel_of({rect.low_m.x, rect.high_m.y}), last = pixel_of({rect.high_m.x, rect.low_m.y});
    return pyramid_.bound(uint32_t(first.x), uint32_t(first.y), uint32_t(std::ceil(last.x)), uint32_t(std::ceil(last.y)));
}

Result<Placement> Placement::of(const Ground& ground, double tile_m, const PlacementOptions& options) {
    if (!(tile_m > 0 && std::isfinite(tile_m))) return bad_command("planting tiles of {} m: they need a size above 0", tile_m);
    if (!(options.lowest_m <= options.highest_m))
        return bad_command("planting from {} m up to {} m: no height lies between", options.lowest_m, options.highest_m);
    if (!(options.steepest >= 0)) return bad_command("planting up to a slope of {}: it has to be 0 or more", options.steepest);
    if (options.fairing_tiles > kMostFairing_tiles)
        return bad_command("fairing over {} tiles: {} at most", options.fairing_tiles, kMostFairing_tiles);
    for (const ImageRgb8* picture : {&options.mask, &options.density})
        if (picture->pixels.size() != size_t(3) * picture->width * picture->height)
            return bad_command("a map of {} x {} pixels with {} bytes: 3 a pixel are needed", picture->width, picture->height,
                               picture->pixels.size());
    Placement made;
    made.ground_ = &ground, made.tile_m_ = tile_m, made.fairing_tiles_ = options.fairing_tiles;
    made.lowest_m_ = options.lowest_m, made.highest_m_ = options.highest_m, made.steepest_ = options.steepest;
    made.mask_ = PaintedMap(options.mask, ground.extent()), made.density_ = PaintedMap(options.density, ground.extent());
    return made;
}

Verdict Placement::verdict(int64_t i, int64_t j) const {
    return Verdict(verdicts_->at(i, j, [&] { return uint8_t(found_verdict(i, j)); }));
}

Verdict Placement::found_verdict(int64_t i, int64_t j) const {
    Rect rect = rect_of(i, j);
    GroundRange range = ground_->range(rect);
    if (!range.is_whole) return Verdict::no_ground;
    if (range.low_m < lowest_m_) return Verdict::too_low;
    if (range.high_m > highest_m_) return Verdict::too_high;
    if (range.steepest > steepest_) return Verdict::too_steep;
    return mask_.at((rect.low_m + rect.high_m) / 2.0) >= kPainted ? Verdict::planted : Verdict::unpainted;
}

Placement::Coverage Placement::coverage(const Rect& rect, const GroundRange& bound) const {
    if (bound.is_empty() || bound.high_m < lowest_m_ || bound.low_m > highest_m_) return Coverage::none;
    PaintedMap::Range painted = mask_.bound(rect);
    if (painted.high < kPainted * 255) return Coverage::none;
    bool is_all = bound.is_whole && bound.low_m >= lowest_m_ && bound.high_m <= highest_m_ && bound.steepest <= steepest_ &&
                  painted.low > kPainted * 255;
    return is_all ? Coverage::all : Coverage::some;
}

bool Placement::is_at_edge(int64_t i, int64_t j) const {
    Coverage round = coverage(rect_of(i - 1, j - 1, 3));
    if (round != Coverage::some) return round == Coverage::none;
    for (int64_t y = j - 1; y <= j + 1; ++y)
        for (int64_t x = i - 1; x <= i + 1; ++x)
            if ((x != i || y != j) && !is_planted(x, y)) return true;
    return false;
}

double Placement::corner_density(int64_t i, int64_t j) const {
    double wanted = density_.at(glm::clamp(glm::dvec2(i, j) * tile_m_, ground_->extent().low_m, ground_->extent().high_m));
    if (fairing_tiles_ == 0 || wanted == 0) return wanted;
    int64_t most = fairing_tiles_;
    Coverage round = coverage(rect_of(i - most, j - most, 2 * most));
    if (round != Coverage::some) return round == Coverage::all ? wanted : 0;
    // The rings of tiles round the corner, from the four that meet there on.
    for (int64_t ring = 1; ring <= most; ++ring)
        for (int64_t y = j - ring; y < j + ring; ++y)
            for (int64_t x = i - ring; x < i + ring; ++x) {
                bool is_of_ring = x == i - ring || x == i + ring - 1 || y == j - ring || y == j + ring - 1;
                if (is_of_ring && !is_planted(x, y)) return wanted * double(ring - 1) / double(most);
            }
    return wanted;
}

CornerAt Placement::corners(const TileSet& set, uint64_t seed) const {
    if (set.corner_density.size() < 2) return {};
    return corners_of_density(
        set, [this](int64_t x, int64_t y) { return corner_density(x, y); }, seed);
}

}  // namespace overlook::wang_ldi
