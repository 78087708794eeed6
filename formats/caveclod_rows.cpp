// Rows of numbers as bytes, by either codec, and the names and pictures of surfaces.
#include <xxhash.h>

#include <algorithm>
#include <cstring>

#include "formats/caveclod_layout.h"
#include "formats/compression.h"
#include "formats/value_codecs.h"

namespace overlook::caveclod {
namespace {

void append_u32(std::vector<std::byte>& bytes, uint32_t value) {
    bytes.resize(bytes.size() + 4);
    store_le<uint32_t>(bytes, bytes.size() - 4, value);
}
void append_bytes(std::vector<std::byte>& bytes, std::span<const std::byte> more) {
    append_u32(bytes, uint32_t(more.size()));
    bytes.insert(bytes.end(), more.begin(), more.end());
}
std::span<const std::byte> bytes_of(const std::string& text) {
    return std::as_bytes(std::span(text));
}

Result<void> append_chunk(std::vector<std::byte>& bytes, std::span<const uint32_t> values, Codec codec) {
    if (codec == Codec::draco) {
        auto packed = draco_packed(values);
        if (!packed) return tl::unexpected(Error{Exit::our_bug, "Draco cannot code a row of numbers"});
        append_bytes(bytes, *packed);
        return {};
    }
    std::vector<std::byte> packed = meshopt_packed(values);
    auto stored = zstd_compressed("mesh block", packed);
    if (!stored) return tl::unexpected(stored.error());
    append_u32(bytes, uint32_t(packed.size()));
    append_bytes(bytes, *stored);
    return {};
}

// Bytes from front to back; what is missing is never read.
class Scan {
  public:
    explicit Scan(std::span<const std::byte> bytes) : bytes_(bytes) {}
    bool u32(uint32_t& value) {
        if (bytes_.size() < 4) return false;
        value = load_le<uint32_t>(bytes_, 0);
        bytes_ = bytes_.subspan(4);
        return true;
    }
    bool take(uint32_t size, std::span<const std::byte>& taken) {
        if (size > bytes_.size()) return false;
        taken = bytes_.first(size);
        bytes_ = bytes_.subspan(size);
        return true;
    }
    bool sized(std::span<const std::byte>& taken) {
        uint32_t size = 0;
        return u32(size) && take(size, taken);
    }
    std::span<const std::byte> rest() const { return bytes_; }

