// Meshes of which a part is in memory: blocks that come and go, coarse to fine, as cameras ask for what is missing
// (runtime/stream).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "formats/caveclod_blocks.h"
#include "runtime/caveclod/mesh.h"
#include "runtime/caveclod/refine.h"
#include "runtime/stream/stream.h"

namespace overlook::caveclod {

// Taking in blocks costs O(all that is there then), so what is large comes by more than one: ends of the runs that come at once,
// the coarsest cut alone and then each at least an eighth of the splits before it, but for the last. So loading all of a mesh
// costs O(its splits), nine times what reading it whole does, and no more than an eighth of it waits for others.
std::vector<uint32_t> runs_of_blocks(std::span<const uint32_t> split_counts);

// A mesh's blocks each need the one before, so what is there of a mesh is always its first blocks: a mesh of its own, the one
// that read(file, blocks) gives. It grows by a run of blocks between two frames, under the refinements of all cameras that share
// it, and loses its last run when no refinement stands on that any more.
//
// Several meshes share one budget: an error in pixels means the same in each, so that room goes where the picture lacks most. Of
// its own budget each would keep room that another needs. Where all room is in use, the mesh that lacks most takes the last run
// of the one that would show it least: refinements collapse what stands on it in their own time, then it goes.
//
// The budget counts all that grows with a mesh: what refinements read, its vertices on the graphics card, and what a worker keeps
// of a file to read on and works with. Surfaces' pictures come whole, and are not counted. What a block takes is planned for by
// what its rows state, and known when it is there.
class MeshStream {
  public:
    // Takes in the coarsest cuts, which stay. Blocks that are beyond the budget by themselves never come. Fails as
    // BlockFile::open, read(), Mesh::make and stream::Stream.
    static Result<std::unique_ptr<MeshStream>> open(std::vector<container::Reader> files, const stream::Settings& settings);
    MeshStream(const MeshStream&) = delete;
    MeshStream& operator=(const MeshStream&) = delete;
    ~MeshStream();

    size_t mesh_count() const { return parts_.size(); }
    const Mesh& mesh(size_t i) const;  // stays where it is
    // Of a mesh, with the coarsest cut.
    uint32_t block_count(size_t i) const;
    uint32_t resident_block_count(size_t i) const;
    const stream::Counts& counts() const { return stream_->counts(); }
    bool is_settled() const { return stream_->is_settled(); }

    // A frame: begin; any refinements, each taken note of, those too that stay as they were; end. Meshes grow in begin_frame and
    // shrink in end_frame. Returns why blocks could not be read, each once: then the mesh stays as coarse as it is.
    std::span<const Error> begin_frame();
    // refinement: of mesh i, as it is drawn. missing_px: by its FrameReport; what is beyond settings.error_px is asked for first,
    // other blocks come where there is room. Refinement, camera and settings must stay until end_frame().
    void take_note(size_t i, const Refinement& refinement, const view::Camera& camera, const Settings& settings,
                   double missing_px);
    void end_frame();

  private:
    struct Part;
    MeshStream() = default;
    stream::Source source_of(const stream::Settings& settings);
    static Result<stream::Bytes> decode(Part& part, uint32_t run);
    Part& part_of(uint32_t stream_block);
    void take_arrived(Part& part);
    void ask();
    void give_way();
    void drop(Part& part);

    uint64_t budget_bytes_ = 0;
    std::vector<std::unique_ptr<Part>> parts_;
    std::unique_ptr<stream::Stream> stream_;  // last: its workers use the others
};

}  // namespace overlook::caveclod
