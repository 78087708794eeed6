// Rows of PLY files, ascii and binary.

#include "tools/bake/mesh/ply_rows.h"

#include <bit>
#include <cstring>

namespace overlook::mesh {
namespace {

template <class T>
double load(const char* bytes, bool is_big_endian) {
    unsigned char copy[sizeof(T)];
    std::memcpy(copy, bytes, sizeof(T));
    if (is_big_endian != (std::endian::native == std::endian::big))
        for (size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(copy[i], copy[sizeof(T) - 1 - i]);
    T value;
    std::memcpy(&value, copy, sizeof(T));
    return double(value);
}

}  // namespace

double PlyRows::fail(const char* why) {
    if (!has_failed_) failure_ = form_ == PlyForm::ascii ? fmt::format("line {}: {}", text_.line(), why) : std::string(why);
    has_failed_ = true;
    return 0;
}

void PlyRows::begin_row() {
    if (form_ != PlyForm::ascii || has_failed_) return;
    if (!text_.find_line('\0')) fail("the file ends before it; was it cut short?");
}

void PlyRows::end_row() {
    if (form_ != PlyForm::ascii || has_failed_) return;
    if (!text_.is_at_line_end()) fail("holds more values than the header says");
}

double PlyRows::value(PlyType type) {
    if (has_failed_) return 0;
    if (form_ != PlyForm::ascii) return binary_value(type);
    double value = 0;
    if (text_.number(value)) return value;
    return fail(text_.is_at_line_end() ? "holds fewer values than the header says" : "holds something that is no number");
}

double PlyRows::binary_value(PlyType type) {
    if (text_.bytes_left() < size_bytes(type)) return fail("the file ends within it; was it cut short?");
    const char* at = text_.take(size_bytes(type));
    const bool is_big = form_ == PlyForm::big_endian;
    switch (type) {
        case PlyType::int8:
            return load<int8_t>(at, is_big);
        case PlyType::uint8:
            return load<uint8_t>(at, is_big);
        case PlyType::int16:
            return load<int16_t>(at, is_big);
        case PlyType::uint16:
            return load<uint16_t>(at, is_big);
        case PlyType::int32:
            return load<int32_t>(at, is_big);
        case PlyType::uint32:
            return load<uint32_t>(at, is_big);
        case PlyType::float32:
            return load<float>(at, is_big);
        default:
            return load<double>(at, is_big);
    }
}

uint64_t PlyRows::list_length(const PlyProperty& list) {
    const double length = value(list.count_type);
    const double item_bytes = form_ == PlyForm::ascii ? 2 : double(size_bytes(list.type));
    if (!(length >= 0) || length * item_bytes > double(text_.bytes_left() + 1)) {
        fail("a list is longer than the rest of the file; was it cut short?");
        return 0;
    }
    return uint64_t(length);
}

void PlyRows::skip(const PlyProperty& property) {
    const uint64_t count = property.is_list ? list_length(property) : 1;
    for (uint64_t i = 0; i < count && !has_failed_; ++i) (void)value(property.type);
}

}  // namespace overlook::mesh