  private:
    std::span<const std::byte> bytes_;
};

const char* take_chunk(Scan& scan, Codec codec, std::span<uint32_t> values) {
    std::span<const std::byte> stored;
    if (codec == Codec::draco) {
        if (!scan.sized(stored)) return "ends within a row";
        return draco_unpack(stored, values) ? nullptr : "has a row that does not decode to the numbers it states";
    }
    uint32_t packed_bytes = 0;
    if (!scan.u32(packed_bytes) || !scan.sized(stored)) return "ends within a row";
    // The codec adds to the numbers themselves at most a header for each 16 bytes of a plane, and a tail.
    if (packed_bytes > 64 + 5 * values.size() + values.size() / 4) return "states more bytes than a row's numbers need";
    if (!fault_of_zstd_frame(stored, packed_bytes).empty()) return "has a row that is not a zstd frame of the bytes it states";
    std::vector<std::byte> packed(packed_bytes);
    if (!zstd_decode(stored, packed).empty() || !meshopt_unpack(packed, values))
        return "has a row that does not decode to the numbers it states";
    return nullptr;
}

bool take_text(Scan& scan, std::string& text) {
    std::span<const std::byte> taken;
    if (!scan.sized(taken) || taken.size() > kNameBytesMax) return false;
    text.assign(reinterpret_cast<const char*>(taken.data()), taken.size());
    return std::none_of(text.begin(), text.end(), [](char c) { return uint8_t(c) < ' ' || uint8_t(c) == 127; });
}

}  // namespace

uint64_t block_checksum(std::span<const std::byte> bytes) {
    return XXH3_64bits(bytes.data(), bytes.size());
}

Result<std::vector<std::byte>> bytes_of_rows(const Rows& rows, Codec codec) {
    std::vector<std::byte> bytes;
    uint64_t value_count = 0;
    for (const std::vector<uint32_t>& row : rows) {
        append_u32(bytes, uint32_t(row.size()));
        value_count += row.size();
        for (size_t first = 0; first < row.size(); first += kMostChunkValues) {
            auto chunk = std::span(row).subspan(first, std::min(kMostChunkValues, row.size() - first));
            if (auto appended = append_chunk(bytes, chunk, codec); !appended) return tl::unexpected(appended.error());
        }
    }
    bytes.resize(std::max<size_t>(bytes.size(), (value_count + kValuesPerByte - 1) / kValuesPerByte));
    return bytes;
}

const char* rows_of_bytes(std::span<const std::byte> bytes, Codec codec, Rows& rows) {
    Scan scan(bytes);
    uint64_t value_count = 0;
    for (std::vector<uint32_t>& row : rows) {
        uint32_t size = 0;
        if (!scan.u32(size)) return "ends before its rows do";
        value_count += size;
        if (value_count > kValuesPerByte * bytes.size()) return "states more numbers than its bytes may hold";
        row.resize(size);
        for (size_t first = 0; first < size; first += kMostChunkValues) {
            auto chunk = std::span(row).subspan(first, std::min<size_t>(kMostChunkValues, size - first));
            if (const char* fault = take_chunk(scan, codec, chunk)) return fault;
        }
    }
    bool is_padded = value_count > kValuesPerByte * (bytes.size() - scan.rest().size());
    if (!scan.rest().empty() && !is_padded) return "has bytes after its rows";
    bool is_zero = std::all_of(scan.rest().begin(), scan.rest().end(), [](std::byte b) { return b == std::byte(0); });
    if (!is_zero || (is_padded && bytes.size() != (value_count + kValuesPerByte - 1) / kValuesPerByte))
        return "has bytes after its rows";
    return nullptr;
}

bool count_rows(std::span<const std::byte> bytes, Codec codec, std::array<uint32_t, kRowCount>& counts) {
    Scan scan(bytes);
    std::span<const std::byte> stored;
    for (uint32_t& count : counts) {
        uint32_t packed_bytes = 0;
        if (!scan.u32(count)) return false;
        for (size_t first = 0; first < count; first += kMostChunkValues) {
            if (codec == Codec::meshopt && !scan.u32(packed_bytes)) return false;
            if (!scan.sized(stored)) return false;
        }
    }
    return true;
}

std::vector<std::byte> bytes_of_surfaces(const std::vector<Surface>& surfaces) {
    std::vector<std::byte> bytes;
    for (const Surface& surface : surfaces) {
        append_bytes(bytes, bytes_of(surface.name));
        append_bytes(bytes, bytes_of(surface.texture));
        append_bytes(bytes, surface.texture_bytes);
        for (uint8_t channel : surface.colour) bytes.push_back(std::byte(channel));
        append_u32(bytes, uint32_t(surface.is_alpha_masked) | uint32_t(surface.is_two_sided) << 1);
        append_u32(bytes, std::bit_cast<uint32_t>(surface.alpha_cutoff));
    }
    return bytes;
}

const char* surfaces_of_bytes(std::span<const std::byte> bytes, uint32_t count, std::vector<Surface>& surfaces) {
    Scan scan(bytes);
    for (uint32_t i = 0; i < count; ++i) {
        Surface surface;
        std::span<const std::byte> picture, colour;
        uint32_t flags = 0, cutoff = 0;
        if (!take_text(scan, surface.name) || !take_text(scan, surface.texture))
            return "has a name that is too long, cut short or not printable";
        if (!scan.sized(picture) || !scan.take(4, colour) || !scan.u32(flags) || !scan.u32(cutoff))
            return "ends within a surface";
        surface.texture_bytes.assign(picture.begin(), picture.end());
        for (size_t k = 0; k < 4; ++k) surface.colour[k] = uint8_t(colour[k]);
        surface.is_alpha_masked = (flags & 1) != 0, surface.is_two_sided = (flags & 2) != 0;
        surface.alpha_cutoff = std::bit_cast<float>(cutoff);
        if (flags > 3 || !(surface.alpha_cutoff >= 0 && surface.alpha_cutoff <= 1))
            return "has unknown flags or an alpha beyond 0..1";
        surfaces.push_back(std::move(surface));
    }
    return scan.rest().empty() ? nullptr : "has bytes after its surfaces";
}

}  // namespace overlook::caveclod
