// A budget of triangles, divided between the coarse cut of each frame and the key that is being made.
#pragma once

#include <cstdint>

#include "runtime/view/error_budget.h"

namespace overlook::lod_sprite {

// The coarse cut gets half of the budget: view::ErrorController makes its errors larger until it fits, fast up and slowly down.
// Keys get what it leaves in each frame, and where that is too little to make one in time, their errors become larger as well.
class Spending {
  public:
    // triangles: that a frame may draw, those into keys included; 0 = as many as its errors take.
    explicit Spending(double triangles);

    // From now on; what was learned stays.
    void set_triangles(double triangles);

    bool is_limited() const { return triangles_ > 0; }
    // By how much the errors asked are multiplied: of the coarse cut, with a key to look into and without; of keys. 1 or more.
    double coarser(bool has_key) const { return (has_key ? keyed_ : unkeyed_).error_px(); }
    double keys_coarser() const { return keys_coarser_; }

    // What a coarse cut made so has. Returns whether that fits; if not, it is to be made again, coarser.
    bool coarse_done(bool has_key, uint64_t triangles);
    // Before a key is begun that has `expected` triangles as things are: it is to be whole within most_frames.
    void plan_key(uint64_t expected, uint32_t most_frames);
    // Frames that a key of so many triangles takes. is_limited() is wanted.
    uint32_t frames_for(uint64_t expected) const;

    // Of this frame's triangles, those left for keys after `spent` of them.
    uint64_t left(uint64_t spent) const;
    // Whether more is left than a budget is kept within.
    bool is_much_left(uint64_t spent) const;
    // Whether frames would cost more if they might, where keys of so many triangles each serve for so many frames. They then cost
    // what they may: keys are made one after the other, as fresh as there are triangles for.
    bool binds(uint64_t key_triangles, double life_frames) const;

  private:
    double triangles_;
    view::ErrorController keyed_, unkeyed_;
    double keys_coarser_ = 1;
    uint64_t coarse_triangles_ = 0;  // of the last cut
};

}  // namespace overlook::lod_sprite
