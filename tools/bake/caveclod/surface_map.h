// A continuous map from the source's surface onto the simplified one, kept up to date through every collapse. How far it moves
// any point bounds the two-sided distance between the two: the error that the baker promises.
//
// Every source position v that has gone lies in one simplified face and is mapped to that face's point nearest to v. Where a
// source edge leads from one face into another it crosses simplified edges; each crossing, a point of the source edge, is mapped
// to the point nearest to it on the simplified edge. Positions that have not gone, and the source's border, stay where they are
// or go to the nearest point of their border edge. Between these points the map is linear: faces are convex, so all of it lies in
// the simplified surface, and since a distance is convex, no point of the source moves farther than the farthest of these points.
// A collapse replaces the map inside one disc and leaves it as it is on the disc's rim, so it stays homotopic to the identity and
// therefore reaches every point of the simplified surface: the bound holds both ways. The map of a face depends on nothing but
// the collapses that led to the face, so it is the same in every legal cut in which the face appears.
//
// Related: J. Cohen, D. Manocha, M. Olano, Simplifying Polygonal Models Using Successive Mappings, 1997 (adds up the moves of one
// collapse after another, where this measures against the source each time); A. Ciampalini, P. Cignoni, C. Montani, R. Scopigno,
// Multiresolution Decimation Based on Global Error, 1997 (gone vertices kept with the faces, as an estimate); A. Lee, W.
// Sweldens, P. Schroeder, L. Cowsar, D. Dobkin, MAPS, 1998.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tools/bake/caveclod/working_mesh.h"

namespace overlook::caveclod {

// Where a source edge crosses a simplified one.
struct Crossing {
    uint32_t cut_edge = kNone, source_edge = kNone;
    uint32_t next_on_source = kNone, next_on_cut = kNone;
    float at = 0;  // of the way from the source edge's first end to its second, 0..1
};

struct SourceEnd {
    uint32_t edge = kNone, other = kNone;
};

// A position of the source, with what is always needed with it in half a line of memory.
struct alignas(32) MapPoint {
    glm::vec3 at_m{0};
    // face * kCorners + 3 inside a face, + 0, 1 or 2 on the border edge that faces this corner; kNone: has not gone
    uint32_t label = kNone;
    glm::vec3 area_vector_m2{0};  // a third of the source's faces round it, times 2
    uint32_t next_in_face = kNone;
};

struct alignas(8) Placement {
    uint32_t fan = kNone, place = 0;
};

struct SurfaceMap {
    std::vector<MapPoint> points;   // [P]
    std::vector<float> may_lose_m;  // [P] how far each may go inward without thinning what it is of; infinite at first
    std::vector<std::array<uint32_t, 2>> ends;  // [E] positions of each source edge
    std::vector<uint32_t> star_begin;           // [P + 1] rows over `star`
    std::vector<SourceEnd> star;                // [2E] the source edges at each position
    std::vector<uint32_t> first_on_source;      // [E] the crossings of each source edge, in order
    std::vector<uint32_t> first_on_cut;         // [E] those of each simplified edge, in any
    std::vector<Crossing> crossings;
    std::vector<uint32_t> first_in_face;  // [F] positions of each face
    // Written while collapses are measured: whose fan each face is in, its number there; the last fan that each position was in,
    // and which of its faces would have the position afterwards.
    std::vector<uint32_t> fan_of_face;  // [F]
    std::vector<uint8_t> place_in_fan;  // [F]
    std::vector<Placement> placement;   // [P]
};

SurfaceMap make_surface_map(const WorkingMesh& mesh);

// New crossings of one source edge: those between `before` and `after` (kNone: its ends) give way to added[begin .. end).
struct Splice {
    uint32_t source_edge = kNone, before = kNone, after = kNone, begin = 0, end = 0;
};
struct AddedCrossing {
    uint32_t place = 0;  // in the fan: crosses the edge from the kept position to link[place]
    float at = 0;
};

// What the collapses of one block change; also holds crossings that may be used again.
struct MapChanges {
    std::vector<Splice> splices;
    std::vector<AddedCrossing> added;
    std::vector<uint32_t> spare;   // of SurfaceMap::crossings
    std::vector<uint32_t> inside;  // scratch
};

struct Measured {
    double error_m = 0;            // of what the collapse makes; what it leaves as it was has its own already
    double thinning_m = 0;         // the farthest inward that a position goes which may not go so far; 0: none does
    bool faces_its_source = true;  // no new face looks away from the source that is mapped to it
    uint32_t splice_begin = 0, splice_end = 0;
};

// Measures a collapse without making it. fan_of_face must say `fan_number` for exactly the fan's faces. Collapses whose fans have
// no face in common may be measured at once. Cost: linear in the source positions and crossings in the fan.
Measured measure_collapse(SurfaceMap& map, const WorkingMesh& mesh, const Fan& fan, uint32_t fan_number, MapChanges& changes);

// Makes the change, before the mesh makes its own (apply_collapse). changes.spare holds at least as many as the splices add.
// Collapses whose fans have no face in common may be made at once.
void apply_to_map(SurfaceMap& map, const WorkingMesh& mesh, const Fan& fan, const Measured& measured, MapChanges& changes);

}  // namespace overlook::caveclod
