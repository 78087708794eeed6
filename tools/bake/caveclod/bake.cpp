#include "tools/bake/caveclod/bake.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "formats/caveclod_codes.h"
#include "tools/bake/caveclod/cut.h"
#include "tools/bake/caveclod/hierarchy_rows.h"

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
    report.budgeted_floor_face_estimate = groups.budgeted_floor_face_estimate;
}

// The mesh with its positions where they will be stored, and how far that moved them: what is measured and judged from here on is
// what will be drawn.
mesh::Mesh on_grid(const mesh::Mesh& mesh, const Precision& precision, Grid& grid, double& moved_m) {
    Hierarchy positions;
    positions.positions_m = mesh.positions_m, positions.origin_m = mesh.origin_m;
    moved_m = quantise(positions, precision).position_m;
    grid = positions.grid;
    mesh::Mesh moved = mesh;
    moved.positions_m = std::move(positions.positions_m), moved.origin_m = positions.origin_m;
    return moved;
}

// [S] what each split would be stated at if no other needed it.
std::vector<float> stated_alone_m(const Hierarchy& hierarchy, const std::vector<float>& own_error_m, double displacement_m) {
    Hierarchy alone;
    alone.error_m = own_error_m;
    add_displacement(alone, displacement_m);
    for (float& error_m : alone.error_m) error_m = error_of_code(code_of_error(std::max(error_m, hierarchy.finest_error_m)));
    return alone.error_m;
}

void note_floor(const Hierarchy& hierarchy, double displacement_m, BakeReport& report) {
    glm::dvec3 low(std::numeric_limits<double>::max()), high(-low);
    for (const glm::vec3& p : hierarchy.positions_m) low = glm::min(low, glm::dvec3(p)), high = glm::max(high, glm::dvec3(p));
    report.size_m = hierarchy.positions_m.empty() ? 0 : glm::length(high - low);
    double error_m = 0.01 * report.size_m;
    report.face_count_at_one_percent = face_count_at(hierarchy, error_m);
    report.kept_at_one_percent = report.simplify.hindrances;
    std::vector<float> alone_m = stated_alone_m(hierarchy, report.simplify.own_error_m, displacement_m);
    for (uint32_t i = 0; i < hierarchy.split_count(); ++i) {
        bool is_applied = double(std::max(hierarchy.error_m[i], hierarchy.finest_error_m)) > error_m;
        Hindrance why = double(alone_m[i]) > error_m ? Hindrance::error : Hindrance::order;
        if (is_applied) ++report.kept_at_one_percent[size_t(why)];
    }
}

// The looks as they will be stored: what seams may cost is measured on what will be drawn.
void store_looks(const mesh::Mesh& mesh, const Precision& precision, Groups& groups, Quantised& quantised) {
    Hierarchy looks;
    looks.vertices = std::move(groups.vertices);
    looks.attributes = attributes_of(mesh);
    quantised = quantise(looks, precision);
    groups.vertices = std::move(looks.vertices);
}

}  // namespace

Result<Hierarchy> bake(const mesh::Mesh& mesh, const BakeOptions& options, BakeReport& report,
                       const std::function<void(double)>& progress, const std::function<void()>& on_floors) {
    report.source_face_count = mesh.faces.size();
    report.source_position_count = mesh.positions_m.size();
    auto groups = find_groups(mesh, options.groups);
    if (!groups) return tl::unexpected(groups.error());
    note_groups(*groups, report);
    on_floors();
    Quantised looks;
    if (options.simplify.seams.moves) store_looks(mesh, options.precision, *groups, looks);
    progress(kGrouped);
    Grid grid;
    double moved_m = 0;
    auto hierarchy = build_hierarchy(on_grid(mesh, options.precision, grid, moved_m), *groups, options.simplify, &report.simplify,
                                     [&](double share) { progress(kGrouped + (kBuilt - kGrouped) * share); });
    if (!hierarchy) return tl::unexpected(hierarchy.error());
    progress(kBuilt);

    canonicalise(*hierarchy);
    hierarchy->grid = grid;
    report.quantised = quantise(*hierarchy, options.precision);
    report.quantised.position_m = moved_m;
    report.quantised.normal_deg = std::max(report.quantised.normal_deg, looks.normal_deg);
    report.quantised.uv = std::max(report.quantised.uv, looks.uv);
    double displacement_m = report.quantised.position_m + options.source_rounding_m;
    add_displacement(*hierarchy, displacement_m);
    if (auto completed = complete(*hierarchy); !completed) return tl::unexpected(completed.error());
    round_errors(*hierarchy);
    note_floor(*hierarchy, displacement_m, report);
    progress(1);
    return hierarchy;
}

}  // namespace overlook::caveclod
