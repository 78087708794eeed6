#include <algorithm>
#include <cmath>
#include <new>

#include "formats/caveclod_blocks.h"

namespace overlook::caveclod {
namespace {

using container::Reader;
using container::Section;

template <class... Args>
tl::unexpected<Error> broken(const Reader& file, int rule, fmt::format_string<Args...> text, Args&&... args) {
    return bad_input("{}: M{}: {}", file.name(), rule, fmt::format(text, std::forward<Args>(args)...));
}

bool is_between(double value, double low, double high) {
    return value >= low && value <= high;
}  // false for NaN

}  // namespace

// The sections of a file into a BlockFile, one after the other, none trusted.
class HeadReader {
  public:
    HeadReader(const Reader& file, BlockFile& out) : file_(file), out_(out), h_(out.head_) {}
    Result<void> run();

  private:
    Result<void> read_counts(std::span<const std::byte> bytes);
    Result<void> read_grid(std::span<const std::byte> bytes);
    Result<void> read_flags(std::span<const std::byte> bytes);
    Result<void> read_surfaces(const Section& section);
    Result<void> read_directory(const Section& section, const Section& blocks);
    Result<void> check_entry(size_t block, const BlockFile::Entry& entry, uint64_t offset, uint64_t split_count,
                             uint64_t stored_bytes) const;

