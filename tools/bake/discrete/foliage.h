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
    // Each component of the shape is a card. O(F log F) for each of some forty prefixes of the order, in parallel.
    explicit Foliage(Shape shape);

    size_t card_count() const { return cards_.size(); }
    const Shape& shape() const { return shape_; }

    // Cards by their places in the order of importance, ascending: few, and such that every point of each other card is within
    // distance_m of one of them.
    std::vector<uint32_t> kept_within(double distance_m) const;

    struct Thinned {
        Shape shape;
        double error_m = 0;  // bounds the two-sided distance to all cards, as they are
        double lost_m2 = 0;  // of the area, after what stays has grown
    };
    // Those cards, each grown about its middle to make up for the area that is lost, by no more than grow_m.
    Thinned thinned(const std::vector<uint32_t>& kept, double grow_m) const;

  private:
    struct Card {
        std::vector<uint32_t> faces;
        glm::dvec3 middle_m{0};
        double area_m2 = 0, radius_m = 0;
    };
    void find_cards();
    void rank();
    void measure();
    Shape kept_shape(const std::vector<uint32_t>& kept, double grow_m) const;
    std::vector<float> distances_m(const std::vector<uint32_t>& kept, const Shape& drawn) const;

    Shape shape_;
    std::vector<Card> cards_;
    std::vector<uint32_t> order_;  // the last is lost first
    // Of so many cards, the first of the order: how far every card's farthest point is from them (0 of their own).
    struct Prefix {
        uint32_t count = 0;
        std::vector<float> distance_m;  // [cards], in the order
    };
    std::vector<Prefix> prefixes_;
};

}  // namespace overlook::discrete
