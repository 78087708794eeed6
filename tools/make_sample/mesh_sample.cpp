#include "tools/make_sample/mesh_sample.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include "tools/bake/caveclod/groups.h"
#include "tools/make_sample/flight_lift.h"
#include "tools/make_sample/sample_folder.h"

namespace overlook::sample {
namespace {

constexpr double kStep_s = 1.0 / 32;

scene::Scene scene_of(const std::string& name) {
    scene::Scene made;
    scene::Layer layer;
    layer.asset = name + ".ovl";
    layer.method = "caveclod";
    made.layers.push_back(layer);
    return made;
}

void append_corner(std::string& text, const mesh::Mesh& mesh, size_t face, size_t corner) {
    fmt::format_to(std::back_inserter(text), " {}/{}/{}", mesh.faces[face][corner] + 1, mesh.face_uvs[face][corner] + 1,
                   mesh.face_normals[face][corner] + 1);
}

}  // namespace

scene::Flight mesh_flight(const MeshGrid& grid, const std::vector<Waypoint>& waypoints, double pitch_deg) {
    const glm::dvec3 &first = grid.positions_m.front(), &last = grid.positions_m.back();
    auto ground_m = [&](double x_m, double y_m) { return height_m(grid, x_m, y_m); };
    scene::Flight flight{kStep_s, scene::Interpolation::smooth, {}};
    for (size_t i = 0; i < waypoints.size(); ++i) {
        const Waypoint &at = waypoints[i], &before = waypoints[i > 0 ? i - 1 : 0],
                       &after = waypoints[std::min(i + 1, waypoints.size() - 1)];
        scene::Key key;
        key.time_s = kMeshFlight_s * double(i) / double(waypoints.size() - 1);
        double x_m = first.x + at.east * (last.x - first.x), y_m = first.y + at.south * (last.y - first.y);
        key.position_m = {std::round(x_m), std::round(y_m), std::ceil(ground_m(x_m, y_m) + at.above_m)};
        double east_m = (after.east - before.east) * (last.x - first.x),
               north_m = (after.south - before.south) * (last.y - first.y);
        key.heading_deg = std::round(std::atan2(east_m, north_m) * 57.29577951308232);
        key.pitch_deg = pitch_deg;
        flight.keys.push_back(key);
    }
    lift(flight, ground_m, kMeshClearance_m);
    return flight;
}

std::string obj_text(const mesh::Mesh& mesh, const std::string& material_library) {
    std::string text = fmt::format("# Written by make-sample: metres, z up.\nmtllib {}\n", material_library);
    auto out = std::back_inserter(text);
    for (const glm::vec3& at : mesh.positions_m) fmt::format_to(out, "v {:.2f} {:.2f} {:.2f}\n", at.x, at.y, at.z);
    for (const glm::vec2& uv : mesh.uvs) fmt::format_to(out, "vt {:.5f} {:.5f}\n", uv.x, 1 - uv.y);
    for (const glm::vec3& normal : mesh.normals) fmt::format_to(out, "vn {:.5f} {:.5f} {:.5f}\n", normal.x, normal.y, normal.z);
    for (uint32_t surface = 0; surface < mesh.surfaces.size(); ++surface) {
        fmt::format_to(out, "usemtl {}\n", mesh.surfaces[surface].name);
        for (size_t face = 0; face < mesh.faces.size(); ++face) {
            if (mesh.face_surface[face] != surface) continue;
            text += 'f';
            for (size_t corner = 0; corner < 3; ++corner) append_corner(text, mesh, face, corner);
            text += '\n';
        }
    }
    return text;
}

std::string mtl_text(const mesh::Mesh& mesh) {
    std::string text = "# Written by make-sample.\n";
    for (const mesh::Surface& surface : mesh.surfaces)
        text += fmt::format("\nnewmtl {}\nKa 0 0 0\nKd 1 1 1\nKs 0 0 0\nmap_Kd {}\n", surface.name, surface.texture);
    return text;
}

Result<MeshSampleReport> write_mesh_sample(const MeshSample& sample, const std::string& folder) {
    Result<caveclod::Groups> groups = caveclod::find_groups(sample.mesh, {});
    if (!groups) return tl::unexpected(groups.error());
    Result<SampleFolder> made = SampleFolder::make(folder);
    if (!made) return tl::unexpected(made.error());

    MeshSampleReport report;
    report.position_count = sample.mesh.positions_m.size();
    report.face_count = sample.mesh.faces.size();
    report.group_count = groups->group_surface.size();
    report.packed_count = groups->packed_count;
    report.dense_population = groups->dense_population;
    std::vector<std::pair<std::string, std::string>> texts = {{sample.name + ".obj", obj_text(sample.mesh, sample.name + ".mtl")},
                                                              {sample.name + ".mtl", mtl_text(sample.mesh)},
                                                              {"recipe.toml", sample.recipe},
                                                              {"scene.json", scene::json_from_scene(scene_of(sample.name))}};
    for (size_t i = 0; i < sample.flights.size(); ++i)
        texts.emplace_back(fmt::format("flight-{}.json", "abcd"[i]), scene::json_from_flight(sample.flights[i]));
    if (Result<void> written = made->write(texts); !written) return tl::unexpected(written.error());
    for (const mesh::Surface& surface : sample.mesh.surfaces)
        if (Result<void> written = made->write(surface.texture, std::as_bytes(std::span(surface.texture_bytes))); !written)
            return tl::unexpected(written.error());
    report.files = made->files();
    return report;
}

}  // namespace overlook::sample
