// The ground that tiles are planted on: its heights everywhere, how high, low and steep it is in a rectangle, and the planes that
// tiles are sheared onto.
//
// Based on: J. Shade, M. F. Cohen, D. P. Mitchell, Tiling Layered Depth Images, 2000, section 5.4. Ours: what a shear is wrong by
// is known exactly, the diagonal is the better of the two, and the ground's triangles need not be the tiles'.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>

#include "formats/terrain.h"
#include "runtime/wang_ldi/pyramid.h"

namespace overlook::wang_ldi {

// A rectangle of the plane, in metres east (x) and north (y).
struct Rect {
    glm::dvec2 low_m{0}, high_m{0};

    bool contains(const Rect& other) const {
        return glm::all(glm::lessThanEqual(low_m, other.low_m)) && glm::all(glm::lessThanEqual(other.high_m, high_m));
    }
    bool meets(const Rect& other) const {
        return glm::all(glm::lessThan(low_m, other.high_m)) && glm::all(glm::lessThan(other.low_m, high_m));
    }
};

struct GroundRange {
    double low_m = std::numeric_limits<double>::infinity(), high_m = -std::numeric_limits<double>::infinity();
    double steepest = 0;   // greatest rise of a triangle, metres up for a metre along
    bool is_whole = true;  // there is ground everywhere

    bool is_empty() const { return low_m > high_m; }
};

// A plane over a rectangle: height_m at its south-west corner, and metres up for a metre east and north.
struct Plane {
    double height_m = 0;
    glm::dvec2 slope{0};
};

// From south-west to north-east, or from north-west to south-east.
enum class Diagonal : uint8_t { rising, falling };

// A rectangle as two triangles with the ground's heights at its corners. halves[0] lies west of the diagonal, halves[1] east.
struct Sheared {
    Diagonal diagonal = Diagonal::rising;
    std::array<Plane, 2> halves;
    double displacement_m = 0;  // the greatest vertical distance between ground and halves: exact, but for rounding
};

// Which half a place of a rectangle belongs to, share_x and share_y (0..1) of its sides from the south-west.
inline uint32_t half_of(Diagonal diagonal, double share_x, double share_y) {
    return diagonal == Diagonal::rising ? share_x >= share_y : share_x + share_y >= 1;
}

// The half to be drawn first for an eye at such a place, which may be outside: the one that the eye is not over. The other one
// is nowhere behind it, since what separates the two is vertical.
inline uint32_t farther_half(Diagonal diagonal, double eye_share_x, double eye_share_y) {
    return 1 - half_of(diagonal, eye_share_x, eye_share_y);
}

class Ground {
  public:
    // A terrain's finest triangles: every second sample, where column and row are both odd, is the middle of a fan of eight.
    // Where a sample of a cell is void there is no ground in the cell. The terrain must outlive this. Memory: 12 bytes for 48
    // samples.
    explicit Ground(const terrain::Terrain& terrain);
    // Flat, 10,000 km to every side of the origin.
    static Ground plain(double height_m = 0);

    const Rect& extent() const { return extent_; }
    // Where there is no ground: not a number; outside of the extent: as at its nearest place.
    double height_m(const glm::dvec2& at_m) const;
    // A cell of the ground that was asked about, so that places near each other look its corners up once. Of one ground only.
    struct Asked {
        uint32_t column = std::numeric_limits<uint32_t>::max(), row = 0;
        std::array<double, 4> corners_m{};  // north-west, north-east, south-west, south-east
    };
    double height_m(const glm::dvec2& at_m, Asked& asked) const {
        return terrain_ ? height_at(grid_of(at_m), asked) : plain_height_m_;
    }

    // The lowest of the way from p to q, both inside the extent; not a number where some of it has no ground. O(cells passed).
    double lowest_m(const glm::dvec2& p, const glm::dvec2& q, Asked& asked) const;
    bool is_plain() const { return terrain_ == nullptr; }

    // Exactly the lowest and the highest, and the steepest of the triangles of all cells that it touches. Empty and not whole if
    // it is not inside the extent or touches a void. O(cells touched).
    GroundRange range(const Rect& rect) const;
    // Contains what range() of every rectangle within it says; empty only if there is no ground at all. O(1).
    GroundRange bound(const Rect& rect) const;

    // A rectangle inside the extent, without voids. O(cells touched).
    Sheared sheared(const Rect& rect, Diagonal diagonal) const;
    // With whichever diagonal is displaced less; rising if none is.
    Sheared sheared(const Rect& rect) const;

  private:
    struct Cells {  // of some cells: in steps of the terrain's heights; steepest is infinite where a sample is void
        int32_t low = std::numeric_limits<int32_t>::max(), high = std::numeric_limits<int32_t>::min();
        float steepest = 0;

        void take(const Cells& other);
    };
    struct Touched {
        uint32_t left, top, right, bottom;
    };
    Ground() = default;
    glm::dvec2 grid_of(const glm::dvec2& at_m) const;  // column and row
    double height_at(const glm::dvec2& grid) const;
    double height_at(const glm::dvec2& grid, Asked& asked) const;
    Touched touched_by(const Rect& rect) const;
    Cells cell(uint32_t column, uint32_t row) const;
    std::array<double, 4> corner_heights_m(const Rect& rect) const;  // south-west, south-east, north-west, north-east
    void displace(const Rect& rect, std::span<Sheared> all) const;   // measures how far each is displaced
    template <class Visit>
    void visit_samples_inside(const Rect& rect, const Visit& visit) const;

    const terrain::Terrain* terrain_ = nullptr;  // null: flat
    glm::dvec2 cells_per_m_{0};                  // of it, along columns and rows
    double plain_height_m_ = 0;
    Rect extent_;
    Pyramid<Cells> pyramid_;
};

}  // namespace overlook::wang_ldi
