#include "tools/make_sample/sample_objects.h"

#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <iterator>
#include <numbers>

#include "tools/make_sample/sample_folder.h"

namespace overlook::sample {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kStep_s = 1.0 / 32;

uint32_t add_surface(mesh::Mesh& mesh, const std::string& name, const glm::vec4& colour) {
    mesh::Surface surface;
    surface.name = name, surface.base_colour = colour;
    mesh.surfaces.push_back(surface);
    return uint32_t(mesh.surfaces.size() - 1);
}

void add_face(mesh::Mesh& mesh, uint32_t surface, uint32_t a, uint32_t b, uint32_t c) {
    mesh.face_source.push_back(uint32_t(mesh.faces.size()));
    mesh.faces.push_back({a, b, c});
    mesh.face_surface.push_back(surface);
}

// A closed tube of rings x sides squares and two fans; at(share along it, angle) is where its wall stands, counterclockwise seen
// from its end.
void add_tube(mesh::Mesh& mesh, uint32_t surface, uint32_t rings, uint32_t sides,
              const std::function<glm::dvec3(double, double)>& at) {
    auto first = uint32_t(mesh.positions_m.size());
    glm::dvec3 begin_m(0), end_m(0);
    for (uint32_t ring = 0; ring <= rings; ++ring)
        for (uint32_t side = 0; side < sides; ++side) {
            glm::dvec3 place_m = at(double(ring) / rings, kTurn * side / sides);
            mesh.positions_m.emplace_back(place_m);
            if (ring == 0) begin_m += place_m / double(sides);
            if (ring == rings) end_m += place_m / double(sides);
        }
    auto begin = uint32_t(mesh.positions_m.size()), end = begin + 1, last = first + rings * sides;
    mesh.positions_m.emplace_back(begin_m);
    mesh.positions_m.emplace_back(end_m);
    for (uint32_t side = 0; side < sides; ++side) {
        uint32_t next = (side + 1) % sides;
        for (uint32_t ring = 0; ring < rings; ++ring) {
            uint32_t a = first + ring * sides + side, b = first + ring * sides + next, c = a + sides, d = b + sides;
            add_face(mesh, surface, a, b, d);
            add_face(mesh, surface, a, d, c);
        }
        add_face(mesh, surface, begin, first + next, first + side);
        add_face(mesh, surface, end, last + side, last + next);
    }
}

// A round bar from one place to another.
void add_bar(mesh::Mesh& mesh, uint32_t surface, uint32_t rings, uint32_t sides, const glm::dvec3& from_m, const glm::dvec3& to_m,
             double thickness_m) {
    glm::dvec3 along = glm::normalize(to_m - from_m);
    glm::dvec3 first = glm::normalize(glm::cross(std::abs(along.z) > 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1), along));
    glm::dvec3 second = glm::cross(along, first);
    add_tube(mesh, surface, rings, sides, [&](double share, double angle) {
        return glm::mix(from_m, to_m, share) + thickness_m / 2 * (std::cos(angle) * first + std::sin(angle) * second);
    });
}

double ground_height_m(double x_m, double y_m) {
    return 1.5 * std::sin(x_m / 17) * std::cos(y_m / 23) + 0.4 * std::sin(x_m / 5 + y_m / 7);
}

void add_ground(mesh::Mesh& mesh, uint32_t surface) {
    constexpr uint32_t kCells = 64;
    constexpr double kCell_m = 2;
    auto first = uint32_t(mesh.positions_m.size());
    for (uint32_t y = 0; y <= kCells; ++y)
        for (uint32_t x = 0; x <= kCells; ++x) {
            double x_m = kCell_m * (double(x) - kCells / 2), y_m = kCell_m * (double(y) - kCells / 2);
            mesh.positions_m.emplace_back(x_m, y_m, ground_height_m(x_m, y_m));
        }
    for (uint32_t y = 0; y < kCells; ++y)
        for (uint32_t x = 0; x < kCells; ++x) {
            uint32_t a = first + y * (kCells + 1) + x, b = a + 1, c = a + kCells + 1, d = c + 1;
            add_face(mesh, surface, a, b, d);
            add_face(mesh, surface, a, d, c);
        }
}

scene::Key key_at(double time_s, const glm::dvec3& at_m, double heading_deg, double pitch_deg) {
    return {time_s, {at_m.x, at_m.y, at_m.z}, heading_deg, pitch_deg, {}};
}

std::string obj_text_of(const mesh::Mesh& mesh, const std::string& name) {
    std::string text = fmt::format("# Written by make-sample: metres, z up.\nmtllib {}.mtl\n", name);
    auto out = std::back_inserter(text);
    for (const glm::vec3& at : mesh.positions_m) fmt::format_to(out, "v {:.5f} {:.5f} {:.5f}\n", at.x, at.y, at.z);
    for (uint32_t face = 0; face < mesh.faces.size(); ++face) {
        uint32_t surface = mesh.face_surface[face];
        if (face == 0 || surface != mesh.face_surface[face - 1]) fmt::format_to(out, "usemtl {}\n", mesh.surfaces[surface].name);
        const auto& [a, b, c] = mesh.faces[face];
        fmt::format_to(out, "f {} {} {}\n", a + 1, b + 1, c + 1);
    }
    return text;
}

