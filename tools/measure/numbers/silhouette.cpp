#include "tools/measure/numbers/silhouette.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>

#include "formats/parallel.h"
#include "tools/measure/numbers/distance_transform.h"
#include "tools/measure/numbers/percentiles.h"
#include "tools/measure/numbers/promised_view.h"

namespace overlook::measure {
namespace {

constexpr uint32_t kRowsAtOnce = 16;
constexpr double kDeeper = 1.01;
constexpr uint32_t kNearBorderSquared = 2;    // whole squares up to 1.5^2
constexpr int kReach = 2, kReachSquared = 6;  // whole squares up to 2.5^2

enum Hole : uint8_t { kNoHole, kShowsBackground, kShowsOther, kShowsDeeper, kAllowed };

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

// Marks pixels at which 1 / depth bends.
void add_steps(const Frame& frame, std::vector<uint8_t>& border) {
    constexpr double kBend = 0.01;
    auto nearness = [&](size_t at) { return 1 / double(frame.depth_m[at]); };
    size_t width = frame.width;
    for (size_t y = 0, at = 0; y < frame.height; ++y)
        for (size_t x = 0; x < width; ++x, ++at) {
            auto bends = [&](size_t before, size_t after) {
                return std::abs(nearness(before) - 2 * nearness(at) + nearness(after)) > kBend * nearness(at);
            };
            if (x > 0 && x + 1 < width && bends(at - 1, at + 1)) border[at] = 1;
            if (y > 0 && y + 1 < frame.height && bends(at - width, at + width)) border[at] = 1;
        }
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

// The reference in the middle of its surroundings, which were drawn with another camera: its own pixels stay as they are.
Frame widened(const Frame& reference, const Frame* around) {
    if (around == nullptr) return reference;
    Frame wide = *around;
    size_t margin = (wide.width - reference.width) / 2;
    for (size_t y = 0; y < reference.height; ++y) {
        size_t from = y * reference.width, to = (y + margin) * wide.width + margin;
        std::copy_n(reference.ids.begin() + ptrdiff_t(from), reference.width, wide.ids.begin() + ptrdiff_t(to));
        std::copy_n(reference.depth_m.begin() + ptrdiff_t(from), reference.width, wide.depth_m.begin() + ptrdiff_t(to));
    }
    return wide;
}

// What one thing's holes are looked for in.
struct Search {
    const Frame &test, &wide;  // wide: the reference and `margin` pixels round it
    int margin = 0;
    uint32_t thing = 0;
    double promised_px = 0;
};

Hole strict_hole_at(const Search& in, int x, int y) {
    size_t at = size_t(y) * in.test.width + size_t(x);
    size_t wide_at = size_t(y + in.margin) * in.wide.width + size_t(x + in.margin);
    if (in.test.ids[at] == kBackground) return kShowsBackground;
    if (in.test.ids[at] != in.thing) return kShowsOther;
    auto is_deeper = [&](float than_m) { return !(double(in.test.depth_m[at]) <= kDeeper * double(than_m)); };
    bool deeper = is_deeper(in.wide.depth_m[wide_at]) && is_deeper(deepest_near(in.wide, in.thing, x + in.margin, y + in.margin));
    return deeper ? kShowsDeeper : kNoHole;
}

Hole hole_at(const Search& in, int x, int y) {
    Hole strict = strict_hole_at(in, x, y);
    if (strict == kNoHole || strict == kShowsOther) return strict;
    return is_within_promise(in.test, in.wide, in.margin, in.promised_px, x, y) ? kAllowed : strict;
}

// Whether a hole is so near the outline that something outside could be its reason.
bool is_near_outline(const Frame& frame, size_t at, uint32_t reach_px) {
    return distance_to_outside_px(frame, at) <= double(reach_px);
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

uint32_t surroundings_px(double promised_px) {
    return uint32_t(std::ceil(std::min(promised_px, kMostPromised_px))) + kReach + 1;
}

HolePixels hole_pixels(const Frame& test, const Frame& reference, uint32_t thing, const HoleRule& rule) {
    assert(are_alike(test, reference) && thing != kBackground);
    Frame wide = widened(reference, rule.around);
    int margin = int(wide.width - reference.width) / 2;
    std::vector<uint8_t> border = border_of(wide, [thing](uint32_t id) { return id == thing; });
    if (rule.has_things_before_things) add_steps(wide, border);
    std::vector<uint32_t> from_border = squared_distances_px(wide.width, wide.height, border);

    HolePixels holes;
    holes.mask.resize(reference.ids.size());
    Search search{test, wide, margin, thing, std::min(rule.promised_px, kMostPromised_px)};
    parallel_ranges(reference.height, kRowsAtOnce, [&](size_t begin, size_t end) {
        for (size_t y = begin, at = begin * reference.width; y < end; ++y) {
            const uint32_t* distances = &from_border[(y + size_t(margin)) * wide.width + size_t(margin)];
            for (size_t x = 0; x < reference.width; ++x, ++at)
                if (reference.ids[at] == thing && distances[x] > kNearBorderSquared)
                    holes.mask[at] = hole_at(search, int(x), int(y));
        }
    });

    uint32_t reach_px = surroundings_px(rule.promised_px);
    for (size_t at = 0; at < holes.mask.size(); ++at) {
        holes.background += holes.mask[at] == kShowsBackground;
        holes.other_thing += holes.mask[at] == kShowsOther;
        holes.deeper += holes.mask[at] == kShowsDeeper;
        holes.allowed += holes.mask[at] == kAllowed;
        bool is_counted = holes.mask[at] != kNoHole && holes.mask[at] != kAllowed;
        holes.needs_surroundings |= is_counted && rule.around == nullptr && is_near_outline(reference, at, reach_px);
        if (reference.ids[at] != thing) continue;
        ++holes.thing_px;
        holes.lost_px += test.ids[at] != thing;
    }
    holes.count = holes.background + holes.other_thing + holes.deeper;
    return holes;
}

}  // namespace overlook::measure
