#include "tools/measure/numbers/silhouette.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>

#include "formats/parallel.h"
#include "tools/measure/numbers/distance_transform.h"
#include "tools/measure/numbers/percentiles.h"

namespace overlook::measure {
namespace {

constexpr uint32_t kRowsAtOnce = 16;
constexpr double kDeeper = 1.01;
constexpr uint32_t kNearBorderSquared = 2;    // whole squares up to 1.5^2
constexpr int kReach = 2, kReachSquared = 6;  // whole squares up to 2.5^2

enum Hole : uint8_t { kNoHole, kShowsBackground, kShowsOther, kShowsDeeper };

[[maybe_unused]] bool are_alike(const Frame& a, const Frame& b) {
    return a.width == b.width && a.height == b.height && a.ids.size() == b.ids.size();
}

// Pixels that are inside and have a pixel left, right, above or below that is not.
std::vector<uint8_t> border_of(const Frame& frame, const std::function<bool(uint32_t id)>& is_inside) {
    std::vector<uint8_t> inside(frame.ids.size()), border(frame.ids.size());
    std::transform(frame.ids.begin(), frame.ids.end(), inside.begin(), is_inside);
    size_t width = frame.width;
    for (size_t y = 0, at = 0; y < frame.height; ++y)
        for (size_t x = 0; x < width; ++x, ++at)
            border[at] = inside[at] && ((x > 0 && !inside[at - 1]) || (x + 1 < width && !inside[at + 1]) ||
                                        (y > 0 && !inside[at - width]) || (y + 1 < frame.height && !inside[at + width]));
    return border;
}

double distance_to_outside_px(const Frame& frame, size_t at) {
    size_t x = at % frame.width, y = at / frame.width;
    return double(std::min({x + 1, frame.width - x, y + 1, frame.height - y}));
}

// From each pixel of one border to the nearest of the other.
std::vector<double> border_distances(const Frame& frame, const std::vector<uint8_t>& from, const std::vector<uint8_t>& to) {
    std::vector<double> distances_px;
    std::vector<uint32_t> squared = squared_distances_px(frame.width, frame.height, to);
    for (size_t at = 0; at < from.size(); ++at)
        if (from[at])
            distances_px.push_back(squared[at] == kNoneMarked ? distance_to_outside_px(frame, at)
                                                              : std::sqrt(double(squared[at])));
    return distances_px;
}

// The greatest depth that the frame shows of a thing within 2.5 px of a pixel.
float deepest_near(const Frame& frame, uint32_t thing, int x, int y) {
    float deepest_m = 0;
    for (int dy = -kReach; dy <= kReach; ++dy)
        for (int dx = -kReach; dx <= kReach; ++dx) {
            if (dx * dx + dy * dy > kReachSquared) continue;
            if (x + dx < 0 || y + dy < 0 || x + dx >= int(frame.width) || y + dy >= int(frame.height)) continue;
            size_t at = size_t(y + dy) * frame.width + size_t(x + dx);
            if (frame.ids[at] == thing) deepest_m = std::max(deepest_m, frame.depth_m[at]);
        }
    return deepest_m;
}

Hole hole_at(const Frame& test, const Frame& reference, uint32_t thing, int x, int y) {
    size_t at = size_t(y) * reference.width + size_t(x);
    if (test.ids[at] == kBackground) return kShowsBackground;
    if (test.ids[at] != thing) return kShowsOther;
    auto is_deeper = [&](float than_m) { return !(double(test.depth_m[at]) <= kDeeper * double(than_m)); };
    bool deeper = is_deeper(reference.depth_m[at]) && is_deeper(deepest_near(reference, thing, x, y));
    return deeper ? kShowsDeeper : kNoHole;
}

}  // namespace

SilhouetteError silhouette_error(const Frame& test, const Frame& reference) {
    assert(are_alike(test, reference));
    auto is_surface = [](uint32_t id) { return id != kBackground; };
    std::vector<uint8_t> border_test = border_of(test, is_surface), border_reference = border_of(reference, is_surface);
    std::vector<double> there_px = border_distances(test, border_test, border_reference);
    std::vector<double> back_px = border_distances(test, border_reference, border_test);

    Percentiles there = percentiles_of(there_px), back = percentiles_of(back_px);
    return {std::max(there.p95, back.p95), std::max(there.max, back.max), there_px.size(), back_px.size()};
}

HolePixels hole_pixels(const Frame& test, const Frame& reference, uint32_t thing) {
    assert(are_alike(test, reference) && thing != kBackground);
    std::vector<uint8_t> border = border_of(reference, [thing](uint32_t id) { return id == thing; });
    std::vector<uint32_t> from_border = squared_distances_px(reference.width, reference.height, border);

    HolePixels holes;
    holes.mask.resize(reference.ids.size());
    parallel_ranges(reference.height, kRowsAtOnce, [&](size_t begin, size_t end) {
        for (size_t y = begin, at = begin * reference.width; y < end; ++y)
            for (size_t x = 0; x < reference.width; ++x, ++at)
                if (reference.ids[at] == thing && from_border[at] > kNearBorderSquared)
                    holes.mask[at] = hole_at(test, reference, thing, int(x), int(y));
    });

    for (size_t at = 0; at < holes.mask.size(); ++at) {
        holes.background += holes.mask[at] == kShowsBackground;
        holes.other_thing += holes.mask[at] == kShowsOther;
        holes.deeper += holes.mask[at] == kShowsDeeper;
        if (reference.ids[at] != thing) continue;
        ++holes.thing_px;
        holes.lost_px += test.ids[at] != thing;
    }
    holes.count = holes.background + holes.other_thing + holes.deeper;
    return holes;
}

}  // namespace overlook::measure
