#include "tools/baked/info_scene.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "formats/numbers.h"

namespace overlook::baked {
namespace {

using nlohmann::ordered_json;
using wang_ldi::PerspectiveLdi;
using wang_ldi::PerspectiveView;

uint32_t pixels_with_samples(const PerspectiveLdi& image) {
    uint32_t count = 0;
    for (size_t p = 0; p + 1 < image.first.size(); ++p) count += image.first[p + 1] > image.first[p];
    return count;
}

double bytes_per_sample(uint64_t bytes, const PerspectiveLdi& image) {
    return double(bytes) / std::max(1u, image.sample_count());
}

}  // namespace

std::string scene_json(const container::Reader& file, const wang_ldi::Scene& scene) {
    const PerspectiveLdi& image = scene.image;
    const PerspectiveView& view = image.view;
    uint64_t bytes = wang_ldi::stored_bytes_of_scene_image(file), samples = 0;
    for (const PerspectiveLdi& picture : scene.pictures) samples += picture.sample_count();
    return ordered_json{{"columns", scene.columns},
                        {"rows", scene.rows},
                        {"width_px", view.width_px},
                        {"height_px", view.height_px},
                        {"eye_m", {view.position_m.x, view.position_m.y, view.position_m.z}},
                        {"heading_deg", view.heading_deg},
                        {"pitch_deg", view.pitch_deg},
                        {"fov_y_deg", view.fov_y_deg},
                        {"near_m", view.near_m},
                        {"far_m", view.far_m},
                        {"cell_m", image.cell_m},
                        {"is_unlit", image.is_unlit},
                        {"has_normals", !image.normals.empty()},
                        {"samples", image.sample_count()},
                        {"pixels_with_samples", pixels_with_samples(image)},
                        {"most_layers", most_layers(image)},
                        {"stored_bytes", bytes},
                        {"bytes_per_sample", bytes_per_sample(bytes, image)},
                        {"unseen_share", double(image.unseen_share)},
                        {"pictures", scene.pictures.size()},
                        {"samples_of_pictures", samples}}
        .dump();
}

void print_scene(const container::Reader& file, const wang_ldi::Scene& scene) {
    const PerspectiveLdi& image = scene.image;
    const PerspectiveView& view = image.view;
    fmt::print("scene: {} x {} tiles as one image of {} x {} px, {}: {} samples, up to {} in a pixel, {:.2f} bytes each\n",
               scene.columns, scene.rows, view.width_px, view.height_px, image.is_unlit ? "unlit" : "lit",
               with_commas(image.sample_count()), most_layers(image),
               bytes_per_sample(wang_ldi::stored_bytes_of_scene_image(file), image));
    fmt::print("seen from ({:.4g}, {:.4g}, {:.4g}) m, heading {:g}, pitch {:g}, {:g} degrees high, {:.4g} to {:.4g} m deep\n",
               view.position_m.x, view.position_m.y, view.position_m.z, view.heading_deg, view.pitch_deg, view.fov_y_deg,
               view.near_m, view.far_m);
    fmt::print("right for eyes up to {:g} m beside it, {:.2g} % unseen; {} pictures by rays\n", image.cell_m,
               100 * double(image.unseen_share), scene.pictures.size());
}

}  // namespace overlook::baked
