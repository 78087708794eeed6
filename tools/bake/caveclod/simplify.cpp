#include "tools/bake/caveclod/simplify.h"

#include <algorithm>
#include <cmath>

#include "tools/bake/caveclod/hierarchy_rows.h"
#include "tools/bake/caveclod/simplify_passes.h"
#include "tools/bake/caveclod/stopwatch.h"

namespace overlook::caveclod {
namespace {

// Candidates cost in proportion to what is left, distances to the source about the same from each halving to the next.
double share_done(uint64_t faces_left, uint64_t faces_before) {
    double left = double(std::max<uint64_t>(faces_left, 1)), before = double(std::max<uint64_t>(faces_before, 2));
    return 0.5 * (1 - left / before) + 0.5 * std::log(before / left) / std::log(before);
}

}  // namespace

Result<Hierarchy> build_hierarchy(const mesh::Mesh& mesh, const Groups& groups, const SimplifyOptions& options,
                                  SimplifyReport* report, const std::function<void(double)>& progress) {
    SimplifyReport counted;
    auto working = [&] {
        Stopwatch watch(counted.topology_s);
        return make_working_mesh(mesh, groups, options.seams.moves);
    }();
    if (!working) return tl::unexpected(working.error());
    CollapseLog log;
    Passes passes(*working, options, counted);
    while (passes.run(options.least_face_count, log)) progress(share_done(passes.face_count(), mesh.faces.size()));
    Result<Hierarchy> made = [&] {
        Stopwatch watch(counted.rows_s);
        return make_rows(mesh, groups, *working, log);
    }();
    if (!made) return made;
    Hierarchy& hierarchy = *made;
    for (uint32_t p = 0; p < working->some_corner.size(); ++p)
        if (working->is_alive(p)) ++counted.hindrances[size_t(passes.hindrance_of(p))];
    counted.own_error_m.assign(log.error_m.rbegin(), log.error_m.rend());
    counted.collapse_count = log.gone.size();
    counted.depth = depth_of(hierarchy);
    counted.need_count = hierarchy.needs.size();
    if (!hierarchy.error_m.empty())
        counted.greatest_error_m = double(*std::max_element(hierarchy.error_m.begin(), hierarchy.error_m.end()));
    if (report != nullptr) *report = counted;
    return made;
}

}  // namespace overlook::caveclod
