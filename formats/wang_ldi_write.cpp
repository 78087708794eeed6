#include "formats/compression.h"
#include "formats/container_rules.h"
#include "formats/wang_ldi_grouped.h"

namespace overlook::wang_ldi {
namespace {

tl::unexpected<Error> bug(std::string_view what, std::string_view has) {
    return tl::unexpected(Error{Exit::our_bug, fmt::format("{} to write has {}", what, has)});
}

// What rows of numbers cannot even be laid out.
std::string_view fault_of_shape(const ImageSet& set, uint32_t level, const Ldi& ldi) {
    size_t side = set.levels[level].side_px, samples = ldi.heights.size();
    if (ldi.side_px != side || ldi.first.size() != side * side + 1) return "another size than its level";
    if (ldi.first.front() != 0 || ldi.first.back() != samples || samples > kMostSamples) return "another count of samples";
    for (size_t p = 0; p < side * side; ++p)
        if (ldi.first[p + 1] < ldi.first[p] || ldi.first[p + 1] - ldi.first[p] > 65535) return "a pixel of too many samples";
    bool fits = ldi.colours.size() == samples && ldi.normals.size() == (set.has_normals ? samples : 0) &&
                ldi.splats.size() == (set.has_splats ? samples : 0);
    if (!fits) return "not one number for each sample";
    if (ldi.palette.size() > kMostColours || ldi.palette.empty() != (samples == 0)) return "too few or too many colours";
    if (!(ldi.unseen_share >= 0 && ldi.unseen_share <= 1)) return "an unseen share beyond 0 to 1";
    return raw_bytes_of(set, ldi.side_px, samples, ldi.palette.size()) > kMostRawBytes ? "too many bytes" : "";
}

}  // namespace

std::vector<std::byte> bytes_of_head(const ImageSet& set) {
    std::vector<std::byte> bytes(head_at::bytes + level_at::entry_bytes * set.levels.size());
    auto u32 = [&](size_t at, size_t value) { store_le<uint32_t>(bytes, at, uint32_t(value)); };
    u32(head_at::tiles, set.tile_count), u32(head_at::levels, set.levels.size());
    u32(head_at::directions, set.direction_count), u32(head_at::contexts, set.context_count);
    u32(head_at::flags,
        (set.has_normals ? kHasNormals : 0) | (set.has_splats ? kHasSplats : 0) | (set.is_grouped ? kIsGrouped : 0));
    store_f64(bytes, head_at::tile_m, set.tile_m), store_f64(bytes, head_at::low_m, set.low_m);
    store_f64(bytes, head_at::high_m, set.high_m), store_f64(bytes, head_at::eye_low_m, set.cell.eye_low_m);
    store_f64(bytes, head_at::eye_high_m, set.cell.eye_high_m), store_f64(bytes, head_at::nearest_m, set.cell.nearest_m);
    store_f64(bytes, head_at::farthest_m, set.cell.farthest_m), store_f64(bytes, head_at::focal_px, set.cell.focal_px);
    store_f64(bytes, head_at::error_px, set.cell.error_px);
    for (int axis = 0; axis < 3; ++axis) store_f64(bytes, head_at::to_sun + 8 * size_t(axis), set.to_sun[axis]);
    store_f32(bytes, head_at::level_fade, set.level_fade), store_f32(bytes, head_at::direction_fade, set.direction_fade);
    for (size_t k = 0; k < set.levels.size(); ++k) {
        size_t at = head_at::bytes + level_at::entry_bytes * k;
        const Level& level = set.levels[k];
        u32(at + level_at::side_px, level.side_px), store_f32(bytes, at + level_at::nearest_m, level.nearest_m);
        store_f32(bytes, at + level_at::height_step_m, level.height_step_m);
        store_f32(bytes, at + level_at::splat_px, level.splat_px);
    }
    return bytes;
}

Result<Packed> packed(const ImageSet& set, uint32_t level, const Ldi& ldi) {
    if (std::string_view fault = fault_of_shape(set, level, ldi); !fault.empty()) return bug("an image", fault);
    if (ImageFault fault = fault_of_ldi(set, level, ldi)) return bug("an image", fault.text);
    GroupedBytes raw;
    if (set.is_grouped)
        raw = grouped_bytes_of(set, level, ldi);
    else
        raw.bytes = bytes_of_ldi(set, ldi);
    auto bytes = zstd_compressed("layered depth image", raw.bytes, raw.ends);
    if (!bytes) return tl::unexpected(bytes.error());
    uint64_t checksum = container::checksum_of(*bytes);
    return Packed{std::move(*bytes), checksum, uint32_t(raw.bytes.size()), ldi.sample_count(), uint32_t(ldi.palette.size()),
                  ldi.unseen_share};
}

Result<ImageWriter> ImageWriter::begin(container::Writer& writer, const ImageSet& set) {
    for (auto rule : {fault_of_counts, fault_of_places, fault_of_levels})
        if (ImageFault fault = rule(set)) return bug("a set of images", fault.text);
    if (auto begun = writer.begin(kImagesTag, container::kMustUnderstand | container::kCheckedInParts); !begun)
        return tl::unexpected(begun.error());
    ImageWriter made(writer, set);
    made.directory_ = bytes_of_head(set);
    return made;
}

Result<void> ImageWriter::add(const Packed& ldi) {
    if (added_ == set_.ldi_count()) return bug("a set of images", "more images than it states");
    size_t at = directory_.size();
    directory_.resize(at + ldi_at::entry_bytes);
    store_le<uint64_t>(directory_, at + ldi_at::offset, offset_);
    store_le<uint64_t>(directory_, at + ldi_at::checksum, ldi.checksum);
    store_le<uint32_t>(directory_, at + ldi_at::stored_bytes, uint32_t(ldi.bytes.size()));
    store_le<uint32_t>(directory_, at + ldi_at::raw_bytes, ldi.raw_bytes);
    store_le<uint32_t>(directory_, at + ldi_at::samples, ldi.sample_count);
    store_le<uint32_t>(directory_, at + ldi_at::colours, ldi.colour_count);
    store_f32(directory_, at + ldi_at::unseen_share, ldi.unseen_share);
    offset_ += ldi.bytes.size(), ++added_;
    return writer_->append(ldi.bytes);
}

Result<void> ImageWriter::end() {
    if (added_ != set_.ldi_count()) return bug("a set of images", fmt::format("{} of {} images", added_, set_.ldi_count()));
    if (auto ended = writer_->end(); !ended) return ended;
    return writer_->add(kDirectoryTag, container::kMustUnderstand, container::Codec::none, directory_);
}

}  // namespace overlook::wang_ldi
