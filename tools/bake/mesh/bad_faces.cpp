// Faces that no surface needs: without area, or there twice.

#include <algorithm>
#include <array>

#include "tools/bake/mesh/exact.h"
#include "tools/bake/mesh/faces.h"
#include "tools/bake/mesh/sheets.h"

namespace overlook::mesh {
namespace {

// A face by its positions in rising order.
struct Triple {
    uint32_t middle, high;
    uint32_t face;
    bool is_even;  // whether low, middle, high is the way round that the face goes
};

void drop_without_area(Mesh& mesh, MeshReport& report) {
    std::vector<uint8_t> keep(mesh.faces.size(), 1);
    for (size_t f = 0; f < mesh.faces.size(); ++f) {
        const Corners& c = mesh.faces[f];
        const bool repeats = c[0] == c[1] || c[1] == c[2] || c[2] == c[0];
        if (!repeats && !are_on_one_line(corner_m(mesh, f, 0), corner_m(mesh, f, 1), corner_m(mesh, f, 2))) continue;
        keep[f] = 0;
        report.dropped.push_back({mesh.face_source[f], repeats ? DropReason::repeated_position : DropReason::no_area, kNone});
    }
    keep_faces(mesh, keep);
}

// Faces by their lowest position: rows of triples, each row in rising order, equal ones by rising face.
std::vector<Triple> sorted_triples(const Mesh& mesh, std::vector<uint32_t>& begin) {
    begin.assign(mesh.positions_m.size() + 1, 0);
    const auto lowest = [](const Corners& c) { return std::min({c[0], c[1], c[2]}); };
    for (const Corners& c : mesh.faces) ++begin[lowest(c) + 1];
    for (size_t p = 1; p < begin.size(); ++p) begin[p] += begin[p - 1];
    std::vector<uint32_t> at(begin.begin(), begin.end() - 1);
    std::vector<Triple> triples(mesh.faces.size());
    for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
        Corners c = mesh.faces[f];
        std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
        triples[at[c[0]]++] = {std::min(c[1], c[2]), std::max(c[1], c[2]), f, c[1] < c[2]};
    }
    for (size_t p = 0; p + 1 < begin.size(); ++p)
        std::sort(triples.begin() + begin[p], triples.begin() + begin[p + 1], [](const Triple& a, const Triple& b) {
            return std::array{a.middle, a.high, a.face} < std::array{b.middle, b.high, b.face};
        });
    return triples;
}

}  // namespace

std::vector<uint32_t> drop_bad_faces(Mesh& mesh, MeshReport& report) {
    drop_without_area(mesh, report);

    std::vector<uint32_t> begin;
    const std::vector<Triple> triples = sorted_triples(mesh, begin);
    std::vector<uint8_t> keep(mesh.faces.size(), 1);
    std::vector<uint32_t> other_side(mesh.faces.size(), kNone);
    for (size_t p = 0; p + 1 < begin.size(); ++p) {
        uint32_t first[2] = {kNone, kNone};  // of the triple at hand, each way round
        for (uint32_t i = begin[p]; i < begin[p + 1]; ++i) {
            const Triple& t = triples[i];
            const bool is_new = i == begin[p] || triples[i - 1].middle != t.middle || triples[i - 1].high != t.high;
            if (is_new) first[0] = first[1] = kNone;
            uint32_t& same = first[t.is_even ? 1 : 0];
            if (same == kNone) {
                same = t.face;
                const uint32_t other = first[t.is_even ? 0 : 1];
                if (other != kNone) other_side[other] = t.face, other_side[t.face] = other;
            } else {
                keep[t.face] = 0;
                report.dropped.push_back({mesh.face_source[t.face], DropReason::duplicate, mesh.face_source[same]});
            }
        }
    }

    std::vector<uint32_t> number(mesh.faces.size());
    uint32_t kept = 0;
    for (size_t f = 0; f < keep.size(); ++f) number[f] = keep[f] ? kept++ : kNone;
    for (size_t f = 0; f < keep.size(); ++f)
        if (keep[f]) other_side[number[f]] = other_side[f] == kNone ? kNone : number[other_side[f]];
    other_side.resize(kept);
    keep_faces(mesh, keep);
    return other_side;
}

}  // namespace overlook::mesh
