#include <new>

#include "formats/compression.h"
#include "formats/container_rules.h"
#include "formats/wang_ldi_layout.h"

namespace overlook::wang_ldi {
namespace {

tl::unexpected<Error> broken(const container::Reader& file, const ImageFault& fault) {
    return bad_input("{}: L{}: {}", file.name(), fault.rule, fault.text);
}

ImageFault set_of_head(std::span<const std::byte> bytes, ImageSet& set) {
    auto u32 = [&](size_t at) { return load_le<uint32_t>(bytes, at); };
    auto f64 = [&](size_t at) { return load_f64(bytes, at); };
    if (bytes.size() < head_at::bytes) return {2, fmt::format("WLDI has {} bytes", bytes.size())};
    set.tile_count = u32(head_at::tiles), set.direction_count = u32(head_at::directions);
    set.context_count = u32(head_at::contexts);
    uint32_t level_count = u32(head_at::levels), flags = u32(head_at::flags);
    set.levels.resize(std::min<size_t>(level_count, kMostLevels + 1));
    if (ImageFault fault = fault_of_counts(set)) return fault;
    if (flags > (kHasNormals | kHasSplats | kIsGrouped) || u32(head_at::reserved) != 0)
        return {4, fmt::format("flags {}, or a reserved number that is not 0", flags)};
    set.has_normals = (flags & kHasNormals) != 0, set.has_splats = (flags & kHasSplats) != 0;
    set.is_grouped = (flags & kIsGrouped) != 0;
    set.tile_m = f64(head_at::tile_m), set.low_m = f64(head_at::low_m), set.high_m = f64(head_at::high_m);
    set.cell = {f64(head_at::eye_low_m),  f64(head_at::eye_high_m), f64(head_at::nearest_m),
                f64(head_at::farthest_m), f64(head_at::focal_px),   f64(head_at::error_px)};
    for (int axis = 0; axis < 3; ++axis) set.to_sun[axis] = f64(head_at::to_sun + 8 * size_t(axis));
    set.level_fade = load_f32(bytes, head_at::level_fade), set.direction_fade = load_f32(bytes, head_at::direction_fade);
    return fault_of_places(set);
}

ImageFault levels_of_bytes(std::span<const std::byte> bytes, ImageSet& set) {
    for (size_t k = 0; k < set.levels.size(); ++k) {
        auto entry = bytes.subspan(head_at::bytes + k * level_at::entry_bytes, level_at::entry_bytes);
        set.levels[k] = {load_le<uint32_t>(entry, level_at::side_px), load_f32(entry, level_at::nearest_m),
                         load_f32(entry, level_at::height_step_m), load_f32(entry, level_at::splat_px)};
    }
    return fault_of_levels(set);
}

Entry entry_of_bytes(std::span<const std::byte> bytes) {
    return {load_le<uint64_t>(bytes, ldi_at::offset),       load_le<uint64_t>(bytes, ldi_at::checksum),
            load_le<uint32_t>(bytes, ldi_at::stored_bytes), load_le<uint32_t>(bytes, ldi_at::raw_bytes),
            load_le<uint32_t>(bytes, ldi_at::samples),      load_le<uint32_t>(bytes, ldi_at::colours),
            load_f32(bytes, ldi_at::unseen_share)};
}

std::string place_of(const ImageSet& set, uint64_t index) {
    Which which = which_of(set, index);
    return fmt::format("{}tile {}, level {}, direction {}", which.context == 0 ? "" : "alone, ", which.tile, which.level,
                       which.direction);
}

ImageFault fault_of_entry(const ImageSet& set, uint64_t index, const Entry& entry) {
    uint32_t side = set.levels[which_of(set, index).level].side_px;
    bool has_counts = entry.sample_count <= kMostSamples && entry.colour_count <= kMostColours &&
                      (entry.colour_count == 0) == (entry.sample_count == 0);
    bool has_bytes = has_counts && entry.raw_bytes <= kMostRawBytes &&
                     raw_bytes_of(set, side, entry.sample_count, entry.colour_count) == entry.raw_bytes;
    if (has_bytes && entry.unseen_share >= 0 && entry.unseen_share <= 1) return {};
    return {8, fmt::format("{}: {} samples and {} colours in {} raw bytes, {} of them unseen", place_of(set, index),
                           entry.sample_count, entry.colour_count, entry.raw_bytes, entry.unseen_share)};
}

}  // namespace

// Fills an ImageReader from the directory.
class DirectoryReader {
  public:
    static Result<ImageReader> run(const container::Reader& file);

