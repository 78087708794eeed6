// Cards of foliage that are lost as a whole: in which order, and how far what is lost lies from what stays.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/bake/discrete/shape.h"

namespace overlook::discrete {

// The cards of one part.
class Foliage {
  public:
    Foliage() = default;
    // Each component of the shape is a card. O(F log F) and the trees of some sixty prefixes, in parallel.
    explicit Foliage(Shape shape);

    size_t card_count() const { return order_.size(); }
    // The least number of cards that bounds what is lost by distance_m, as far as measured ahead.
    size_t count_within(double distance_m) const;
    uint64_t triangle_count(size_t kept) const { return triangles_before_[kept]; }

    struct Thinned {
        Shape shape;
        double error_m = 0;  // bounds the two-sided distance to all cards, as they are
        double lost_m2 = 0;  // of the area, after what stays has grown
    };
    // The first `kept` cards, each grown about its middle to make up for the area that is lost, by no more than grow_m.
    Thinned thinned(size_t kept, double grow_m) const;
    const Shape& shape() const { return shape_; }

  private:
    struct Card {
        std::vector<uint32_t> faces;
        glm::dvec3 middle_m{0};
        double area_m2 = 0, radius_m = 0;
    };
    void find_cards();
    void rank();
    void measure();
    Shape kept_shape(size_t kept, double grow_m) const;
    double lost_distance_m(size_t kept, const Shape& drawn) const;

    Shape shape_;
    std::vector<Card> cards_;
    std::vector<uint32_t> order_;                               // the last is lost first
    std::vector<uint64_t> triangles_before_;                    // [cards + 1]
    std::vector<std::pair<size_t, double>> distance_of_count_;  // ascending counts, falling distances
};

}  // namespace overlook::discrete
