// What a frame of a chain's instances takes, by how much coarser than asked their levels may be.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "runtime/discrete/select.h"
#include "runtime/view/camera.h"

namespace overlook::discrete {

// Whether only those triangles of a level are drawn that are in the picture, where its sides cut the thing.
inline bool is_drawn_in_part(const LevelFacts& facts) {
    constexpr uint64_t kLeast = 1024;  // of fewer all are
    return facts.triangle_count >= kLeast && !facts.bunches.empty();
}

// Holds what decides about the instances in view, so that it can be asked again and again. facts must outlive it.
class Demand {
  public:
    Demand(const ChainFacts& facts, const SelectSettings& settings) : facts_(&facts), settings_(settings) {}

    // One that is in view of the camera, which is the selector's. in_use: its level; none: it has none yet.
    void add(const Selector& selector, const Placement& placement, std::optional<uint32_t> in_use, const view::Camera& camera);

    // Triangles, exactly, when all changes of level are over, with levels so many times as coarse as asked (discrete::coarser).
    // times > 0. O(instances x levels).
    double triangles(double times) const;

  private:
    struct Instance {
        std::optional<uint32_t> in_use;
        std::optional<uint32_t> seen_offset;  // in seen_, of one that the picture's sides cut
    };
    const ChainFacts* facts_;
    SelectSettings settings_;
    std::vector<Instance> instances_;
    std::vector<double> now_, ahead_;  // strains, [instances x levels]; ahead_ may be empty
    std::vector<double> seen_;         // triangles in the picture, [levels] each
};

}  // namespace overlook::discrete
