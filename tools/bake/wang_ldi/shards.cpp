#include "tools/bake/wang_ldi/shards.h"

#include <cstring>
#include <filesystem>

#include "formats/atomic_file.h"
#include "formats/container_rules.h"
#include "formats/little_endian.h"
#include "formats/mapped_file.h"

namespace overlook::wang_ldi {
namespace {

// checksum of all that follows, then numbers, then the image's frame.
constexpr size_t kChecksumBytes = 8, kNumbers = 13, kHeadBytes = kChecksumBytes + 8 * kNumbers;

std::vector<std::byte> bytes_of(const Shard& shard) {
    std::vector<std::byte> bytes(kHeadBytes + shard.packed.bytes.size());
    const Judgement& j = shard.judgement;
    const uint64_t numbers[] = {shard.packed.checksum,
                                uint64_t(shard.packed.raw_bytes) << 32 | shard.packed.sample_count,
                                uint64_t(shard.packed.colour_count) << 32 | std::bit_cast<uint32_t>(shard.packed.unseen_share),
                                shard.rays,
                                shard.hits,
                                shard.eyes,
                                j.pixels,
                                j.holes,
                                j.deeper,
                                j.nearer,
                                std::bit_cast<uint64_t>(j.mean_error),
                                std::bit_cast<uint64_t>(j.p99_error),
                                shard.packed.bytes.size()};
    static_assert(std::size(numbers) == kNumbers);
    for (size_t i = 0; i < kNumbers; ++i) store_le<uint64_t>(bytes, kChecksumBytes + 8 * i, numbers[i]);
    if (!shard.packed.bytes.empty()) std::memcpy(bytes.data() + kHeadBytes, shard.packed.bytes.data(), shard.packed.bytes.size());
    store_le<uint64_t>(bytes, 0, container::checksum_of(std::span(bytes).subspan(kChecksumBytes)));
    return bytes;
}

std::optional<Shard> shard_of(std::span<const std::byte> bytes) {
    if (bytes.size() < kHeadBytes) return std::nullopt;
    if (load_le<uint64_t>(bytes, 0) != container::checksum_of(bytes.subspan(kChecksumBytes))) return std::nullopt;
    auto number = [&](size_t i) { return load_le<uint64_t>(bytes, kChecksumBytes + 8 * i); };
    if (number(12) != bytes.size() - kHeadBytes) return std::nullopt;
    Shard shard;
    shard.packed.checksum = number(0);
    shard.packed.raw_bytes = uint32_t(number(1) >> 32), shard.packed.sample_count = uint32_t(number(1));
    shard.packed.colour_count = uint32_t(number(2) >> 32);
    shard.packed.unseen_share = std::bit_cast<float>(uint32_t(number(2)));
    shard.rays = number(3), shard.hits = number(4), shard.eyes = number(5);
    shard.judgement = {
        number(6), number(7), number(8), number(9), std::bit_cast<double>(number(10)), std::bit_cast<double>(number(11))};
    shard.packed.bytes.assign(bytes.begin() + kHeadBytes, bytes.end());
    return shard;
}

}  // namespace

Result<Shards> Shards::in(const std::string& folder, uint64_t key) {
    Shards shards;
    shards.folder_ = folder, shards.key_ = key;
    if (folder.empty()) return shards;
    std::error_code problem;
    std::filesystem::create_directories(folder, problem);
    if (problem) return cannot_write("{}: cannot be made: {}", folder, problem.message());
    return shards;
}

std::string Shards::path_of(uint64_t index) const {
    return fmt::format("{}/{:016x}-{}.part", folder_, key_, index);
}

std::optional<Shard> Shards::find(uint64_t index) const {
    if (folder_.empty()) return std::nullopt;
    auto file = MappedFile::open(path_of(index));
    return file ? shard_of(file->bytes()) : std::nullopt;
}

Result<void> Shards::keep(uint64_t index, const Shard& shard) const {
    if (folder_.empty()) return {};
    return write_file(path_of(index), bytes_of(shard));
}

void Shards::remove_all(uint64_t count) const {
    if (folder_.empty()) return;
    std::error_code ignored;
    for (uint64_t index = 0; index < count; ++index) std::filesystem::remove(path_of(index), ignored);
    std::filesystem::remove(folder_, ignored);
}

}  // namespace overlook::wang_ldi
