// Needs, spheres and cones: what follows from the splits themselves.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "formats/caveclod_codes.h"
#include "formats/parallel.h"

namespace overlook::caveclod {
namespace {

// What rounding may take from a radius.
constexpr double kRoundedUp = 1 + 1e-6;

constexpr size_t kGrain = 4096;  // splits

struct WideCone {
    glm::dvec3 axis{0};  // of length 1, or 0 while it holds nothing
    double half_rad = 0;
    double cosine = 2;  // of half_rad; 2: a lone direction, or not known
};

double angle_rad(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// All that lies in it, by its corners.
struct Box {
    glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};

    void take(const glm::dvec3& point) { low = glm::min(low, point), high = glm::max(high, point); }
    void take(const Box& box) { low = glm::min(low, box.low), high = glm::max(high, box.high); }
    double farthest(const glm::dvec3& from) const { return glm::length(glm::max(glm::abs(low - from), glm::abs(high - from))); }
};

// The least cone round two (Barequet and Elber 2005 in general; for two it lies on the great circle through their axes).
void unite(WideCone& cone, const WideCone& other) {
    if (other.axis == glm::dvec3(0) || cone.half_rad >= std::numbers::pi) return;
    if (cone.axis == glm::dvec3(0)) {
        cone = other;
        return;
    }
    double apart = angle_rad(cone.axis, other.axis);
    if (apart + other.half_rad <= cone.half_rad) return;
    if (apart + cone.half_rad <= other.half_rad) {
        cone = other;
        return;
    }
    cone.cosine = 2;
    double half = (apart + cone.half_rad + other.half_rad) / 2;
    glm::dvec3 side = other.axis - cone.axis * glm::dot(cone.axis, other.axis);
    double length = glm::length(side);
    if (half >= std::numbers::pi || !(length > 1e-9)) {
        cone.half_rad = half >= std::numbers::pi || apart > 1 ? std::numbers::pi : half + apart;
        return;
    }
    double turn = half - cone.half_rad;
    cone.axis = glm::normalize(cone.axis * std::cos(turn) + side * (std::sin(turn) / length));
    cone.half_rad = half;
}

// The same of a lone direction: most lie well within.
void unite(WideCone& cone, const glm::dvec3& direction) {
    if (glm::dot(cone.axis, direction) > cone.cosine) return;
    unite(cone, WideCone{direction, 0});
    cone.cosine = cone.half_rad > 0 ? std::cos(cone.half_rad) : 2;
}

// The mesh on its way up, and what each split itself touches there.
class Completion {
  public:
    explicit Completion(Hierarchy& hierarchy) : hierarchy_(hierarchy), given_begin_(hierarchy.need_begin) {
        given_ = std::move(hierarchy.needs);
        hierarchy.needs.clear();
        hierarchy.need_begin.assign(1, 0);
    }

    Result<void> run() {
        if (const char* fault = shape_fault()) return refuse(0, fault);
        state_.add_positions(hierarchy_.positions_m.size());
        for (uint32_t face = 0; face < hierarchy_.base_face_count; ++face) add_face(face, MeshState::kNone);
        radius_.resize(hierarchy_.split_count());
        boxes_.resize(hierarchy_.split_count());
        cones_.resize(hierarchy_.split_count());
        for (uint32_t i = 0; i < hierarchy_.split_count(); ++i)
            if (const char* fault = apply(i)) return refuse(i, fault);
        parallel_ranges(hierarchy_.split_count(), kGrain, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) enclose(uint32_t(i));
        });
        saturate();
        return {};
    }

  private:
    static tl::unexpected<Error> refuse(uint32_t split, const char* fault) {
        return tl::unexpected(Error{Exit::our_bug, fmt::format("split {} {}", split, fault)});
    }

    const char* shape_fault() const {
        const Hierarchy& h = hierarchy_;
        size_t splits = h.owner.size();
        bool fits = h.positions_m.size() == h.base_position_count + splits && h.added_begin.size() == splits + 1 &&
                    h.moved_begin.size() == splits + 1 && h.error_m.size() == splits &&
                    h.face_positions.size() == h.added_begin.back() && h.added_begin.front() == h.base_face_count &&
                    h.moved.size() == h.moved_begin.back() && h.birth_wedge.size() == 3 * h.face_positions.size() &&
                    h.moved_wedge.size() == h.moved.size() && (given_.empty() || given_begin_.size() == splits + 1);
        return fits ? nullptr : "has rows that do not fit each other";
    }

    void add_face(uint32_t face, uint32_t split) {
        const uint16_t* wedge = hierarchy_.birth_wedge.data() + 3 * size_t(face);
        state_.add_face(hierarchy_.face_positions[face], {wedge[0], wedge[1], wedge[2]}, split);
    }

