// Grouped rows, read. Which group a number is in depends on the numbers before it, which is what reading an image takes longest
// for: the columns beside a pixel are looked through eight heights at a time.
#include "formats/wang_ldi_columns.h"
#include "formats/wang_ldi_grouped.h"

namespace overlook::wang_ldi {
namespace {

using namespace groups;

constexpr uint32_t kMostGroups = 32, kMostBands = 4;
constexpr bool fits(const GroupCounts& groups) {
    return std::max({groups.counts, groups.heights, groups.colours()}) <= kMostGroups && groups.colour_bands <= kMostBands;
}
static_assert(fits(group_counts_of(0)) && fits(group_counts_of(kFewSamples)) && fits(group_counts_of(kManySamples)));

// Numbers by group, as GroupWriter has put them: false where a group has no more.
class GroupReader {
  public:
    // sizes: of the groups, u32 each. Whether they are `count` together at most.
    bool begin(std::span<const std::byte> sizes, size_t count, std::span<const std::byte> low, std::span<const std::byte> high) {
        uint64_t sum = 0;
        groups_ = sizes.size() / 4;
        for (size_t g = 0; g < groups_; ++g) {
            at_[g] = uint32_t(sum), sum += load_le<uint32_t>(sizes, 4 * g);
            if (sum > count) return false;
            ends_[g] = uint32_t(sum);
        }
        low_ = low, high_ = high;
        return true;
    }
    bool take(uint32_t group, uint16_t& value) {
        uint32_t at = at_[group];
        if (at == ends_[group]) return false;
        value = uint16_t(uint16_t(low_[at]) | uint16_t(high_[at]) << 8);
        at_[group] = at + 1;
        return true;
    }
    bool take(uint32_t group, uint8_t& value) {
        uint32_t at = at_[group];
        if (at == ends_[group]) return false;
        value = uint8_t(low_[at]), at_[group] = at + 1;
        return true;
    }
    // All are taken, and nothing stands behind them.
    bool is_done() const {
        auto is_zero = [](std::byte byte) { return byte == std::byte(0); };
        long used = long(ends_[groups_ - 1]);
        return std::equal(at_.begin(), at_.begin() + long(groups_), ends_.begin()) &&
               std::all_of(low_.begin() + used, low_.end(), is_zero) &&
               (high_.empty() || std::all_of(high_.begin() + used, high_.end(), is_zero));
    }

  private:
    size_t groups_ = 0;
    std::array<uint32_t, kMostGroups> at_{}, ends_{};
    std::span<const std::byte> low_, high_;
};

ImageFault fault_of_groups(const char* what) {
    return {16, fmt::format("its groups of {} have other sizes than are stated", what)};
}

// Pixels that have samples: as many numbers as they are in the groups.
ImageFault read_counts(std::span<const std::byte> occupied, GroupReader& counts, const GroupCounts& groups, size_t samples,
                       Ldi& ldi) {
    uint64_t sum = 0;
    for (size_t p = 0; p + 1 < ldi.first.size(); ++p) {
        ldi.first[p] = uint32_t(sum);
        uint16_t more = 0;
        if ((occupied[p / 8] & std::byte(1 << (p % 8))) != std::byte(0)) {
            if (!counts.take(group_of_count(groups, Beside(ldi, p)), more)) return fault_of_groups("counts");
            sum += uint64_t(more) + 1;
        }
        ldi.first[p + 1] = uint32_t(sum);
        if (sum > samples) break;
    }
    if (sum != samples) return {11, fmt::format("its pixels have {} samples or more, {} are stated", sum, samples)};
    for (size_t bit = ldi.first.size() - 1; bit < 8 * occupied.size(); ++bit)
        if ((occupied[bit / 8] & std::byte(1 << (bit % 8))) != std::byte(0)) return {11, "pixels beyond its last have samples"};
    return counts.is_done() ? ImageFault() : fault_of_groups("counts");
}

// Heights and colours of the pixels, one after the other.
class SampleReader {
  public:
    SampleReader(const GroupCounts& groups, GroupReader& heights, GroupReader& colours, uint32_t most, Ldi& ldi);
    ImageFault run();

  private:
    static constexpr int kNone = -65536;

    bool read(size_t pixel);  // false: fault_ says why
    template <class StepsTo, class NearestTo>
    bool read(size_t pixel, const Beside& beside, const StepsTo& steps_to, const NearestTo& nearest_to);
    bool fail(ImageFault fault) {
        fault_ = std::move(fault);
        return false;
    }
    uint32_t colour_group(int nearest, uint32_t height) const {
        uint32_t bands =
            uint32_t(height >= bands_from_[0]) + uint32_t(height >= bands_from_[1]) + uint32_t(height >= bands_from_[2]);
        return bands * groups_.colour_classes + classes_[size_t(nearest + 1)];
    }

