// The seam to zstd: whole pieces of memory, one frame each, bounded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "formats/result.h"

namespace overlook {

// One zstd frame that states its content size, made by one thread. The same bytes for the same version of zstd, on any machine.
// raw may be empty. Fails with Exit::impossible: "NAME: there is not enough memory to compress 4,096 bytes".
// ends: places in raw, ascending, where numbers of another kind begin: blocks end there, each with a code of its own, wherever
// that is worth a block.
Result<std::vector<std::byte>> zstd_compressed(const std::string& name, std::span<const std::byte> raw,
                                               std::span<const size_t> ends = {});

// Why `stored` cannot be exactly one zstd frame of raw_bytes of content; empty if it may be. Allocates nothing. stored and
// raw_bytes may be hostile: besides the frame's own words, a frame never expands more than its blocks can (128 KiB from each 4
// bytes).
std::string fault_of_zstd_frame(std::span<const std::byte> stored, uint64_t raw_bytes);

// Decodes one frame into exactly `raw`. Returns zstd's reason if it cannot; empty if all is well.
std::string zstd_decode(std::span<const std::byte> stored, std::span<std::byte> raw);

}  // namespace overlook
