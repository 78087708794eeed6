// Levels of billboards: cards with pictures in place of what they show well enough, beside what stays a mesh.
//
// Based on: X. Decoret, F. Durand, F. Sillion, J. Dorsey, Billboard Clouds for Extreme Model Simplification, 2003; A. Jakulin,
// Interactive Vegetation Rendering with Slicing and Blending, 2000 (slices across foliage, in several directions).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tools/bake/discrete/family.h"
#include "tools/bake/discrete/picture_pack.h"
#include "tools/bake/discrete/seen_area.h"

namespace overlook::discrete {

// The surface of a level's picture, while it is not yet one of the chain's.
constexpr uint32_t kPictureSurface = 0xffffffff;

struct Billboards {
    std::string kind;  // "cloud", "cross"
    Shape shape;       // faces of kPictureSurface show `picture`
    PackedPicture picture;
    double error_m = 0;  // bounds the two-sided distance to member(0) of the family
    SeenChange seen;
};

// What is to be made, before rays are cast.
struct BillboardPlan {
    std::string kind;
    double texel_m = 0;
    std::vector<CardOrder> orders;
    Shape rest;  // what stays a mesh
    uint64_t triangle_count() const { return rest.faces.size() + 2 * orders.size(); }
};

constexpr uint64_t kMostTexels = 1 << 20;

class BillboardMaker {
  public:
    // family must outlive it. Fails as Looks::make does.
    static Result<BillboardMaker> make(const Family& family);

    // Cards within distance_m or thereabouts: what is flat or can be covered by few planes on those, foliage on slices across it,
    // each part by itself; what is solid as the family cuts it.
    BillboardPlan cloud(double distance_m) const;
    // Cards through the middle: of a flat part one along it, of others upright_count upright ones that cross, and a level one
    // where has_level.
    BillboardPlan cross(int upright_count, bool has_level) const;

    // Casts the pictures and measures. Nothing where nothing is to be seen, or the pictures would have more than kMostTexels.
    std::optional<Billboards> build(const BillboardPlan& plan) const;

  private:
    struct Part {
        uint32_t part = 0;
        Shape finest;
        RayScene rays;
    };
    const Part& part_of(const CardOrder& order) const;
    void add_cards(const CardOrder& order, double texel_m, std::vector<Card>& cards) const;
    void add_slices(const Part& part, double distance_m, BillboardPlan& plan) const;
    void add_covering(const Part& part, const Shape& cut, double distance_m, BillboardPlan& plan) const;
    Shape shape_of(const BillboardPlan& plan, const std::vector<Card>& cards, const PackedPicture& picture) const;
    double error_m(const Shape& shape, const Mask& mask) const;

    explicit BillboardMaker(const Family& family) : family_(&family) {}

    const Family* family_;
    std::vector<Part> parts_;
    Shape finest_;
    Looks looks_;
    glm::dvec3 middle_m_{0};
    double radius_m_ = 0;
    std::array<double, kSeenFrom> seen_m2_{};
};

}  // namespace overlook::discrete
