#include <new>

#include "formats/caveclod_layout.h"
#include "formats/discrete_layout.h"
#include "formats/value_codecs.h"

namespace overlook::discrete {
namespace {

using container::Reader;
using container::Section;

tl::unexpected<Error> broken(const Reader& file, const Fault& fault) {
    return bad_input("{}: D{}: {}", file.name(), fault.rule, fault.text);
}

// The sections of a file into a chain, one after the other, none trusted.
class ChainReader {
  public:
    explicit ChainReader(const Reader& file) : file_(file) {}
    Result<Chain> run();

  private:
    Fault read_counts(std::span<const std::byte> bytes);
    Fault read_places(std::span<const std::byte> bytes);
    Fault read_attributes(std::span<const std::byte> bytes);
    Fault read_entry(std::span<const std::byte> entry, size_t level);
    Fault read_levels(std::span<const std::byte> directory, const Section& geometry);
    Result<void> read_geometry(const Section& section);
    Result<void> read_surfaces(const Section& section);
    Result<void> read_parts(const Section& section);
    Result<void> read_visibility();
    Result<std::vector<std::byte>> bytes_of(const Section& section, uint64_t most_bytes, int rule) const;

    const Reader& file_;
    Chain chain_;
    std::vector<LevelSize> sizes_;
    uint32_t level_count_ = 0, part_count_ = 0, surface_count_ = 0, visibility_count_ = 0;
};

Result<std::vector<std::byte>> ChainReader::bytes_of(const Section& section, uint64_t most_bytes, int rule) const {
    if (section.raw_bytes > most_bytes)
        return broken(file_, {rule, fmt::format("{} is of {} bytes", container::tag_text(section.tag), section.raw_bytes)});
    return file_.read(section, most_bytes);
}

Fault ChainReader::read_counts(std::span<const std::byte> bytes) {
    level_count_ = load_le<uint32_t>(bytes, info_at::levels), part_count_ = load_le<uint32_t>(bytes, info_at::parts);
    surface_count_ = load_le<uint32_t>(bytes, info_at::surfaces);
    visibility_count_ = load_le<uint32_t>(bytes, info_at::visibilities);
    auto is_in = [](uint32_t count, uint32_t most) { return count >= 1 && count <= most; };
    bool is_fine = is_in(level_count_, kMostLevels) && is_in(part_count_, kMostParts) && is_in(surface_count_, kSurfacesMax) &&
                   (visibility_count_ <= 1 || visibility_count_ == level_count_ - 1);
    if (is_fine) return {};
    return {3, fmt::format("{} levels, {} parts, {} surfaces, {} visibilities", level_count_, part_count_, surface_count_,
                           visibility_count_)};
}

Fault ChainReader::read_places(std::span<const std::byte> bytes) {
    auto get = [&](size_t at) { return load_f64(bytes, at); };
    for (int axis = 0; axis < 3; ++axis) {
        chain_.origin_m[axis] = get(info_at::origin_m + 8 * size_t(axis));
        chain_.middle_m[axis] = get(info_at::middle_m + 8 * size_t(axis));
    }
    for (int axis = 0; axis < 2; ++axis) chain_.uv_low[axis] = get(info_at::uv_low + 8 * size_t(axis));
    chain_.position_step_m = get(info_at::position_step_m), chain_.uv_step = get(info_at::uv_step);
    chain_.radius_m = get(info_at::radius_m), chain_.clip_s = get(info_at::clip_s);
    chain_.finest_error_m = get(info_at::finest_error_m);
    return fault_of_places(chain_);
}

Fault ChainReader::read_attributes(std::span<const std::byte> bytes) {
    auto attributes = load_le<uint32_t>(bytes, info_at::attributes);
    chain_.attributes = {(attributes & kHasNormals) != 0, (attributes & kHasUvs) != 0, (attributes & kHasColours) != 0};
    if (attributes <= 7) return {};
    return {5, fmt::format("attributes {}", attributes)};
}

Fault ChainReader::read_entry(std::span<const std::byte> entry, size_t level) {
    auto get = [&](size_t at) { return load_le<uint32_t>(entry, at); };
    LevelSize size{get(level_at::vertices), get(level_at::indices), get(level_at::draws), get(level_at::vertex_bytes),
                   get(level_at::index_bytes)};
    uint32_t rung = get(level_at::rung), flags = get(level_at::flags);
    bool is_known = rung <= uint32_t(Rung::impostor) && flags <= kIsPlain;
    bool is_some = size.vertices > 0 && size.indices > 0 && size.indices % 3 == 0 && size.draws > 0;
    bool fits = size.vertices <= kCountMax && size.indices <= kCountMax &&
                uint64_t(size.vertices) * sizeof(Vertex) <= uint64_t(size.vertex_bytes) * kRecordBytesPerPackedByte &&
                size.indices / 3 < size.index_bytes && size.draws <= size.indices / 3;
    if (!is_known || !is_some || !fits)
        return {7, fmt::format("level {} is of rung {}, flags {}: {} vertices in {} bytes, {} indices in {}, {} draws", level,
                               rung, flags, size.vertices, size.vertex_bytes, size.indices, size.index_bytes, size.draws)};
    sizes_.push_back(size);
    Level& made = chain_.levels.emplace_back();
    made.rung = Rung(rung), made.is_plain = (flags & kIsPlain) != 0;
    made.error_m = load_f32(entry, level_at::error_m), made.lost_area_share = load_f32(entry, level_at::lost_area_share);
    made.added_area_share = load_f32(entry, level_at::added_area_share);
    return {};
}

Fault ChainReader::read_levels(std::span<const std::byte> directory, const Section& geometry) {
    uint64_t bytes = 0;
    for (size_t k = 0; k < level_count_; ++k) {
        if (Fault fault = read_entry(directory.subspan(k * level_at::entry_bytes, level_at::entry_bytes), k)) return fault;
        bytes += sizes_.back().bytes();
    }
    if (bytes != geometry.raw_bytes || bytes > kGeometryBytesMax)
        return {8, fmt::format("DGEO has {} bytes, its levels {}", geometry.raw_bytes, bytes)};
    return fault_of_errors(chain_);
}

Result<void> ChainReader::read_geometry(const Section& section) {
    auto bytes = bytes_of(section, kGeometryBytesMax, 8);
    if (!bytes) return tl::unexpected(bytes.error());
    std::span<const std::byte> rest = *bytes;
    for (size_t k = 0; k < level_count_; ++k) {
        auto size = size_t(sizes_[k].bytes());
        if (Fault fault = level_of_bytes(rest.first(size), sizes_[k], part_count_, surface_count_, chain_.levels[k]))
            return broken(file_, {fault.rule, fmt::format("level {}: {}", k, fault.text)});
        rest = rest.subspan(size);
    }
    return {};
}

Result<void> ChainReader::read_surfaces(const Section& section) {
    auto bytes = bytes_of(section, kSurfaceBytesMax, 6);
    if (!bytes) return tl::unexpected(bytes.error());
    if (const char* fault = caveclod::surfaces_of_bytes(*bytes, surface_count_, chain_.surfaces))
        return broken(file_, {6, fmt::format("DSUR {}", fault)});
    return {};
}

Result<void> ChainReader::read_parts(const Section& section) {
    auto bytes = bytes_of(section, kPartBytesMax, 14);
    if (!bytes) return tl::unexpected(bytes.error());
    if (Fault fault = parts_of_bytes(*bytes, part_count_, chain_.parts)) return broken(file_, fault);
    for (size_t p = 0; p < chain_.parts.size(); ++p)
        if (Fault fault = fault_of_part(chain_.parts[p], chain_.clip_s, p == 0))
            return broken(file_, {fault.rule, fmt::format("part {} {}", p, fault.text)});
    return {};
}

Result<void> ChainReader::read_visibility() {
    const Section* section = file_.find(kVisibilityTag);
    if ((section != nullptr) != (visibility_count_ > 0))
        return broken(
            file_, {18, fmt::format("{} visibilities are stated, DVIS {} there", visibility_count_, section ? "is" : "is not")});
    if (section == nullptr) return {};
    auto bytes = bytes_of(*section, kVisibilityBytesMax, 18);
    if (!bytes) return tl::unexpected(bytes.error());
    if (Fault fault = visibility_of_bytes(*bytes, visibility_count_, chain_.visibility)) return broken(file_, fault);
    return {};
}

Result<Chain> ChainReader::run() {
    static constexpr container::Tag kKnown[] = {kInfoTag,  kLevelsTag,     kGeometryTag,          kSurfacesTag,
                                                kPartsTag, kVisibilityTag, container::tag("PROV")};
    const Section *info = file_.find(kInfoTag), *levels = file_.find(kLevelsTag), *geometry = file_.find(kGeometryTag),
                  *surfaces = file_.find(kSurfacesTag), *parts = file_.find(kPartsTag);
    if (file_.kind() != kKind || !info || !levels || !geometry || !surfaces || !parts)
        return broken(file_, {1, fmt::format("is no chain of levels (its kind is {})", container::tag_text(file_.kind()))});
    if (auto known = file_.require_known(kKnown); !known) return tl::unexpected(known.error());
    if (info->raw_bytes != info_at::bytes) return broken(file_, {2, fmt::format("DINF has {} bytes", info->raw_bytes)});
    auto head = file_.read(*info, info_at::bytes);
    if (!head) return tl::unexpected(head.error());
    if (Fault fault = read_counts(*head)) return broken(file_, fault);
    if (Fault fault = read_places(*head)) return broken(file_, fault);
    if (Fault fault = read_attributes(*head)) return broken(file_, fault);
    if (auto ok = read_surfaces(*surfaces); !ok) return tl::unexpected(ok.error());

    if (levels->codec != container::Codec::none || levels->raw_bytes != level_count_ * level_at::entry_bytes)
        return broken(file_, {7, fmt::format("DLEV has {} bytes; {} levels need {}, uncompressed", levels->raw_bytes,
                                             level_count_, level_count_ * level_at::entry_bytes)});
    auto directory = file_.read(*levels, levels->raw_bytes);
    if (!directory) return tl::unexpected(directory.error());
    if (Fault fault = read_levels(*directory, *geometry)) return broken(file_, fault);
    if (auto ok = read_geometry(*geometry); !ok) return tl::unexpected(ok.error());
    chain_.picture_count = load_le<uint32_t>(*head, info_at::pictures);
    if (Fault fault = fault_of_pictures(chain_)) return broken(file_, fault);
    if (auto ok = read_parts(*parts); !ok) return tl::unexpected(ok.error());
    if (Fault fault = fault_of_sphere(chain_)) return broken(file_, fault);
    if (auto ok = read_visibility(); !ok) return tl::unexpected(ok.error());
    return std::move(chain_);
}

}  // namespace

Result<Chain> read(const Reader& file) {
    try {
        return ChainReader(file).run();
    } catch (const std::bad_alloc&) {
        return impossible("{}: there is not enough memory for this chain", file.name());
    }
}

Result<Chain> read(const std::string& path) {
    auto file = Reader::open(path);
    if (!file) return tl::unexpected(file.error());
    return read(*file);
}

}  // namespace overlook::discrete