    // The versions of faces that the split makes or ends, in its sphere and its cone.
    void enclose(uint32_t split) {
        glm::dvec3 middle(hierarchy_.positions_m[hierarchy_.owner[split]]);
        double farthest2 = 0;
        for (size_t t = touched_begin_[split]; t < touched_begin_[split + 1]; ++t) {
            glm::dvec3 corners[3];
            for (size_t c = 0; c < 3; ++c) corners[c] = glm::dvec3(hierarchy_.positions_m[touched_[t][c]]);
            for (const glm::dvec3& corner : corners) {
                farthest2 = std::max(farthest2, glm::dot(corner - middle, corner - middle));
                boxes_[split].take(corner);
            }
            glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
            double length = glm::length(normal);
            if (length > 0) unite(cones_[split], normal / length);
        }
        radius_[split] = std::sqrt(farthest2);
    }

    const char* apply(uint32_t i) {
        Hierarchy& h = hierarchy_;
        uint32_t owner = h.owner[i], created = h.new_position(i);
        if (owner >= created) return "is of a position that is not there yet";
        if (h.added_begin[i + 1] - h.added_begin[i] > 2) return "adds more than two faces";
        auto moved = std::span(h.moved).subspan(h.moved_begin[i], h.moved_begin[i + 1] - h.moved_begin[i]);
        for (uint32_t corner : moved) {
            if (corner / kCorners >= h.added_begin[i] || corner % kCorners == 3 || state_.position(corner) != owner)
                return "moves a face that is not at its owner";
            touched_.push_back(state_.positions(corner / kCorners));
        }
        Added added;
        for (uint32_t face = h.added_begin[i]; face < h.added_begin[i + 1]; ++face) {
            const auto& at = h.face_positions[face];
            bool is_last = at[1] == created;
            uint32_t third = is_last ? at[2] : at[1];
            if (at[0] != owner || (is_last ? at[1] : at[2]) != created || third >= created || third == owner)
                return "adds a face that is not canonical";
            added.faces[added.count++] = {third, is_last, h.face_group[face], {}};
        }
        touched_needs(state_, h, owner, moved, added, needs_);
        if (const char* fault = add_given(i)) return fault;
        h.needs.insert(h.needs.end(), needs_.begin(), needs_.end());
        h.need_begin.push_back(uint32_t(h.needs.size()));
        for (size_t k = 0; k < moved.size(); ++k) {
            state_.move(moved[k], created, h.moved_wedge[h.moved_begin[i] + k], i);
            touched_.push_back(state_.positions(moved[k] / kCorners));
        }
        for (uint32_t face = h.added_begin[i]; face < h.added_begin[i + 1]; ++face) {
            add_face(face, i);
            touched_.push_back(h.face_positions[face]);
        }
        touched_begin_.push_back(touched_.size());
        return nullptr;
    }

    const char* add_given(uint32_t i) {
        if (given_.empty()) return nullptr;
        for (uint32_t k = given_begin_[i]; k < given_begin_[i + 1]; ++k) {
            if (given_[k] >= i) return "needs one that is not before it";
            needs_.push_back(given_[k]);
        }
        std::sort(needs_.begin(), needs_.end());
        needs_.erase(std::unique(needs_.begin(), needs_.end()), needs_.end());
        return nullptr;
    }

    // From fine to coarse: what is needed holds what needs it. Of the two spheres that do, by way of spheres and by way of boxes,
    // the lesser.
    void saturate() {
        Hierarchy& h = hierarchy_;
        h.radius_m.resize(radius_.size());
        h.cone.resize(radius_.size());
        for (uint32_t i = h.split_count(); i-- > 0;) {
            glm::dvec3 middle(h.positions_m[h.owner[i]]);
            if (boxes_[i].low.x <= boxes_[i].high.x) radius_[i] = std::min(radius_[i], boxes_[i].farthest(middle));
            h.radius_m[i] = float(radius_[i] * kRoundedUp);
            radius_[i] = std::max(double(h.radius_m[i]), radius_[i]);
            h.cone[i] = cone_of(cones_[i].axis, cones_[i].half_rad);
            for (uint32_t k = h.need_begin[i]; k < h.need_begin[i + 1]; ++k) {
                uint32_t needed = h.needs[k];
                double reach = glm::length(middle - glm::dvec3(h.positions_m[h.owner[needed]])) + radius_[i];
                radius_[needed] = std::max(radius_[needed], reach);
                boxes_[needed].take(boxes_[i]);
                unite(cones_[needed], cones_[i]);
            }
        }
    }

    Hierarchy& hierarchy_;
    std::vector<uint32_t> given_begin_, given_, needs_;
    MeshState state_;
    std::vector<std::array<uint32_t, 3>> touched_;  // by each split: versions of faces before and after it
    std::vector<size_t> touched_begin_{0};          // [S + 1] rows of touched_
    std::vector<double> radius_;
    std::vector<Box> boxes_;
    std::vector<WideCone> cones_;
};

}  // namespace

Result<void> complete(Hierarchy& hierarchy) {
    return Completion(hierarchy).run();
}

}  // namespace overlook::caveclod
