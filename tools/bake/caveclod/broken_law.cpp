#include <fmt/format.h>

#include <algorithm>

#include "tools/bake/caveclod/cut.h"

namespace overlook::caveclod {
namespace {

constexpr uint32_t kNobody = ~uint32_t(0);

bool are_rows(const std::vector<uint32_t>& begin, size_t rows, size_t first, size_t last) {
    return begin.size() == rows + 1 && begin.front() == first && begin.back() == last &&
           std::is_sorted(begin.begin(), begin.end());
}

std::string broken_shape(const Hierarchy& h) {
    size_t splits = h.owner.size(), positions = h.positions_m.size(), faces = h.face_positions.size();
    if (positions != h.base_position_count + splits) return "positions are not those of the coarsest cut and one for each split";
    if (h.error_m.size() != splits) return "errors are not one for each split";
    if (!are_rows(h.need_begin, splits, 0, h.needs.size())) return "rows of needs";
    if (!are_rows(h.added_begin, splits, h.base_face_count, faces)) return "rows of added faces";
    if (!are_rows(h.moved_begin, splits, 0, h.moved.size())) return "rows of turned corners";
    if (!are_rows(h.vertex_begin, positions, 0, h.vertices.size())) return "rows of render vertices";
    if (h.birth_wedge.size() != 3 * faces || h.moved_wedge.size() != h.moved.size() ||
        h.moved_back_wedge.size() != h.moved.size())
        return "wedges are not one for each corner";
    if (h.face_group.size() != faces) return "groups are not one for each face";
    for (size_t p = 0; p < positions; ++p)
        for (uint32_t v = h.vertex_begin[p]; v < h.vertex_begin[p + 1]; ++v)
            if (h.vertices[v].position != p) return fmt::format("render vertex {} is not in the row of its position", v);
    return "";
}

class Replay {
  public:
    explicit Replay(const Hierarchy& h)
        : h_(h), now_(h.face_positions), touched_by_(now_.size(), kNobody), seen_(h.owner.size(), kNobody) {}

    std::string broken() {
        for (uint32_t f = 0; f < h_.base_face_count; ++f)
            if (std::string law = broken_birth(f, h_.base_position_count); !law.empty()) return law;
        for (uint32_t i = 0; i < h_.split_count(); ++i)
            if (std::string law = broken_split(i); !law.empty()) return fmt::format("split {}: {}", i, law);
        return "";
    }

  private:
    std::string broken_birth(uint32_t f, uint32_t position_count) const {
        auto p = now_[f];
        for (size_t c = 0; c < 3; ++c) {
            if (p[c] >= position_count) return fmt::format("face {} stands at a position that is not there yet", f);
            if (h_.birth_wedge[3 * f + c] >= h_.vertex_begin[p[c] + 1] - h_.vertex_begin[p[c]])
                return fmt::format("face {} has no render vertex", f);
        }
        return p[0] == p[1] || p[1] == p[2] || p[2] == p[0] ? fmt::format("face {} is degenerate", f) : "";
    }

    // Whether everything that `split` needs, directly or not, includes `wanted`.
    bool leads_to(uint32_t split, uint32_t wanted) {
        std::vector<uint32_t> pending{split};
        while (!pending.empty()) {
            uint32_t i = pending.back();
            pending.pop_back();
            for (uint32_t n = h_.need_begin[i]; n < h_.need_begin[i + 1]; ++n) {
                if (h_.needs[n] == wanted) return true;
                if (h_.needs[n] < wanted || seen_[h_.needs[n]] == stamp_) continue;
                seen_[h_.needs[n]] = stamp_;
                pending.push_back(h_.needs[n]);
            }
        }
        return false;
    }

    std::string broken_need(uint32_t i, uint32_t wanted) {
        if (wanted == kNobody) return "";
        ++stamp_;
        return leads_to(i, wanted) ? "" : fmt::format("does not need split {}, which touched a face of it last", wanted);
    }

    std::string broken_split(uint32_t i) {
        if (h_.owner[i] >= h_.new_position(i)) return "its owner is not there yet";
        for (uint32_t n = h_.need_begin[i]; n < h_.need_begin[i + 1]; ++n) {
            if (h_.needs[n] >= i) return "needs a split that is not before it";
            if (h_.error_m[h_.needs[n]] < h_.error_m[i]) return "its error is above that of a split that it needs";
        }
        uint32_t added = h_.added_begin[i + 1] - h_.added_begin[i];
        if (added < 1 || added > 2) return "adds no face, or more than two";
        if (h_.moved_begin[i] == h_.moved_begin[i + 1]) return "turns no face";
        std::vector<uint32_t> corners;
        for (uint32_t m = h_.moved_begin[i]; m < h_.moved_begin[i + 1]; ++m) {
            if (std::string law = broken_turn(i, m); !law.empty()) return law;
            for (uint32_t p : now_[h_.moved[m] / kCorners]) corners.push_back(p);
        }
        return broken_additions(i, corners);
    }

    std::string broken_turn(uint32_t i, uint32_t m) {
        uint32_t face = h_.moved[m] / kCorners, corner = h_.moved[m] % kCorners, owner = h_.owner[i], made = h_.new_position(i);
        if (face >= h_.added_begin[i] || corner > 2) return "turns a face that is not there yet";
        if (now_[face][corner] != owner) return fmt::format("turns face {}, which is not at its owner", face);
        if (std::string law = broken_need(i, touched_by_[face]); !law.empty()) return law;
        if (h_.moved_wedge[m] >= h_.vertex_begin[made + 1] - h_.vertex_begin[made])
            return "has no render vertex at the new position";
        if (h_.moved_back_wedge[m] >= h_.vertex_begin[owner + 1] - h_.vertex_begin[owner])
            return "has no render vertex at its owner";
        now_[face][corner] = made;
        touched_by_[face] = i;
        return "";
    }

    std::string broken_additions(uint32_t i, const std::vector<uint32_t>& corners) {
        for (uint32_t f = h_.added_begin[i]; f < h_.added_begin[i + 1]; ++f) {
            if (std::string law = broken_birth(f, h_.new_position(i) + 1); !law.empty()) return law;
            bool at_owner = false, at_new = false;
            for (uint32_t p : now_[f]) {
                at_owner |= p == h_.owner[i], at_new |= p == h_.new_position(i);
                bool is_known = p == h_.owner[i] || std::find(corners.begin(), corners.end(), p) != corners.end();
                if (!is_known) return fmt::format("adds face {}, whose far corner no turned face has", f);
            }
            if (!at_owner || !at_new) return fmt::format("adds face {}, which is not between its owner and its new position", f);
            touched_by_[f] = i;
        }
        return "";
    }

    const Hierarchy& h_;
    std::vector<std::array<uint32_t, 3>> now_;
    std::vector<uint32_t> touched_by_, seen_;
    uint32_t stamp_ = 0;
};

}  // namespace

std::string broken_law(const Hierarchy& hierarchy) {
    std::string law = broken_shape(hierarchy);
    return law.empty() ? Replay(hierarchy).broken() : law;
}

}  // namespace overlook::caveclod
