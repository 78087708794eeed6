// A hierarchy as a file's bytes, and back.
#pragma once

#include <span>
#include <string>

#include "formats/caveclod.h"
#include "tests/formats/scratch_folder.h"

namespace overlook::caveclod::synthetic {

// Empty if it cannot be written.
inline std::string file_of(const Hierarchy& hierarchy, Codec codec = kDefaultCodec) {
    ScratchFolder folder;
    Result<container::Writer> writer = container::Writer::create(folder / "mesh.ovl", kKind);
    if (!writer || !write(*writer, hierarchy, codec) || !writer->commit()) return "";
    return text_of_file(folder / "mesh.ovl");
}

inline Result<Hierarchy> read_bytes(const std::string& bytes, uint32_t most_blocks = ~0u) {
    Result<container::Reader> file = container::Reader::open_bytes(std::as_bytes(std::span(bytes)), "mesh.ovl");
    if (!file) return tl::unexpected(file.error());
    return read(*file, most_blocks);
}

}  // namespace overlook::caveclod::synthetic
