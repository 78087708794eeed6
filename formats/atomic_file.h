// Output that appears under its final name only when it is whole.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "formats/result.h"

namespace overlook {

// Written under a temporary name in the same folder; commit() flushes it to the disk and renames it. Destroyed before that (or
// interrupted by SIGINT, SIGTERM: see remove_unfinished_files) the temporary file goes and whatever stood under the final name stays.
// Every failure is Exit::cannot_write and names the final path and the system's reason: "out/a.ovl: cannot write: No space left on device".
class AtomicFile {
  public:
    AtomicFile() = default;
    AtomicFile(AtomicFile&& other) noexcept;
    AtomicFile& operator=(AtomicFile&& other) noexcept;
    ~AtomicFile();

    static Result<AtomicFile> create(const std::string& path);

    Result<void> append(std::span<const std::byte> bytes);
    // Overwrites bytes already written (a header filled in at the end).
    Result<void> write_at(uint64_t offset, std::span<const std::byte> bytes);
    Result<void> commit();

    const std::string& path() const { return path_; }

  private:
    int descriptor_ = -1;
    std::string path_;
    std::string temporary_path_;
};

// A whole small file at once, atomically.
Result<void> write_file(const std::string& path, std::span<const std::byte> bytes);
Result<void> write_file(const std::string& path, std::string_view text);

// Removes the temporary files of this process that are still open; safe to call from a signal handler.
void remove_unfinished_files() noexcept;

}  // namespace overlook
