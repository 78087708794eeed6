#include "tools/make_sample/tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <random>

#include "tools/bake/images.h"
#include "tools/make_sample/shapes.h"

namespace overlook::sample {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr uint32_t kBark = 0, kLeaves = 1;
constexpr double kGolden_rad = 2.399963229728653;

// How the members of an order are: their count on each of the order before, length, radius, roundness, lean from the one they
// stand on.
struct Order {
    int count;
    double length_m, radius_m, lean_rad;
    double sides, rings;
};
constexpr std::array<Order, 4> kOrders{
    {{1, 5.2, 0.26, 0, 22, 26}, {9, 3.1, 0.10, 0.95, 12, 14}, {6, 1.5, 0.035, 0.8, 8, 8}, {5, 0.75, 0.012, 0.75, 5, 5}}};
constexpr int kLeavesOfTwig = 120;
constexpr double kLeaf_m = 0.085;  // half a side

struct Branch {
    int order;
    glm::dvec3 from_m, along;
    double length_m, radius_m, bend;
    glm::dvec3 bend_to;

    glm::dvec3 at_m(double share) const { return from_m + length_m * (share * along + bend * share * share * bend_to); }
};

class Grower {
  public:
    Grower(uint64_t seed, const TreeDetail& detail, ShapeMaker& shapes) : random_(seed), detail_(detail), shapes_(shapes) {}

    void grow(const Branch& branch) {
        if (branch.order <= detail_.finest_order) add_wood(branch);
        if (branch.order + 1 == int(kOrders.size())) {
            add_leaves(branch);
            return;
        }
        const Order& next = kOrders[size_t(branch.order + 1)];
        for (int i = 0; i < next.count; ++i) {
            double least = branch.order == 0 ? 0.38 : 0.25;
            double share = least + (1 - least) * (i + 0.5) / next.count;
            grow(child(branch, next, share, kGolden_rad * i + 2 * number()));
        }
    }

  private:
    double number() { return double(random_() >> 11) * 0x1p-53; }

    Branch child(const Branch& on, const Order& order, double share, double angle) {
        glm::dvec3 first = side_of(on.along), second = glm::cross(on.along, first);
        glm::dvec3 out = std::cos(angle) * first + std::sin(angle) * second;
        double lean = order.lean_rad * (0.8 + 0.4 * number()) * (on.order == 0 ? 1.3 - 0.6 * share : 1);
        double length_m = order.length_m * (0.75 + 0.5 * number()) * (1.15 - 0.55 * share);
        glm::dvec3 along = glm::normalize(std::cos(lean) * on.along + std::sin(lean) * out);
        return {on.order + 1,          on.at_m(share), along, length_m, order.radius_m * (1.2 - 0.5 * share),
                0.1 + 0.15 * number(), {0, 0, 1}};
    }

    void add_wood(const Branch& branch) {
        const Order& order = kOrders[size_t(branch.order)];
        auto sides = uint32_t(std::max(3.0, std::round(order.sides * detail_.round_share)));
        auto rings = uint32_t(std::max(1.0, std::round(order.rings * detail_.round_share)));
        glm::dvec3 first = side_of(branch.along), second = glm::cross(branch.along, first);
        bool is_trunk = branch.order == 0;
        shapes_.add_tube(kBark, rings, sides, true, [&](double share, double angle) {
            double foot = is_trunk ? 0.6 * std::exp(-9 * share) * (1 + 0.3 * std::cos(5 * angle)) : 0;
            double radius_m = branch.radius_m * (1 - 0.75 * share + foot);
            return branch.at_m(share) + radius_m * (std::cos(angle) * first + std::sin(angle) * second);
        });
    }

