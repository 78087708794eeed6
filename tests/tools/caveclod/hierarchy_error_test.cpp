// The stated error is an upper bound of the two-sided distance to the source, for every legal cut.
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "tests/tools/caveclod/test_meshes.h"
#include "tools/bake/caveclod/cut.h"
#include "tools/bake/caveclod/prove_cuts.h"
#include "tools/bake/caveclod/turned_faces.h"

namespace overlook::caveclod {
namespace {

struct Baked {
    mesh::Mesh mesh;
    Hierarchy hierarchy;
    double size_m = 0;
};

Baked bake(mesh::Mesh mesh, double crease_deg = 180) {
    GroupOptions options;
    options.crease_deg = crease_deg;
    auto groups = find_groups(mesh, options);
    auto hierarchy = build_hierarchy(mesh, *groups, {});
    EXPECT_TRUE(hierarchy.has_value());
    glm::dvec3 low(1e300), high(-1e300);
    for (const glm::vec3& p : mesh.positions_m) low = glm::min(low, glm::dvec3(p)), high = glm::max(high, glm::dvec3(p));
    return {std::move(mesh), std::move(*hierarchy), glm::length(high - low)};
}

TriangleTree tree_of_cut(const Hierarchy& h, const Applied& applied) {
    return TriangleTree(test::triangles_of(h.positions_m, faces_of(h, applied).positions));
}

TEST(StatedError, IsNeverBelowTheDistanceOfARandomCut) {
    std::vector<Baked> all;
    all.push_back(bake(test::grid(60, 50, test::rough_m)));
    all.push_back(bake(test::grid(40, 40, test::rough_m), 12));
    all.push_back(bake(test::sphere(70, 35, 0.05)));
    all.push_back(bake(test::torus(60, 24, 1, 0.3)));
    all.push_back(bake(test::seamed_cylinder(48, 24)));
    for (const Baked& baked : all) {
        TriangleTree source(test::triangles_of(baked.mesh.positions_m, baked.mesh.faces));
        std::vector<double> ratios;
        for (uint64_t seed = 0; seed < 40; ++seed) {
            double share = 0.001 * std::pow(500.0, double(seed % 10) / 9);
            Applied applied = random_cut(baked.hierarchy, uint64_t(double(baked.mesh.faces.size()) * share) + 1, seed);
            double stated_m = stated_error_m(baked.hierarchy, applied);
            Distance measured =
                two_sided_distance(tree_of_cut(baked.hierarchy, applied), source, 0.05, 1e-6 * baked.size_m, 2000);
            EXPECT_LE(measured.least_m, stated_m * (1 + 1e-6) + 1e-7 * baked.size_m) << "seed " << seed;
            ratios.push_back(stated_m / std::max(measured.least_m, 1e-6 * baked.size_m));
        }
        std::sort(ratios.begin(), ratios.end());
        EXPECT_LE(ratios[ratios.size() / 2], 1.1) << "the bound is proven, and it is also tight";
    }
}

// So small that costs come to nothing in floats, down to all in one place: what waits must come to its turn all the same.
TEST(Passes, EndWhereAMeshIsTooSmallToHaveASize) {
    std::mt19937 random(9);
    for (float size_m : {1e-19f, 1e-30f, 1e-38f, 1e-42f, 0.0f}) {
        mesh::Mesh mesh = test::grid(12, 12, [](double, double) { return 0.0; });
        for (glm::vec3& p : mesh.positions_m) {
            p *= size_m;
            mesh.colours.push_back({uint8_t(random()), uint8_t(random()), uint8_t(random()), 255});
        }
        mesh.face_colours = mesh.faces;
        Baked baked = bake(std::move(mesh));
        EXPECT_EQ(broken_law(baked.hierarchy), "") << size_m;
        EXPECT_GT(baked.hierarchy.split_count(), 100u) << size_m;
    }
}

// A bound that is halved must be found broken, or the test above could not fail.
TEST(StatedError, IsFoundBrokenWhenHalved) {
    Baked baked = bake(test::sphere(60, 30, 0.03));
    TriangleTree source(test::triangles_of(baked.mesh.positions_m, baked.mesh.faces));
    Applied applied = random_cut(baked.hierarchy, 200, 3);
    Distance measured = two_sided_distance(tree_of_cut(baked.hierarchy, applied), source, 0.05, 1e-6, 2000);
    EXPECT_GT(measured.least_m, stated_error_m(baked.hierarchy, applied) / 2);
}

TEST(CutsProof, HoldsForTwoThousandCuts) {
    std::vector<Baked> all;
    all.push_back(bake(test::grid(30, 25, test::rough_m)));
    all.push_back(bake(test::grid(24, 24, test::rough_m), 12));
    all.push_back(bake(test::sphere(36, 18, 0.05)));
    all.push_back(bake(test::torus(32, 16, 1, 0.3)));
    for (const Baked& baked : all) {
        ProofOptions options;
        options.cut_count = 500;
        options.least_share = 0.005;
        options.steps = 100;
        CutsProof proof = prove_cuts(baked.hierarchy, options);
        EXPECT_EQ(proof.cut_count, 500u);
        EXPECT_EQ(proof.broken_count, 0u) << "first with seed " << proof.first_broken_seed;
        EXPECT_EQ(proof.turned_count, 0u) << "of " << proof.face_count;
        EXPECT_LE(proof.greatest_measured_share, 1 + 1e-5);
        // Over the first, collapses that would turn a face are left out; what is done instead is bounded less tightly: 1.133.
        EXPECT_LE(proof.median_stated_over_measured, &baked == &all[0] ? 1.15 : 1.1);
    }
}

TEST(CutsProof, NoticesErrorsThatAreTooSmall) {
    Baked baked = bake(test::sphere(36, 18, 0.05));
    for (float& error_m : baked.hierarchy.error_m) error_m *= 0.8f;
    ProofOptions options;
    options.cut_count = 20;
    CutsProof proof = prove_cuts(baked.hierarchy, options);
    EXPECT_GT(proof.broken_count, 10u);
    EXPECT_GT(proof.greatest_measured_share, 1.2);
}

TEST(StatedError, HoldsAfterPositionsHaveMoved) {
    Baked baked = bake(test::sphere(60, 30, 0.03));
    TriangleTree source(test::triangles_of(baked.mesh.positions_m, baked.mesh.faces));
    double step_m = 0.01, moved_m = 0;
    for (glm::vec3& p : baked.hierarchy.positions_m) {
        glm::dvec3 rounded = glm::round(glm::dvec3(p) / step_m) * step_m;
        moved_m = std::max(moved_m, glm::length(glm::dvec3(glm::vec3(rounded)) - glm::dvec3(p)));
        p = glm::vec3(rounded);
    }
    add_displacement(baked.hierarchy, moved_m);
    for (uint64_t seed = 0; seed < 12; ++seed) {
        Applied applied =
            seed == 0 ? Applied(baked.hierarchy.split_count(), 1) : random_cut(baked.hierarchy, 3600 >> (seed % 6), seed);
        Distance measured = two_sided_distance(tree_of_cut(baked.hierarchy, applied), source, 0.05, 1e-6, 2000);
        EXPECT_LE(measured.least_m, stated_error_m(baked.hierarchy, applied) * (1 + 1e-6)) << seed;
        EXPECT_GT(measured.least_m, 0);
    }
}

// The sagitta of a regular n-gon inscribed in the circle is the least that any n chords leave.
TEST(StatedError, OfACylinderIsThatOfItsChords) {
    Baked baked = bake(test::seamed_cylinder(64, 2));
    for (uint32_t chords : {32u, 16u, 8u}) {
        double sagitta_m = 1 - std::cos(std::numbers::pi / chords);
        Applied applied(baked.hierarchy.split_count());
        for (size_t i = 0; i < applied.size(); ++i) applied[i] = double(baked.hierarchy.error_m[i]) > sagitta_m * 1.001;
        CutFaces cut = faces_of(baked.hierarchy, applied);
        EXPECT_TRUE(is_legal(baked.hierarchy, applied));
        EXPECT_GE(cut.face.size(), 2u * chords);
        EXPECT_LE(cut.face.size(), 6u * chords);
    }
}

// By the definition in turned_faces.h, which the baker keeps to: none, in any cut.
size_t turned_count(const Baked& baked, const TriangleTree& source, const CutFaces& cut) {
    double slack_m = turn_slack_m(baked.mesh.positions_m);
    size_t count = 0;
    for (const Triangle& t : test::triangles_of(baked.hierarchy.positions_m, cut.positions))
        count += is_turned(source, t, slack_m);
    return count;
}

std::vector<Baked> rough_meshes() {
    std::vector<Baked> all;
    all.push_back(bake(test::grid(60, 50, test::rough_m)));
    all.push_back(bake(test::grid(60, 50, [](double x, double y) { return 3 * test::rough_m(x, y); })));
    all.push_back(bake(test::grid(40, 40, test::rough_m), 12));
    all.push_back(bake(test::sphere(70, 35, 0.05)));
    all.push_back(bake(test::sphere(70, 35, 0.2)));
    all.push_back(bake(test::torus(60, 24, 1, 0.3)));
    all.push_back(bake(test::seamed_cylinder(48, 24)));
    return all;
}

TEST(TurnedFaces, AreNoneInRandomCuts) {
    size_t drawn = 0;
    for (const Baked& baked : rough_meshes()) {
        TriangleTree source(test::triangles_of(baked.mesh.positions_m, baked.mesh.faces));
        for (uint64_t seed = 0; seed < 20; ++seed) {
            Applied applied =
                random_cut(baked.hierarchy, std::max<uint64_t>(100, baked.mesh.faces.size() >> (1 + seed % 6)), seed);
            CutFaces cut = faces_of(baked.hierarchy, applied);
            EXPECT_EQ(turned_count(baked, source, cut), 0u) << seed;
            drawn += cut.face.size();
        }
    }
    EXPECT_GT(drawn, 70000u);
}

TEST(TurnedFaces, AreNoneInTheCoarsestCutEither) {
    for (const Baked& baked : rough_meshes()) {
        TriangleTree source(test::triangles_of(baked.mesh.positions_m, baked.mesh.faces));
        Applied none(baked.hierarchy.split_count(), 0);
        EXPECT_EQ(turned_count(baked, source, faces_of(baked.hierarchy, none)), 0u);
        bool is_creased_all_over = baked.hierarchy.group_surface.size() > 100;  // most positions are rigid then
        EXPECT_LT(baked.hierarchy.base_face_count, is_creased_all_over ? 2700u : 200u) << "and yet the mesh gets small";
    }
}

// Every set of splits that is closed under needs, of meshes small enough to have all of them tried.
void for_every_legal_cut(const Hierarchy& h, const std::function<void(const Applied&)>& visit) {
    Applied applied(h.split_count(), 0);
    std::function<void(uint32_t)> decide = [&](uint32_t split) {
        if (split == h.split_count()) return visit(applied);
        decide(split + 1);
        bool may = true;
        for (uint32_t n = h.need_begin[split]; n < h.need_begin[split + 1]; ++n) may = may && applied[h.needs[n]] != 0;
        if (!may) return;
        applied[split] = 1;
        decide(split + 1);
        applied[split] = 0;
    };
    decide(0);
}

TEST(StatedError, HoldsForEveryLegalCutOfSmallMeshes) {
    std::vector<Baked> all;
    all.push_back(bake(test::sphere(5, 4)));
    all.push_back(bake(test::sphere(4, 4, 0.2)));
    all.push_back(bake(test::grid(3, 3, test::rough_m)));
    all.push_back(bake(test::grid(4, 3, [](double x, double y) { return 0.3 * x * x - 0.5 * x * y; })));
    all.push_back(bake(test::seamed_cylinder(5, 2)));
    size_t cuts = 0;
    for (const Baked& baked : all) {
        TriangleTree source(test::triangles_of(baked.mesh.positions_m, baked.mesh.faces));
        ASSERT_GE(baked.hierarchy.split_count(), 6u);
        for_every_legal_cut(baked.hierarchy, [&](const Applied& applied) {
            ++cuts;
            Distance measured = two_sided_distance(tree_of_cut(baked.hierarchy, applied), source, 0.05, 1e-6, 200);
            EXPECT_LE(measured.least_m, stated_error_m(baked.hierarchy, applied) * (1 + 1e-6) + 1e-7);
        });
    }
    EXPECT_GE(cuts, 200u);
}

// The mesh, and beside it at height_m the same with its other side out: the two face each other, as a box and the table under it.
mesh::Mesh with_counterpart(mesh::Mesh mesh, float height_m) {
    uint32_t positions = uint32_t(mesh.positions_m.size()), faces = uint32_t(mesh.faces.size());
    for (uint32_t p = 0; p < positions; ++p) mesh.positions_m.push_back(mesh.positions_m[p] + glm::vec3(0, 0, height_m));
    for (uint32_t f = 0; f < faces; ++f) {
        auto [a, b, c] = mesh.faces[f];
        mesh.faces.push_back({a + positions, c + positions, b + positions});
    }
    mesh.face_source.clear(), mesh.surfaces.clear();
    test::finish(mesh);
    return mesh;
}

TEST(Hierarchy, PartsThatFaceEachOtherGetAsCoarseAsEachAlone) {
    mesh::Mesh alone = test::grid(40, 30, test::rough_m);
    for (float height_m : {0.002f, -0.002f}) {
        mesh::Mesh both = with_counterpart(alone, height_m);
        auto one = build_hierarchy(alone, *find_groups(alone, {}), {}), two = build_hierarchy(both, *find_groups(both, {}), {});
        ASSERT_TRUE(one && two);
        EXPECT_LE(two->base_face_count, 2 * one->base_face_count + 8) << height_m;
        for (double error_m : {0.01, 0.02, 0.05})
            EXPECT_LE(double(face_count_at(*two, error_m)), 2.2 * double(face_count_at(*one, error_m))) << height_m;
    }
}

// Where each pass takes half of all that could go, dear ones come before cheap ones, and 821 and 1,168 triangles stay.
TEST(Hierarchy, DearCollapsesDoNotComeBeforeCheapOnes) {
    Baked terrain = bake(test::grid(80, 80, test::rough_m)), ball = bake(test::sphere(80, 40, 0.05));
    EXPECT_LE(face_count_at(terrain.hierarchy, 0.01 * terrain.size_m), 700u);
    EXPECT_LE(face_count_at(ball.hierarchy, 0.01 * ball.size_m), 1050u);
}

}  // namespace
}  // namespace overlook::caveclod
