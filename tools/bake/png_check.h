// Whether a PNG file is whole, before a library decodes it (and prints that it is not).
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "formats/result.h"

namespace overlook {

bool is_png(std::span<const std::byte> bytes);

// Every chunk lies within the file and has its checksum, the first is IHDR, and IEND is reached. Cost: one pass over the bytes,
// which may be hostile. Fails with Exit::bad_input:
//   "NAME: PNG chunk at byte 33 ends after the file, which is 40 bytes long; was the copy cut short?"
//   "NAME: PNG chunk at byte 33 is damaged: its checksum does not match"
Result<void> check_png(std::span<const std::byte> bytes, const std::string& name);

}  // namespace overlook
