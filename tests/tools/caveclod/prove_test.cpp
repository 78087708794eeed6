#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/tools/caveclod/test_meshes.h"
#include "tools/bake/caveclod/bake.h"
#include "tools/bake/caveclod/cut.h"
#include "tools/bake/caveclod/turned_faces.h"
#include "tools/bake/mesh_provenance.h"
#include "tools/baked/prove_caveclod.h"

namespace overlook::caveclod {
namespace {

Hierarchy baked(const mesh::Mesh& mesh, const BakeOptions& options = {}) {
    BakeReport report;
    auto hierarchy = bake(mesh, options, report, [](double) {});
    EXPECT_TRUE(hierarchy) << hierarchy.error().message;
    return *hierarchy;
}

Proof proof_of(const Hierarchy& hierarchy, const mesh::Mesh& mesh, const SeamBudget& seams = {}) {
    ProofOptions options;
    options.cut_count = 40;
    return prove(hierarchy, mesh, seams, options, [](double) {});
}

TEST(MeshProof, HoldsForWhatWasBaked) {
    mesh::Mesh mesh = test::sphere(48, 24, 0.02);
    Proof proof = proof_of(baked(mesh), mesh);
    EXPECT_TRUE(proof.holds()) << proof.broken_law;
    EXPECT_EQ(proof.triangle_count, mesh.faces.size());
    EXPECT_GT(proof.cuts.greatest_measured_share, 0.5);
    EXPECT_LE(proof.finest_moved_m, proof.finest_stated_m);
}

TEST(MeshProof, FindsErrorsThatAreStatedTooSmall) {
    mesh::Mesh mesh = test::sphere(48, 24, 0.02);
    Hierarchy hierarchy = baked(mesh);
    for (float& error_m : hierarchy.error_m) error_m *= 0.5f;
    Proof proof = proof_of(hierarchy, mesh);
    EXPECT_GT(proof.cuts.broken_count, 0u);
    EXPECT_FALSE(proof.holds());
}

TEST(MeshProof, FindsTrianglesThatAreLostOrForeign) {
    mesh::Mesh mesh = test::torus(24, 12, 3, 1);
    Hierarchy hierarchy = baked(mesh);
    mesh::Mesh other = mesh;
    other.positions_m[5] *= 1.01f;
    Proof proof = proof_of(hierarchy, other);
    EXPECT_EQ(proof.lost_triangle_count, 6u);
    EXPECT_EQ(proof.foreign_triangle_count, 6u);
    EXPECT_FALSE(proof.holds());
}

TEST(MeshProof, FindsCornersThatMovedFartherThanStated) {
    mesh::Mesh mesh = test::torus(24, 12, 3, 1);
    Hierarchy hierarchy = baked(mesh);
    hierarchy.finest_error_m *= 0.1f;
    Proof proof = proof_of(hierarchy, mesh);
    EXPECT_GT(proof.finest_moved_m, proof.finest_stated_m);
    EXPECT_FALSE(proof.holds());
}

TEST(MeshProof, HoldsWhatReadingHasMoved) {
    mesh::Mesh mesh = test::torus(24, 12, 3, 1);
    BakeOptions options;
    options.source_rounding_m = 0.25;
    BakeReport report;
    auto hierarchy = bake(mesh, options, report, [](double) {});
    ASSERT_TRUE(hierarchy) << hierarchy.error().message;
    EXPECT_GE(hierarchy->finest_error_m, 0.25);
    EXPECT_GE(*std::min_element(hierarchy->error_m.begin(), hierarchy->error_m.end()), 0.25f);
}

TEST(MeshProof, FindsFacesThatAreTurned) {
    mesh::Mesh mesh = test::torus(24, 12, 3, 1);
    Hierarchy hierarchy = baked(mesh);
    EXPECT_EQ(proof_of(hierarchy, mesh).cuts.turned_count, 0u);
    // A few positions on the other side of the torus: what is drawn between there and here lies across.
    for (uint32_t p = 0; p < hierarchy.base_position_count; ++p) hierarchy.positions_m[p] = -hierarchy.positions_m[p];
    EXPECT_GT(proof_of(hierarchy, mesh).cuts.turned_count, 0u);
    EXPECT_FALSE(proof_of(hierarchy, mesh).holds());
}

// [P] whether a position is of the upper of two sheets.
std::vector<uint8_t> upper_positions(const Hierarchy& h, double between_m) {
    std::vector<uint8_t> is_upper;
    for (const glm::vec3& p : h.positions_m) is_upper.push_back(double(p.z) + h.origin_m.z > between_m);
    return is_upper;
}

// Faces of a cut turned from their own sheet, each held against all of it.
uint64_t turned_from_own_sheet(const Hierarchy& h, const CutFaces& cut, const std::vector<uint8_t>& is_upper) {
    auto triangle_of = [&](const std::array<uint32_t, 3>& f) {
        return Triangle{glm::dvec3(h.positions_m[f[0]]), glm::dvec3(h.positions_m[f[1]]), glm::dvec3(h.positions_m[f[2]])};
    };
    std::array<std::vector<Triangle>, 2> sheets;
    for (const auto& face : faces_of(h, Applied(h.split_count(), 1)).positions)
        sheets[is_upper[face[0]]].push_back(triangle_of(face));
    std::array<TriangleTree, 2> trees{TriangleTree(sheets[0]), TriangleTree(sheets[1])};
    uint64_t count = 0;
    for (const auto& face : cut.positions)
        count += is_turned(trees[is_upper[face[0]]], triangle_of(face), turn_slack_m(h.positions_m));
    return count;
}

// Of the lower sheet, the base's positions and those next to them look down, on ledges, and all else lies beneath them and looks
// up: near its corners a coarse face finds nothing that looks away, in its middle all does.
void undercut(Hierarchy& h, const std::vector<uint8_t>& is_upper) {
    std::vector<int> ring(h.positions_m.size(), 2);
    std::fill_n(ring.begin(), h.base_position_count, 0);
    for (const auto& face : faces_of(h, Applied(h.split_count(), 1)).positions)
        if (std::any_of(face.begin(), face.end(), [&](uint32_t p) { return ring[p] == 0; }))
            for (uint32_t p : face) ring[p] = std::min(ring[p], 1);
    for (uint32_t p = 0; p < ring.size(); ++p) {
        if (is_upper[p]) continue;
        glm::vec3& at_m = h.positions_m[p];
        if (ring[p] < 2) at_m.x = 1 - 2 * float(h.origin_m.x) - at_m.x;
        at_m.z -= ring[p] == 0 ? 0.2f : ring[p] == 1 ? 0.25f : 0.5f;
    }
}

// However large or small the errors are that a file states: none is hidden by them, and none made up.
TEST(MeshProof, FindsTheSameFacesTurnedWhateverErrorIsStated) {
    Hierarchy h = baked(test::facing_sheets(24, 0.1));
    ProofOptions options;
    options.cut_count = 20;
    EXPECT_EQ(prove_cuts(h, options).turned_count, 0u);
    std::vector<uint8_t> is_upper = upper_positions(h, 0.05);
    undercut(h, is_upper);
    for (float scale : {1.0f, 0x1p-20f, 0x1p20f}) {
        Hierarchy told = h;
        for (float& error_m : told.error_m) error_m *= scale;
        told.finest_error_m *= scale;
        uint64_t expected = 0;
        for (uint64_t i = 0; i < options.cut_count; ++i)
            expected += turned_from_own_sheet(told, faces_of(told, proof_cut(told, options, i)), is_upper);
        EXPECT_GT(expected, 20u);
        EXPECT_EQ(prove_cuts(told, options).turned_count, expected) << scale;
    }
}

TEST(MeshProof, KnowsTrianglesWithTwoCornersInOnePlace) {
    mesh::Mesh mesh = test::torus(24, 12, 3, 1);
    for (size_t p = 0; p + 7 < mesh.positions_m.size(); p += 7) mesh.positions_m[p] = mesh.positions_m[p + 1];
    Proof proof = proof_of(baked(mesh), mesh);
    EXPECT_EQ(proof.lost_triangle_count, 0u);
    EXPECT_EQ(proof.foreign_triangle_count, 0u);
}

TEST(MeshProof, FindsABrokenLaw) {
    mesh::Mesh mesh = test::torus(24, 12, 3, 1);
    Hierarchy hierarchy = baked(mesh);
    std::swap(hierarchy.error_m.front(), hierarchy.error_m.back());
    EXPECT_NE(proof_of(hierarchy, mesh).broken_law, "");
}

BakeOptions budgeted(double crease_deg, double uv_texels) {
    BakeOptions options;
    options.groups.crease_deg = crease_deg;
    options.simplify.seams.moves = true;
    options.simplify.seams.uv_texels = uv_texels;
    return options;
}

TEST(SeamsProof, FindsNoCornerBesideTheSourcesOwnUnderTheStrictRule) {
    BakeOptions options;
    options.groups.crease_deg = 40;
    for (const mesh::Mesh& mesh : {test::seamed_cylinder(64, 8), test::cube(6)}) {
        Proof proof = proof_of(baked(mesh, options), mesh);
        EXPECT_TRUE(proof.holds());
        EXPECT_EQ(proof.seams.carried_count, 0u);
        EXPECT_GT(proof.seams.corner_count, 0u);
    }
}

TEST(SeamsProof, FacetsGoWhereSeamsMoveAndEveryPromiseHolds) {
    mesh::Mesh mesh = test::sphere(40, 20);
    BakeOptions strict;
    strict.groups.crease_deg = 0;
    BakeOptions moving = budgeted(0, 1);
    Hierarchy held = baked(mesh, strict), moved = baked(mesh, moving);
    EXPECT_GT(held.base_face_count, mesh.faces.size() * 9 / 10);
    EXPECT_LT(moved.base_face_count, mesh.faces.size() / 10);
    Proof proof = proof_of(moved, mesh, moving.simplify.seams);
    EXPECT_TRUE(proof.holds()) << proof.broken_law << proof.seams.wrong_count;
    EXPECT_GT(proof.seams.carried_count, 0u);
    EXPECT_GT(proof.seams.greatest_shift_m, 0);
}

TEST(SeamsProof, FindsCornersBeyondABudgetThatIsTooSmall) {
    mesh::Mesh mesh = test::sphere(48, 24, 0.05);
    BakeOptions options = budgeted(15, 1);
    options.simplify.seams.normal_deg = 40;
    Hierarchy hierarchy = baked(mesh, options);
    Proof proof = proof_of(hierarchy, mesh, options.simplify.seams);
    EXPECT_TRUE(proof.holds());
    ASSERT_GT(proof.seams.worst.normal_deg, 2);
    SeamBudget smaller = options.simplify.seams;
    smaller.normal_deg = 0.5;
    EXPECT_GT(proof_of(hierarchy, mesh, smaller).seams.wrong_count, 0u);
    EXPECT_FALSE(proof_of(hierarchy, mesh, smaller).holds());
    EXPECT_EQ(proof_of(hierarchy, mesh).seams.wrong_count, proof.seams.carried_count) << "none is right under the strict rule";
}

TEST(SeamsProof, FindsSeamsThatMovedFartherThanStated) {
    mesh::Mesh mesh = test::sphere(40, 20);
    BakeOptions options = budgeted(0, 1);
    Hierarchy hierarchy = baked(mesh, options);
    for (float& error_m : hierarchy.error_m) error_m *= 0.2f;
    EXPECT_GT(proof_of(hierarchy, mesh, options.simplify.seams).seams.wrong_count, 0u);
}

TEST(SeamsProof, BudgetsAreKeptInWhatTheBakerReports) {
    mesh::Mesh mesh = test::seamed_cylinder(64, 16);
    for (double texels : {4.0, 40.0, 200.0}) {
        BakeOptions options = budgeted(180, texels);
        BakeReport report;
        ASSERT_TRUE(bake(mesh, options, report, [](double) {}));
        EXPECT_LE(report.simplify.seam_error.uv_texels, texels);
        EXPECT_LE(report.simplify.seam_error.normal_deg, 10);
        EXPECT_LE(report.simplify.greatest_seam_shift_m, report.simplify.greatest_error_m * (1 + 1e-6));
        EXPECT_LE(report.budgeted_floor_face_estimate, report.floor_face_estimate);
    }
}

TEST(BakeReport, SaysOfEachPositionAtOnePercentWhatKeepsIt) {
    mesh::Mesh mesh = test::sphere(48, 24, 0.05);
    for (const BakeOptions& options : {BakeOptions{}, budgeted(15, 1)}) {
        BakeReport report;
        auto h = bake(mesh, options, report, [](double) {});
        ASSERT_TRUE(h) << h.error().message;
        Applied applied(h->split_count(), 0);
        for (uint32_t i = 0; i < h->split_count(); ++i) applied[i] = double(h->error_m[i]) > 0.01 * report.size_m;
        CutFaces cut = faces_of(*h, applied);
        ASSERT_EQ(cut.face.size(), report.face_count_at_one_percent);
        std::vector<uint32_t> positions;
        for (const auto& face : cut.positions) positions.insert(positions.end(), face.begin(), face.end());
        std::sort(positions.begin(), positions.end());
        positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
        const HindranceCounts &at = report.kept_at_one_percent, &coarsest = report.simplify.hindrances;
        EXPECT_EQ(std::accumulate(at.begin(), at.end(), uint64_t(0)), positions.size());
        EXPECT_EQ(std::accumulate(coarsest.begin(), coarsest.end(), uint64_t(0)), h->base_position_count);
        EXPECT_GT(at[size_t(Hindrance::error)], 0u);
        EXPECT_EQ(coarsest[size_t(Hindrance::error)] + coarsest[size_t(Hindrance::order)], 0u);
    }
}

TEST(MeshChoices, ComeBackFromTheirWords) {
    mesh::BakeChoices choices;
    choices.input.metres_per_unit = 0.0254;
    choices.input.up = mesh::Up::y;
    choices.bake.groups.crease_deg = 40;
    choices.bake.groups.ignores_uv = true;
    choices.bake.precision.position_bits = 16;
    container::Provenance provenance{"bake-lod mesh", "1", mesh::options_in_words(choices), {}};
    EXPECT_EQ(provenance.options.size(), 5u);
    auto back = mesh::choices_from_words(provenance);
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back->input.metres_per_unit, 0.0254);
    EXPECT_EQ(back->input.up, mesh::Up::y);
    EXPECT_EQ(back->bake.groups.crease_deg, 40);
    EXPECT_TRUE(back->bake.groups.ignores_uv);
    EXPECT_EQ(back->bake.precision.position_bits, 16u);
    for (const char* words : {"wide", "200", "nan", "40 "}) {
        provenance.options = {{"crease-deg", words}};
        EXPECT_FALSE(mesh::choices_from_words(provenance)) << words;
    }
}

}  // namespace
}  // namespace overlook::caveclod
