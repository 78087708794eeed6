// A frame's items as they go to the graphics card.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/discrete/director.h"
#include "runtime/discrete/poses.h"
#include "runtime/view/camera.h"

namespace overlook::discrete {

// As in draw_shaders.h.
struct PackedItem {
    glm::vec3 place_m{0};
    float scale = 1;
    float cosine = 1, sine = 0, share = 1, grain = 1;
    uint32_t id = 0, level = 0, show = 0, change = 0;  // id: instance + 1
    glm::vec2 shift{0};                                // of Show::dithered_out the first is Item::up_to
    uint32_t first_pose = 0, is_plain = 0;
    glm::vec3 line{0};  // split.h's line_of
    uint32_t side = 0;  // Item::Side
};
static_assert(sizeof(PackedItem) == 80);

// As OpenGL has it (glMultiDrawElementsIndirect).
struct Command {
    uint32_t index_count = 0, instance_count = 0, first_index = 0;
    int32_t base_vertex = 0;
    uint32_t base_instance = 0;
};

// Commands of one surface that stand one after the other: one call.
struct Call {
    uint32_t surface = 0, first_command = 0, command_count = 0;

    bool operator==(const Call&) const = default;
};

// A command of something translucent.
struct Translucent {
    double distance_m = 0;  // from the eye to the middle of the instance
    uint32_t surface = 0, command = 0;
};

// What of a chain a list is made by: where each level lies in the one vertex and the one index buffer.
struct ChainLayout {
    struct Run {
        uint32_t surface = 0, first_index = 0, index_count = 0;
    };
    struct LevelRuns {
        std::vector<Run> runs;
        int32_t base_vertex = 0;
        bool is_plain = false;
    };
    std::vector<LevelRuns> levels;
    std::vector<Visibility> visibilities;  // without their values
    glm::dvec3 origin_m{0};
    double clip_s = 0;  // 0: nothing moves
};

// A frame that can be drawn again: all that decides its picture.
struct DrawList {
    view::Camera camera;
    std::vector<PackedItem> items;  // those that are translucent last
    std::vector<Command> commands;
    std::vector<Call> whole_calls;
    std::vector<Translucent> translucent;  // back to front
    std::vector<PartPose> poses;
};

// chain: what moves; layout must be its own. time_s: of the clip. first_instance: how many instances there are of chains before
// this one in the same picture, so that ids are unique.
DrawList draw_list(const ChainLayout& layout, const Chain& chain, const FrameList& frame, std::span<const Placement> placements,
                   const view::Camera& camera, double time_s, uint32_t first_instance = 0);

// Calls of one of several lists.
struct ListedCalls {
    uint32_t list = 0;
    std::vector<Call> calls;

    bool operator==(const ListedCalls&) const = default;
};
// What is translucent of all lists of one picture, back to front: neighbours of one list stand together, those of one surface are
// one call.
std::vector<ListedCalls> translucent_calls(std::span<const DrawList* const> lists);

}  // namespace overlook::discrete
