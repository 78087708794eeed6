// A file is the 32 hex digits of its payload's hash, then the payload: rgb [h, w, 3], depth_m [h, w] as little-endian floats, ids
// [h, w] as little-endian 32-bit numbers. The picture's size follows from the camera, which is part of the name.
#include "tools/measure/reference_cache.h"

#include <bit>
#include <cassert>
#include <cstring>

#include "formats/atomic_file.h"
#include "formats/mapped_file.h"

namespace overlook::measure {
namespace {

static_assert(std::endian::native == std::endian::little, "frames are kept as they lie in memory");
constexpr size_t kHashDigits = 32;

size_t payload_bytes(const view::Camera& camera) {
    return size_t(camera.width_px) * camera.height_px * (3 + sizeof(float) + sizeof(uint32_t));
}

}  // namespace

KeptFrame read_kept(const std::string& path, const view::Camera& camera) {
    Result<MappedFile> file = MappedFile::open(path);
    if (!file) return {};
    std::span<const std::byte> bytes = file->bytes();
    if (bytes.size() != kHashDigits + payload_bytes(camera)) return {std::nullopt, true};
    std::span<const std::byte> payload = bytes.subspan(kHashDigits);
    if (std::memcmp(bytes.data(), content_hash(payload).data(), kHashDigits) != 0) return {std::nullopt, true};

    Frame frame;
    frame.width = camera.width_px;
    frame.height = camera.height_px;
    frame.camera = camera;
    size_t pixels = size_t(frame.width) * frame.height;
    frame.rgb.resize(3 * pixels);
    frame.depth_m.resize(pixels);
    frame.ids.resize(pixels);
    std::memcpy(frame.rgb.data(), payload.data(), 3 * pixels);
    std::memcpy(frame.depth_m.data(), payload.data() + 3 * pixels, sizeof(float) * pixels);
    std::memcpy(frame.ids.data(), payload.data() + (3 + sizeof(float)) * pixels, sizeof(uint32_t) * pixels);
    return {std::move(frame), false};
}

Result<void> keep(const std::string& path, const Frame& frame) {
    assert(frame.width == frame.camera.width_px && frame.height == frame.camera.height_px);
    std::vector<std::byte> bytes(kHashDigits);
    auto append = [&](std::span<const std::byte> part) { bytes.insert(bytes.end(), part.begin(), part.end()); };
    bytes.reserve(kHashDigits + payload_bytes(frame.camera));
    append(std::as_bytes(std::span(frame.rgb)));
    append(std::as_bytes(std::span(frame.depth_m)));
    append(std::as_bytes(std::span(frame.ids)));
    std::string hash = content_hash(std::span(bytes).subspan(kHashDigits));
    std::memcpy(bytes.data(), hash.data(), kHashDigits);
    return write_file(path, std::span<const std::byte>(bytes));
}

}  // namespace overlook::measure
