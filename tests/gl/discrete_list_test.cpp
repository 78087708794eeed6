// What goes to the graphics card of several chains in one picture.
#include <gtest/gtest.h>

#include "runtime/discrete/draw_list.h"

namespace overlook::discrete {
namespace {

// By distance over all lists, not list by list; what stands together in the order and in its list is one call.
TEST(DrawLists, MixWhatIsTranslucentBackToFront) {
    DrawList trees, mills;
    trees.translucent = {{90, 0, 4}, {70, 0, 5}, {20, 0, 6}, {20, 1, 7}};
    mills.translucent = {{80, 2, 0}, {30, 2, 1}, {10, 2, 2}};
    const DrawList* lists[] = {&trees, &mills};
    std::vector<ListedCalls> wanted = {{0, {{0, 4, 1}}},
                                       {1, {{2, 0, 1}}},
                                       {0, {{0, 5, 1}}},
                                       {1, {{2, 1, 1}}},
                                       {0, {{0, 6, 1}, {1, 7, 1}}},
                                       {1, {{2, 2, 1}}}};
    EXPECT_EQ(translucent_calls(lists), wanted);
    EXPECT_EQ(translucent_calls(std::span(lists).last(1)), (std::vector<ListedCalls>{{0, {{2, 0, 3}}}}));
    EXPECT_TRUE(translucent_calls({}).empty());
}

}  // namespace
}  // namespace overlook::discrete
