// Based on: Aldus, TIFF Revision 6.0, 1992; Open Geospatial Consortium, GeoTIFF Standard 1.1 (19-008r4),
// 2019.
#include "tools/make_sample/geotiff.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <string>

namespace overlook::sample {
namespace {

enum Type : uint16_t { kAscii = 2, kShort = 3, kLong = 4, kDouble = 12 };

constexpr uint32_t kEntryBytes = 12;
constexpr uint32_t kStripTargetBytes = 1 << 16;

void put(std::vector<std::byte>& out, uint64_t value, unsigned bytes) {
    for (unsigned i = 0; i < bytes; ++i) out.push_back(std::byte(value >> (8 * i) & 255));
}

struct Field {
    uint16_t tag;
    uint16_t type;
    uint32_t count;
    std::vector<std::byte> value;
};

Field shorts(uint16_t tag, std::initializer_list<uint16_t> values) {
    Field field{tag, kShort, uint32_t(values.size()), {}};
    for (uint16_t value : values) put(field.value, value, 2);
    return field;
}

Field longs(uint16_t tag, std::span<const uint32_t> values) {
    Field field{tag, kLong, uint32_t(values.size()), {}};
    for (uint32_t value : values) put(field.value, value, 4);
    return field;
}

Field doubles(uint16_t tag, std::initializer_list<double> values) {
    Field field{tag, kDouble, uint32_t(values.size()), {}};
    for (double value : values) put(field.value, std::bit_cast<uint64_t>(value), 8);
    return field;
}

Field text(uint16_t tag, const std::string& value) {
    Field field{tag, kAscii, uint32_t(value.size() + 1), {}};
    for (char c : value) put(field.value, uint8_t(c), 1);
    put(field.value, 0, 1);
    return field;
}

std::vector<Field> fields_of(uint32_t width, uint32_t height, const Placement& placement, std::optional<int> nodata,
                             uint32_t rows_per_strip) {
    uint32_t strip_count = (height + rows_per_strip - 1) / rows_per_strip;
    std::vector<uint32_t> offsets(strip_count), sizes(strip_count);
    for (uint32_t i = 0; i < strip_count; ++i) sizes[i] = 4 * width * std::min(rows_per_strip, height - i * rows_per_strip);
    std::vector<Field> fields;
    fields.push_back(longs(256, std::span(&width, 1)));
    fields.push_back(longs(257, std::span(&height, 1)));
    fields.push_back(shorts(258, {32}));  // bits a sample
    fields.push_back(shorts(259, {1}));   // not compressed
    fields.push_back(shorts(262, {1}));   // black is zero
    fields.push_back(longs(273, offsets));
    fields.push_back(shorts(277, {1}));  // samples a pixel
    fields.push_back(longs(278, std::span(&rows_per_strip, 1)));
    fields.push_back(longs(279, sizes));
    fields.push_back(shorts(339, {3}));  // IEEE floats
    fields.push_back(doubles(33550, {placement.cell_m, placement.cell_m, 0}));
    fields.push_back(doubles(33922, {0, 0, 0, placement.easting_m, placement.northing_m, 0}));
    // Version 1.1.0, then: projected, pixel is point, this reference system.
    fields.push_back(shorts(34735, {1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 2, 3072, 0, 1, placement.epsg}));
    if (nodata) fields.push_back(text(42113, std::to_string(*nodata)));
    return fields;
}

}  // namespace

std::vector<std::byte> geotiff_bytes(std::span<const float> samples, uint32_t width, uint32_t height, const Placement& placement,
                                     std::optional<int> nodata) {
    assert(samples.size() == size_t(width) * height && samples.size() < (size_t(1) << 30) - 4096);
    uint32_t rows_per_strip = std::clamp(kStripTargetBytes / (4 * width), 1u, height);
    std::vector<Field> fields = fields_of(width, height, placement, nodata, rows_per_strip);

    // Place the values that do not fit their entries behind the directory, the heights behind those.
    uint32_t outside = 8 + 2 + kEntryBytes * uint32_t(fields.size()) + 4;
    uint32_t data = outside;
    for (const Field& field : fields)
        if (field.value.size() > 4) data += uint32_t(field.value.size() + 1) / 2 * 2;
    data = (data + 15) / 16 * 16;
    for (Field& field : fields) {
        if (field.tag != 273) continue;
        std::vector<std::byte> offsets;
        for (uint32_t i = 0; i < field.count; ++i) put(offsets, data + i * rows_per_strip * 4 * width, 4);
        field.value = offsets;
    }

    std::vector<std::byte> out, behind;
    out.reserve(data + 4 * samples.size());
    put(out, 0x002a4949, 4);
    put(out, 8, 4);
    put(out, fields.size(), 2);
    for (const Field& field : fields) {
        put(out, field.tag, 2);
        put(out, field.type, 2);
        put(out, field.count, 4);
        bool is_inside = field.value.size() <= 4;
        if (is_inside) out.insert(out.end(), field.value.begin(), field.value.end());
        put(out, is_inside ? 0 : outside + behind.size(), is_inside ? unsigned(4 - field.value.size()) : 4);
        if (is_inside) continue;
        behind.insert(behind.end(), field.value.begin(), field.value.end());
        if (behind.size() % 2 != 0) behind.push_back(std::byte{0});
    }
    put(out, 0, 4);
    out.insert(out.end(), behind.begin(), behind.end());
    out.resize(data);
    for (float sample : samples) put(out, std::bit_cast<uint32_t>(sample), 4);
    return out;
}

}  // namespace overlook::sample