  private:
    static ImageFault read_entries(std::span<const std::byte> bytes, ImageReader& made);
};

ImageFault DirectoryReader::read_entries(std::span<const std::byte> bytes, ImageReader& made) {
    uint64_t next = 0, count = made.set_.ldi_count();
    made.entries_.reserve(count);
    for (uint64_t i = 0; i < count; ++i) {
        auto at = bytes.subspan(size_t(i) * ldi_at::entry_bytes, ldi_at::entry_bytes);
        Entry entry = entry_of_bytes(at);
        if (load_le<uint32_t>(at, ldi_at::reserved) != 0)
            return {4, fmt::format("{}: a reserved number is not 0", place_of(made.set_, i))};
        if (entry.offset != next)
            return {7, fmt::format("{}: begins at {}, the one before ends at {}", place_of(made.set_, i), entry.offset, next)};
        if (ImageFault fault = fault_of_entry(made.set_, i, entry)) return fault;
        next += entry.stored_bytes;
        made.entries_.push_back(entry);
    }
    if (next == made.stored_.size()) return {};
    return {7, fmt::format("WLDS has {} bytes, its images {}", made.stored_.size(), next)};
}

Result<ImageReader> DirectoryReader::run(const container::Reader& file) {
    const container::Section *directory = file.find(kDirectoryTag), *images = file.find(kImagesTag);
    if (!directory || !images || directory->codec != container::Codec::none || !(images->flags & container::kCheckedInParts))
        return broken(file, {1, "has no layered depth images as they are stored"});
    auto bytes = file.read(*directory, directory->stored_bytes);
    if (!bytes) return tl::unexpected(bytes.error());

    ImageReader made;
    made.file_ = &file, made.stored_ = file.stored(*images);
    if (ImageFault fault = set_of_head(*bytes, made.set_)) return broken(file, fault);
    size_t head = head_at::bytes + level_at::entry_bytes * made.set_.levels.size();
    if (bytes->size() != head + ldi_at::entry_bytes * made.set_.ldi_count())
        return broken(file, {2, fmt::format("WLDI has {} bytes; {} levels and {} images need another count", bytes->size(),
                                            made.set_.levels.size(), made.set_.ldi_count())});
    if (ImageFault fault = levels_of_bytes(*bytes, made.set_)) return broken(file, fault);
    if (ImageFault fault = read_entries(std::span<const std::byte>(*bytes).subspan(head), made)) return broken(file, fault);
    return made;
}

Result<ImageReader> ImageReader::open(const container::Reader& file) {
    try {
        return DirectoryReader::run(file);
    } catch (const std::bad_alloc&) {
        return impossible("{}: there is not enough memory for the directory of its images", file.name());
    }
}

Result<Ldi> ImageReader::read(uint64_t index) const {
    const Entry& entry = entries_[size_t(index)];
    auto fail = [&](int rule, std::string_view text) {
        return broken(*file_, {rule, fmt::format("{}: {}", place_of(set_, index), text)});
    };
    std::span<const std::byte> stored = stored_.subspan(size_t(entry.offset), entry.stored_bytes);
    if (container::checksum_of(stored) != entry.checksum)
        return fail(9, "its bytes have another checksum; was the copy damaged?");
    if (std::string fault = fault_of_zstd_frame(stored, entry.raw_bytes); !fault.empty()) return fail(10, fault);
    try {
        std::vector<std::byte> raw(entry.raw_bytes);
        if (std::string fault = zstd_decode(stored, raw); !fault.empty()) return fail(10, fault);
        Ldi ldi;
        if (ImageFault fault = ldi_of_bytes(raw, set_, which_of(set_, index).level, entry, ldi))
            return fail(fault.rule, fault.text);
        return ldi;
    } catch (const std::bad_alloc&) {
        return impossible("{}: there is not enough memory for an image of {} samples", file_->name(), entry.sample_count);
    }
}

}  // namespace overlook::wang_ldi
