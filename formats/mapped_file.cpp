#include "formats/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace overlook {

MappedFile::MappedFile(MappedFile&& other) noexcept : bytes_(std::exchange(other.bytes_, {})) {}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept {
    std::swap(bytes_, other.bytes_);
    return *this;
}

MappedFile::~MappedFile() {
    if (!bytes_.empty()) munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

namespace {

// Maps what stands behind an open descriptor; an empty file gives an empty span.
Result<std::span<const std::byte>> map(const std::string& path, int descriptor) {
    struct stat status {};
    if (fstat(descriptor, &status) != 0) return bad_input("{}: {}", path, std::strerror(errno));
    if (S_ISDIR(status.st_mode)) return bad_input("{}: is a folder; give a file", path);
    if (!S_ISREG(status.st_mode)) {
        return bad_input("{}: is not a regular file, so it cannot be mapped; copy it into a file first", path);
    }
    if (status.st_size == 0) return std::span<const std::byte>();

    size_t size = size_t(status.st_size);
    void* address = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
    if (address == MAP_FAILED) return bad_input("{}: {}", path, std::strerror(errno));
    return std::span(static_cast<const std::byte*>(address), size);
}

}  // namespace

Result<MappedFile> MappedFile::open(const std::string& path) {
    // O_NONBLOCK: a named pipe is refused below instead of being waited for.
    int descriptor = -1;
    do {
        descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    } while (descriptor < 0 && errno == EINTR);
    if (descriptor < 0) return bad_input("{}: {}", path, std::strerror(errno));

    Result<std::span<const std::byte>> bytes = map(path, descriptor);
    ::close(descriptor);
    if (!bytes) return tl::unexpected(bytes.error());
    MappedFile file;
    file.bytes_ = *bytes;
    return file;
}

std::string content_hash(std::span<const std::byte> bytes) {
    XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace overlook
