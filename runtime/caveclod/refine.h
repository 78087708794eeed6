// Which faces of a mesh one camera draws: a set of splits that is closed under what they need, changed a little every frame.
//
// Based on: H. Hoppe, View-Dependent Refinement of Progressive Meshes, 1997 (incremental refinement, amortised by a budget,
// geomorphs); B. Kram, C. Shaw, Multiple Camera Considerations in a View-Dependent Continuous Level of Detail Algorithm, 2002
// (what is a camera's own); M. Duchaineau et al., ROAMing Terrain, 1997 (two queues under a budget of triangles). Different here:
// a camera has bits of splits instead of pointers to nodes, and evaluates only splits that could change now: those not applied
// whose needs all are, and those applied that nothing applied needs.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "runtime/caveclod/face_slots.h"
#include "runtime/caveclod/glide_list.h"
#include "runtime/caveclod/mesh.h"
#include "runtime/caveclod/settings.h"
#include "runtime/view/camera.h"
#include "runtime/view/pixel_detail.h"

namespace overlook::caveclod {

class ScreenTest;

// One camera's refinement of one mesh, which must outlive it. Any number of them may refine one mesh at once, each in one thread.
// Between two frames the mesh may grow, and shrink to no less than split_end().
//
// An index of a face is a vertex of the mesh, or mesh.glide_begin() + the place in glide_vertices().
//
// Why gliding keeps the promise: a split glides only if its new position is on one side of all the faces it moves, their normals
// and those of all that they stand for lie within a half-space about one direction, and the star goes round once. Then both forms
// of the star are heights over one region, seen along that direction; the tetrahedra between the old and the new corner over each
// face moved all have one orientation, and their sum's boundary is the new form less the old, so they fill what is between the
// two and nothing else. A corner part of the way lies on the edge between the two corners, and its faces within those tetrahedra:
// what is drawn lies between what was drawn and what will be drawn. Both keep error_px as cuts of their own: a split begins to
// glide at kGlideEnter of the error that forces it, and jumps to its place as soon as that is reached. Stars that glide at the
// same time share no face, since a split that touches another's faces needs it, and is not applied before the other has arrived;
// so the cuts with every gliding star at its lower, and at its upper form are legal too, and bound the picture from both sides.
//
// All other splits fade: the new position is at its place at once, which is the finer cut itself, and looks at first as the
// coarser surface did there (what its face's corners make of it by the barycentric coordinates of the nearest of the faces
// moved), then more and more as itself. They need not begin early.
class Refinement {
  public:
    explicit Refinement(const Mesh& mesh);

    // Brings the faces nearer to what the camera asks for, by most_operations at most. dt_s >= 0: time since the last frame, for
    // glides. finer: parts of the picture that keep another error, less than settings.error_px; null = none. Cost:
    // O(splits / 64) + O(evaluated) + O(operations * log(operations)).
    FrameReport refine(const view::Camera& camera, const Settings& settings, double dt_s,
                       const view::FinerParts* finer = nullptr);

    const FaceSlots& faces() const { return faces_; }
    std::span<const GlideVertex> glide_vertices() const { return glides_.vertices(); }
    // What draws has taken all that has changed.
    void clear_dirty() { faces_.clear_dirty(); }

    bool is_applied(uint32_t split) const { return has(applied_, split); }
    // Above all splits that are applied or on their way.
    uint32_t split_end() const;
    // Where an index is drawn now, in the world.
    glm::dvec3 place_m(uint32_t index) const;
    // Bounds the displacement in pixels of all drawn in view, as the camera of the last frame saw it, by what lies within error_m
    // of it: without looking at faces where that is at most enough_px. Cost O(faces) at most.
    double displaced_px(const view::Camera& camera, const Settings& settings, double error_m, double enough_px) const;
    const Mesh& mesh() const { return mesh_; }
    // Pieces that a frame's looking falls into, which refine_all() shares out.
    size_t part_count() const;

    struct Bytes {
        uint64_t fixed = 0;   // whatever is drawn: bits
        uint64_t active = 0;  // grows with what is drawn
        uint64_t glides = 0;  // of that on its way
    };
    Bytes bytes() const;

