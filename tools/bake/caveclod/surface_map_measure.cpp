// The part of the surface map that decides: where positions and crossings go when a fan changes, and how far that is.
#include <algorithm>
#include <atomic>
#include <cmath>

#include "runtime/view/nearest_in_triangle.h"
#include "tools/bake/caveclod/distances.h"
#include "tools/bake/caveclod/surface_map.h"

namespace overlook::caveclod {
namespace {

// Along the fan, places are told apart by whole numbers: twice the face's for its inside, one less for the spoke before it.
constexpr int kApex = -1000;  // the kept position, which is on all of them
// Distances are taken in double; this covers their rounding and that to float.
constexpr double kRoundingShare = 1e-6;
// A face takes about a sixth of what lies round its corners, and may be turned from what it stands for by at most some 84
// degrees.
constexpr double kShareOfCorner = 1.0 / 6, kLeastCosine = 0.1;

class FanMeasure {
  public:
    FanMeasure(SurfaceMap& map, const WorkingMesh& mesh, const Fan& fan, uint32_t number, MapChanges& changes)
        : map_(map), mesh_(mesh), fan_(fan), number_(number), changes_(changes), kept_(mesh.at(fan.kept)) {}

    Measured measure() {
        Measured measured;
        measured.splice_begin = uint32_t(changes_.splices.size());
        place_positions();
        measured.faces_its_source = faces_its_source();
        place_crossings();
        measured.splice_end = uint32_t(changes_.splices.size());
        measured.error_m = std::sqrt(greatest2_) * (1 + kRoundingShare);
        measured.thinning_m = thinning_m_;
        return measured;
    }

  private:
    glm::dvec3 at(uint32_t p) const { return glm::dvec3(map_.points[p].at_m); }
    // Other fans' positions may be placed at the same time.
    Placement placement_of(uint32_t p) const { return std::atomic_ref(map_.placement[p]).load(std::memory_order_relaxed); }
    bool is_in_fan(uint32_t face) const { return map_.fan_of_face[face] == number_; }

    void place_positions() {
        for (uint32_t i = fan_.first; i <= fan_.last; ++i) {
            probes_[i] = sided_probe_of(kept_, mesh_.at(fan_.link[i]), mesh_.at(fan_.link[i + 1]));
            area_vectors_[i] = glm::dvec3(0);
            if (i > fan_.first) beyond_spoke_[i] = glm::cross(probes_[i - 1].normal + probes_[i].normal, probes_[i].b - kept_);
        }
        changes_.inside.clear();
        if (fan_.is_closed)
            place_in_nearest(fan_.gone);
        else
            place_on_border(fan_.gone);
        for (uint32_t i = 0; i < fan_.count; ++i) {
            uint32_t face = fan_.corner[i] / kCorners;
            map_.place_in_fan[face] = uint8_t(i);
            for (uint32_t v = map_.first_in_face[face]; v != kNone; v = map_.points[v].next_in_face) place_position(v, i);
        }
    }

    void place_position(uint32_t v, uint32_t face) {
        uint32_t slot = map_.points[v].label & 3u;
        if (slot == 3) return place_inside(v, fan_.nearest_staying(face));
        if (slot != (fan_.corner[face] & 3u)) return place_on_border(v);
        place(v, fan_.nearest_staying(face), 0);
    }

    // Whether a distance might be an inward one that thins what v is of.
    bool may_thin(uint32_t v, double distance2) const {
        double may_lose_m = double(map_.may_lose_m[v]);
        return distance2 > may_lose_m * may_lose_m;
    }

    // The face between the spokes that v is between. Only where that would raise what is found is the nearest one looked for.
    void place_inside(uint32_t v, uint32_t sector) {
        glm::dvec3 p = at(v), from_kept = p - kept_;
        uint32_t start = sector;
        while (sector < fan_.last && glm::dot(beyond_spoke_[sector + 1], from_kept) > 0) ++sector;
        if (sector == start)
            while (sector > fan_.first && glm::dot(beyond_spoke_[sector], from_kept) < 0) --sector;
        double distance2 = distance2_to_triangle(p, probes_[sector]);
        if (distance2 > greatest2_ || may_thin(v, distance2))
            place_in_nearest(v);
        else
            place(v, sector, distance2);
    }

