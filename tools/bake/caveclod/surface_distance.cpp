#include "tools/bake/caveclod/surface_distance.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "tools/bake/caveclod/distances.h"

namespace overlook::caveclod {
namespace {

constexpr size_t kFirstLook = 16;  // every so-manyth triangle is looked at first, for a distance that most others are within

double distance_m(const glm::dvec3& p, const Triangle& t) {
    return std::sqrt(distance2_to_triangle(p, probe_of(t[0], t[1], t[2])));
}

// The farthest of the corners from one triangle: no point between them is farther.
double worst_m(const Triangle& corners, const Triangle& t) {
    TriangleProbe probe = probe_of(t[0], t[1], t[2]);
    double most2 = 0;
    for (const glm::dvec3& corner : corners) most2 = std::max(most2, distance2_to_triangle(corner, probe));
    return std::sqrt(most2);
}

// A piece of one triangle of `from`.
struct Piece {
    Triangle corners;
    std::array<TriangleTree::Nearest, 3> nearest;  // to each corner
    double most_m = 0;
    bool operator<(const Piece& other) const { return most_m < other.most_m; }
};

// Over the whole piece no point is farther from `to` than from any one triangle of it, and there the farthest is a corner.
double most_of(const Piece& piece, const TriangleTree& to) {
    double most_m = 1e300;
    for (size_t c = 0; c < 3; ++c) {
        bool is_again = c > 0 && piece.nearest[c].triangle == piece.nearest[c - 1].triangle;
        if (!is_again) most_m = std::min(most_m, worst_m(piece.corners, to.triangle(piece.nearest[c].triangle)));
    }
    return most_m;
}

}  // namespace

Distance one_sided_distance(const TriangleTree& from, const TriangleTree& to, double gap, double floor_m, uint64_t most_steps,
                            double enough_m) {
    if (from.triangles().empty()) return {};
    if (to.triangles().empty()) return {1e300, 1e300};
    Distance found;
    std::priority_queue<Piece> pending;
    auto is_done = [&](double most_m) {
        bool is_asked_more = enough_m == 0 || found.least_m > enough_m;
        return most_m <= (is_asked_more ? found.least_m * (1 + gap) + floor_m : enough_m);
    };
    auto push = [&](Piece piece) {
        piece.most_m = most_of(piece, to);
        found.most_m = std::max(found.most_m, std::min(piece.most_m, is_done(piece.most_m) ? piece.most_m : 0));
        if (!is_done(piece.most_m)) pending.push(piece);
    };
    uint32_t guess = 0;  // what was nearest last: what is asked next lies close by, mostly
    auto reach = [&](const glm::dvec3& p) {
        double guess_m = distance_m(p, to.triangle(guess));
        TriangleTree::Nearest nearest = to.nearest(p, guess_m);
        if (nearest.triangle < to.triangles().size()) guess = nearest.triangle;
        else nearest = {guess, guess_m};
        found.least_m = std::max(found.least_m, nearest.distance_m);
        return nearest;
    };
    for (size_t i = 0; i < from.triangles().size(); i += kFirstLook) reach(from.triangles()[i][0]);
    for (const Triangle& t : from.triangles()) {
        double guess_m = worst_m(t, to.triangle(guess));
        if (is_done(guess_m)) found.most_m = std::max(found.most_m, guess_m);
        else push({t, {reach(t[0]), reach(t[1]), reach(t[2])}, 0});
    }
    uint64_t steps = 0;
    for (; !pending.empty() && !is_done(pending.top().most_m) && steps < most_steps; ++steps) {
        Piece piece = pending.top();
        pending.pop();
        int longest = 0;
        for (int c = 1; c < 3; ++c)
            if (glm::distance(piece.corners[c], piece.corners[(c + 1) % 3]) >
                glm::distance(piece.corners[longest], piece.corners[(longest + 1) % 3]))
                longest = c;
        int other = (longest + 1) % 3;
        glm::dvec3 middle = (piece.corners[longest] + piece.corners[other]) * 0.5;
        TriangleTree::Nearest nearest = reach(middle);
        for (int replaced : {longest, other}) {
            Piece half = piece;
            half.corners[replaced] = middle, half.nearest[replaced] = nearest;
            push(half);
        }
    }
    if (!pending.empty()) found.most_m = std::max(found.most_m, pending.top().most_m);
    found.most_m = std::max(found.most_m, found.least_m);
    return found;
}

Distance two_sided_distance(const TriangleTree& a, const TriangleTree& b, double gap, double floor_m, uint64_t most_steps,
                            double enough_m) {
    Distance there = one_sided_distance(a, b, gap, floor_m, most_steps, enough_m),
             back = one_sided_distance(b, a, gap, floor_m, most_steps, enough_m);
    return {std::max(there.least_m, back.least_m), std::max(there.most_m, back.most_m)};
}

}  // namespace overlook::caveclod
