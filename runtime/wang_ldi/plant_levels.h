// At which level each plant that is drawn as geometry is shown, and which parts of it.
#pragma once

#include <cstdint>
#include <memory>
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
    discrete::FrameList frame;  // items of one level one after the other, the nearest first; a plant of two levels is one in view
    double error_px = 0;        // nothing of them is displaced by more
};
// How exact plants are: nothing of a level is displaced by more than error_px, as a bound; 0: the finest levels. A level begins
// where that permits it and is whole where it is displaced by (1 - fade) times as much, or where the next one begins; between
// these the one before gives way to it. fade: 0..0.9, 0: levels change at once.
struct PlantAccuracy {
    double error_px = 0, fade = 0;
};

// By which levels a plant is shown of which what is displaced by within_m is displaced by as much as is asked, in the chain's own
// metres: the coarser one's share is 0..1, and the finer one's the rest. One level: both are the same, and the share is 1.
struct LevelMix {
    uint32_t finer = 0, coarser = 0;
    double coarser_share = 1;

    bool is_one() const { return finer == coarser; }
};
// Depends on within_m without a jump in any level's share, unless fade is 0 or two levels begin at the same place.
LevelMix levels_within(const PlantForm& form, double within_m, double fade);

// Those in the camera's picture. Of two levels of one plant the coarser is dithered_in, the finer dithered_out; a plant that
// gives way to something else is drawn behind the part of the door that its share opens, both levels together.
ListedPlants plants_listed(const PlantForm& form, const PlantPlaces& places, const view::Camera& camera,
                           const PlantAccuracy& accuracy);

// What of a model is drawn for a camera: what is whole, or what is behind a screen door.
struct PlantList {
    uint32_t model = 0;
    bool is_fading = false;
    std::shared_ptr<const PlantPlaces> places;  // all of the model
    ListedPlants listed;
};
// Of all models, two each, in their order; lists of nothing are left out.
std::vector<PlantList> plant_lists(std::span<const PlantForm> forms, std::vector<PlantPlaces> by_model,
                                   const view::Camera& camera, const PlantAccuracy& accuracy);

}  // namespace overlook::wang_ldi
