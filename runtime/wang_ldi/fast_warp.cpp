#include "runtime/wang_ldi/fast_warp.h"

#include <algorithm>
#include <atomic>
#include <limits>

#include "formats/parallel.h"
#include "runtime/wang_ldi/fast_tile.h"
#include "runtime/wang_ldi/hole_fill.h"
#include "runtime/wang_ldi/list_parts.h"

namespace overlook::wang_ldi {
namespace {

constexpr size_t kItemsAtOnce = 4;
constexpr uint32_t kRowsAtOnce = 16;

// Of two pixels, the later canvas's over the earlier's.
template <Hiding hiding>
int64_t over(int64_t earlier, int64_t later) {
    if (hiding == Hiding::by_depth) return std::min(earlier, later);
    return later == Canvas::kNothing ? earlier : later;
}

// Reads a row of all canvases out, and empties it.
template <Hiding hiding>
void read_row(std::vector<Canvas>& canvases, uint32_t y, Warped& picture) {
    uint32_t* colours = picture.colours.data() + size_t(y) * picture.width_px;
    float* depths_m = picture.depth_m.data() + size_t(y) * picture.width_px;
    int64_t* first = canvases[0].row(y);
    for (size_t c = 1; c < canvases.size(); ++c) {
        int64_t* other = canvases[c].row(y);
        for (uint32_t x = 0; x < picture.width_px; ++x) first[x] = over<hiding>(first[x], other[x]), other[x] = Canvas::kNothing;
    }
    for (uint32_t x = 0; x < picture.width_px; ++x) {
        bool is_something = first[x] != Canvas::kNothing;
        colours[x] = is_something ? colour_of_key(first[x]) : 0;
        depths_m[x] = is_something ? depth_of_key(first[x]) : std::numeric_limits<float>::infinity();
        first[x] = Canvas::kNothing;
    }
}

// By depth any thread may take any items; by order each takes a part of the list.
template <Hiding hiding>
void draw_items(const FastScene& scene, std::vector<FastTools>& tools) {
    const std::vector<Item>& items = scene.list.items;
    if (hiding == Hiding::by_order) {
        std::vector<size_t> ends = parts_of(scene.field, scene.list, unsigned(tools.size()));
        parallel_ranges(ends.size(), 1, [&](size_t part, size_t) {
            FastTile<hiding> tile(scene, tools[part]);
            for (size_t i = part > 0 ? ends[part - 1] : 0; i < ends[part]; ++i) tile.draw(items[i]);
        });
        return;
    }
    std::atomic<size_t> next = 0;
    parallel_ranges(tools.size(), 1, [&](size_t thread, size_t) {
        FastTile<hiding> tile(scene, tools[thread]);
        // The nearest first: they have most samples, and few threads are left waiting for one at the end.
        for (size_t begin = next.fetch_add(kItemsAtOnce); begin < items.size(); begin = next.fetch_add(kItemsAtOnce))
            for (size_t i = begin; i < std::min(begin + kItemsAtOnce, items.size()); ++i) tile.draw(items[items.size() - 1 - i]);
    });
}

}  // namespace

struct FastWarp::Threads {
    std::vector<Canvas> canvases;
    std::vector<FastTools> tools;

    void fit(unsigned count, const Eye& eye, const view::Camera& camera, bool uses_vectors) {
        canvases.resize(count), tools.resize(count);
        for (unsigned t = 0; t < count; ++t) {
            canvases[t].fit(camera.width_px, camera.height_px, eye.most_splat_px);
            tools[t].canvas = &canvases[t], tools[t].counts = {};
            tools[t].project = uses_vectors ? best_project_samples() : project_samples_anywhere;
        }
    }

    template <Hiding hiding>
    WarpCounts draw(const FastScene& scene, Warped& picture) {
        draw_items<hiding>(scene, tools);
        parallel_ranges(picture.height_px, kRowsAtOnce, [&](size_t begin, size_t end) {
            for (size_t y = begin; y < end; ++y) read_row<hiding>(canvases, uint32_t(y), picture);
        });
        WarpCounts sum;
        for (const FastTools& one : tools) sum.add(one.counts);
        return sum;
    }
};

FastWarp::FastWarp() : threads_(std::make_unique<Threads>()) {}
FastWarp::~FastWarp() = default;

WarpCounts FastWarp::warp(const view::Camera& camera, const Field& field, const FieldList& list, const PreparedAt& image_at,
                          const FastOptions& options, Warped& picture, const FarImages* far) {
    picture.width_px = camera.width_px, picture.height_px = camera.height_px;
    picture.colours.resize(size_t(camera.width_px) * camera.height_px), picture.depth_m.resize(picture.colours.size());
    Eye eye(camera, options.finer);
    threads_->fit(std::max(1u, thread_count()), eye, camera, options.uses_vectors);
    FastScene scene{eye, PictureBounds(camera), field, list, image_at, far, highest_step_m(*field.parts().images)};
    WarpCounts counts = options.hiding == Hiding::by_order ? threads_->draw<Hiding::by_order>(scene, picture)
                                                           : threads_->draw<Hiding::by_depth>(scene, picture);
    holes_filled_ = options.fills_holes ? fill_holes(picture, options.finer) : 0;
    return counts;
}

}  // namespace overlook::wang_ldi
