// Thin things: how thick they are found to be, and that what is drawn of them stays thick until it is stated not to.
#include "tools/bake/caveclod/thickness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/tools/caveclod/test_meshes.h"
#include "tools/bake/caveclod/cut.h"
#include "tools/bake/caveclod/turned_faces.h"

namespace overlook::caveclod {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::infinity();

// A closed bar round the z axis from 0 to length_m: `sides` round it, its ends closed by fans.
mesh::Mesh bar(uint32_t rings, uint32_t sides, double radius_m, double length_m) {
    mesh::Mesh mesh;
    for (uint32_t ring = 0; ring <= rings; ++ring)
        for (uint32_t side = 0; side < sides; ++side) {
            double a = 2 * std::numbers::pi * side / sides;
            mesh.positions_m.emplace_back(radius_m * std::cos(a), radius_m * std::sin(a), length_m * ring / rings);
        }
    uint32_t foot = uint32_t(mesh.positions_m.size()), head = foot + 1, last = rings * sides;
    mesh.positions_m.emplace_back(0, 0, 0);
    mesh.positions_m.emplace_back(0, 0, length_m);
    for (uint32_t side = 0; side < sides; ++side) {
        uint32_t next = (side + 1) % sides;
        for (uint32_t ring = 0; ring < rings; ++ring) {
            uint32_t a = ring * sides + side, b = ring * sides + next, c = a + sides, d = b + sides;
            mesh.faces.push_back({a, b, d});
            mesh.faces.push_back({a, d, c});
        }
        mesh.faces.push_back({foot, next, side});
        mesh.faces.push_back({head, last + side, last + next});
    }
    test::finish(mesh);
    return mesh;
}

void append(mesh::Mesh& mesh, const mesh::Mesh& other) {
    uint32_t first = uint32_t(mesh.positions_m.size());
    mesh.positions_m.insert(mesh.positions_m.end(), other.positions_m.begin(), other.positions_m.end());
    for (mesh::Corners face : other.faces) {
        for (uint32_t& p : face) p += first;
        mesh.face_source.push_back(uint32_t(mesh.faces.size()));
        mesh.face_surface.push_back(0);
        mesh.faces.push_back(face);
    }
}

// [P] in the mesh's own order.
std::vector<float> thicknesses(const mesh::Mesh& mesh, double most_m = 1e300) {
    Groups groups = *find_groups(mesh, {});
    WorkingMesh working = *make_working_mesh(mesh, groups);
    std::vector<std::array<uint32_t, 3>> faces;
    for (const WorkingFace& face : working.faces) faces.push_back({face.position[0], face.position[1], face.position[2]});
    SourceParts source(working.positions_m, faces);
    std::vector<float> found = thickness_of_positions(working, source, turn_slack_m(working.positions_m), most_m),
                       in_order(found.size());
    for (size_t p = 0; p < found.size(); ++p) in_order[working.source_position[p]] = found[p];
    return in_order;
}

Hierarchy baked(const mesh::Mesh& mesh) {
    SimplifyOptions options;
    options.keeps_thin = true;
    return *build_hierarchy(mesh, *find_groups(mesh, {}), options);
}

// All splits above a stated error, and no more.
Applied applied_above(const Hierarchy& h, double error_m) {
    Applied applied(h.split_count());
    for (uint32_t i = 0; i < h.split_count(); ++i) applied[i] = double(h.error_m[i]) > error_m;
    return applied;
}

// The least width, over all directions across the z axis, of a cut's section at a height. 0 where it has none.
double least_width_m(const Hierarchy& h, const CutFaces& cut, double height_m) {
    std::vector<glm::dvec2> crossings;
    for (const auto& f : cut.positions)
        for (size_t c = 0; c < 3; ++c) {
            glm::dvec3 a(h.positions_m[f[c]]), b(h.positions_m[f[(c + 1) % 3]]);
            if ((a.z < height_m) != (b.z < height_m)) crossings.emplace_back(glm::mix(a, b, (height_m - a.z) / (b.z - a.z)));
        }
    double least_m = crossings.empty() ? 0 : 1e300;
    for (int i = 0; i < 180 && !crossings.empty(); ++i) {
        double a = std::numbers::pi * i / 180, low = 1e300, high = -1e300;
        for (const glm::dvec2& p : crossings) {
            double along = p.x * std::cos(a) + p.y * std::sin(a);
            low = std::min(low, along), high = std::max(high, along);
        }
        least_m = std::min(least_m, high - low);
    }
    return least_m;
}

double least_width_m(const Hierarchy& h, double error_m, double length_m) {
    CutFaces cut = faces_of(h, applied_above(h, error_m));
    double least_m = 1e300;
    for (int i = 5; i < 96; ++i) least_m = std::min(least_m, least_width_m(h, cut, length_m * (i + 0.37) / 100));
    return least_m;
}

TEST(Thickness, OfABarIsItsDiameter) {
    for (uint32_t sides : {8u, 9u, 12u}) {
        std::vector<float> found = thicknesses(bar(6, sides, 0.5, 20));
        double apothem_m = 0.5 * std::cos(std::numbers::pi / sides);
        for (uint32_t p = sides; p < 6 * sides; ++p) {
            EXPECT_LE(found[p], 1 + 1e-6) << sides << ", " << p;
            EXPECT_GE(found[p], 0.5 + apothem_m - 1e-6) << sides << ", " << p;
        }
        EXPECT_NEAR(found[7 * sides], 20, 1e-5) << "seen from the middle of an end it is as thick as it is long";
    }
}

TEST(Thickness, OfASphereIsItsDiameterAndOfOpenSurfacesNotKnown) {
    for (float thickness_m : thicknesses(test::sphere(32, 16))) EXPECT_NEAR(thickness_m, 2, 0.03);
    for (float thickness_m : thicknesses(test::grid(20, 20, test::rough_m))) EXPECT_EQ(thickness_m, kUnknown);
}

TEST(Thickness, IsOfEachPieceAlone) {
    mesh::Mesh mesh = bar(2, 12, 0.5, 20), thin = bar(2, 12, 0.1, 20);
    append(mesh, thin);
    std::vector<float> found = thicknesses(mesh);
    EXPECT_NEAR(found[12], 1, 1e-5) << "the wall of the thin one within looks away as well";
    EXPECT_NEAR(found[mesh.positions_m.size() / 2 + 12], 0.2, 1e-5);
}

TEST(Thickness, IsNotKnownWhereTheWallIsNotLookedAtFromWithin) {
    // The ray straight down from the middle of the upper end leaves through a wall that leans by 17 degrees.
    mesh::Mesh leaning = bar(6, 12, 0.5, 20);
    for (glm::vec3& p : leaning.positions_m) p.x += 0.3f * p.z;
    std::vector<float> found = thicknesses(leaning);
    EXPECT_EQ(found[7 * 12 + 1], kUnknown);
    EXPECT_LT(found[3 * 12], 1.01f);
}

TEST(Thickness, IsNotLookedForBeyondWhatIsAskedFor) {
    std::vector<float> found = thicknesses(bar(6, 12, 0.5, 20), 2);
    EXPECT_EQ(found[7 * 12], kUnknown) << "along the bar";
    EXPECT_LE(found[3 * 12], 1.001f) << "across";
}

TEST(ThinThings, StayThickUntilTheyAreStatedNotTo) {
    uint32_t thinned_count = 0;
    for (uint32_t sides : {6u, 8u, 9u, 10u, 12u, 24u}) {
        constexpr double kRadius_m = 0.15, kLength_m = 60;
        Hierarchy h = baked(bar(16, sides, kRadius_m, kLength_m));
        // A third of a radius, weighted. From a corner to the wall over against it are two radii, or, where sides are odd and
        // that wall is a side, one and an apothem: what takes a third of that is stated at so many times as much.
        double thinned_m = kThinningWeight * kMostThinning * kRadius_m;
        double thickness = sides % 2 == 0 ? 2 : 1 + std::cos(std::numbers::pi / sides);
        for (double error_m : {0.5 * kRadius_m, kRadius_m, 2 * kRadius_m, thinned_m, 1.9 * thinned_m}) {
            EXPECT_GE(least_width_m(h, error_m, kLength_m), kRadius_m) << sides << " sides, " << error_m;
            EXPECT_LE(faces_of(h, applied_above(h, error_m)).face.size(), 40u) << "and yet few triangles: " << sides;
        }
        // Of every cut, down to the coarsest, which may be thick as well.
        bool is_thinned = false;
        for (float error_m : h.error_m) {
            Applied applied = applied_above(h, double(error_m));
            if (least_width_m(h, faces_of(h, applied), kLength_m / 2) >= kRadius_m) continue;
            is_thinned = true;
            EXPECT_GE(stated_error_m(h, applied), thickness * thinned_m * (1 - 1e-6)) << sides << " sides, " << error_m;
        }
        thinned_count += is_thinned;
    }
    EXPECT_GE(thinned_count, 4u) << "or there would be nothing to state";
}

// Of all that is not thin beside the whole mesh, what is stated stays as tight as it was.
TEST(ThinThings, AreThoseThatAreThinBesideTheMesh) {
    constexpr double kRadius_m = 0.15;
    for (double length_m : {20.0, 60.0}) {
        Hierarchy h = baked(bar(16, 12, kRadius_m, length_m));
        double stated_m = double(*std::max_element(h.error_m.begin(), h.error_m.end()));
        bool is_thin = 2 * kRadius_m < kThinnestShare * length_m;
        EXPECT_EQ(stated_m > 2 * kThinningWeight * kMostThinning * kRadius_m, is_thin) << stated_m;
        EXPECT_LE(stated_m, is_thin ? 1e300 : 3 * kRadius_m);
    }
}

}  // namespace
}  // namespace overlook::caveclod
