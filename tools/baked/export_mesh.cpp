#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <nlohmann/json.hpp>

#include "formats/caveclod.h"
#include "formats/numbers.h"
#include "tools/bake/caveclod/cut.h"
#include "tools/baked/mesh_file.h"
#include "tools/baked/verbs.h"

namespace overlook::baked {
namespace {

using caveclod::CutFaces;
using caveclod::Hierarchy;
using Rgb = std::array<uint8_t, 3>;

constexpr Rgb kFree{90, 170, 90}, kSharp{240, 200, 60}, kRigid{210, 60, 50};

// Well apart for numbers beside one another: hues a golden angle apart, three brightnesses.
Rgb colour_of_number(uint32_t number) {
    double hue = double(number) * 0.61803398875;
    hue = 6 * (hue - std::floor(hue));
    double value = 0.95 - 0.2 * double(number % 3);
    auto channel = [&](double at) {
        double away = std::abs(std::fmod(hue - at + 9, 6.0) - 3);
        return uint8_t(255 * value * (0.25 + 0.75 * std::clamp(2 - away, 0.0, 1.0)));
    };
    return {channel(0), channel(2), channel(4)};
}

Rgb times(const std::array<uint8_t, 4>& a, const std::array<uint8_t, 4>& b) {
    Rgb product;
    for (size_t i = 0; i < 3; ++i) product[i] = uint8_t((unsigned(a[i]) * b[i] + 127) / 255);
    return product;
}

// A side of a face, as seen from that face.
struct Side {
    uint32_t from = 0, to = 0, group = 0, from_vertex = 0, to_vertex = 0;
    bool operator<(const Side& other) const { return std::tie(from, to) < std::tie(other.from, other.to); }
};

std::vector<Side> sorted_sides(const Hierarchy& h, const CutFaces& finest) {
    std::vector<Side> sides;
    for (size_t f = 0; f < finest.face.size(); ++f)
        for (size_t c = 0; c < 3; ++c) {
            size_t d = (c + 1) % 3;
            sides.push_back({finest.positions[f][c], finest.positions[f][d], h.face_group[finest.face[f]], finest.vertices[f][c],
                             finest.vertices[f][d]});
        }
    std::sort(sides.begin(), sides.end());
    return sides;
}

// FREE, SHARP and RIGID (Kram and Shaw 2002, 3.3) by how many boundary edges meet: borders, changes of group, seams.
std::vector<Rgb> colours_by_class(const Hierarchy& h) {
    std::vector<uint8_t> boundary_count(h.positions_m.size(), 0);
    auto count = [&](uint32_t position) { boundary_count[position] = uint8_t(std::min(boundary_count[position] + 1, 9)); };
    std::vector<Side> sides = sorted_sides(h, caveclod::faces_of(h, caveclod::Applied(h.split_count(), 1)));
    for (const Side& side : sides) {
        auto twin = std::lower_bound(sides.begin(), sides.end(), Side{side.to, side.from, 0, 0, 0});
        bool is_border = twin == sides.end() || twin->from != side.to || twin->to != side.from;
        bool is_smooth = !is_border && twin->group == side.group && twin->from_vertex == side.to_vertex &&
                         twin->to_vertex == side.from_vertex;
        if (is_smooth) continue;
        count(side.from);
        if (is_border) count(side.to);
    }
    std::vector<Rgb> colours;
    for (uint8_t boundaries : boundary_count) colours.push_back(boundaries == 0 ? kFree : boundaries == 2 ? kSharp : kRigid);
    return colours;
}

// Corners are written apart where their colours differ: by render vertex and face colour.
MeshData mesh_of(const Hierarchy& h, const CutFaces& cut, const std::string& colour) {
    MeshData mesh;
    std::vector<Rgb> by_class = colour == "class" ? colours_by_class(h) : std::vector<Rgb>{};
    std::vector<std::pair<uint64_t, uint32_t>> corners;  // (vertex, face's colour number), corner
    for (size_t f = 0; f < cut.face.size(); ++f)
        for (uint32_t c = 0; c < 3; ++c) {
            uint32_t group = h.face_group[cut.face[f]];
            uint32_t own = colour == "group"   ? group
                           : colour == "id"    ? h.group_packed[group]
                           : colour == "class" ? 0
                                               : h.group_surface[group];
            corners.emplace_back(uint64_t(cut.vertices[f][c]) << 32 | own, uint32_t(3 * f + c));
        }
    std::sort(corners.begin(), corners.end());
    mesh.indices.resize(corners.size());
    for (size_t i = 0; i < corners.size(); ++i) {
        if (i == 0 || corners[i].first != corners[i - 1].first) {
            const caveclod::RenderVertex& vertex = h.vertices[corners[i].first >> 32];
            uint32_t own = uint32_t(corners[i].first);
            glm::dvec3 at_m = h.origin_m + glm::dvec3(h.positions_m[vertex.position]);
            mesh.positions.insert(mesh.positions.end(), {at_m.x, at_m.y, at_m.z});
            Rgb rgb = colour == "group" || colour == "id" ? colour_of_number(own)
                      : colour == "class"                 ? by_class[vertex.position]
                                                          : times(h.surfaces[own].colour, vertex.colour);
            mesh.colours.insert(mesh.colours.end(), rgb.begin(), rgb.end());
        }
        mesh.indices[corners[i].second] = uint32_t(mesh.positions.size() / 3 - 1);
    }
    return mesh;
}

}  // namespace

int export_mesh(const ExportArgs& args, const container::Reader& file, const command::Common& common) {
    const char* name = "baked export";
    auto hierarchy = caveclod::read(file);
    if (!hierarchy) return command::fail(name, hierarchy.error());
    if (args.error_m < double(hierarchy->finest_error_m))
        return command::fail(name, Error{Exit::impossible,
                                         fmt::format("{}: cannot be exported within {:g} m: its positions are stored to {:g} m; "
                                                     "bake with more --position-bits",
                                                     args.file, args.error_m, double(hierarchy->finest_error_m))});
    caveclod::Applied applied(hierarchy->split_count());
    for (size_t i = 0; i < applied.size(); ++i) applied[i] = double(hierarchy->error_m[i]) > args.error_m;
    CutFaces cut = caveclod::faces_of(*hierarchy, applied);
    auto report = write_triangles(args.output, mesh_of(*hierarchy, cut, args.colour));
    if (!report) return command::fail(name, report.error());

    double stated_m = caveclod::stated_error_m(*hierarchy, applied);
    if (common.json) {
        nlohmann::ordered_json json{{"file", args.output},          {"error_m", args.error_m},
                                    {"stated_error_m", stated_m},   {"colour", args.colour},
                                    {"triangles", report->triangle_count}, {"vertices", report->vertex_count},
                                    {"bytes", report->file_bytes},  {"position_rounding_m", report->rounding_m}};
        fmt::print("{}\n", json.dump(2));
    } else {
        command::note(common, fmt::format("{}: {} of {} triangles, {} vertices, within {:.4g} m of the source both ways{}", args.output,
                                          with_commas(report->triangle_count), with_commas(hierarchy->face_positions.size()),
                                          with_commas(report->vertex_count), stated_m,
                                          report->rounding_m > 0
                                              ? fmt::format("; positions rounded by up to {:.2g} m", report->rounding_m)
                                              : ""));
    }
    return int(Exit::done);
}

}  // namespace overlook::baked