    void place_in_nearest(uint32_t v) {
        glm::dvec3 p = at(v);
        double least2 = distance2_to_triangle(p, probes_[fan_.first]);
        uint32_t nearest = fan_.first;
        for (uint32_t i = fan_.first + 1; i <= fan_.last; ++i) {
            double distance2 = distance2_to_triangle(p, probes_[i]);
            if (distance2 < least2) least2 = distance2, nearest = i;
        }
        place(v, nearest, least2);
    }

    void place_on_border(uint32_t v) {
        bool is_last = fan_.first == 1;
        double distance2 = distance2_to_segment(at(v), kept_, mesh_.at(fan_.link[is_last ? fan_.count : 0]));
        place(v, is_last ? fan_.last : fan_.first, distance2);
    }

    void place(uint32_t v, uint32_t sector, double distance2) {
        changes_.inside.push_back(v);
        std::atomic_ref(map_.placement[v]).store(Placement{number_, sector}, std::memory_order_relaxed);
        area_vectors_[sector] += glm::dvec3(map_.points[v].area_vector_m2);
        greatest2_ = std::max(greatest2_, distance2);
        if (may_thin(v, distance2)) note_thinning(v, probes_[sector]);
    }

    // How far inward v goes, along its own normal: what slides along the wall takes nothing of the thickness.
    void note_thinning(uint32_t v, const TriangleProbe& face) {
        glm::dvec3 inward(-map_.points[v].area_vector_m2);
        double length = glm::length(inward);
        if (!(length > 0)) return;
        double inward_m = glm::dot(view::nearest_in_triangle(at(v), face.a, face.b, face.c) - at(v), inward) / length;
        if (inward_m > double(map_.may_lose_m[v])) thinning_m_ = std::max(thinning_m_, inward_m);
    }

    // Against what the source's positions in the face, and in part those at its corners, have round them.
    bool faces_its_source() const {
        auto around = [&](uint32_t p) { return glm::dvec3(map_.points[p].area_vector_m2); };
        for (uint32_t i = fan_.first; i <= fan_.last; ++i) {
            glm::dvec3 corners = around(fan_.kept) + around(fan_.link[i]) + around(fan_.link[i + 1]);
            glm::dvec3 region = area_vectors_[i] + corners * kShareOfCorner, normal = probes_[i].normal;
            double both = glm::dot(normal, region);
            double least2 = kLeastCosine * kLeastCosine * glm::dot(normal, normal) * glm::dot(region, region);
            if (both < 0 || both * both < least2) return false;
        }
        return true;
    }

    void place_crossings() {
        for (uint32_t v : changes_.inside) {
            uint32_t sector = map_.placement[v].place;
            for (uint32_t i = map_.star_begin[v]; i < map_.star_begin[v + 1]; ++i) {
                auto [edge, other] = map_.star[i];
                Placement there = placement_of(other);
                if (there.fan == number_ && other < v) continue;
                bool is_plain = there.fan == number_ && there.place == sector && map_.first_on_source[edge] == kNone;
                if (!is_plain) cross(edge);
            }
        }
        for (uint32_t place = 0; place < fan_.count; ++place) {
            uint32_t spoke = mesh_.edge(previous_corner(fan_.corner[place]));
            for (uint32_t c = map_.first_on_cut[spoke]; c != kNone; c = map_.crossings[c].next_on_cut) {
                uint32_t edge = map_.crossings[c].source_edge;
                bool has_end_inside =
                    placement_of(map_.ends[edge][0]).fan == number_ || placement_of(map_.ends[edge][1]).fan == number_;
                if (!has_end_inside && first_inside(edge) == c) cross(edge);
            }
        }
    }

    // How many of the two faces at a simplified edge are in the fan: 2 for a spoke, 1 for a link edge. `face` is one of them.
    uint32_t faces_in_fan(uint32_t cut_edge, uint32_t& face) const {
        uint32_t count = 0;
        for (uint32_t corner : mesh_.edge_corners[cut_edge])
            if (corner != kNone && is_in_fan(corner / kCorners)) ++count, face = corner / kCorners;
        return count;
    }

    uint32_t first_inside(uint32_t source_edge) const {
        uint32_t c = map_.first_on_source[source_edge], face = kNone;
        while (c != kNone && faces_in_fan(map_.crossings[c].cut_edge, face) != 2) c = map_.crossings[c].next_on_source;
        return c;
    }

