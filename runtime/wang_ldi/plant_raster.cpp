#include "runtime/wang_ldi/plant_raster.h"

#include <algorithm>
#include <atomic>
#include <tuple>

#include "formats/parallel.h"
#include "runtime/wang_ldi/plant_pen.h"

namespace overlook::wang_ldi {
namespace {

constexpr uint32_t kRowsAtOnce = 16;

struct Task {
    double distance_m = 0;
    uint32_t list = 0, item = 0;
};

// The nearest first: they have most triangles, and hide what comes after them.
std::vector<Task> tasks_of(const view::Camera& camera, std::span<const PlantList> lists) {
    std::vector<Task> tasks;
    for (uint32_t l = 0; l < lists.size(); ++l) {
        const std::vector<discrete::Item>& items = lists[l].listed.frame.items;
        for (uint32_t i = 0; i < items.size(); ++i) {
            glm::dvec3 foot_m = lists[l].places.placements[items[i].instance].translation_m;
            tasks.push_back({glm::length(glm::dvec2(foot_m - camera.position_m)), l, i});
        }
    }
    std::sort(tasks.begin(), tasks.end(), [](const Task& a, const Task& b) {
        return std::tuple(a.distance_m, a.list, a.item) < std::tuple(b.distance_m, b.list, b.item);
    });
    return tasks;
}

// Of what is equally deep the picture's own stays.
void read_row(std::vector<Canvas>& canvases, uint32_t y, Warped& picture) {
    uint32_t* colours = picture.colours.data() + size_t(y) * picture.width_px;
    float* depths_m = picture.depth_m.data() + size_t(y) * picture.width_px;
    int64_t* first = canvases[0].row(y);
    for (size_t c = 1; c < canvases.size(); ++c) {
        int64_t* other = canvases[c].row(y);
        for (uint32_t x = 0; x < picture.width_px; ++x) first[x] = std::min(first[x], other[x]), other[x] = Canvas::kNothing;
    }
    for (uint32_t x = 0; x < picture.width_px; ++x) {
        if (first[x] == Canvas::kNothing) continue;
        float depth_m = std::bit_cast<float>(uint32_t(uint64_t(first[x]) >> 32));
        if (depth_m < depths_m[x]) depths_m[x] = depth_m, colours[x] = uint32_t(uint64_t(first[x]));
        first[x] = Canvas::kNothing;
    }
}

}  // namespace

struct PlantRaster::Threads {
    std::vector<Canvas> canvases;
};

PlantRaster::PlantRaster() : threads_(std::make_unique<Threads>()) {}
PlantRaster::~PlantRaster() = default;

void PlantRaster::draw(const view::Camera& camera, std::span<const PlantShape> shapes, const PlantLight& light,
                       std::span<const PlantList> lists, Warped& picture) {
    std::vector<Task> tasks = tasks_of(camera, lists);
    if (tasks.empty()) return;
    std::vector<Canvas>& canvases = threads_->canvases;
    canvases.resize(std::max(1u, thread_count()));
    for (Canvas& canvas : canvases) canvas.fit(camera.width_px, camera.height_px);
    std::atomic<size_t> next = 0;
    parallel_ranges(canvases.size(), 1, [&](size_t thread, size_t) {
        PlantPen pen(camera, light);
        for (size_t t = next++; t < tasks.size(); t = next++) {
            const PlantList& list = lists[tasks[t].list];
            pen.draw(shapes[list.model], list, list.listed.frame.items[tasks[t].item], canvases[thread]);
        }
    });
    parallel_ranges(picture.height_px, kRowsAtOnce, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y) read_row(canvases, uint32_t(y), picture);
    });
}

}  // namespace overlook::wang_ldi
