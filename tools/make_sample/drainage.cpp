// Based on: Richard Barnes, Clarence Lehman, David Mulla, "Priority-Flood: An Optimal Depression-Filling and
// Watershed-Labeling Algorithm for Digital Elevation Models", Computers & Geosciences 62, 2014.
#include "tools/make_sample/drainage.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

#include "formats/parallel.h"
#include "tools/make_sample/noise.h"

namespace overlook::sample {
namespace {

constexpr uint32_t kUnseen = ~0u;

void flood(const Grid& height_m, const std::vector<uint8_t>& is_outlet, Drainage& out) {
    using Entry = std::pair<double, uint32_t>;
    std::vector<Entry> storage;
    storage.reserve(height_m.values.size() / 8);
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open(std::greater<>(), std::move(storage));
    for (uint32_t i = 0; i < height_m.values.size(); ++i) {
        if (!is_outlet[i]) continue;
        out.receiver[i] = i;
        out.filled_m[i] = height_m.values[i];
        open.push({out.filled_m[i], i});
    }
    while (!open.empty()) {
        auto [level_m, cell] = open.top();
        open.pop();
        out.order.push_back(cell);
        for_neighbours(height_m.side, cell, [&, level = level_m, from = cell](size_t next, double, size_t) {
            if (out.receiver[next] != kUnseen) return;
            out.receiver[next] = from;
            out.filled_m[next] = std::max(level, height_m.values[next]);
            open.push({out.filled_m[next], uint32_t(next)});
        });
    }
}

// Lower filled neighbours stand earlier in the order, so the order stays right.
void choose_steepest(uint32_t side, const std::vector<uint8_t>& is_outlet, double wander, uint64_t seed, Drainage& out) {
    parallel_ranges(out.receiver.size(), 1 << 14, [&](size_t begin, size_t end) {
        for (size_t cell = begin; cell < end; ++cell) {
            if (is_outlet[cell]) continue;
            uint64_t hash = hash_of(seed, cell, 0);
            double steepest = 0;
            for_neighbours(side, cell, [&](size_t next, double distance, size_t k) {
                double bend = 1 + wander * (double(hash >> (8 * k) & 255) / 255 - 0.5);
                double slope = (out.filled_m[cell] - out.filled_m[next]) / distance * bend;
                if (slope <= steepest) return;
                steepest = slope;
                out.receiver[cell] = uint32_t(next);
            });
        }
    });
}

}  // namespace

Drainage drain(const Grid& height_m, const std::vector<uint8_t>& is_outlet, double wander, uint64_t seed) {
    Drainage out;
    out.order.reserve(height_m.values.size());
    out.receiver.assign(height_m.values.size(), kUnseen);
    out.filled_m.assign(height_m.values.size(), 0);
    flood(height_m, is_outlet, out);
    choose_steepest(height_m.side, is_outlet, wander, seed, out);
    return out;
}

std::vector<double> drained_area_m2(const Drainage& drainage, double cell_m) {
    std::vector<double> area_m2(drainage.order.size(), cell_m * cell_m);
    for (size_t i = drainage.order.size(); i-- > 0;) {
        uint32_t cell = drainage.order[i], receiver = drainage.receiver[cell];
        if (receiver != cell) area_m2[receiver] += area_m2[cell];
    }
    return area_m2;
}

}  // namespace overlook::sample