    // Where along the fan the end p of a source edge is.
    int level_of_end(uint32_t p) const {
        if (Placement there = placement_of(p); there.fan == number_) return 2 * int(there.place);
        if (p == fan_.kept) return kApex;
        auto found = std::find(fan_.link.begin(), fan_.link.begin() + fan_.count + 1, p);
        return 2 * int(found - fan_.link.begin()) - 1;
    }

    // One stretch of a source edge within the fan.
    struct Run {
        uint32_t before = kNone;
        double begin_at = 0;
        int level = 0;
        uint32_t lost = 0;  // crossings
    };

    bool begins_inside(uint32_t a, uint32_t b, uint32_t first) const {
        if (placement_of(a).fan == number_) return true;
        if (map_.points[a].label != kNone) return false;
        uint32_t face = kNone;
        return first == kNone ? placement_of(b).fan == number_ : faces_in_fan(map_.crossings[first].cut_edge, face) == 2;
    }

    void cross(uint32_t source_edge) {
        auto [a, b] = map_.ends[source_edge];
        uint32_t c = map_.first_on_source[source_edge];
        bool inside = begins_inside(a, b, c);
        Run run;
        if (inside) run.level = level_of_end(a);
        for (; c != kNone; c = map_.crossings[c].next_on_source) {
            uint32_t face = kNone, count = faces_in_fan(map_.crossings[c].cut_edge, face);
            if (count == 0) continue;
            if (count == 2) {
                ++run.lost;
                continue;
            }
            int level = 2 * int(fan_.nearest_staying(map_.place_in_fan[face]));
            if (inside)
                finish(source_edge, run, c, double(map_.crossings[c].at), level);
            else
                run = {c, double(map_.crossings[c].at), level, 0};
            inside = !inside;
        }
        if (inside) finish(source_edge, run, kNone, 1, level_of_end(b));
    }

    void finish(uint32_t source_edge, const Run& run, uint32_t after, double end_at, int level) {
        Splice splice{source_edge, run.before, after, uint32_t(changes_.added.size()), 0};
        bool is_apex = run.level == kApex || level == kApex;
        float begin_at = float(run.begin_at);
        if (!is_apex && run.level < level)
            for (int at = run.level + 1; at < level; ++at)
                if (at % 2 != 0) begin_at = cross_spoke(source_edge, uint32_t(at + 1) / 2, begin_at, float(end_at));
        if (!is_apex && run.level > level)
            for (int at = run.level - 1; at > level; --at)
                if (at % 2 != 0) begin_at = cross_spoke(source_edge, uint32_t(at + 1) / 2, begin_at, float(end_at));
        splice.end = uint32_t(changes_.added.size());
        if (splice.end > splice.begin || run.lost > 0) changes_.splices.push_back(splice);
    }

    float cross_spoke(uint32_t source_edge, uint32_t place, float begin_at, float end_at) {
        glm::dvec3 a = at(map_.ends[source_edge][0]), b = at(map_.ends[source_edge][1]), end = mesh_.at(fan_.link[place]);
        glm::dvec3 from = a + (b - a) * double(begin_at), to = a + (b - a) * double(end_at);
        double share = nearest_share(from, to, kept_, end);
        float where = std::clamp(float(begin_at + share * (double(end_at) - double(begin_at))), begin_at, end_at);
        greatest2_ = std::max(greatest2_, distance2_to_segment(a + (b - a) * double(where), kept_, end));
        changes_.added.push_back({place, where});
        return where;
    }

    SurfaceMap& map_;
    const WorkingMesh& mesh_;
    const Fan& fan_;
    uint32_t number_;
    MapChanges& changes_;
    glm::dvec3 kept_;
    double greatest2_ = 0, thinning_m_ = 0;
    std::array<SidedProbe, kMostValence> probes_;
    std::array<glm::dvec3, kMostValence> area_vectors_;
    std::array<glm::dvec3, kMostValence> beyond_spoke_;  // points from the spoke before a face into it
};

}  // namespace

Measured measure_collapse(SurfaceMap& map, const WorkingMesh& mesh, const Fan& fan, uint32_t fan_number, MapChanges& changes) {
    return FanMeasure(map, mesh, fan, fan_number, changes).measure();
}

}  // namespace overlook::caveclod
