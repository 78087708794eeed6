// What reading and repairing a mesh found and did: every face of the file is in the mesh or stands here.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tools/bake/mesh.h"

namespace overlook::mesh {

enum class DropReason : uint8_t {
    too_few_corners,    // a "polygon" of one or two corners
    not_finite,         // a corner's position is NaN or infinite
    repeated_position,  // two corners lie at one position
    no_area,            // three positions on one line
    duplicate,          // the same three positions, the same way round, as the face `twin`
};
constexpr size_t kDropReasonCount = 5;

// "no_area" and so on, as reports write it.
std::string_view name_of(DropReason reason);

// A triangle of the file that is not in the mesh. Numbers count the file's triangles from 0, in its order; a polygon of n corners
// is n - 2 of them, one of fewer than three is one.
struct DroppedFace {
    uint32_t source = 0;
    DropReason reason = DropReason::no_area;
    uint32_t twin = kNone;  // duplicate: the file's triangle that was kept instead
};

// triangle_count == face_count + dropped.size(), always.
struct MeshReport {
    std::string form;         // "OBJ", "PLY ascii", "PLY binary", "OFF", "STL ascii", "STL binary", "glTF", "GLB"
    std::string source_name;  // bare file name
    std::string source_hash;  // XXH3-128 of the file's bytes, 32 hex digits

    // What stands in the file.
    uint64_t polygon_count = 0;          // faces as written, strips counted by their triangles
    uint64_t triangle_count = 0;         // ... cut into triangles
    uint64_t file_position_count = 0;    // positions as written (glTF: by node that draws them)
    uint64_t strip_glue_count = 0;       // triangles of strips and fans with an index twice, which only lead on: no faces
    uint32_t lod_count = 0;              // of glTF: the most levels that a node names besides itself (MSFT_lod)
    uint64_t other_primitive_count = 0;  // points and lines, which have no face

    // What the mesh has.
    uint64_t face_count = 0;
    uint64_t position_count = 0;
    uint64_t component_count = 0;         // pieces connected over edges, after repair
    uint64_t closed_component_count = 0;  // of them those without a border
    uint64_t border_edge_count = 0;

    // What was done.
    uint64_t welded_position_count = 0;     // equal to one before them
    uint64_t unused_position_count = 0;     // used by no face that was kept
    uint64_t flipped_face_count = 0;        // turned to agree with their neighbours
    uint64_t back_side_count = 0;           // faces that stand the other way round too; kept, on sheets of their own
    uint64_t complex_edge_count = 0;        // edges of three faces or more, not counting back sides
    uint64_t unorientable_edge_count = 0;   // edges of two faces that no turning makes agree (Moebius, Klein); cut
    uint64_t contradicting_edge_count = 0;  // ... whose faces each agree with their own normals, but not with each other; cut
    uint64_t cut_edge_count = 0;            // edges that were added by taking apart faces that shared one
    uint64_t split_position_count = 0;      // positions that were added to take sheets apart
    uint64_t bad_normal_count = 0;          // normals of the file, not finite or of no length: taken as missing
    uint64_t bad_uv_count = 0;              // texture coordinates that are not finite: taken as missing
    double rounding_m = 0;                  // the farthest that a position lies from where the file puts it

    std::vector<DroppedFace> dropped;  // by rising source
    std::vector<std::string> notes;    // a line each: what the file asks for that is missing or not read ("a.mtl: ...")

    uint64_t dropped_count(DropReason reason) const;
};

// The report for people: a line each for what stands in the file, what the mesh has, what was done, and the notes.
std::vector<std::string> text_of(const MeshReport& report);

}  // namespace overlook::mesh
