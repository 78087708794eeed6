// An image as bytes before compression, and back: its palette, then rows of like numbers, wide ones byte by byte.
#include "formats/wang_ldi_groups.h"

namespace overlook::wang_ldi {
namespace {

// A pixel's lowest sample is told from the lowest of the pixel with samples before it, any other from the one below it.
std::vector<uint16_t> residuals_of(const Ldi& ldi) {
    std::vector<uint16_t> residuals(ldi.heights.size());
    int lowest = 0;
    for (size_t p = 0; p + 1 < ldi.first.size(); ++p) {
        for (uint32_t s = ldi.first[p]; s < ldi.first[p + 1]; ++s) {
            bool is_lowest = s == ldi.first[p];
            int height = ldi.heights[s];
            residuals[s] = is_lowest ? groups::folded(height - lowest) : uint16_t(height - ldi.heights[s - 1] - 1);
            if (is_lowest) lowest = height;
        }
    }
    return residuals;
}

// False if a height leaves 16 bits.
bool heights_of_residuals(std::span<const std::byte> planes, Ldi& ldi) {
    uint16_t lowest = 0;
    size_t count = ldi.heights.size();
    for (size_t p = 0; p + 1 < ldi.first.size(); ++p) {
        for (uint32_t s = ldi.first[p]; s < ldi.first[p + 1]; ++s) {
            uint16_t code = plane_value(planes, count, s);
            if (s == ldi.first[p]) {
                ldi.heights[s] = lowest = uint16_t(lowest + groups::unfolded(code));
                continue;
            }
            uint32_t height = uint32_t(ldi.heights[s - 1]) + code + 1;
            if (height > 65535) return false;
            ldi.heights[s] = uint16_t(height);
        }
    }
    return true;
}

}  // namespace

void put_planes(std::vector<std::byte>& bytes, std::span<const uint16_t> values) {
    for (int shift : {0, 8})
        for (uint16_t value : values) bytes.push_back(std::byte((value >> shift) & 0xff));
}

uint64_t raw_bytes_of(const ImageSet& set, uint32_t side_px, uint64_t samples, uint64_t colours) {
    uint64_t of_sample = 3u + (set.has_normals ? 2u : 0u) + (set.has_splats ? 1u : 0u);
    uint64_t pixels = uint64_t(side_px) * side_px;
    if (!set.is_grouped) return 3 * colours + 2 * pixels + of_sample * samples;
    return 4 * group_counts_of(samples).all() + 3 * colours + (pixels + 7) / 8 + (2 + of_sample) * samples;
}

std::vector<std::byte> bytes_of_ldi(const ImageSet& set, const Ldi& ldi) {
    std::vector<std::byte> bytes;
    bytes.reserve(raw_bytes_of(set, ldi.side_px, ldi.heights.size(), ldi.palette.size()));
    for (const auto& colour : ldi.palette)
        for (uint8_t channel : colour) bytes.push_back(std::byte(channel));
    std::vector<uint16_t> counts(ldi.first.size() - 1);
    for (size_t p = 0; p < counts.size(); ++p) counts[p] = uint16_t(ldi.first[p + 1] - ldi.first[p]);
    put_planes(bytes, counts);
    put_planes(bytes, residuals_of(ldi));
    for (uint8_t colour : ldi.colours) bytes.push_back(std::byte(colour));
    put_normals_and_splats(ldi, bytes);
    return bytes;
}

void put_normals_and_splats(const Ldi& ldi, std::vector<std::byte>& bytes) {
    for (size_t axis = 0; axis < 2; ++axis)
        for (const auto& normal : ldi.normals) bytes.push_back(std::byte(normal[axis]));
    for (uint8_t splat : ldi.splats) bytes.push_back(std::byte(splat));
}

void take_normals_and_splats(std::span<const std::byte> bytes, const ImageSet& set, Ldi& ldi) {
    size_t samples = ldi.heights.size();
    if (set.has_normals) {
        ldi.normals.resize(samples);
        for (size_t s = 0; s < samples; ++s) ldi.normals[s] = {int8_t(bytes[s]), int8_t(bytes[samples + s])};
        bytes = bytes.subspan(2 * samples);
    }
    if (!set.has_splats) return;
    ldi.splats.resize(samples);
    for (size_t s = 0; s < samples; ++s) ldi.splats[s] = uint8_t(bytes[s]);
}

ImageFault ldi_of_bytes(std::span<const std::byte> bytes, const ImageSet& set, uint32_t level, const Entry& entry, Ldi& ldi) {
    if (set.is_grouped) return ldi_of_grouped(bytes, set, level, entry, ldi);
    auto take = [&](size_t count) {
        auto taken = bytes.first(count);
        bytes = bytes.subspan(count);
        return taken;
    };
    size_t side = set.levels[level].side_px, pixels = side * side, samples = entry.sample_count;
    ldi.side_px = uint32_t(side), ldi.unseen_share = entry.unseen_share;
    ldi.palette.resize(entry.colour_count);
    for (auto& colour : ldi.palette)
        for (uint8_t& channel : colour) channel = uint8_t(take(1)[0]);

    std::span<const std::byte> counts = take(2 * pixels);
    ldi.first.resize(pixels + 1);
    uint64_t sum = 0;
    for (size_t p = 0; p < pixels && sum <= samples; ++p) sum += plane_value(counts, pixels, p), ldi.first[p + 1] = uint32_t(sum);
    if (sum != samples) return {11, fmt::format("its pixels have {} samples or more, {} are stated", sum, samples)};

    ldi.heights.resize(samples);
    if (!heights_of_residuals(take(2 * samples), ldi)) return {12, "a height is above step 65,535"};
    ldi.colours.resize(samples);
    std::span<const std::byte> colours = take(samples);
    for (size_t s = 0; s < samples; ++s) ldi.colours[s] = uint8_t(colours[s]);
    take_normals_and_splats(bytes, set, ldi);
    return fault_of_ldi(set, level, ldi);
}

}  // namespace overlook::wang_ldi
