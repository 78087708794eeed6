#include "runtime/discrete/draw_list.h"

#include <algorithm>
#include <cmath>

namespace overlook::discrete {
namespace {

float part_of_turn(double turns) {
    return float(turns - std::floor(turns));
}

PackedItem packed(const ChainLayout& layout, const Item& item, const Placement& placement, const view::Camera& camera) {
    PackedItem made;
    made.place_m = glm::vec3(placement.at(layout.origin_m) - camera.position_m);
    made.scale = float(placement.scale), made.cosine = float(placement.cosine), made.sine = float(placement.sine);
    made.share = float(item.share), made.grain = float(item.grain);
    made.id = item.instance + 1, made.level = item.level, made.show = uint32_t(item.show), made.change = item.change;
    made.is_plain = layout.levels[item.level].is_plain;
    if (item.show == Show::visible) {
        double period_m = double(layout.visibilities[item.change].period_m) * item.grain;
        const glm::dvec3& origin = layout.origin_m;
        made.shift = {part_of_turn((origin.x + origin.z) / period_m), part_of_turn((origin.y + origin.z) / period_m)};
    }
    return made;
}

struct SurfaceCommand {
    uint32_t surface = 0;
    Command command;
};

// Of items [begin, end), which are of one level.
void add_run(const ChainLayout& layout, uint32_t level, uint32_t begin, uint32_t end, std::vector<SurfaceCommand>& commands) {
    const ChainLayout::LevelRuns& from = layout.levels[level];
    for (const ChainLayout::Run& run : from.runs)
        commands.push_back({run.surface, {run.index_count, end - begin, run.first_index, from.base_vertex, begin}});
}

// Neighbours of one surface become one call.
std::vector<Call> calls_of(std::span<const SurfaceCommand> from, std::vector<Command>& commands) {
    std::vector<Call> calls;
    for (const SurfaceCommand& one : from) {
        if (calls.empty() || calls.back().surface != one.surface) calls.push_back({one.surface, uint32_t(commands.size()), 0});
        ++calls.back().command_count;
        commands.push_back(one.command);
    }
    return calls;
}

}  // namespace

DrawList draw_list(const ChainLayout& layout, const Chain& chain, const FrameList& frame, std::span<const Placement> placements,
                   const view::Camera& camera, double time_s) {
    DrawList list;
    list.camera = camera;
    for (const std::vector<Item>* items : {&frame.items, &frame.translucent}) {
        for (const Item& item : *items) list.items.push_back(packed(layout, item, placements[item.instance], camera));
    }
    if (layout.clip_s > 0) {
        for (PackedItem& item : list.items) {
            item.first_pose = uint32_t(list.poses.size());
            append_poses(chain, time_s + clip_begin_s(item.id - 1, layout.clip_s), list.poses);
        }
    }
    // What is whole goes by surface, what is translucent keeps its order.
    std::vector<SurfaceCommand> whole, translucent;
    uint32_t whole_count = uint32_t(frame.items.size());
    for (uint32_t begin = 0, end = 0; begin < whole_count; begin = end) {
        uint32_t level = list.items[begin].level;
        while (end < whole_count && list.items[end].level == level) ++end;
        add_run(layout, level, begin, end, whole);
    }
    std::stable_sort(whole.begin(), whole.end(), [](const auto& a, const auto& b) { return a.surface < b.surface; });
    for (uint32_t i = whole_count; i < list.items.size(); ++i) add_run(layout, list.items[i].level, i, i + 1, translucent);
    list.whole_calls = calls_of(whole, list.commands);
    list.translucent_calls = calls_of(translucent, list.commands);
    return list;
}

}  // namespace overlook::discrete
