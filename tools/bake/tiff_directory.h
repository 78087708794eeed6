// The first directory of a TIFF file: a table of tags, read from bytes that may be hostile. Classic TIFF and BigTIFF, either byte
// order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "formats/result.h"

namespace overlook::dem {

// One line of the directory. Its values lie at bytes[offset ...]; nothing says yet that they lie within the file.
struct TiffEntry {
    uint16_t tag = 0;
    uint16_t type = 0;
    uint64_t count = 0;
    uint64_t offset = 0;
};

struct TiffDirectory {
    std::span<const std::byte> bytes;  // the whole file; must outlive this
    std::string name;                  // of the file, for messages
    bool is_big_endian = false;
    std::vector<TiffEntry> entries;
};

// True if the file begins as a TIFF does.
bool is_tiff(std::span<const std::byte> bytes);

// Reads header and table. Cost: O(number of entries). Fails with Exit::bad_input:
//   "NAME: is not a TIFF file"
//   "NAME: TIFF directory at byte B ends after the file, which is N bytes long; was the copy cut short?"
//   "NAME: TIFF tag T stands twice in the directory"
Result<TiffDirectory> read_tiff_directory(std::span<const std::byte> bytes, const std::string& name);

// The values of a tag; empty if the tag is not there. Reads types BYTE, SHORT, LONG and LONG8 as integers, these and FLOAT and
// DOUBLE as doubles, ASCII as text up to its first zero byte. Allocates no more than eight times the bytes that the values take
// in the file. Fails with Exit::bad_input:
//   "NAME: TIFF tag T (WHAT) ends after the file, which is N bytes long; was the copy cut short?"
//   "NAME: TIFF tag T (WHAT) has type Y, which is not a number's"
Result<std::vector<uint64_t>> tiff_integers(const TiffDirectory& directory, uint16_t tag, const char* what);
Result<std::vector<double>> tiff_doubles(const TiffDirectory& directory, uint16_t tag, const char* what);
Result<std::string> tiff_text(const TiffDirectory& directory, uint16_t tag, const char* what);

// One integer, `otherwise` if the tag is not there. Fails as above, and "NAME: TIFF tag T (WHAT) has C values where one is
// expected".
Result<uint64_t> tiff_integer(const TiffDirectory& directory, uint16_t tag, const char* what, uint64_t otherwise);

}  // namespace overlook::dem
