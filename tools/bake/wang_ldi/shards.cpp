#include "tools/bake/wang_ldi/shards.h"

#include <bit>
#include <filesystem>
#include <vector>

#include "formats/atomic_file.h"
#include "formats/container_rules.h"
#include "formats/little_endian.h"
#include "formats/mapped_file.h"

namespace overlook::wang_ldi {
namespace {

// checksum of all that follows, then numbers, then the image's frame.
constexpr size_t kJudgementNumbers = 11 + Shares::kSteps;
constexpr size_t kChecksumBytes = 8, kNumbers = 7 + 2 * kJudgementNumbers, kHeadBytes = kChecksumBytes + 8 * kNumbers;

void add_numbers(const Judgement& judgement, std::vector<uint64_t>& numbers) {
    numbers.insert(numbers.end(),
                   {judgement.pixels, judgement.holes, judgement.holes_left, judgement.deeper, judgement.nearer,
                    judgement.covered, judgement.covered_drawn, judgement.covered_filled, judgement.error_pixels,
                    std::bit_cast<uint64_t>(judgement.error_sum), std::bit_cast<uint64_t>(judgement.unfilled_error_sum)});
    numbers.insert(numbers.end(), judgement.errors.counts.begin(), judgement.errors.counts.end());
}

std::vector<std::byte> bytes_of(const Shard& shard) {
    const Packed& packed = shard.packed;
    std::vector<uint64_t> numbers{packed.checksum,
                                  uint64_t(packed.raw_bytes) << 32 | packed.sample_count,
                                  uint64_t(packed.colour_count) << 32 | std::bit_cast<uint32_t>(packed.unseen_share),
                                  shard.rays,
                                  shard.hits,
                                  shard.eyes};
    add_numbers(shard.judgement, numbers), add_numbers(shard.foreign, numbers);
    numbers.push_back(packed.bytes.size());
    std::vector<std::byte> bytes(kHeadBytes);
    for (size_t i = 0; i < kNumbers; ++i) store_le<uint64_t>(bytes, kChecksumBytes + 8 * i, numbers[i]);
    bytes.insert(bytes.end(), packed.bytes.begin(), packed.bytes.end());
    store_le<uint64_t>(bytes, 0, container::checksum_of(std::span(bytes).subspan(kChecksumBytes)));
    return bytes;
}

std::optional<Shard> shard_of(std::span<const std::byte> bytes) {
    if (bytes.size() < kHeadBytes) return std::nullopt;
    if (load_le<uint64_t>(bytes, 0) != container::checksum_of(bytes.subspan(kChecksumBytes))) return std::nullopt;
    auto number = [&](size_t i) { return load_le<uint64_t>(bytes, kChecksumBytes + 8 * i); };
    if (number(kNumbers - 1) != bytes.size() - kHeadBytes) return std::nullopt;
    Shard shard;
    shard.packed.checksum = number(0);
    shard.packed.raw_bytes = uint32_t(number(1) >> 32), shard.packed.sample_count = uint32_t(number(1));
    shard.packed.colour_count = uint32_t(number(2) >> 32);
    shard.packed.unseen_share = std::bit_cast<float>(uint32_t(number(2)));
    shard.rays = number(3), shard.hits = number(4), shard.eyes = number(5);
    auto judgement = [&](size_t at) {
        Judgement read{number(at),
                       number(at + 1),
                       number(at + 2),
                       number(at + 3),
                       number(at + 4),
                       number(at + 5),
                       number(at + 6),
                       number(at + 7),
                       number(at + 8),
                       std::bit_cast<double>(number(at + 9)),
                       std::bit_cast<double>(number(at + 10)),
                       {}};
        for (size_t step = 0; step < Shares::kSteps; ++step) read.errors.counts[step] = number(at + 11 + step);
        return read;
    };
    shard.judgement = judgement(6), shard.foreign = judgement(6 + kJudgementNumbers);
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
    // What writers of the same bake had begun when they were killed: ".KEY-INDEX.part.PROCESS.COUNT.tmp" (atomic_file.cpp).
    const std::string own = fmt::format(".{:016x}-", key_);
    std::vector<std::filesystem::path> unfinished;
    for (std::filesystem::directory_iterator at(folder_, ignored), end; !ignored && at != end; at.increment(ignored)) {
        std::string name = at->path().filename().string();
        if (name.starts_with(own) && name.ends_with(".tmp")) unfinished.push_back(at->path());
    }
    for (const auto& path : unfinished) std::filesystem::remove(path, ignored);
    std::filesystem::remove(folder_, ignored);
}

}  // namespace overlook::wang_ldi
