// A baked mesh read block by block: what reading it whole does, and what streaming it needs.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "formats/caveclod.h"
#include "formats/caveclod_layout.h"
#include "formats/container.h"

namespace overlook::caveclod {

// Head and directory of a mesh's file, checked; the blocks stay in the file as they are stored. Block 0 is the coarsest cut, each
// of the others some splits more. The file must outlive it.
class BlockFile {
  public:
    // Fails as read().
    static Result<BlockFile> open(const container::Reader& file);

    uint32_t block_count() const { return uint32_t(entries_.size()); }
    uint32_t split_count() const { return split_count_; }
    uint32_t face_count() const { return face_count_; }
    uint32_t vertex_count() const { return vertex_count_; }
    uint32_t first_split(uint32_t block) const { return entries_[block].first_split; }
    uint64_t stored_begin(uint32_t block) const { return entries_[block].offset; }  // in MBLK
    // The stated error of the cut with every split of the first `blocks` blocks (1 at least) applied.
    float finest_error_m(uint32_t blocks) const;
    // Of what blocks after the first `blocks` hold: no split there bounds more. 0 if there is none.
    float missing_error_m(uint32_t blocks) const;

    // The surfaces as they are drawn; what is read from here on has them without their pictures.
    std::vector<Surface> take_surfaces();

    // What a block adds, by what its rows state, without decoding them: nobody knows whether it is true before the block is read.
    struct Counts {
        uint32_t splits = 0, positions = 0, faces_at_most = 0;
        uint64_t vertices = 0;
    };
    Counts counts(uint32_t block) const;

  private:
    friend class PrefixReader;
    friend class HeadReader;
    struct Entry {
        uint64_t offset = 0, checksum = 0;
        uint32_t stored_bytes = 0, first_split = 0, split_count = 0, rest_error = 0;
    };
    BlockFile() = default;

    const container::Reader* file_ = nullptr;
    std::span<const std::byte> stored_;
    std::vector<Entry> entries_;
    Hierarchy head_;  // without positions, splits and faces
    uint32_t split_count_ = 0, face_count_ = 0, vertex_count_ = 0, group_count_ = 0;
    uint32_t finest_error_ = 0, greatest_error_ = 0;  // codes
    Codec codec_ = Codec::meshopt;
};

// The first blocks of a file as a hierarchy that grows. The block file must outlive it.
class PrefixReader {
  public:
    explicit PrefixReader(const BlockFile& file);
    PrefixReader(const PrefixReader&) = delete;
    PrefixReader& operator=(const PrefixReader&) = delete;

    uint32_t block_count() const { return block_count_; }  // read so far
    // Reads the next block; there must be one. Fails as read(); then nothing more can be read. Cost O(the block).
    Result<void> read_next();
    // Makes what was read a hierarchy like that of read(file, block_count() - 1). At least block 0 must be read. Cost O(all that
    // was read). More may be read afterwards.
    Result<void> complete();
    const Hierarchy& hierarchy() const { return hierarchy_; }
    Hierarchy take() { return std::move(hierarchy_); }  // then nothing more can be read

    // What it keeps in memory, the surfaces left out.
    uint64_t bytes() const;

  private:
    const BlockFile& file_;
    Hierarchy hierarchy_;
    Unpacker unpacker_;
    Rows rows_;
    uint32_t block_count_ = 0;
};

}  // namespace overlook::caveclod
