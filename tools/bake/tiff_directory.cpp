// The directory of a TIFF file.
// Source: Aldus Corporation, "TIFF Revision 6.0", 1992, section 2; BigTIFF as described by the libtiff project, 2007.

#include "tools/bake/tiff_directory.h"

#include <algorithm>
#include <bit>

namespace overlook::dem {
namespace {

constexpr uint16_t kByte = 1, kAscii = 2, kShort = 3, kLong = 4, kFloat = 11, kDouble = 12, kLong8 = 16;

// Bytes of one value of a type; 0 for types that hold no number or text that we read.
uint64_t bytes_of_type(uint16_t type) {
    switch (type) {
        case kByte:
        case kAscii:
            return 1;
        case kShort:
            return 2;
        case kLong:
        case kFloat:
            return 4;
        case kDouble:
        case kLong8:
            return 8;
        default:
            return 0;
    }
}

// The unsigned number of `size` bytes at `offset`; the caller has checked that they are there.
uint64_t number_at(std::span<const std::byte> bytes, bool is_big_endian, uint64_t offset, uint64_t size) {
    uint64_t value = 0;
    for (uint64_t i = 0; i < size; ++i) {
        const uint64_t place = is_big_endian ? offset + i : offset + size - 1 - i;
        value = value << 8 | std::to_integer<uint64_t>(bytes[size_t(place)]);
    }
    return value;
}

// A whole span [offset, offset + size) inside `total` bytes, without overflow.
bool lies_within(uint64_t offset, uint64_t size, uint64_t total) {
    return size <= total && offset <= total - size;
}

const TiffEntry* find(const TiffDirectory& directory, uint16_t tag) {
    const auto at = std::lower_bound(directory.entries.begin(), directory.entries.end(), tag,
                                     [](const TiffEntry& entry, uint16_t wanted) { return entry.tag < wanted; });
    return at != directory.entries.end() && at->tag == tag ? &*at : nullptr;
}

Result<void> check_values(const TiffDirectory& directory, const TiffEntry& entry, const char* what) {
    const uint64_t size = bytes_of_type(entry.type);
    if (size == 0)
        return bad_input("{}: TIFF tag {} ({}) has type {}, which is not a number's", directory.name, entry.tag, what,
                         entry.type);
    const uint64_t total = directory.bytes.size();
    if (entry.count > total / size || !lies_within(entry.offset, entry.count * size, total))
        return bad_input("{}: TIFF tag {} ({}) ends after the file, which is {} bytes long; was the copy cut short?",
                         directory.name, entry.tag, what, total);
    return {};
}

// How the two forms of the file lay out their directory.
struct Layout {
    bool is_big_endian = false;
    uint64_t offset_bytes = 4;  // of an offset, and of the values kept in the entry itself
    uint64_t entry_count_bytes = 2;
    uint64_t first_directory_at = 4;
    uint64_t entry_bytes = 12;
};

Layout layout_of(std::span<const std::byte> bytes) {
    Layout layout;
    layout.is_big_endian = bytes[0] == std::byte('M');
    if (number_at(bytes, layout.is_big_endian, 2, 2) == 43) {
        layout.offset_bytes = 8;
        layout.entry_count_bytes = 8;
        layout.first_directory_at = 8;
        layout.entry_bytes = 20;
    }
    return layout;
}

TiffEntry entry_at(std::span<const std::byte> bytes, const Layout& layout, uint64_t at) {
    TiffEntry entry;
    entry.tag = uint16_t(number_at(bytes, layout.is_big_endian, at, 2));
    entry.type = uint16_t(number_at(bytes, layout.is_big_endian, at + 2, 2));
    entry.count = number_at(bytes, layout.is_big_endian, at + 4, layout.offset_bytes);
    const uint64_t value_at = at + 4 + layout.offset_bytes;
    const uint64_t size = bytes_of_type(entry.type);
    const bool is_inline = size != 0 && entry.count <= layout.offset_bytes / size;
    entry.offset = is_inline ? value_at : number_at(bytes, layout.is_big_endian, value_at, layout.offset_bytes);
    return entry;
}

}  // namespace

bool is_tiff(std::span<const std::byte> bytes) {
    if (bytes.size() < 8) return false;
    const bool is_little = bytes[0] == std::byte('I') && bytes[1] == std::byte('I');
    const bool is_big = bytes[0] == std::byte('M') && bytes[1] == std::byte('M');
    if (!is_little && !is_big) return false;
    const uint64_t version = number_at(bytes, is_big, 2, 2);
    return version == 42 || version == 43;
}

Result<TiffDirectory> read_tiff_directory(std::span<const std::byte> bytes, const std::string& name) {
    if (!is_tiff(bytes)) return bad_input("{}: is not a TIFF file", name);
    const Layout layout = layout_of(bytes);
    const uint64_t total = bytes.size();
    const auto cut_short = [&](uint64_t at) {
        return bad_input("{}: TIFF directory at byte {} ends after the file, which is {} bytes long; was the copy cut short?",
                         name, at, total);
    };

    if (!lies_within(layout.first_directory_at, layout.offset_bytes, total)) return cut_short(layout.first_directory_at);
    const uint64_t at = number_at(bytes, layout.is_big_endian, layout.first_directory_at, layout.offset_bytes);
    if (!lies_within(at, layout.entry_count_bytes, total)) return cut_short(at);
    const uint64_t count = number_at(bytes, layout.is_big_endian, at, layout.entry_count_bytes);
    if (count > total / layout.entry_bytes || !lies_within(at + layout.entry_count_bytes, count * layout.entry_bytes, total))
        return cut_short(at);

    TiffDirectory directory{bytes, name, layout.is_big_endian, {}};
    directory.entries.reserve(size_t(count));
    for (uint64_t i = 0; i < count; ++i)
        directory.entries.push_back(entry_at(bytes, layout, at + layout.entry_count_bytes + i * layout.entry_bytes));
    std::stable_sort(directory.entries.begin(), directory.entries.end(),
                     [](const TiffEntry& a, const TiffEntry& b) { return a.tag < b.tag; });
    const auto twice = std::adjacent_find(directory.entries.begin(), directory.entries.end(),
                                          [](const TiffEntry& a, const TiffEntry& b) { return a.tag == b.tag; });
    if (twice != directory.entries.end()) return bad_input("{}: TIFF tag {} stands twice in the directory", name, twice->tag);
    return directory;
}

Result<std::vector<uint64_t>> tiff_integers(const TiffDirectory& directory, uint16_t tag, const char* what) {
    std::vector<uint64_t> values;
    const TiffEntry* entry = find(directory, tag);
    if (!entry) return values;
    if (entry->type != kByte && entry->type != kShort && entry->type != kLong && entry->type != kLong8)
        return bad_input("{}: TIFF tag {} ({}) has type {}, which is not a whole number's", directory.name, tag, what,
                         entry->type);
    if (auto checked = check_values(directory, *entry, what); !checked) return tl::unexpected(checked.error());
    const uint64_t size = bytes_of_type(entry->type);
    values.reserve(size_t(entry->count));
    for (uint64_t i = 0; i < entry->count; ++i)
        values.push_back(number_at(directory.bytes, directory.is_big_endian, entry->offset + i * size, size));
    return values;
}

Result<std::vector<double>> tiff_doubles(const TiffDirectory& directory, uint16_t tag, const char* what) {
    std::vector<double> values;
    const TiffEntry* entry = find(directory, tag);
    if (!entry) return values;
    if (auto checked = check_values(directory, *entry, what); !checked) return tl::unexpected(checked.error());
    const uint64_t size = bytes_of_type(entry->type);
    values.reserve(size_t(entry->count));
    for (uint64_t i = 0; i < entry->count; ++i) {
        const uint64_t bits = number_at(directory.bytes, directory.is_big_endian, entry->offset + i * size, size);
        if (entry->type == kDouble)
            values.push_back(std::bit_cast<double>(bits));
        else if (entry->type == kFloat)
            values.push_back(double(std::bit_cast<float>(uint32_t(bits))));
        else
            values.push_back(double(bits));
    }
    return values;
}

Result<std::string> tiff_text(const TiffDirectory& directory, uint16_t tag, const char* what) {
    std::string text;
    const TiffEntry* entry = find(directory, tag);
    if (!entry) return text;
    if (entry->type != kAscii)
        return bad_input("{}: TIFF tag {} ({}) has type {}, which is not a text's", directory.name, tag, what, entry->type);
    if (auto checked = check_values(directory, *entry, what); !checked) return tl::unexpected(checked.error());
    for (uint64_t i = 0; i < entry->count; ++i) {
        const char c = char(std::to_integer<uint8_t>(directory.bytes[size_t(entry->offset + i)]));
        if (c == '\0') break;
        text.push_back(c);
    }
    return text;
}

Result<uint64_t> tiff_integer(const TiffDirectory& directory, uint16_t tag, const char* what, uint64_t otherwise) {
    Result<std::vector<uint64_t>> values = tiff_integers(directory, tag, what);
    if (!values) return tl::unexpected(values.error());
    if (!find(directory, tag)) return otherwise;
    if (values->size() != 1)
        return bad_input("{}: TIFF tag {} ({}) has {} values where one is expected", directory.name, tag, what, values->size());
    return values->front();
}

}  // namespace overlook::dem
