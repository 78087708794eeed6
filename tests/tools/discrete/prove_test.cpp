// baked verify proves levels of billboards by their texels, and finds out those that state too little.
#include "tools/baked/prove_discrete.h"

#include <gtest/gtest.h>

#include "tests/tools/discrete/shapes_for_tests.h"
#include "tools/bake/discrete/from_mesh.h"

namespace overlook::discrete {
namespace {

class ProofOfBillboards : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        mesh::MeshFile file = test::file_of(test::bush(1200));
        MeshChainOptions options;
        options.bake.simplify.seams.moves = true, options.impostors = Impostors::automatic;
        MeshChainReport report;
        auto chain = chain_from_mesh(file, options, report, [](double) {});
        ASSERT_TRUE(chain) << chain.error().message;
        files_ = {file}, chain_ = *chain;
    }
    static ChainProof proof_of(const Chain& chain) {
        auto proof = prove(chain, files_, [](double) {});
        EXPECT_TRUE(proof) << proof.error().message;
        return proof ? *proof : ChainProof{};
    }
    static inline std::vector<mesh::MeshFile> files_;
    static inline Chain chain_;
};

TEST_F(ProofOfBillboards, HoldsOfAllThatIsBaked) {
    ChainProof proof = proof_of(chain_);
    EXPECT_TRUE(proof.holds());
    size_t boards = 0;
    for (const LevelProof& level : proof.levels) {
        if (level.rung != Rung::billboards) continue;
        ++boards;
        EXPECT_TRUE(level.is_proven);
        EXPECT_LE(level.measured.least_m, level.measured.most_m);
    }
    EXPECT_GE(boards, 2u);
    EXPECT_GE(proof.proven_count(), boards);
}
TEST_F(ProofOfBillboards, FailsWhereTheErrorIsTooLittle) {
    Chain chain = chain_;
    Level& last = chain.levels.back();
    ASSERT_EQ(last.rung, Rung::billboards);
    last.error_m *= 0.6f;
    ChainProof proof = proof_of(chain);
    EXPECT_TRUE(proof.levels.back().is_broken);
    EXPECT_FALSE(proof.holds());
}
TEST_F(ProofOfBillboards, FailsWhereMoreOfTheViewIsAddedThanStated) {
    Chain chain = chain_;
    auto most = std::max_element(chain.levels.begin(), chain.levels.end(),
                                 [](const Level& a, const Level& b) { return a.added_area_share < b.added_area_share; });
    ASSERT_GT(most->added_area_share, 1e-3f);
    most->added_area_share *= 0.5f;
    EXPECT_FALSE(proof_of(chain).holds());
}
TEST_F(ProofOfBillboards, RefusesAPictureThatDoesNotDecode) {
    Chain chain = chain_;
    chain.surfaces.back().texture_bytes.resize(40);
    auto proof = prove(chain, files_, [](double) {});
    ASSERT_FALSE(proof);
    EXPECT_EQ(proof.error().exit, Exit::bad_input);
}

}  // namespace
}  // namespace overlook::discrete
