#include "runtime/lod_sprite/paper_strips.h"

#include <algorithm>
#include <cassert>

namespace overlook::lod_sprite::paper {

void Strips::find_neighbours(const terrain::Cut& cut) {
    size_t corners = cut.indices.size();
    neighbours_.assign(corners, kNone);
    edges_.clear();
    for (size_t corner = 0; corner < corners; ++corner) {
        uint32_t a = cut.indices[corner], b = cut.indices[corner % 3 == 2 ? corner - 2 : corner + 1];
        bool is_new = false;
        uint32_t other = edges_.at({std::min(a, b), std::max(a, b), 0}, uint32_t(corner), is_new);
        if (is_new || neighbours_[other] != kNone) continue;  // an edge has two triangles at most
        neighbours_[corner] = other / 3;
        neighbours_[other] = uint32_t(corner / 3);
    }
}

uint32_t Strips::neighbours_left(uint32_t triangle) const {
    uint32_t count = 0;
    for (uint32_t side = 0; side < 3; ++side) {
        uint32_t other = neighbours_[3 * triangle + side];
        count += other != kNone && !is_used_[other];
    }
    return count;
}

uint32_t Strips::best_next(uint32_t triangle) const {
    uint32_t best = kNone, fewest = 4;
    for (uint32_t side = 0; side < 3; ++side) {
        uint32_t other = neighbours_[3 * triangle + side];
        if (other == kNone || is_used_[other]) continue;
        uint32_t left = neighbours_left(other);
        if (left < fewest || (left == fewest && other < best)) best = other, fewest = left;
    }
    return best;
}

uint32_t Strips::side_towards(uint32_t from, uint32_t to) const {
    uint32_t side = 0;
    while (neighbours_[3 * from + side] != to) ++side;
    return side;
}

void Strips::use(uint32_t triangle) {
    is_used_[triangle] = 1;
    order_.push_back(triangle);
}

// Vertex i of a strip is joined to the two before it, so that without a turn a strip leaves its triangles alternately by the left
// and by the right of the side that it came in by; the first triangle may be sent so that its second is reached either way.
void Strips::build(const terrain::Cut& cut, const StripOptions& options) {
    assert(options.longest >= 1);
    find_neighbours(cut);
    uint32_t count = uint32_t(cut.triangle_count());
    is_used_.assign(count, 0);
    order_.clear();
    begins_.assign(1, 0);
    vertex_count_ = 0;
    for (uint32_t first = 0; first < count; ++first) {
        if (is_used_[first]) continue;
        use(first);
        vertex_count_ += 3;
        uint32_t way_before = 0;  // out of the last triangle: 0 = either, else steps from the side it came in by, 1 or 2
        for (uint32_t at = first; order_.size() - begins_.back() < options.longest;) {
            uint32_t next = best_next(at);
            if (next == kNone) break;
            if (at != first) {
                uint32_t came_by = side_towards(at, order_[order_.size() - 2]);
                uint32_t way = (side_towards(at, next) + 3 - came_by) % 3;
                vertex_count_ += way == way_before;
                way_before = way;
            }
            use(next);
            ++vertex_count_;
            at = next;
        }
        begins_.push_back(uint32_t(order_.size()));
    }
}

uint64_t Strips::take_from_mixed(std::span<uint8_t> is_visible) const {
    uint64_t lost = 0;
    for (size_t strip = 0; strip < strip_count(); ++strip) {
        std::span<const uint32_t> own = std::span(order_).subspan(begins_[strip], begins_[strip + 1] - begins_[strip]);
        uint64_t visible = 0;
        for (uint32_t triangle : own) visible += is_visible[triangle];
        if (visible == 0 || visible == own.size()) continue;
        for (uint32_t triangle : own) is_visible[triangle] = 0;
        lost += visible;
    }
    return lost;
}

}  // namespace overlook::lod_sprite::paper
