// Reference frames on the disk.
#pragma once

#include <optional>
#include <string>

#include "formats/result.h"
#include "tools/measure/frame.h"

namespace overlook::measure {

struct KeptFrame {
    std::optional<Frame> frame;
    bool is_damaged = false;  // there is a file, but not a whole one of this size
};

// The frame kept under this name, of this camera. The file may be hostile: its size must be the one that the camera's picture
// has, and its checksum right, before anything of it is believed.
KeptFrame read_kept(const std::string& path, const view::Camera& camera);

// Keeps colour, depth and ids under this name; it appears whole. Same frame, same bytes. Fails with Exit::cannot_write.
Result<void> keep(const std::string& path, const Frame& frame);

}  // namespace overlook::measure