  private:
    friend class TeamFrame;
    using Bits = std::vector<uint64_t>;
    static bool has(const Bits& bits, uint32_t i) { return (bits[i / 64] >> (i % 64) & 1) != 0; }
    static void put(Bits& bits, uint32_t i, bool value) {
        uint64_t bit = uint64_t(1) << (i % 64);
        bits[i / 64] = value ? bits[i / 64] | bit : bits[i / 64] & ~bit;
    }

    struct Wish {
        double error_px;
        uint32_t split;
        // By error, and among equals the coarser before the finer.
        bool operator<(const Wish& other) const {
            return error_px != other.error_px ? error_px < other.error_px : split > other.split;
        }
        bool operator>(const Wish& other) const { return other < *this; }
    };
    // What looking at some splits has found. Nothing is changed meanwhile, so that threads may share them out.
    struct Found {
        std::vector<uint32_t> waiting, standing, moving;  // that were looked at: not applied; applied; on their way
        std::vector<Wish> splits, collapses, reserve;
        std::vector<uint32_t> turned, arrived;  // on their way: those that shall not collapse, those that must be at their place
        double error_px = 0;                    // the greatest of them that is left unsplit in view, and whose it is
        uint32_t greatest = 0, evaluated_count = 0;

        void leave(uint32_t split, double px) {
            if (px > error_px) error_px = px, greatest = split;
        }
        void clear();
    };
    struct Frame;  // what one call of refine() works with

    // refine() in three steps: between the first and the last any threads may look at parts, each once.
    void begin(Frame& frame, double dt_s);
    void look(const Frame& frame, size_t part);
    void finish(Frame& frame);

    void follow_mesh();
    void open(uint32_t split) { put(open_, split, true); }
    void close(uint32_t split) { put(open_, split, false); }
    void look_at(const Frame& frame, uint32_t split, Found& found) const;
    void look_at_waiting(const Frame& frame, Found& found) const;
    void look_at_standing(const Frame& frame, Found& found) const;
    void guess_greatest(Frame& frame);
    void take(Frame& frame, const Found& found);
    void evaluate(Frame& frame, uint32_t split);
    void operate(Frame& frame);
    void undo_unwanted(Frame& frame);
    bool split_next(Frame& frame);
    bool collapse_next(Frame& frame);
    bool make_room(Frame& frame, double error_px);
    void apply(Frame& frame, const Wish& wish);
    bool may_glide(const Frame& frame, const Wish& wish) const;
    void undo(Frame& frame, uint32_t split);
    void take_back(uint32_t split);

    void start_glide(uint32_t split, bool is_collapsing, float share);
    void find_sources(bool glides);
    bool must_wait(const Frame& frame, const Wish& wish);
    void finish_glide(uint32_t split);
    void advance_glides(Frame& frame, double dt_s);

    const Mesh& mesh_;
    uint32_t split_count_ = 0;  // the mesh's when it was looked at last
    // Of splits: applied; could be applied or undone now; on its way.
    Bits applied_, open_, gliding_;
    FaceSlots faces_;
    GlideList glides_;
    uint32_t greatest_left_ = 0;  // of the splits that the last frame left unsplit: that of the greatest error
    // Scratch.
    SplitRecord record_, other_;
    std::vector<uint32_t> needs_, opened_, slots_;
    std::vector<Wish> splits_, collapses_, reserve_;
    Found one_;                 // of a single split
    std::vector<Found> parts_;  // [part_count()]
    std::vector<Glide> arrived_;
    std::vector<GlideVertex> sources_;  // of the split that begins: one for each new vertex
    std::vector<double> inside_;        // [as sources_] how far inside its face a vertex lies, least barycentric coordinate
};

// Refines each camera's own, several at once; the result is that of one after the other. All spans of one length. Takes no more
// threads than there are parts.
void refine_all(std::span<Refinement* const> refinements, std::span<const view::Camera> cameras, const Settings& settings,
                double dt_s, std::span<FrameReport> reports);

// The paper's comparison (Kram and Shaw 2002, 4.2), the variant `shared`: one refinement is brought to what each camera wants in
// turn, every frame, whatever that takes (no budget of operations, nothing glides), and `draw(camera)` is called when it is
// there.
void refine_in_turn(Refinement& shared, std::span<const view::Camera> cameras, const Settings& settings,
                    const std::function<void(size_t camera)>& draw, std::span<FrameReport> reports);

}  // namespace overlook::caveclod
