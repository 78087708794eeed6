#include "formats/atomic_file.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <utility>

#include "formats/unfinished_files.h"

namespace overlook {
namespace {

tl::unexpected<Error> refuse(const std::string& path, const std::string& reason) {
    return cannot_write("{}: cannot write: {}", path, reason);
}

struct SplitPath {
    std::string folder;  // with its last '/', or empty
    std::string name;
};

SplitPath split(const std::string& path) {
    size_t slash = path.rfind('/');
    if (slash == std::string::npos) return {"", path};
    return {path.substr(0, slash + 1), path.substr(slash + 1)};
}

// The regular file, or the free name, that `path` leads to.
Result<std::string> final_path_of(const std::string& path) {
    if (path.empty()) return refuse("(no name)", "the path is empty");
    if (path == "-") {
        return refuse(path, "the standard output cannot take this file; give a file's name (./- for a file of that name)");
    }
    if (path.find('\0') != std::string::npos) return refuse(path.c_str(), "the path holds a zero byte");
    if (path.back() == '/') return refuse(path, std::string(std::strerror(EISDIR)) + "; give the name of a file in it");

    struct stat status {};
    if (stat(path.c_str(), &status) == 0) {
        if (S_ISDIR(status.st_mode)) {
            return refuse(path, std::string(std::strerror(EISDIR)) + "; give the name of a file in it");
        }
        if (!S_ISREG(status.st_mode)) return refuse(path, "is not a regular file; give the name of a file");
    }
    if (lstat(path.c_str(), &status) != 0 || !S_ISLNK(status.st_mode)) return path;

    std::unique_ptr<char, decltype(&std::free)> target(realpath(path.c_str(), nullptr), &std::free);
    if (!target) return refuse(path, std::string("is a link that leads nowhere: ") + std::strerror(errno));
    return std::string(target.get());
}

// A hidden name beside the final one; the final name is cut so that the whole is never longer than a name may be (255 bytes).
std::string temporary_name(const std::string& final_name, unsigned count) {
    constexpr size_t kLongest = 200;
    size_t kept = std::min(final_name.size(), kLongest);
    while (kept > 0 && kept < final_name.size() && (uint8_t(final_name[kept]) & 0xc0) == 0x80) kept--;  // whole UTF-8 only
    return fmt::format(".{}.{}.{}.tmp", final_name.substr(0, kept), getpid(), count);
}

std::string reason_of_open(int error, const std::string& folder) {
    std::string reason = std::strerror(error);
    if (error == ENOENT && folder.size() > 1) reason += "; make the folder " + folder.substr(0, folder.size() - 1) + " first";
    return reason;
}

// How many more bytes than `offset` the process may write before the system raises SIGXFSZ.
uint64_t bytes_allowed_after(uint64_t offset) {
    struct rlimit limit {};
    if (getrlimit(RLIMIT_FSIZE, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return UINT64_MAX;
    return limit.rlim_cur > offset ? limit.rlim_cur - offset : 0;
}

// So that the new name survives a power cut. Some file systems cannot do it and say EINVAL; there is nothing more to do there.
int sync_folder(const std::string& folder) {
    int descriptor = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return errno == EACCES ? 0 : errno;  // a folder may be writable without being readable
    int error = fsync(descriptor) != 0 && errno != EINVAL ? errno : 0;
    close(descriptor);
    return error;
}

}  // namespace

AtomicFile::AtomicFile(AtomicFile&& other) noexcept {
    *this = std::move(other);
}

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    std::swap(unfinished_slot_, other.unfinished_slot_);
    std::swap(size_bytes_, other.size_bytes_);
    path_.swap(other.path_);
    final_path_.swap(other.final_path_);
    temporary_path_.swap(other.temporary_path_);
    failure_.swap(other.failure_);
    return *this;
}

AtomicFile::~AtomicFile() {
    if (descriptor_ >= 0) close(descriptor_);
    if (!temporary_path_.empty()) unlink(temporary_path_.c_str());
    forget_unfinished_file(unfinished_slot_);
}

Result<AtomicFile> AtomicFile::create(const std::string& path) {
    Result<std::string> final_path = final_path_of(path);
    if (!final_path) return tl::unexpected(final_path.error());
    SplitPath parts = split(*final_path);

    static std::atomic<unsigned> counter{0};
    constexpr int kTries = 1000;  // names left behind by a killed process of the same number
    for (int i = 0; i < kTries; i++) {
        std::string temporary = parts.folder + temporary_name(parts.name, counter++);
        if (temporary.size() >= PATH_MAX) return refuse(path, std::strerror(ENAMETOOLONG));
        int slot = remember_unfinished_file(temporary);
        if (slot == kNoUnfinishedSlot) {
            return refuse(path, fmt::format("{} files are being written already", kMaxUnfinishedFiles));
        }
        int descriptor = open(temporary.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        int error = errno;
        if (descriptor >= 0) {
            AtomicFile file;
            file.descriptor_ = descriptor;
            file.unfinished_slot_ = slot;
            file.path_ = path;
            file.final_path_ = *final_path;
            file.temporary_path_ = temporary;
            return file;
        }
        forget_unfinished_file(slot);
        if (error != EEXIST && error != EINTR) return refuse(path, reason_of_open(error, parts.folder));
    }
    return refuse(path, "its folder is full of unfinished files (*.tmp); remove them");
}

tl::unexpected<Error> AtomicFile::fail(const std::string& reason) {
    if (failure_.empty()) failure_ = reason;
    return refuse(path_, failure_);
}

Result<void> AtomicFile::write_all(uint64_t offset, std::span<const std::byte> bytes) {
    if (!failure_.empty()) return fail(failure_);
    if (descriptor_ < 0) return tl::unexpected(Error{Exit::our_bug, path_ + ": written to while it is not open"});
    if (bytes.size() > bytes_allowed_after(offset)) return fail(std::strerror(EFBIG));

    while (!bytes.empty()) {
        ssize_t written = pwrite(descriptor_, bytes.data(), bytes.size(), off_t(offset));
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return fail(std::strerror(errno));
        bytes = bytes.subspan(size_t(written));
        offset += uint64_t(written);
    }
    return {};
}

Result<void> AtomicFile::append(std::span<const std::byte> bytes) {
    Result<void> written = write_all(size_bytes_, bytes);
    if (written) size_bytes_ += bytes.size();
    return written;
}

Result<void> AtomicFile::write_at(uint64_t offset, std::span<const std::byte> bytes) {
    if (offset > size_bytes_ || bytes.size() > size_bytes_ - offset) {
        return tl::unexpected(Error{Exit::our_bug, path_ + ": overwrites bytes that are not written yet"});
    }
    return write_all(offset, bytes);
}

Result<void> AtomicFile::commit() {
    if (!failure_.empty()) return fail(failure_);
    if (descriptor_ < 0) return tl::unexpected(Error{Exit::our_bug, path_ + ": committed while it is not open"});

    int synced = 0;
    do {
        synced = fsync(descriptor_);
    } while (synced != 0 && errno == EINTR);
    if (synced != 0) return fail(std::strerror(errno));
    if (close(std::exchange(descriptor_, -1)) != 0) return fail(std::strerror(errno));

    if (std::rename(temporary_path_.c_str(), final_path_.c_str()) != 0) return fail(std::strerror(errno));
    temporary_path_.clear();
    forget_unfinished_file(std::exchange(unfinished_slot_, kNoUnfinishedSlot));
    if (int error = sync_folder(split(final_path_).folder); error != 0) return fail(std::strerror(error));
    return {};
}

Result<void> write_file(const std::string& path, std::span<const std::byte> bytes) {
    Result<AtomicFile> file = AtomicFile::create(path);
    if (!file) return tl::unexpected(file.error());
    if (Result<void> written = file->append(bytes); !written) return written;
    return file->commit();
}

Result<void> write_file(const std::string& path, std::string_view text) {
    return write_file(path, std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace overlook
