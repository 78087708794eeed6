// A rung stays only if some distance asks for it and it is much cheaper than the one before.
#include "tools/bake/discrete/ladder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace overlook::discrete {
namespace {

LadderOptions options_of(double least_saving) {
    LadderOptions options;
    options.least_saving = least_saving;
    options.view = {1000, 90, 1};  // 500 pixels to a tangent of 1
    return options;
}

std::vector<size_t> kept(const std::vector<Verdict>& verdicts) {
    std::vector<size_t> numbers;
    for (size_t i = 0; i < verdicts.size(); ++i)
        if (verdicts[i].is_kept) numbers.push_back(i);
    return numbers;
}

TEST(Ladder, KeepsARungFromTheDistanceThatItsErrorAllows) {
    std::vector<Candidate> candidates{{1000, 0}, {500, 0.01}, {250, 0.1}};
    std::vector<Verdict> verdicts = choose_rungs(candidates, 10, options_of(1.4));
    EXPECT_EQ(kept(verdicts), (std::vector<size_t>{0, 1, 2}));
    EXPECT_DOUBLE_EQ(verdicts[0].from_m, 0);
    EXPECT_NEAR(verdicts[1].from_m, 5.01, 1e-9);
    EXPECT_DOUBLE_EQ(verdicts[0].to_m, verdicts[1].from_m);
    EXPECT_NEAR(verdicts[2].from_m, 50.1, 1e-9);
    EXPECT_NEAR(verdicts[2].to_m, 2 * 10 * 500, 1e-6);
}
TEST(Ladder, LeavesOutWhatIsNotMuchCheaper) {
    std::vector<Candidate> candidates{{1000, 0}, {800, 0.01}, {500, 0.1}, {400, 0.2}, {300, 0.3}};
    EXPECT_EQ(kept(choose_rungs(candidates, 10, options_of(1.4))), (std::vector<size_t>{0, 2, 4}));
    EXPECT_EQ(kept(choose_rungs(candidates, 10, options_of(1))), (std::vector<size_t>{0, 1, 2, 3, 4}));
}
TEST(Ladder, LeavesOutWhatServesOnlyWhereNothingIsSeen) {
    // Of 1 m radius it is less than a pixel from 1000 m on; an error of 2 m serves from 1002 m on.
    std::vector<Candidate> candidates{{1000, 0}, {500, 1.9}, {100, 2}};
    EXPECT_EQ(kept(choose_rungs(candidates, 1, options_of(1.4))), (std::vector<size_t>{0, 1}));
}
TEST(Ladder, PrefersTheCheaperOfTwoThatAreAsNear) {
    std::vector<Candidate> candidates{{1000, 0}, {500, 0.1}, {100, 0.1}};
    EXPECT_EQ(kept(choose_rungs(candidates, 10, options_of(1.4))), (std::vector<size_t>{0, 2}));
}
TEST(Ladder, HasNoMoreLevelsThanAsked) {
    std::vector<Candidate> candidates;
    for (int i = 0; i < 10; ++i) candidates.push_back({uint64_t(1) << (20 - i), 0.01 * i});
    LadderOptions options = options_of(1.4);
    options.most_levels = 4;
    EXPECT_EQ(kept(choose_rungs(candidates, 100, options)).size(), 4u);
}
TEST(LadderView, PutsWhatServesAtItsDistanceWithinThePixelsAllowed) {
    LadderView view{1080, 60, 1.5};
    for (double error_m : {1e-4, 0.01, 3.0}) {
        double at_m = view.distance_m(error_m);
        // The nearest that the displaced point can come to the eye is error_m nearer.
        EXPECT_NEAR(error_m * view.focal_px() / (at_m - error_m), 1.5, 1e-9);
    }
}

}  // namespace
}  // namespace overlook::discrete
