// A hierarchy's mesh as it is while its splits are applied one after the other: what the writer, the reader and complete() walk
// along.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "formats/caveclod.h"

namespace overlook::caveclod {

// A corner of a face that stands at some position: the face is (that position, `next`, `previous`) counter-clockwise.
struct StarCorner {
    uint32_t corner = 0;  // face * kCorners + corner
    uint32_t next = 0, previous = 0;
    uint32_t fan = 0;                             // counted from 0 in the star
    bool begins_open = false, ends_open = false;  // the fan's first face has no neighbour before it; its last none after it
};

class MeshState {
  public:
    // Of position_count positions more, none of which has a face yet.
    void add_positions(size_t position_count) { first_.resize(first_.size() + position_count, kNone); }
    void add_face(const std::array<uint32_t, 3>& positions, const std::array<uint16_t, 3>& wedges, uint32_t touched_by);
    void move(uint32_t corner, uint32_t to, uint16_t wedge, uint32_t touched_by);

    size_t position_count() const { return first_.size(); }
    size_t face_count() const { return positions_.size(); }
    // What so many faces and positions take.
    static uint64_t bytes(uint64_t face_count, uint64_t position_count) {
        return face_count * (3 * sizeof(uint32_t) + 3 * sizeof(uint16_t) + sizeof(uint32_t) + 2 * kCorners * sizeof(uint32_t)) +
               position_count * sizeof(uint32_t);
    }
    uint64_t bytes() const { return bytes(face_count(), position_count()); }
    uint32_t position(uint32_t corner) const { return positions_[corner / kCorners][corner % kCorners]; }
    uint16_t wedge(uint32_t corner) const { return wedges_[corner / kCorners][corner % kCorners]; }
    const std::array<uint32_t, 3>& positions(uint32_t face) const { return positions_[face]; }
    // The split that last added or moved the face; kNone if none has.
    uint32_t touched_by(uint32_t face) const { return touched_by_[face]; }

    // The faces round a position, fan by fan, each counter-clockwise; open fans first, from their open ends, and closed ones from
    // their least corner. Valid until the next call. Cost O(valence * log(valence)).
    std::span<const StarCorner> star(uint32_t position);

    static constexpr uint32_t kNone = ~uint32_t(0);

  private:
    void link(uint32_t corner, uint32_t position);
    void unlink(uint32_t corner, uint32_t position);
    void gather(uint32_t position);
    void walk(size_t from, uint32_t fan);

    std::vector<std::array<uint32_t, 3>> positions_;
    std::vector<std::array<uint16_t, 3>> wedges_;
    std::vector<uint32_t> touched_by_;
    // Corners at a position are linked both ways.
    std::vector<uint32_t> first_, next_, previous_;

    // Scratch of star(): found, in order of their corners; those by next position; which are already in the answer.
    std::vector<StarCorner> found_, star_;
    std::vector<uint32_t> by_next_, by_previous_;
    std::vector<uint8_t> is_taken_;
    std::vector<uint32_t> cursor_;  // of a run of equal next positions, at its first: how many of it are known to be taken
};

}  // namespace overlook::caveclod
