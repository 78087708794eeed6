// The one compressor of baked files: zstd, whose bytes do not depend on the number of threads.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace overlook {

// One zstd frame that states its content size.
std::vector<std::byte> compress(std::span<const std::byte> raw);

// Decodes one whole frame, which may be hostile, to exactly out.size() bytes; false if it states another size, is damaged, or has bytes behind it.
bool decompress(std::span<const std::byte> frame, std::span<std::byte> out);

}  // namespace overlook