std::string mtl_text_of(const mesh::Mesh& mesh) {
    std::string text = "# Written by make-sample.\n";
    for (const mesh::Surface& surface : mesh.surfaces) {
        const glm::vec4& colour = surface.base_colour;
        text +=
            fmt::format("\nnewmtl {}\nKa 0 0 0\nKd {:.2f} {:.2f} {:.2f}\nKs 0 0 0\n", surface.name, colour.r, colour.g, colour.b);
    }
    return text;
}

}  // namespace

mesh::Mesh vase_mesh() {
    constexpr uint32_t kRings = 192, kSides = 256;
    constexpr double kHeight_m = 3;
    mesh::Mesh mesh;
    add_tube(mesh, add_surface(mesh, "clay", {0.75f, 0.45f, 0.30f, 1}), kRings, kSides, [](double up, double angle) {
        double flutes = 0.03 * std::sin(24 * angle + 9 * up) * std::sin(std::numbers::pi * up);
        double radius_m = 0.55 + 0.4 * std::sin(1.1 + 5 * up) * std::sin(std::numbers::pi * (0.15 + 0.8 * up)) + flutes;
        return glm::dvec3(radius_m * std::cos(angle), radius_m * std::sin(angle), kHeight_m * (up - 0.5));
    });
    return mesh;
}

scene::Flight vase_flight() {
    constexpr int kKeys = 72;
    constexpr double kAway_m = 4.5, kUp_m = 1, kTime_s = 24;
    scene::Flight flight{kStep_s, scene::Interpolation::smooth, {}};
    double pitch_deg = -std::atan2(kUp_m, kAway_m) * 360 / kTurn;
    for (int i = 0; i <= kKeys; ++i) {
        double angle = kTurn * i / kKeys;
        glm::dvec3 at_m(-kAway_m * std::sin(angle), -kAway_m * std::cos(angle), kUp_m);
        flight.keys.push_back(key_at(kTime_s * i / kKeys, at_m, 360.0 * i / kKeys, pitch_deg));
    }
    return flight;
}

mesh::Mesh masts_mesh() {
    constexpr int kMasts = 12, kPosts = 45;
    constexpr double kSpacing_m = 8, kMast_m = 15, kMastThickness_m = 0.3, kPost_m = 1.2, kPostThickness_m = 0.06;
    mesh::Mesh mesh;
    uint32_t ground = add_surface(mesh, "ground", {0.25f, 0.45f, 0.20f, 1}),
             mast = add_surface(mesh, "mast", {0.90f, 0.04f, 0.04f, 1});
    add_ground(mesh, ground);
    auto foot_m = [](double x_m, double y_m) { return glm::dvec3(x_m, y_m, ground_height_m(x_m, y_m) - 0.5); };
    for (int i = 0; i < kMasts; ++i) {
        glm::dvec3 at_m = foot_m(kSpacing_m * (i - (kMasts - 1) / 2.0), 12 * std::sin(2.0 * i));
        add_bar(mesh, mast, 48, 12, at_m, at_m + glm::dvec3(0, 0, kMast_m + 0.5), kMastThickness_m);
    }
    auto post_m = [&](int i) { return foot_m(2 * (i - (kPosts - 1) / 2.0), -16 + 3 * std::sin(0.3 * i)); };
    for (int i = 0; i < kPosts; ++i) {
        add_bar(mesh, mast, 8, 8, post_m(i), post_m(i) + glm::dvec3(0, 0, kPost_m + 0.5), kPostThickness_m);
        for (double up_m : {0.8, 1.2})
            if (i + 1 < kPosts)
                add_bar(mesh, mast, 8, 8, post_m(i) + glm::dvec3(0, 0, up_m + 0.5), post_m(i + 1) + glm::dvec3(0, 0, up_m + 0.5),
                        kPostThickness_m);
    }
    return mesh;
}

scene::Flight masts_flight() {
    scene::Flight flight{0.25, scene::Interpolation::smooth, {}};
    flight.keys = {key_at(0, {-10, -110, 7}, 4, 0), key_at(4, {8, -65, 6}, -2, 0), key_at(8, {20, -30, 5}, -16, 4)};
    return flight;
}

Result<std::vector<std::string>> make_object(const std::string& name, const std::string& folder) {
    Result<SampleFolder> made = SampleFolder::make(folder);
    if (!made) return tl::unexpected(made.error());
    bool is_vase = name == "vase";
    mesh::Mesh mesh = is_vase ? vase_mesh() : masts_mesh();
    scene::Scene scene;
    scene.layers.resize(1);
    scene.layers[0].asset = name + ".ovl", scene.layers[0].method = "caveclod";
    std::pair<std::string, std::string> files[] = {
        {name + ".obj", obj_text_of(mesh, name)},
        {name + ".mtl", mtl_text_of(mesh)},
        {"scene.json", scene::json_from_scene(scene)},
        {"flight.json", scene::json_from_flight(is_vase ? vase_flight() : masts_flight())}};
    if (Result<void> written = made->write(files); !written) return tl::unexpected(written.error());
    return made->files();
}

}  // namespace overlook::sample
