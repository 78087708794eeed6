// Output that appears under its final name only when it is whole.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "formats/result.h"

namespace overlook {

// Written under a temporary name in the same folder (hidden: ".NAME.PROCESS.COUNT.tmp"); commit() flushes it to the disk and
// renames it. Destroyed before that (or interrupted by SIGINT, SIGTERM: see remove_unfinished_files) the temporary file goes and
// whatever stood under the final name stays. kill -9 leaves the temporary file, never a half-written final one.
//
// Every failure of the system is Exit::cannot_write and names the path as it was given and the system's reason:
//   "out/a.ovl: cannot write: No space left on device"
//   "out/a.ovl: cannot write: No such file or directory; make the folder out first"
//   "/dev/full: cannot write: is not a regular file; give the name of a file"
//   "-: cannot write: the standard output cannot take this file; give a file's name (./- for a file of that name)"
// A link is followed: the file it leads to is replaced, the link stays. A file-size limit (ulimit -f) is found before the system
// raises SIGXFSZ, so that the process lives and the library needs no signal handler. After a failure every further call fails
// alike.
//
// It does not lock: of two writers of one path the last to commit wins, whole. Objects are independent; one object is for one
// thread.
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
    Result<void> write_all(uint64_t offset, std::span<const std::byte> bytes);
    tl::unexpected<Error> fail(const std::string& reason);

    int descriptor_ = -1;
    int unfinished_slot_ = -1;
    uint64_t size_bytes_ = 0;
    std::string path_;        // as given: for messages
    std::string final_path_;  // what it leads to
    std::string temporary_path_;
    std::string failure_;  // the reason of the first failure
};

// A whole small file at once, atomically.
Result<void> write_file(const std::string& path, std::span<const std::byte> bytes);
Result<void> write_file(const std::string& path, std::string_view text);

// Removes the temporary files of this process that are still open (at most 64 can be); safe to call from a signal handler, which
// must then end the process. The library installs no handler; runtime/command does.
void remove_unfinished_files() noexcept;

}  // namespace overlook
