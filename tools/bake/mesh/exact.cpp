// Source: J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates", Discrete &
// Computational Geometry 18, 1997: two-sum, two-product (by a fused multiply-add), grow-expansion.

#include "tools/bake/mesh/exact.h"

#include <cmath>
#include <cstddef>
#include <initializer_list>

namespace overlook::mesh {
namespace {

// high + low is the exact value.
struct Two {
    double high, low;
};

Two sum_of(double a, double b) {
    const double high = a + b;
    const double b_part = high - a, a_part = high - b_part;
    return {high, (a - a_part) + (b - b_part)};
}
Two product_of(double a, double b) {
    const double high = a * b;
    return {high, std::fma(a, b, -high)};
}

// A sum of doubles without rounding: parts that do not overlap.
struct Expansion {
    double parts[16];
    size_t count = 0;

    void add(double value) {
        for (size_t i = 0; i < count; ++i) {
            const Two two = sum_of(value, parts[i]);
            value = two.high;
            parts[i] = two.low;
        }
        parts[count++] = value;
    }
    void add_product(const Two& a, const Two& b, double sign) {
        for (const double x : {a.high, a.low})
            for (const double y : {b.high, b.low}) {
                const Two two = product_of(x * sign, y);
                add(two.high);
                add(two.low);
            }
    }
    bool is_zero() const {
        for (size_t i = 0; i < count; ++i)
            if (parts[i] != 0) return false;
        return true;
    }
};

// Whether (b - a) x (c - a) is zero in the plane of two axes. Floats times floats stay far from a double's least and greatest.
bool is_flat(double ax, double ay, double bx, double by, double cx, double cy) {
    const double left = (bx - ax) * (cy - ay), right = (by - ay) * (cx - ax);
    // Each difference and product is off by 2^-53 of itself at most, the last difference too: (3 + small) of them in all.
    const double bound = 4 * 0x1p-53 * (std::abs(left) + std::abs(right));
    if (std::abs(left - right) > bound) return false;
    Expansion sum;
    sum.add_product(sum_of(bx, -ax), sum_of(cy, -ay), 1);
    sum.add_product(sum_of(by, -ay), sum_of(cx, -ax), -1);
    return sum.is_zero();
}

}  // namespace

bool are_on_one_line(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    return is_flat(a.x, a.y, b.x, b.y, c.x, c.y) && is_flat(a.y, a.z, b.y, b.z, c.y, c.z) &&
           is_flat(a.z, a.x, b.z, b.x, c.z, c.x);
}

}  // namespace overlook::mesh
