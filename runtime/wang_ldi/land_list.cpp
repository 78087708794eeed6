#include "runtime/wang_ldi/land_list.h"

#include <algorithm>

namespace overlook::wang_ldi {

uint64_t LandList::triangle_count() const {
    uint64_t count = cut.triangle_count();
    for (const PlantList& of_model : plants) count += of_model.listed.frame.triangle_count;
    return count;
}

Result<void> LandLister::list(const view::Camera& camera, const glm::dvec3& origin_m, const FrameOptions& options,
                              uint32_t texture_side_px, double morph, LandList& out) const {
    FrameOptions possible = options;
    possible.has_geometry &= forms_ != nullptr;
    Result<Field> field =
        Field::of(parts(possible), field_options_of(planted_.images().set(), possible, camera, texture_side_px));
    if (!field) return tl::unexpected(field.error());
    out.field.emplace(std::move(*field));
    cut_ground(camera, origin_m, options.error_px, morph, out);
    out.field->list(camera, out.list, out.scratch);
    list_plants(camera, {options.error_px, options.plant_fade}, out);
    return {};
}

// A plant stands inside its tile; all of its levels within its form.
FieldParts LandLister::parts(const FrameOptions& options) const {
    FieldParts parts = planted_.parts();
    for (size_t model = 0; options.has_geometry && model < forms_->size(); ++model) {
        double scale = planted_.greatest_scales()[model];
        parts.overhang_m = std::max(parts.overhang_m, scale * (*forms_)[model].reach_m);
        parts.plants_high_m = std::max(parts.plants_high_m, scale * (*forms_)[model].high_m);
    }
    return parts;
}

void LandLister::cut_ground(const view::Camera& camera, const glm::dvec3& origin_m, double error_px, double morph,
                            LandList& out) const {
    view::Camera on_terrain = camera;
    on_terrain.position_m -= origin_m;
    refiner_.cut_by_pixels(on_terrain, error_px, out.cut, morph);
}

void LandLister::fill_with_ground(const view::Camera& camera, const glm::dvec3& origin_m, double finest_px, double error_px,
                                  const view::CountedError& budget, double morph, LandList& out) const {
    budget.filled_px(finest_px, error_px, double(out.triangle_count()), [&](double px) {
        cut_ground(camera, origin_m, px, morph, out);
        return double(out.triangle_count());
    });
}

void LandLister::list_plants(const view::Camera& camera, const PlantAccuracy& accuracy, LandList& out) const {
    out.plants.clear();
    if (forms_ == nullptr) return;
    std::vector<PlantPlaces> by_model(planted_.planting().models.size());
    for (const Item& item : out.list.items)
        for (const Shown& shown : out.list.shown_of(item))
            if (out.field->ladder().rungs[shown.rung].stage == Stage::geometry)
                add_plants(planted_, item.i, item.j, float(shown.by_rung.share()) / kWhole, by_model);
    out.plants = plant_lists(*forms_, std::move(by_model), camera, accuracy);
}

}  // namespace overlook::wang_ldi
