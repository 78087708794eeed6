#include "tools/bake/caveclod/bake.h"

namespace overlook::caveclod {
namespace {

constexpr double kGrouped = 0.05, kBuilt = 0.85;  // shares of the time, about

void note_groups(const Groups& groups, BakeReport& report) {
    report.free_count = groups.free_count;
    report.sharp_count = groups.sharp_count;
    report.rigid_count = groups.rigid_count;
    report.group_count = groups.group_surface.size();
    report.packed_count = groups.packed_count;
    report.clique_bound = groups.clique_bound;
    report.dense_population = groups.dense_population;
    report.dense_bytes = groups.dense_bytes;
    report.rows_bytes = groups.rows_bytes;
    report.floor_face_estimate = groups.floor_face_estimate;
}

}  // namespace

Result<Hierarchy> bake(const mesh::Mesh& mesh, const BakeOptions& options, BakeReport& report,
                       const std::function<void(double)>& progress) {
    report.source_face_count = mesh.faces.size();
    report.source_position_count = mesh.positions_m.size();
    auto groups = find_groups(mesh, options.groups);
    if (!groups) return tl::unexpected(groups.error());
    note_groups(*groups, report);
    progress(kGrouped);
    auto hierarchy = build_hierarchy(mesh, *groups, options.simplify, &report.simplify);
    if (!hierarchy) return tl::unexpected(hierarchy.error());
    progress(kBuilt);

    canonicalise(*hierarchy);
    report.quantised = quantise(*hierarchy, options.precision);
    add_displacement(*hierarchy, report.quantised.position_m + options.source_rounding_m);
    if (auto completed = complete(*hierarchy); !completed) return tl::unexpected(completed.error());
    round_errors(*hierarchy);
    progress(1);
    return hierarchy;
}

}  // namespace overlook::caveclod