    const Reader& file_;
    BlockFile& out_;
    Hierarchy& h_;
    uint32_t surface_count_ = 0, block_count_ = 0;
};

Result<void> HeadReader::read_counts(std::span<const std::byte> bytes) {
    auto get = [&](size_t at) { return load_le<uint32_t>(bytes, at); };
    h_.base_position_count = get(info_at::base_positions), h_.base_face_count = get(info_at::base_faces);
    out_.split_count_ = get(info_at::splits), out_.face_count_ = get(info_at::faces);
    out_.vertex_count_ = get(info_at::vertices), out_.group_count_ = get(info_at::groups);
    surface_count_ = get(info_at::surfaces), block_count_ = get(info_at::blocks);
    uint64_t positions = uint64_t(h_.base_position_count) + out_.split_count_;
    bool is_some = h_.base_position_count > 0 && out_.face_count_ > 0 && out_.group_count_ > 0 && surface_count_ > 0;
    bool is_few = positions <= kCountMax && out_.face_count_ <= kCountMax && out_.vertex_count_ <= kCountMax &&
                  out_.group_count_ <= out_.face_count_ && surface_count_ <= kSurfacesMax;
    if (!is_some || !is_few || h_.base_face_count > out_.face_count_ || out_.vertex_count_ < positions)
        return broken(file_, 3, "{} positions, {} faces, {} vertices, {} groups and {} surfaces", positions, out_.face_count_,
                      out_.vertex_count_, out_.group_count_, surface_count_);
    return {};
}

Result<void> HeadReader::read_grid(std::span<const std::byte> bytes) {
    auto get = [&](size_t at) { return load_le<uint32_t>(bytes, at); };
    bool is_fine = true;
    for (int axis = 0; axis < 3; ++axis) {
        h_.origin_m[axis] = load_f64(bytes, info_at::origin_m + 8 * size_t(axis));
        is_fine = is_fine && is_between(h_.origin_m[axis], -1e12, 1e12);
    }
    Grid& grid = h_.grid;
    grid.position_step_m = load_f64(bytes, info_at::position_step_m);
    grid.uv_step = load_f64(bytes, info_at::uv_step);
    for (int axis = 0; axis < 2; ++axis) {
        grid.uv_low[axis] = load_f64(bytes, info_at::uv_low + 8 * size_t(axis));
        is_fine = is_fine && is_between(grid.uv_low[axis], -1e9, 1e9);
    }
    grid.position_bits = get(info_at::position_bits), grid.uv_bits = get(info_at::uv_bits);
    grid.normal_bits = get(info_at::normal_bits);
    is_fine = is_fine && is_between(grid.position_step_m, 1e-12, 1e9) && is_between(grid.uv_step, 1e-12, 1e9) &&
              is_between(grid.position_bits, 8, 20) && is_between(grid.uv_bits, 8, 16) && is_between(grid.normal_bits, 6, 16);
    if (!is_fine)
        return broken(file_, 4, "steps of {} m from ({}, {}, {}) in {} bits, of uv {} in {} bits, and normals of {} bits",
                      grid.position_step_m, h_.origin_m.x, h_.origin_m.y, h_.origin_m.z, grid.position_bits, grid.uv_step,
                      grid.uv_bits, grid.normal_bits);
    return {};
}

Result<void> HeadReader::read_flags(std::span<const std::byte> bytes) {
    uint32_t attributes = load_le<uint32_t>(bytes, info_at::attributes), codec = load_le<uint32_t>(bytes, info_at::codec);
    h_.attributes = {(attributes & kHasNormals) != 0, (attributes & kHasUvs) != 0, (attributes & kHasColours) != 0};
    out_.finest_error_ = load_le<uint32_t>(bytes, info_at::finest_error);
    out_.greatest_error_ = load_le<uint32_t>(bytes, info_at::greatest_error);
    bool is_zero = true;
    for (size_t at = info_at::reserved; at < info_at::bytes; ++at) is_zero = is_zero && bytes[at] == std::byte(0);
    if (attributes > 7 || codec > uint32_t(Codec::draco) || std::max(out_.finest_error_, out_.greatest_error_) > kErrorCodeMax ||
        !is_zero)
        return broken(file_, 5, "attributes {}, codec {}, error codes {} and {}, or a reserved number that is not 0", attributes,
                      codec, out_.finest_error_, out_.greatest_error_);
    out_.codec_ = Codec(codec);
    return {};
}

Result<void> HeadReader::read_surfaces(const Section& section) {
    if (section.raw_bytes > kSurfaceBytesMax) return broken(file_, 6, "surfaces of {} bytes", section.raw_bytes);
    auto bytes = file_.read(section, kSurfaceBytesMax);
    if (!bytes) return tl::unexpected(bytes.error());
    if (const char* fault = surfaces_of_bytes(*bytes, surface_count_, h_.surfaces)) return broken(file_, 6, "MSUR {}", fault);
    return {};
}

Result<void> HeadReader::check_entry(size_t block, const BlockFile::Entry& entry, uint64_t offset, uint64_t split_count,
                                     uint64_t stored_bytes) const {
    if (entry.offset != offset || entry.stored_bytes > stored_bytes - offset)
        return broken(file_, 8, "block {} is {} bytes at {}; the one before ends at {} of {}", block, entry.stored_bytes,
                      entry.offset, offset, stored_bytes);
    bool is_whole = block == 0 ? entry.split_count == 0 : entry.split_count >= 1 && entry.split_count <= kBlockSplitsMax;
    if (!is_whole || entry.first_split != split_count)
        return broken(file_, 7, "block {} has {} splits from {}; {} are before it", block, entry.split_count, entry.first_split,
                      split_count);
    return {};
}

Result<void> HeadReader::read_directory(const Section& section, const Section& blocks) {
    uint64_t count = uint64_t(block_count_) + 1;
    if (section.codec != container::Codec::none || section.raw_bytes != count * directory_at::entry_bytes)
        return broken(file_, 7, "a directory of {} bytes; {} blocks need {}, uncompressed", section.raw_bytes, count,
                      count * directory_at::entry_bytes);
    if (blocks.codec != container::Codec::none)
        return broken(file_, 8, "MBLK is compressed as a whole, its blocks must be one by one");
    auto bytes = file_.read(section, section.raw_bytes);
    if (!bytes) return tl::unexpected(bytes.error());

    out_.entries_.resize(count);
    uint64_t offset = 0, split_count = 0;
    for (uint64_t i = 0; i < count; ++i) {
        std::span<const std::byte> at = std::span(*bytes).subspan(i * directory_at::entry_bytes, directory_at::entry_bytes);
        BlockFile::Entry& entry = out_.entries_[i];
        entry = {load_le<uint64_t>(at, directory_at::offset),       load_le<uint64_t>(at, directory_at::checksum),
                 load_le<uint32_t>(at, directory_at::stored_bytes), load_le<uint32_t>(at, directory_at::first_split),
                 load_le<uint32_t>(at, directory_at::splits),       load_le<uint32_t>(at, directory_at::rest_error)};
        if (auto ok = check_entry(i, entry, offset, split_count, blocks.stored_bytes); !ok) return ok;
        offset += entry.stored_bytes, split_count += entry.split_count;
    }
    if (split_count != out_.split_count_) return broken(file_, 7, "{} splits in all, {} stated", split_count, out_.split_count_);
    if (offset != blocks.stored_bytes)
        return broken(file_, 8, "the last block ends at {} of {} bytes", offset, blocks.stored_bytes);
    out_.stored_ = file_.stored(blocks);
    return {};
}

Result<void> HeadReader::run() {
    static constexpr container::Tag kKnown[] = {kInfoTag, kDirectoryTag, kBlocksTag, kSurfacesTag, container::tag("PROV")};
    const Section *info_section = file_.find(kInfoTag), *directory = file_.find(kDirectoryTag), *blocks = file_.find(kBlocksTag),
                  *surfaces = file_.find(kSurfacesTag);
    if (file_.kind() != kKind || !info_section || !directory || !blocks || !surfaces)
        return broken(file_, 1, "is no baked mesh (its kind is {})", container::tag_text(file_.kind()));
    if (auto known = file_.require_known(kKnown); !known) return tl::unexpected(known.error());
    if (info_section->raw_bytes != info_at::bytes) return broken(file_, 2, "MINF has {} bytes", info_section->raw_bytes);
    auto bytes = file_.read(*info_section, info_at::bytes);
    if (!bytes) return tl::unexpected(bytes.error());

    out_.file_ = &file_;
    if (auto ok = read_counts(*bytes); !ok) return ok;
    if (auto ok = read_grid(*bytes); !ok) return ok;
    if (auto ok = read_flags(*bytes); !ok) return ok;
    if (auto ok = read_surfaces(*surfaces); !ok) return ok;
    return read_directory(*directory, *blocks);
}

Result<BlockFile> BlockFile::open(const Reader& file) {
    BlockFile opened;
    if (auto ok = HeadReader(file, opened).run(); !ok) return tl::unexpected(ok.error());
    return opened;
}

namespace {

Result<Hierarchy> read_all(const Reader& file, uint32_t most_blocks) {
    Result<BlockFile> blocks = BlockFile::open(file);
    if (!blocks) return tl::unexpected(blocks.error());
    PrefixReader prefix(*blocks);
    uint64_t wanted = std::min<uint64_t>(blocks->block_count(), uint64_t(most_blocks) + 1);
    while (prefix.block_count() < wanted)
        if (auto ok = prefix.read_next(); !ok) return tl::unexpected(ok.error());
    if (auto ok = prefix.complete(); !ok) return tl::unexpected(ok.error());
    return prefix.take();
}

}  // namespace

Result<Hierarchy> read(const Reader& file, uint32_t most_blocks) {
    try {
        return read_all(file, most_blocks);
    } catch (const std::bad_alloc&) {
        return impossible("{}: there is not enough memory for this mesh", file.name());
    }
}

Result<Hierarchy> read(const std::string& path) {
    auto file = Reader::open(path);
    if (!file) return tl::unexpected(file.error());
    return read(*file);
}

}  // namespace overlook::caveclod
