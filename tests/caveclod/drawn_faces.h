// What a refinement draws, and what its cut should draw.
#pragma once

#include <algorithm>
#include <vector>

#include "runtime/caveclod/refine.h"
#include "tests/caveclod/synthetic_hierarchy.h"

namespace overlook::caveclod::synthetic {

inline std::vector<Triangle> drawn(const Refinement& refinement) {
    std::vector<Triangle> triangles;
    const FaceSlots& faces = refinement.faces();
    for (uint32_t surface = 0; surface < faces.surface_count(); ++surface)
        for (uint32_t p = 0; p < faces.pages(surface).size(); ++p)
            for (uint32_t i = 0; i < faces.page_count(surface, p); ++i) {
                const FacePage& page = *faces.pages(surface)[p];
                triangles.push_back({page.faces[i], {}, {page.indices[3 * i], page.indices[3 * i + 1], page.indices[3 * i + 2]}});
            }
    std::sort(triangles.begin(), triangles.end());
    return triangles;
}

// Of all splits of h; what a mesh has not there is not applied.
inline std::vector<bool> applied(const Hierarchy& h, const Refinement& refinement) {
    std::vector<bool> bits(h.split_count());
    for (uint32_t i = 0; i < refinement.mesh().split_count(); ++i) bits[i] = refinement.is_applied(i);
    return bits;
}

inline std::vector<Triangle> expected(const Hierarchy& h, const Refinement& refinement) {
    std::vector<Triangle> triangles = triangles_of(h, applied(h, refinement));
    for (Triangle& t : triangles) t.positions = {};
    return triangles;
}

inline bool is_closed(const Hierarchy& h, const std::vector<bool>& is_applied) {
    for (uint32_t i = 0; i < h.split_count(); ++i)
        for (uint32_t k = h.need_begin[i]; is_applied[i] && k < h.need_begin[i + 1]; ++k)
            if (!is_applied[h.needs[k]]) return false;
    return true;
}

// All that drawing reads of a refinement.
inline std::vector<uint32_t> buffers(const Refinement& refinement) {
    std::vector<uint32_t> all;
    for (uint32_t surface = 0; surface < refinement.faces().surface_count(); ++surface)
        for (uint32_t p = 0; p < refinement.faces().pages(surface).size(); ++p) {
            const FacePage& page = *refinement.faces().pages(surface)[p];
            all.insert(all.end(), page.indices.begin(), page.indices.begin() + 3 * refinement.faces().page_count(surface, p));
        }
    for (const GlideVertex& vertex : refinement.glide_vertices())
        all.insert(all.end(), {vertex.to_bits, vertex.from[0], vertex.from[1], vertex.from[2], vertex.weights[0],
                               vertex.weights[1], uint32_t(1e6f * vertex.share)});
    return all;
}

}  // namespace overlook::caveclod::synthetic
