#include "runtime/wang_ldi/plant_raster.h"

#include <algorithm>
#include <tuple>

#include "formats/parallel.h"
#include "runtime/wang_ldi/plant_pen.h"

namespace overlook::wang_ldi {
namespace {

constexpr uint32_t kRowsAtOnce = 16, kStrip_px = 80;

struct Task {
    double distance_m = 0;
    uint32_t list = 0, item = 0;
};

Door door_of(const discrete::Item& item) {
    auto share = float(item.share);
    if (item.show == discrete::Show::dithered_in) return {0, share};
    return item.show == discrete::Show::dithered_out ? Door{share, float(item.up_to)} : Door{};
}

// The nearest first: they have most triangles, and hide what comes after them.
std::vector<Task> tasks_of(const view::Camera& camera, std::span<const PlantList> lists) {
    std::vector<Task> tasks;
    for (uint32_t l = 0; l < lists.size(); ++l) {
        const std::vector<discrete::Item>& items = lists[l].listed.frame.items;
        for (uint32_t i = 0; i < items.size(); ++i) {
            glm::dvec3 foot_m = lists[l].places->placements[items[i].instance].translation_m;
            tasks.push_back({glm::length(glm::dvec2(foot_m - camera.position_m)), l, i});
        }
    }
    std::sort(tasks.begin(), tasks.end(), [](const Task& a, const Task& b) {
        return std::tuple(a.distance_m, a.list, a.item) < std::tuple(b.distance_m, b.list, b.item);
    });
    return tasks;
}

// Of what is equally deep the picture's own stays. Empties the canvas.
void read_row(Canvas& canvas, uint32_t y, Warped& picture) {
    uint32_t* colours = picture.colours.data() + size_t(y) * picture.width_px;
    float* depths_m = picture.depth_m.data() + size_t(y) * picture.width_px;
    int64_t* row = canvas.row(y);
    for (uint32_t x = 0; x < picture.width_px; ++x) {
        if (row[x] == Canvas::kNothing) continue;
        float depth_m = depth_of_key(row[x]);
        if (depth_m < depths_m[x]) depths_m[x] = depth_m, colours[x] = colour_of_key(row[x]);
        row[x] = Canvas::kNothing;
    }
}

}  // namespace

PlantRaster::PlantRaster() : canvas_(std::make_unique<Canvas>()) {}
PlantRaster::~PlantRaster() = default;

void PlantRaster::draw(const view::Camera& camera, std::span<const PlantShape> shapes, const PlantLight& light,
                       std::span<const PlantList> lists) {
    std::vector<Task> tasks = tasks_of(camera, lists);
    is_empty_ = tasks.empty();
    if (is_empty_) return;
    canvas_->fit(camera.width_px, camera.height_px);
    parallel_ranges(camera.width_px, kStrip_px, [&](size_t left, size_t right) {
        PlantPen pen(camera, light);
        pen.begin(*canvas_, int(left), int(right));
        for (const Task& task : tasks) {
            const PlantList& list = lists[task.list];
            const discrete::Item& item = list.listed.frame.items[task.item];
            pen.draw(shapes[list.model], item.level, list.places->placements[item.instance], door_of(item));
        }
    });
}

void PlantRaster::lay_over(Warped& picture) {
    if (is_empty_) return;
    is_empty_ = true;
    parallel_ranges(picture.height_px, kRowsAtOnce, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y) read_row(*canvas_, uint32_t(y), picture);
    });
}

}  // namespace overlook::wang_ldi