    const GroupCounts& groups_;
    GroupReader &heights_, &colours_;
    Ldi& ldi_;
    ImageFault fault_;
    int before_ = 0;      // the lowest of the last pixel with samples
    bool is_at_the_top_;  // samples may be at 65,535 steps
    std::array<uint8_t, 257> classes_{};
    std::array<uint32_t, kMostBands - 1> bands_from_;  // heights from which a next band begins
};

SampleReader::SampleReader(const GroupCounts& groups, GroupReader& heights, GroupReader& colours, uint32_t most, Ldi& ldi)
    : groups_(groups), heights_(heights), colours_(colours), ldi_(ldi), is_at_the_top_(most == 65535) {
    for (int nearest = 0; nearest < 256 && !ldi.palette.empty(); ++nearest)
        classes_[size_t(nearest) + 1] = uint8_t(group_of_colour(groups, ldi, nearest, 0, most));
    for (uint32_t band = 1; band < kMostBands; ++band)
        bands_from_[band - 1] =
            band < groups.colour_bands ? (band * (most + 1) + groups.colour_bands - 1) / groups.colour_bands : ~0u;
}

// steps_to(below): as NextAbove. nearest_to(sample, below): as NearestColour, but kNone for the height below the lowest.
template <class StepsTo, class NearestTo>
bool SampleReader::read(size_t pixel, const Beside& beside, const StepsTo& steps_to, const NearestTo& nearest_to) {
    uint32_t s = ldi_.first[pixel], end = ldi_.first[pixel + 1];
    uint16_t code = 0;
    if (!heights_.take(kGroupOfLowest, code)) return fail(fault_of_groups("heights"));
    int below = kNone, height = before_ = uint16_t(lowest_told_from(ldi_, beside, before_) + unfolded(code));
    for (;;) {
        ldi_.heights[s] = uint16_t(height);
        int nearest = nearest_to(s, below);
        if (!colours_.take(colour_group(nearest, uint32_t(height)), ldi_.colours[s])) return fail(fault_of_groups("colours"));
        if (++s == end) return true;
        below = height;
        int steps = steps_to(below);
        if (!heights_.take(group_of_height(groups_, steps), code)) return fail(fault_of_groups("heights"));
        height += 1 + gap_of_code(code, steps);
        if (height > 65535) return fail({12, fmt::format("sample {} in pixel {} is at step {}", s, pixel, height)});
    }
}

bool SampleReader::read(size_t pixel) {
    Beside beside(ldi_, pixel);
    if (is_at_the_top_) {
        NextAbove next(ldi_, beside);
        NearestColour nearest(ldi_, beside);
        auto nearest_to = [&](uint32_t sample, int below) { return nearest.of(sample, below == kNone); };
        return read(
            pixel, beside, [&](int below) { return next.steps(below); }, nearest_to);
    }
    WindowsBeside windows(ldi_.heights.data(), beside);
    NearestColour far(ldi_, beside);  // of heights far off; looks through a column once, as these ascend
    auto nearest_to = [&](uint32_t sample, int below) {
        int height = ldi_.heights[sample], distance = 0;
        uint32_t found = windows.nearest(height, distance);
        if (distance == WindowsBeside::kFar) return far.of(sample, below == kNone);
        uint32_t is_below = -uint32_t(height - below < distance);
        return int(ldi_.colours[(found & ~is_below) | ((sample - 1) & is_below)]);
    };
    return read(
        pixel, beside, [&](int below) { return windows.steps(below); }, nearest_to);
}

ImageFault SampleReader::run() {
    for (size_t p = 0; p + 1 < ldi_.first.size(); ++p)
        if (ldi_.first[p] != ldi_.first[p + 1])
            if (!read(p)) return fault_;
    if (!heights_.is_done()) return fault_of_groups("heights");
    return colours_.is_done() ? ImageFault() : fault_of_groups("colours");
}

}  // namespace

ImageFault ldi_of_grouped(std::span<const std::byte> bytes, const ImageSet& set, uint32_t level, const Entry& entry, Ldi& ldi) {
    auto take = [&](size_t count) {
        auto taken = bytes.first(count);
        bytes = bytes.subspan(count);
        return taken;
    };
    size_t side = set.levels[level].side_px, pixels = side * side, samples = entry.sample_count;
    GroupCounts groups = group_counts_of(samples);
    ldi.side_px = uint32_t(side), ldi.unseen_share = entry.unseen_share;
    auto count_sizes = take(4 * groups.counts), height_sizes = take(4 * groups.heights),
         colour_sizes = take(4 * groups.colours());
    ldi.palette.resize(entry.colour_count);
    for (auto& colour : ldi.palette)
        for (uint8_t& channel : colour) channel = uint8_t(take(1)[0]);
    auto occupied = take((pixels + 7) / 8);

    ldi.first.resize(pixels + 1), ldi.heights.resize(samples + kLanes), ldi.colours.resize(samples);
    auto low = take(samples), high = take(samples);
    GroupReader counts, heights, colours;
    if (!counts.begin(count_sizes, samples, low, high)) return fault_of_groups("counts");
    if (ImageFault fault = read_counts(occupied, counts, groups, samples, ldi)) return fault;
    low = take(samples), high = take(samples);
    if (!heights.begin(height_sizes, samples, low, high)) return fault_of_groups("heights");
    if (!colours.begin(colour_sizes, samples, take(samples), {})) return fault_of_groups("colours");
    if (ImageFault fault = SampleReader(groups, heights, colours, highest_step(set, level), ldi).run()) return fault;
    ldi.heights.resize(samples);
    take_normals_and_splats(bytes, set, ldi);
    return fault_of_ldi(set, level, ldi);
}

}  // namespace overlook::wang_ldi
