// What is planted on a tile, found by place and size: a grid of squares for each class of packing radii, so that a tree among
// grass costs the grass nothing.
//
// Based on: T. Ulrich, Loose Octrees, 2000 (a grid for each power of two of the sizes).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "formats/wang_tiles.h"

namespace overlook::wang_ldi {

class ObjectGrid {
  public:
    ObjectGrid(const Planting& planting, size_t tile);

    // Calls visit(index) for every object of the tile whose middle may lie within `share` times the sum of its packing radius and
    // of radius_m about (x, y), which may be anywhere, until it returns false. Returns how many squares were looked at.
    template <typename Visit>
    uint64_t visit_near(double x, double y, double radius_m, double share, Visit visit) const {
        uint64_t squares = 0;
        for (const Class& one : classes_) {
            double reach = share * (one.most_radius_m + radius_m);
            if (x + reach < 0 || y + reach < 0 || x - reach > size_m_ || y - reach > size_m_) continue;
            uint32_t left = one.square_of(x - reach), right = one.square_of(x + reach);
            for (uint32_t row = one.square_of(y - reach); row <= one.square_of(y + reach); ++row, squares += right - left + 1)
                for (uint32_t o = one.first[row * one.side + left]; o < one.first[row * one.side + right + 1]; ++o)
                    if (!visit(one.objects[o])) return squares;
        }
        return squares + classes_.size();
    }
    double most_radius_m() const { return most_radius_m_; }  // 0 of an empty tile

  private:
    struct Class {
        double most_radius_m = 0, squares_per_m = 0;
        uint32_t side = 1;
        std::vector<uint32_t> first, objects;  // [side * side + 1], [objects of the class], square by square

        uint32_t square_of(double at_m) const {
            return uint32_t(std::clamp(std::floor(at_m * squares_per_m), 0.0, double(side - 1)));
        }
    };

    void add_class(const Planting& planting, size_t tile, const std::vector<uint32_t>& objects);

    std::vector<Class> classes_;
    double size_m_ = 0, most_radius_m_ = 0;
};

}  // namespace overlook::wang_ldi
