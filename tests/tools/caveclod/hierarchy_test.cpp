// What the hierarchy must be, on meshes whose answer is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "formats/parallel.h"
#include "tests/tools/caveclod/test_meshes.h"
#include "tools/bake/caveclod/cut.h"

namespace overlook::caveclod {
namespace {

double flat_m(double, double) {
    return 0;
}

Hierarchy baked(const mesh::Mesh& mesh, double crease_deg = 180, SimplifyReport* report = nullptr) {
    GroupOptions options;
    options.crease_deg = crease_deg;
    auto groups = find_groups(mesh, options);
    EXPECT_TRUE(groups.has_value());
    auto hierarchy = build_hierarchy(mesh, *groups, {}, report);
    EXPECT_TRUE(hierarchy.has_value()) << hierarchy.error().message;
    return std::move(*hierarchy);
}

struct Named {
    std::string name;
    mesh::Mesh mesh;
    double crease_deg = 180;
};

std::vector<Named> all_meshes() {
    std::vector<Named> meshes;
    meshes.push_back({"plane", test::grid(20, 20, flat_m)});
    meshes.push_back({"terrain", test::grid(40, 30, test::rough_m)});
    meshes.push_back({"creased terrain", test::grid(40, 40, test::rough_m), 12});
    meshes.push_back({"sphere", test::sphere(30, 15)});
    meshes.push_back({"bumpy sphere", test::sphere(60, 30, 0.05)});
    meshes.push_back({"torus", test::torus(40, 16, 1, 0.3)});
    meshes.push_back({"cylinder", test::seamed_cylinder(32, 12)});
    meshes.push_back({"cube", test::cube(8), 40});
    return meshes;
}

// Everything drawn at a corner.
using Corner = std::tuple<float, float, float, float, float, float, float, float>;
Corner corner_of(const glm::vec3& p, const RenderVertex& v) {
    return {p.x, p.y, p.z, v.normal.x, v.normal.y, v.normal.z, v.uv.x, v.uv.y};
}

using Face = std::array<Corner, 3>;
Face turned(Face face) {
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    return face;
}

std::multiset<Face> source_faces(const mesh::Mesh& mesh, const Groups& groups) {
    std::multiset<Face> faces;
    for (size_t f = 0; f < mesh.faces.size(); ++f) {
        Face face;
        for (size_t c = 0; c < 3; ++c)
            face[c] = corner_of(mesh.positions_m[mesh.faces[f][c]], groups.vertices[groups.face_vertices[f][c]]);
        faces.insert(turned(face));
    }
    return faces;
}

std::multiset<Face> cut_faces(const Hierarchy& h, const CutFaces& cut) {
    std::multiset<Face> faces;
    for (size_t f = 0; f < cut.face.size(); ++f) {
        Face face;
        for (size_t c = 0; c < 3; ++c) face[c] = corner_of(h.positions_m[cut.positions[f][c]], h.vertices[cut.vertices[f][c]]);
        faces.insert(turned(face));
    }
    return faces;
}

// Every edge has one or two faces, and two run along it in opposite directions; each position's faces form one fan.
std::string broken_surface(const CutFaces& cut) {
    std::map<std::pair<uint32_t, uint32_t>, int> directed;
    std::map<uint32_t, std::map<uint32_t, uint32_t>> after;
    for (const auto& f : cut.positions)
        for (size_t c = 0; c < 3; ++c) {
            if (++directed[{f[c], f[(c + 1) % 3]}] > 1) return "two faces run along an edge the same way";
            after[f[c]][f[(c + 1) % 3]] = f[(c + 2) % 3];
        }
    for (const auto& [position, next] : after) {
        std::set<uint32_t> ends;
        for (auto [from, to] : next) ends.insert(to);
        uint32_t start = next.begin()->first;
        for (auto [from, to] : next)
            if (!ends.contains(from)) start = from;
        size_t steps = 0;
        for (auto at = next.find(start); at != next.end() && steps < next.size(); at = next.find(at->second)) ++steps;
        if (steps != next.size()) return "the faces at a position are not one fan";
    }
    return "";
}

TEST(Hierarchy, KeepsEveryLawOnEveryMesh) {
    for (const Named& named : all_meshes()) {
        Hierarchy h = baked(named.mesh, named.crease_deg);
        EXPECT_EQ(broken_law(h), "") << named.name;
        EXPECT_GT(h.split_count(), 0u) << named.name;
    }
}

TEST(Hierarchy, IsTheSourceAtItsFinestCut) {
    for (const Named& named : all_meshes()) {
        GroupOptions options;
        options.crease_deg = named.crease_deg;
        auto groups = find_groups(named.mesh, options);
        auto h = build_hierarchy(named.mesh, *groups, {});
        Applied all(h->split_count(), 1);
        EXPECT_EQ(cut_faces(*h, faces_of(*h, all)), source_faces(named.mesh, *groups)) << named.name;
        EXPECT_EQ(stated_error_m(*h, all), 0) << named.name;
    }
}

TEST(Hierarchy, KeepsASurfaceInEveryRandomCut) {
    for (const Named& named : all_meshes()) {
        Hierarchy h = baked(named.mesh, named.crease_deg);
        for (uint64_t seed = 0; seed < 40; ++seed) {
            Applied applied = random_cut(h, named.mesh.faces.size() >> (seed % 9), seed);
            ASSERT_TRUE(is_legal(h, applied));
            EXPECT_EQ(broken_surface(faces_of(h, applied)), "") << named.name << ", seed " << seed;
        }
    }
}

TEST(Hierarchy, DrawsOnlyCornersThatTheSourceHasThere) {
    for (const Named& named : all_meshes()) {
        GroupOptions options;
        options.crease_deg = named.crease_deg;
        auto groups = find_groups(named.mesh, options);
        auto h = build_hierarchy(named.mesh, *groups, {});
        std::set<std::pair<uint32_t, Corner>> known;
        for (size_t f = 0; f < named.mesh.faces.size(); ++f)
            for (size_t c = 0; c < 3; ++c)
                known.insert({groups->face_group[f], corner_of(named.mesh.positions_m[named.mesh.faces[f][c]],
                                                               groups->vertices[groups->face_vertices[f][c]])});
        for (uint64_t seed = 0; seed < 20; ++seed) {
            CutFaces cut = faces_of(*h, random_cut(*h, named.mesh.faces.size() >> (seed % 9), seed));
            for (size_t f = 0; f < cut.face.size(); ++f)
                for (size_t c = 0; c < 3; ++c) {
                    Corner corner = corner_of(h->positions_m[cut.positions[f][c]], h->vertices[cut.vertices[f][c]]);
                    EXPECT_TRUE(known.contains({h->face_group[cut.face[f]], corner})) << named.name;
                }
        }
    }
}

TEST(Hierarchy, CollapsesAPlaneToItsOutlineWithoutError) {
    mesh::Mesh plane = test::grid(30, 30, flat_m);
    Hierarchy h = baked(plane);
    // The four corners may go as well, at an error; down to two triangles nothing is lost.
    Applied applied(h.split_count(), 0);
    for (uint32_t i = 0; i < h.split_count(); ++i) applied[i] = h.error_m[i] > 1e-6f;
    EXPECT_TRUE(is_legal(h, applied));
    EXPECT_EQ(faces_of(h, applied).face.size(), 2u);
}

TEST(Hierarchy, NeverLosesTheCornersOfACube) {
    Hierarchy h = baked(test::cube(10), 40);
    Applied none(h.split_count(), 0);
    CutFaces coarsest = faces_of(h, none);
    EXPECT_EQ(coarsest.face.size(), 12u);
    EXPECT_LT(stated_error_m(h, none), 1e-6);
    std::set<std::tuple<float, float, float>> corners;
    for (const auto& f : coarsest.positions)
        for (uint32_t p : f) corners.insert({h.positions_m[p].x, h.positions_m[p].y, h.positions_m[p].z});
    EXPECT_EQ(corners.size(), 8u);
}

// Across the seam texture coordinate 1 meets 0: a face that crossed it would have both, and stretch the texture backwards.
TEST(Hierarchy, KeepsTheSeamOfACylinder) {
    Hierarchy h = baked(test::seamed_cylinder(48, 20));
    for (uint64_t seed = 0; seed < 30; ++seed) {
        CutFaces cut = faces_of(h, random_cut(h, 1920u >> (seed % 7), seed));
        double area = 0;
        for (const auto& f : cut.vertices) {
            glm::dvec2 a(h.vertices[f[0]].uv), b(h.vertices[f[1]].uv), c(h.vertices[f[2]].uv);
            double turned_area = ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
            EXPECT_GE(turned_area, 0);
            area += turned_area;
        }
        EXPECT_NEAR(area, 1, 1e-6) << "the unit square of the texture is not covered once, seed " << seed;
    }
}

TEST(Hierarchy, IsTheSameForAnyThreadCount) {
    mesh::Mesh mesh = test::sphere(90, 45, 0.03);
    set_thread_count(1);
    Hierarchy one = baked(mesh);
    for (unsigned threads : {2u, 3u, 7u}) {
        set_thread_count(threads);
        Hierarchy other = baked(mesh);
        EXPECT_EQ(one.positions_m, other.positions_m);
        EXPECT_EQ(one.owner, other.owner);
        EXPECT_EQ(one.error_m, other.error_m);
        EXPECT_EQ(one.needs, other.needs);
        EXPECT_EQ(one.moved, other.moved);
        EXPECT_EQ(one.moved_back_wedge, other.moved_back_wedge);
        EXPECT_EQ(one.face_positions, other.face_positions);
        EXPECT_EQ(one.vertices, other.vertices);
    }
    set_thread_count(0);
}

TEST(Hierarchy, IsShallow) {
    SimplifyReport report;
    mesh::Mesh mesh = test::sphere(160, 80, 0.02);
    baked(mesh, 180, &report);
    EXPECT_LE(report.depth, 5 * std::log2(double(mesh.faces.size())));
    EXPECT_LE(double(report.need_count), 3.0 * double(report.collapse_count));
}

TEST(Hierarchy, RefusesAMeshThatIsNoSurface) {
    mesh::Mesh mesh = test::grid(2, 2, flat_m);
    auto groups = find_groups(mesh, {});
    mesh.faces[3] = mesh.faces[2];
    auto h = build_hierarchy(mesh, *groups, {});
    ASSERT_FALSE(h.has_value());
    EXPECT_EQ(h.error().exit, Exit::bad_input);
    EXPECT_EQ(h.error().message,
              "face 3 cannot be added: an edge of it has two faces already, or the faces at a corner are no fan");
}

TEST(Hierarchy, RefusesAPositionWithoutAFace) {
    mesh::Mesh mesh = test::grid(2, 2, flat_m);
    mesh.positions_m.emplace_back(5, 5, 5);
    auto groups = find_groups(mesh, {});
    auto h = build_hierarchy(mesh, *groups, {});
    ASSERT_FALSE(h.has_value());
    EXPECT_EQ(h.error().message, "position 9 is no corner of any face");
}

TEST(Hierarchy, StopsAtTheFaceCountAskedFor) {
    mesh::Mesh mesh = test::sphere(30, 15);
    auto groups = find_groups(mesh, {});
    SimplifyOptions options;
    options.least_face_count = 300;
    auto h = build_hierarchy(mesh, *groups, options);
    EXPECT_LE(h->base_face_count, 300u);
    EXPECT_GE(h->base_face_count, 298u);
    EXPECT_EQ(broken_law(*h), "");
}

TEST(Hierarchy, OfComponentsKeepsEachOfThem) {
    mesh::Mesh mesh = test::sphere(8, 5);
    uint32_t position_count = uint32_t(mesh.positions_m.size()), face_count = uint32_t(mesh.faces.size());
    for (uint32_t copy = 1; copy < 60; ++copy) {
        for (uint32_t p = 0; p < position_count; ++p) mesh.positions_m.push_back(mesh.positions_m[p] + glm::vec3(3 * copy, 0, 0));
        for (uint32_t f = 0; f < face_count; ++f) {
            mesh::Corners face = mesh.faces[f];
            for (uint32_t& p : face) p += copy * position_count;
            mesh.faces.push_back(face);
        }
    }
    mesh.face_surface.assign(mesh.faces.size(), 0);
    Hierarchy h = baked(mesh);
    EXPECT_EQ(broken_law(h), "");
    EXPECT_EQ(broken_surface(faces_of(h, Applied(h.split_count(), 0))), "");
    EXPECT_GE(h.base_face_count, 60u * 4) << "no component may vanish: nothing would stand where it was";
}

TEST(Hierarchy, LeavesWhatMayNotBeCollapsed) {
    for (uint32_t n : {1u, 2u}) {
        mesh::Mesh mesh = test::grid(n, 1, flat_m);
        Hierarchy h = baked(mesh);
        EXPECT_EQ(broken_law(h), "");
        EXPECT_GE(h.base_face_count, 1u);
    }
}

TEST(HierarchyLaws, AreNoticedWhenBroken) {
    Hierarchy good = baked(test::grid(12, 12, test::rough_m));
    ASSERT_EQ(broken_law(good), "");
    auto breaks = [&](const std::function<void(Hierarchy&)>& change) {
        Hierarchy bad = good;
        change(bad);
        return !broken_law(bad).empty();
    };
    uint32_t with_needs = 0;
    while (good.need_begin[with_needs] == good.need_begin[with_needs + 1]) ++with_needs;
    EXPECT_TRUE(breaks([&](Hierarchy& h) { h.error_m[with_needs] = 1e9f; }));
    EXPECT_TRUE(breaks([&](Hierarchy& h) { h.needs.clear(), h.need_begin.assign(h.owner.size() + 1, 0); }));
    EXPECT_TRUE(breaks([](Hierarchy& h) { h.moved[0] ^= 1u; }));
    EXPECT_TRUE(breaks([](Hierarchy& h) { h.owner[5] = h.new_position(5); }));
    EXPECT_TRUE(breaks([](Hierarchy& h) { h.birth_wedge[0] = 7; }));
    EXPECT_TRUE(breaks([](Hierarchy& h) { h.face_positions.back()[0] = h.face_positions.back()[1]; }));
}

}  // namespace
}  // namespace overlook::caveclod
