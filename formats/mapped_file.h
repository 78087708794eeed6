// A file mapped into memory, read-only.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "formats/result.h"

namespace overlook {

class MappedFile {
  public:
    MappedFile() = default;
    MappedFile(MappedFile&& other) noexcept;
    MappedFile& operator=(MappedFile&& other) noexcept;
    ~MappedFile();

    // Maps a regular file; an empty one gives an empty span. Fails with Exit::bad_input: "PATH: No such file or directory".
    static Result<MappedFile> open(const std::string& path);

    std::span<const std::byte> bytes() const { return bytes_; }

  private:
    std::span<const std::byte> bytes_;
};

// XXH3-128 of the bytes as 32 hex digits: the identity of an input.
std::string content_hash(std::span<const std::byte> bytes);

}  // namespace overlook
