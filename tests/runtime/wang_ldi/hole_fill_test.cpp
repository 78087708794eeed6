// Holes within a surface are closed with what lies behind, and no outline grows.
#include "runtime/wang_ldi/hole_fill.h"

#include <gtest/gtest.h>

#include <string>

#include "formats/parallel.h"

namespace overlook::wang_ldi {
namespace {

// A letter for each pixel: 'a' the nearest, a metre more for each letter after; '.' nothing.
Warped picture_of(const std::vector<std::string>& rows) {
    Warped picture;
    picture.clear(uint32_t(rows[0].size()), uint32_t(rows.size()));
    for (size_t p = 0; p < picture.colours.size(); ++p) {
        char letter = rows[p / rows[0].size()][p % rows[0].size()];
        if (letter != '.') picture.colours[p] = 0xff000000u | uint32_t(letter), picture.depth_m[p] = float(letter - 'a' + 1);
    }
    return picture;
}
std::vector<std::string> rows_of(const Warped& picture) {
    std::vector<std::string> rows(picture.height_px);
    for (size_t p = 0; p < picture.colours.size(); ++p)
        rows[p / picture.width_px] += picture.colours[p] == 0 ? '.' : char(picture.colours[p] & 0xff);
    return rows;
}
std::vector<std::string> filled(const std::vector<std::string>& rows, uint32_t finer = 1) {
    Warped picture = picture_of(rows);
    uint64_t count = fill_holes(picture, finer), changed = 0;
    std::vector<std::string> after = rows_of(picture);
    for (size_t y = 0; y < rows.size(); ++y)
        for (size_t x = 0; x < rows[y].size(); ++x) {
            changed += after[y][x] != rows[y][x];
            if (rows[y][x] != '.') {
                EXPECT_EQ(after[y][x], rows[y][x]);
            }
            if (after[y][x] != '.') {
                EXPECT_EQ(picture.depth_m[y * rows[0].size() + x], float(after[y][x] - 'a' + 1));
            }
        }
    EXPECT_EQ(count, changed);
    return after;
}
using Rows = std::vector<std::string>;

TEST(HoleFill, ClosesOneAndTwoPixelsWithTheFartherOfWhatIsRound) {
    EXPECT_EQ(filled({"aaa", "a.b", "aca"}), (Rows{"aaa", "acb", "aca"}));
    EXPECT_EQ(filled({"aaaa", "b..c", "adaa"}), (Rows{"aaaa", "bdcc", "adaa"}));
    EXPECT_EQ(filled({"aaaa", "a..a", "a..a", "aeaa"}), (Rows{"aaaa", "aeaa", "aeaa", "aeaa"}));
}

// Every letter finer x finer times.
Rows enlarged(const Rows& rows, uint32_t finer) {
    Rows large;
    for (const std::string& row : rows) {
        std::string wide;
        for (char letter : row) wide.append(finer, letter);
        large.insert(large.end(), finer, wide);
    }
    return large;
}

TEST(HoleFill, OfAFinerPictureClosesGapsOfAsManyPixelsOfThePicture) {
    for (uint32_t finer : {2u, 3u, 4u}) {
        for (const Rows& rows : {Rows{"aaa", "a.a", "aaa"}, Rows{"aaaa", "a..a", "a..a", "aeaa"}}) {
            Rows large = filled(enlarged(rows, finer), finer);
            for (const std::string& row : large) EXPECT_EQ(row.find('.'), std::string::npos) << finer;
        }
        for (const Rows& rows : {Rows{"aaaaa", "a...a", "aaaaa"}, Rows{"aaa", "a..", "aaa"}, Rows{"a.a", "a.a", "a.a"}})
            EXPECT_EQ(filled(enlarged(rows, finer), finer), enlarged(rows, finer)) << finer;
    }
}

TEST(HoleFill, LeavesWhatIsWiderOrOpen) {
    for (const Rows& rows : {Rows{"aaaaa", "a...a", "aaaaa"}, Rows{"aaa", "a.a", "a.a", "a.a", "aaa"}, Rows{"a.a", "a.a", "a.a"},
                             Rows{"aaa", "...", "aaa"}, Rows{"aaa", "a..", "aaa"}, Rows{"...", ".a.", "..."}, Rows{"a.", ".a"}})
        EXPECT_EQ(filled(rows), rows);
}

// The sky between two stems and round an outline, drawn at random, is only filled where it is closed within two pixels each way.
TEST(HoleFill, OfARandomPictureFillsExactlyWhatTheRuleSaysWithAnyThreads) {
    const int width = 97, height = 80;
    Rows rows(height, std::string(width, '.'));
    uint32_t state = 1;
    for (auto& row : rows)
        for (char& letter : row) {
            state = state * 1664525u + 1013904223u;
            if (state >> 24 < 150) letter = char('a' + (state >> 16) % 20);
        }
    auto is_closed = [&](int x, int y, int dx, int dy) {
        int gap = 1;
        for (int sign : {-1, 1})
            for (int n = 1;; ++n) {
                int i = x + sign * n * dx, j = y + sign * n * dy;
                if (i < 0 || j < 0 || i >= width || j >= height) return false;
                if (rows[size_t(j)][size_t(i)] != '.') break;
                ++gap;
            }
        return gap <= 2;
    };
    uint64_t expected = 0, empty = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if (rows[size_t(y)][size_t(x)] == '.') ++empty, expected += is_closed(x, y, 1, 0) && is_closed(x, y, 0, 1);
    Warped one = picture_of(rows);
    set_thread_count(1);
    EXPECT_EQ(fill_holes(one), expected);
    EXPECT_GT(expected, 100u);
    EXPECT_GT(empty, expected + 100);
    set_thread_count(5);
    Warped many = picture_of(rows);
    fill_holes(many);
    set_thread_count(0);
    EXPECT_TRUE(many.colours == one.colours && many.depth_m == one.depth_m);
}

}  // namespace
}  // namespace overlook::wang_ldi
