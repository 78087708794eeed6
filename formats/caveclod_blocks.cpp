// Blocks of a mesh, one after the other.
#include "formats/caveclod_blocks.h"

#include <algorithm>

namespace overlook::caveclod {
namespace {

template <class... Args>
tl::unexpected<Error> broken(const container::Reader& file, int rule, fmt::format_string<Args...> text, Args&&... args) {
    return bad_input("{}: M{}: {}", file.name(), rule, fmt::format(text, std::forward<Args>(args)...));
}

template <class... Vectors>
uint64_t bytes_of(const Vectors&... vectors) {
    return (uint64_t(vectors.size() * sizeof(vectors[0])) + ...);
}

}  // namespace

float BlockFile::missing_error_m(uint32_t blocks) const {
    return blocks < block_count() ? error_of_code(entries_[blocks].rest_error) : 0;
}

float BlockFile::finest_error_m(uint32_t blocks) const {
    return std::max(error_of_code(finest_error_), missing_error_m(blocks));
}

std::vector<Surface> BlockFile::take_surfaces() {
    std::vector<Surface> taken = head_.surfaces;
    for (Surface& surface : head_.surfaces) std::vector<std::byte>().swap(surface.texture_bytes);
    return taken;
}

BlockFile::Counts BlockFile::counts(uint32_t block) const {
    const Entry& entry = entries_[block];
    Counts counts;
    counts.splits = entry.split_count;
    counts.positions = block == 0 ? head_.base_position_count : entry.split_count;
    counts.faces_at_most = block == 0 ? head_.base_face_count : 2 * entry.split_count;
    std::array<uint32_t, kRowCount> rows{};
    if (!count_rows(stored_.subspan(entry.offset, entry.stored_bytes), codec_, rows)) rows = {};
    uint64_t vertices = head_.attributes.normals   ? rows[kNormal] / 2
                        : head_.attributes.uvs     ? rows[kUv] / 2
                        : head_.attributes.colours ? rows[kColour] / 4
                                                   : counts.positions + uint64_t(rows[kWedge]);
    counts.vertices = std::clamp<uint64_t>(vertices, counts.positions, std::max(vertex_count_, counts.positions));
    return counts;
}

PrefixReader::PrefixReader(const BlockFile& file)
    : file_(file), hierarchy_(file.head_), unpacker_(hierarchy_, file.greatest_error_) {}

Result<void> PrefixReader::read_next() {
    uint32_t block = block_count_;
    const container::Reader& file = *file_.file_;
    const BlockFile::Entry& entry = file_.entries_[block];
    std::span<const std::byte> bytes = file_.stored_.subspan(entry.offset, entry.stored_bytes);
    if (block_checksum(bytes) != entry.checksum)
        return broken(file, 9, "block {}: its bytes do not match their checksum; was the file damaged?", block);
    if (const char* fault = rows_of_bytes(bytes, file_.codec_, rows_)) return broken(file, 10, "block {} {}", block, fault);
    uint32_t greatest = 0;
    Fault fault = block == 0 ? unpacker_.base(rows_, file_.group_count_) : unpacker_.splits(rows_, entry.split_count, greatest);
    if (fault) return broken(file, fault.rule, "block {} {}", block, fault.text);
    // What is left of splits after a block, by the directory.
    uint32_t after = block + 1 < file_.block_count() ? file_.entries_[block + 1].rest_error : 0;
    if (entry.rest_error != std::max(greatest, after) || after > kErrorCodeMax)
        return broken(file, 18, "block {} has errors up to code {}, those after it {}; {} is stated", block, greatest, after,
                      entry.rest_error);
    ++block_count_;
    const Hierarchy& h = hierarchy_;
    bool is_whole = block_count_ == file_.block_count();
    bool fits = is_whole ? h.face_positions.size() == file_.face_count_ && h.vertices.size() == file_.vertex_count_
                         : h.face_positions.size() <= file_.face_count_ && h.vertices.size() <= file_.vertex_count_;
    if (!fits)
        return broken(file, 19, "{} faces and {} vertices, {} and {} stated", h.face_positions.size(), h.vertices.size(),
                      file_.face_count_, file_.vertex_count_);
    return {};
}

Result<void> PrefixReader::complete() {
    hierarchy_.finest_error_m = file_.finest_error_m(block_count_);
    return caveclod::complete(hierarchy_);
}

uint64_t PrefixReader::bytes() const {
    const Hierarchy& h = hierarchy_;
    return unpacker_.bytes() + bytes_of(h.positions_m, h.owner, h.error_m, h.radius_m, h.cone, h.need_begin, h.needs,
                                        h.added_begin, h.moved_begin, h.moved, h.face_positions, h.face_group, h.group_surface,
                                        h.group_packed, h.vertices, h.vertex_begin, h.birth_wedge, h.moved_wedge,
                                        h.moved_back_wedge);
}

}  // namespace overlook::caveclod