    void add_leaves(const Branch& twig) {
        int kept = std::max(1, int(std::lround(kLeavesOfTwig * detail_.leaf_share)));
        double grown = std::sqrt(double(kLeavesOfTwig) / kept);
        for (int i = 0; i < kLeavesOfTwig; ++i) {
            // Each leaf takes its numbers, whether it is drawn or not: every detail has the same ones.
            std::array<double, 7> n;
            for (double& v : n) v = number();
            if (i >= kept) continue;
            double share = 0.1 + 0.95 * n[0];
            double turn = kTurn * n[1], up = 2 * n[2] - 1, flat = std::sqrt(1 - up * up);
            glm::dvec3 off(flat * std::cos(turn), flat * std::sin(turn), up);
            glm::dvec3 middle_m = twig.at_m(share) + off * (0.06 + 0.3 * std::sqrt(n[3]));
            glm::dvec3 from_crown = glm::normalize(middle_m - glm::dvec3(0, 0, 5.0));
            glm::dvec3 facing = glm::normalize(from_crown + 0.9 * glm::dvec3(2 * n[4] - 1, 2 * n[5] - 1, 2 * n[6] - 0.6));
            double size_m = kLeaf_m * grown * (0.75 + 0.5 * n[5]), spin = kTurn * n[4];
            glm::dvec3 a = side_of(facing), b = glm::cross(facing, a);
            glm::dvec3 right = std::cos(spin) * a + std::sin(spin) * b, above = glm::cross(facing, right);
            shapes_.add_card(kLeaves, middle_m, size_m * right, size_m * above, glm::vec3(glm::normalize(facing + from_crown)));
        }
    }

    std::mt19937_64 random_;
    const TreeDetail& detail_;
    ShapeMaker& shapes_;
};

// Five leaves on a stalk, with a rim of opacity that falls off over a texel.
std::vector<uint8_t> leaf_pixels(uint32_t side) {
    std::vector<uint8_t> pixels;
    for (uint32_t y = 0; y < side; ++y)
        for (uint32_t x = 0; x < side; ++x) {
            glm::dvec2 at((x + 0.5) / side, 1 - (y + 0.5) / side);
            double inside = 0.012 - std::abs(at.x - 0.5 - 0.02 * std::sin(9 * at.y));  // the stalk
            if (at.y > 0.86) inside = -1;
            double vein = 1;
            for (int leaf = 0; leaf < 5; ++leaf) {
                double angle = (leaf - 2) * 0.72;
                glm::dvec2 foot(0.5, 0.12 + 0.16 * (2 - std::abs(leaf - 2))), along(std::sin(angle), std::cos(angle));
                glm::dvec2 from = at - foot;
                double on = glm::dot(from, along) / 0.46, off = from.x * along.y - from.y * along.x;
                double width = on > 0 && on < 1 ? 0.15 * std::sqrt(on) * (1 - on) * 2.2 : -1;
                if (width - std::abs(off) > inside) inside = width - std::abs(off), vein = std::min(1.0, std::abs(off) * 60);
            }
            double opacity = std::clamp(0.5 + inside * side, 0.0, 1.0);
            double light = 0.75 + 0.25 * vein;
            for (double c : {78 * light, 122 * light, 44 * light, 255 * opacity}) pixels.push_back(uint8_t(std::lround(c)));
        }
    return pixels;
}

}  // namespace

TreeDetail tree_detail(int level) {
    static constexpr TreeDetail kDetails[kTreeLevels] = {
        {1, 1, 3}, {0.5, 0.72, 3}, {0.25, 0.45, 3}, {0.13, 0.5, 2}, {0.05, 0.36, 2}};
    return kDetails[std::clamp(level, 0, kTreeLevels - 1)];
}

Result<mesh::Mesh> tree_mesh(uint64_t seed, const TreeDetail& detail) {
    constexpr uint32_t kTexels = 128;
    mesh::Surface bark, leaves;
    bark.name = "bark", bark.base_colour = {0.30f, 0.22f, 0.15f, 1};
    leaves.name = "leaves", leaves.texture = "leaves.png";
    leaves.is_alpha_masked = leaves.is_two_sided = true;
    auto png = png_bytes(kTexels, kTexels, 4, leaf_pixels(kTexels));
    if (!png) return tl::unexpected(png.error());
    const auto* bytes = reinterpret_cast<const uint8_t*>(png->data());
    leaves.texture_bytes.assign(bytes, bytes + png->size());

    ShapeMaker shapes({bark, leaves});
    const Order& trunk = kOrders[0];
    Grower(seed, detail, shapes).grow({0, {0, 0, -0.1}, {0, 0, 1}, trunk.length_m, trunk.radius_m, 0.06, {0.6, 0.3, 0}});
    return shapes.take();
}

}  // namespace overlook::sample
