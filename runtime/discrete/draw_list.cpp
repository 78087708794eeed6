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
    made.level = item.level, made.show = uint32_t(item.show), made.change = item.change;
    made.is_plain = layout.levels[item.level].is_plain;
    made.side = uint32_t(item.side);
    if (item.side != Item::Side::whole) {
        view::Axes axes = view::axes_of(camera);
        glm::dvec3 in_eye(glm::dot(item.normal, axes.right), glm::dot(item.normal, axes.up), glm::dot(item.normal, axes.forward));
        made.line = glm::vec3(line_of(in_eye, view::focal_px(camera), camera.width_px, camera.height_px));
    }
    if (item.show == Show::dithered_out) made.shift.x = float(item.up_to);
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

// Of one item of which not all is drawn.
void add_runs(const ChainLayout& layout, const Item& item, uint32_t place, std::span<const TriangleRun> runs,
              std::vector<SurfaceCommand>& commands) {
    const ChainLayout::LevelRuns& from = layout.levels[item.level];
    for (const TriangleRun& run : runs.subspan(item.first_run, item.run_count)) {
        const ChainLayout::Run& draw = from.runs[run.draw];
        commands.push_back({draw.surface, {run.index_count, 1, draw.first_index + run.first_index, from.base_vertex, place}});
    }
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
                   const view::Camera& camera, double time_s, uint32_t first_instance) {
    DrawList list;
    list.camera = camera;
    for (const std::vector<Item>* items : {&frame.items, &frame.translucent}) {
        for (const Item& item : *items) {
            PackedItem& made = list.items.emplace_back(packed(layout, item, placements[item.instance], camera));
            made.id = first_instance + item.instance + 1;
            if (layout.clip_s <= 0) continue;
            made.first_pose = uint32_t(list.poses.size());
            append_poses(chain, time_s + clip_begin_s(item.instance, layout.clip_s), list.poses);
        }
    }
    // What is whole goes by surface, what is translucent keeps its order.
    std::vector<SurfaceCommand> whole;
    uint32_t whole_count = uint32_t(frame.items.size());
    for (uint32_t begin = 0, end = 0; begin < whole_count; begin = end) {
        const Item& first = frame.items[begin];
        if (first.run_count > 0) {
            add_runs(layout, first, begin, frame.runs, whole);
            end = begin + 1;
            continue;
        }
        while (end < whole_count && frame.items[end].level == first.level && frame.items[end].run_count == 0) ++end;
        add_run(layout, first.level, begin, end, whole);
    }
    std::stable_sort(whole.begin(), whole.end(), [](const auto& a, const auto& b) { return a.surface < b.surface; });
    list.whole_calls = calls_of(whole, list.commands);
    for (uint32_t i = whole_count; i < list.items.size(); ++i) {
        const Item& item = frame.translucent[i - whole_count];
        double distance_m = glm::length(placements[item.instance].at(chain.middle_m) - camera.position_m);
        std::vector<SurfaceCommand> commands;
        if (item.run_count > 0)
            add_runs(layout, item, i, frame.runs, commands);
        else
            add_run(layout, item.level, i, i + 1, commands);
        for (const SurfaceCommand& one : commands) {
            list.translucent.push_back({distance_m, one.surface, uint32_t(list.commands.size())});
            list.commands.push_back(one.command);
        }
    }
    return list;
}

std::vector<ListedCalls> translucent_calls(std::span<const DrawList* const> lists) {
    std::vector<std::pair<uint32_t, Translucent>> all;
    for (uint32_t list = 0; list < lists.size(); ++list) {
        for (const Translucent& one : lists[list]->translucent) all.emplace_back(list, one);
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const auto& a, const auto& b) { return a.second.distance_m > b.second.distance_m; });
    std::vector<ListedCalls> runs;
    for (const auto& [list, one] : all) {
        if (runs.empty() || runs.back().list != list) runs.push_back({list, {}});
        std::vector<Call>& calls = runs.back().calls;
        bool goes_on = !calls.empty() && calls.back().surface == one.surface &&
                       calls.back().first_command + calls.back().command_count == one.command;
        if (!goes_on) calls.push_back({one.surface, one.command, 0});
        ++calls.back().command_count;
    }
    return runs;
}

}  // namespace overlook::discrete
