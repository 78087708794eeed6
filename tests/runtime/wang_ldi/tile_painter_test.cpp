// Images that give way to each other show every place of a tile once, and in an order that holds between them.
#include "runtime/wang_ldi/tile_painter.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace overlook::wang_ldi {
namespace {

struct Touch {
    uint32_t side_px, column, row;
    int who;
};

// Writes down what is drawn of it.
class Witness final : public Columns {
  public:
    Witness(int who, uint32_t side, Thresholds rung, Thresholds direction, std::vector<Touch>& touches)
        : who_(who), touches_(touches) {
        side_px = side, by_rung = rung, by_direction = direction;
    }
    void stand_on(const Plane&) override {}
    void draw(uint32_t column, uint32_t row) override { touches_.push_back({side_px, column, row, who_}); }

  private:
    int who_;
    std::vector<Touch>& touches_;
};

struct Pass {
    std::vector<Touch> touches;

    // Two levels and two directions of each, mixed by shares, in all halves of all pieces.
    Pass(uint32_t fine, uint32_t coarse, uint32_t rung_share, uint32_t direction_share, uint32_t pieces, const glm::dvec2& eye) {
        Mix rungs{0, 1, rung_share}, directions{0, 1, direction_share};
        std::vector<Witness> witnesses;
        std::vector<Columns*> all;
        for (int who = 0; who < 4; ++who)
            witnesses.push_back({who, who < 2 ? fine : coarse, who < 2 ? first_of(rungs) : second_of(rungs),
                                 who % 2 == 0 ? first_of(directions) : second_of(directions), touches});
        for (Witness& witness : witnesses) all.push_back(&witness);
        for (uint32_t n = 0; n < 2 * pieces * pieces; ++n)
            paint_piece({77, coarse, eye}, {n / 2 % pieces, n / 2 / pieces, pieces, false, n % 2, Diagonal::falling}, all);
    }
};

TEST(TilePainter, EveryPlaceIsShownByOneLevelAndOneDirection) {
    for (auto [fine, coarse] : {std::pair{64u, 32u}, {31u, 31u}, {62u, 37u}, {40u, 7u}})
        for (uint32_t pieces : {1u, 2u, 4u})
            for (uint32_t rung_share : {1u, 77u, 255u})
                for (uint32_t direction_share : {0u, 100u, 256u}) {
                    Pass pass(fine, coarse, rung_share, direction_share, pieces, {0.3, 2.2});
                    std::map<std::pair<uint32_t, uint32_t>, int> fine_times, coarse_times;
                    uint64_t second_direction = 0;
                    for (const Touch& touch : pass.touches) {
                        ++(touch.who < 2 ? fine_times : coarse_times)[{touch.column, touch.row}];
                        second_direction += touch.who % 2;
                        uint32_t decides = rung_threshold(77, touch.column, touch.row, touch.side_px, coarse);
                        ASSERT_EQ(touch.who >= 2, decides >= kWhole - rung_share);
                    }
                    for (uint32_t row = 0; row < coarse; ++row)
                        for (uint32_t column = 0; column < coarse; ++column) {
                            int of_coarse = coarse_times[{column, row}];
                            ASSERT_LE(of_coarse, 1);
                            Span x = pixels_of(column, coarse, fine), y = pixels_of(row, coarse, fine);
                            for (uint32_t j = y.from; j < y.to; ++j)
                                for (uint32_t i = x.from; i < x.to; ++i) {
                                    int times = fine_times[{i, j}];
                                    ASSERT_EQ(times, 1 - of_coarse) << fine << " over " << coarse << ": " << i << " " << j;
                                }
                        }
                    double share = double(second_direction) / double(pass.touches.size());
                    EXPECT_NEAR(share, direction_share / 256.0, direction_share % 256 == 0 ? 0 : 0.12);
                }
}

// The same place of the tile, and so the same flower, is in a share of a hundred what it is in any larger one.
TEST(TilePainter, AGrowingShareTakesNothingBack) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> since;
    for (uint32_t share = 1; share < 256; share += 6) {
        Pass pass(32, 16, share, 0, 1, {0.5, -3});
        std::map<std::pair<uint32_t, uint32_t>, bool> coarse;
        for (const Touch& touch : pass.touches)
            if (touch.who >= 2) coarse[{touch.column, touch.row}] = true;
        for (const auto& [place, first] : since) ASSERT_TRUE(coarse[place]) << share << " lost what came at " << first;
        for (const auto& [place, is_shown] : coarse) since.insert({place, share});
    }
    EXPECT_GT(since.size(), 16u * 16 * 9 / 10);
}

// Along every ray over a half nothing that is drawn is hidden by what was drawn before it, whichever image each is from.
TEST(TilePainter, TheOrderHoldsBetweenImagesToo) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> unit(0, 1);
    uint64_t compared = 0;
    for (int view = 0; view < 60; ++view) {
        glm::dvec2 eye(3 * unit(random) - 1, 3 * unit(random) - 1);
        Pass pass(24, 12, 128, 128, 1, eye);
        for (int ray = 0; ray < 20; ++ray) {
            glm::dvec2 along = glm::normalize(glm::dvec2(unit(random), unit(random)) - eye);
            double nearest[2] = {INFINITY, INFINITY};  // of what was drawn so far, in each half of the piece
            for (const Touch& touch : pass.touches) {
                glm::dvec2 low = glm::dvec2(touch.column, touch.row) / double(touch.side_px), high = low + 1.0 / touch.side_px;
                double enters = 0, leaves = INFINITY;
                for (int k = 0; k < 2; ++k) {
                    double a = (low[k] - eye[k]) / along[k], b = (high[k] - eye[k]) / along[k];
                    enters = std::max(enters, std::min(a, b)), leaves = std::min(leaves, std::max(a, b));
                }
                if (leaves - enters < 1e-9) continue;
                double x = (touch.column + 0.5) / touch.side_px, y = (touch.row + 0.5) / touch.side_px;
                double& before = nearest[half_of(Diagonal::falling, x, y)];
                ASSERT_LE(leaves, before + 1e-9) << "view " << view << ", pixel " << touch.column << " " << touch.row;
                before = std::min(before, enters), ++compared;
            }
        }
    }
    EXPECT_GT(compared, 5000u);
}

}  // namespace
}  // namespace overlook::wang_ldi
