// At which level each plant that is drawn as geometry is shown, and which parts of it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/discrete/director.h"
#include "runtime/view/camera.h"
#include "runtime/wang_ldi/plants.h"

namespace overlook::wang_ldi {

// A chain of levels as it is planted, upright on its foot, which is its own world's origin.
struct PlantForm {
    discrete::ChainFacts facts;
    double reach_m = 0, low_m = 0, high_m = 0;          // everything of all levels: within reach of the vertical, and of these
    std::vector<std::vector<discrete::Bunch>> bunches;  // [levels]: as of facts, but enough triangles each to be worth a question
};
// O(triangles).
PlantForm form_of(const discrete::Chain& chain);

struct ListedPlants {
    discrete::FrameList frame;  // items of one level one after the other, the nearest first
    double error_px = 0;        // nothing of them is displaced by more
};
// Those in the camera's picture, each at the coarsest level that is displaced by at most error_px, as a bound; 0: the finest.
ListedPlants plants_listed(const PlantForm& form, const PlantPlaces& places, const view::Camera& camera, double error_px);

// What of a model is drawn for a camera: those that are whole, or those that give way to something else.
struct PlantList {
    uint32_t model = 0;
    bool is_fading = false;
    PlantPlaces places;
    ListedPlants listed;
};
// Of all models, two each, in their order; lists of nothing are left out.
std::vector<PlantList> plant_lists(std::span<const PlantForm> forms, std::span<const PlantPlaces> by_model,
                                   const view::Camera& camera, double error_px);

}  // namespace overlook::wang_ldi
