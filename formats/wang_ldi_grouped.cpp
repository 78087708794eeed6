#include "formats/wang_ldi_grouped.h"

#include "formats/wang_ldi_groups.h"

namespace overlook::wang_ldi {
namespace {

using namespace groups;

// Numbers by group, in each in the order in which they come.
class GroupWriter {
  public:
    explicit GroupWriter(uint32_t groups) : groups_(groups) {}
    void add(uint32_t group, uint16_t value) { groups_[group].push_back(value); }
    void put_sizes(std::vector<std::byte>& bytes) const {
        for (const auto& group : groups_)
            for (int shift : {0, 8, 16, 24}) bytes.push_back(std::byte((group.size() >> shift) & 0xff));
    }
    // `count` bytes of them all, zeros behind the last.
    void put(size_t count, int shift, GroupedBytes& made) const {
        size_t begin = made.bytes.size();
        for (const auto& group : groups_) {
            for (uint16_t value : group) made.bytes.push_back(std::byte((value >> shift) & 0xff));
            if (!group.empty()) made.ends.push_back(made.bytes.size());
        }
        made.bytes.resize(begin + count);
        made.ends.push_back(made.bytes.size());
    }

  private:
    std::vector<std::vector<uint16_t>> groups_;
};

// The same, read: false where a group has no more.
class GroupReader {
  public:
    // sizes: of the groups, u32 each. Whether they are `count` together at most.
    bool begin(std::span<const std::byte> sizes, size_t count, std::span<const std::byte> low, std::span<const std::byte> high) {
        uint64_t sum = 0;
        for (size_t g = 0; 4 * g < sizes.size(); ++g) {
            at_.push_back(size_t(sum)), sum += load_le<uint32_t>(sizes, 4 * g);
            if (sum > count) return false;
            ends_.push_back(size_t(sum));
        }
        low_ = low, high_ = high;
        return true;
    }
    bool take(uint32_t group, uint16_t& value) {
        size_t& at = at_[group];
        if (at == ends_[group]) return false;
        value = uint16_t(uint16_t(low_[at]) | (high_.empty() ? 0 : uint16_t(high_[at]) << 8));
        ++at;
        return true;
    }
    // All are taken, and nothing stands behind them.
    bool is_done() const {
        auto is_zero = [](std::byte byte) { return byte == std::byte(0); };
        size_t used = ends_.back();
        return at_ == taken() && std::all_of(low_.begin() + long(used), low_.end(), is_zero) &&
               std::all_of(high_.begin() + long(std::min(used, high_.size())), high_.end(), is_zero);
    }

  private:
    const std::vector<size_t>& taken() const { return ends_; }
    std::vector<size_t> at_, ends_;
    std::span<const std::byte> low_, high_;
};

void add_counts(const Ldi& ldi, const GroupCounts& groups, GroupWriter& counts, std::vector<std::byte>& occupied) {
    size_t pixels = ldi.first.size() - 1;
    occupied.resize((pixels + 7) / 8);
    for (size_t p = 0; p < pixels; ++p) {
        uint32_t count = ldi.first[p + 1] - ldi.first[p];
        if (count == 0) continue;
        occupied[p / 8] |= std::byte(1 << (p % 8));
        counts.add(group_of_count(groups, Beside(ldi, p)), uint16_t(count - 1));
    }
}

void add_heights(const Ldi& ldi, const GroupCounts& groups, GroupWriter& heights) {
    int before = 0;
    for (size_t p = 0; p + 1 < ldi.first.size(); ++p) {
        if (ldi.first[p] == ldi.first[p + 1]) continue;
        Beside beside(ldi, p);
        int lowest = ldi.heights[ldi.first[p]];
        heights.add(kGroupOfLowest, folded(lowest - lowest_told_from(ldi, beside, before)));
        before = lowest;
        NextAbove next(ldi, beside);
        for (uint32_t s = ldi.first[p] + 1; s < ldi.first[p + 1]; ++s) {
            int below = ldi.heights[s - 1], steps = next.steps(below), gap = ldi.heights[s] - below - 1;
            heights.add(group_of_height(groups, steps), code_of_gap(gap, steps));
        }
    }
}

void add_colours(const Ldi& ldi, const GroupCounts& groups, uint32_t most, GroupWriter& colours) {
    for (size_t p = 0; p + 1 < ldi.first.size(); ++p) {
        NearestColour nearest(ldi, Beside(ldi, p));
        for (uint32_t s = ldi.first[p]; s < ldi.first[p + 1]; ++s) {
            int colour = nearest.of(s, s == ldi.first[p]);
            colours.add(group_of_colour(groups, ldi, colour, ldi.heights[s], most), ldi.colours[s]);
        }
    }
}

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

ImageFault read_heights(GroupReader& heights, const GroupCounts& groups, Ldi& ldi) {
    int before = 0;
    for (size_t p = 0; p + 1 < ldi.first.size(); ++p) {
        uint32_t begin = ldi.first[p], end = ldi.first[p + 1];
        if (begin == end) continue;
        Beside beside(ldi, p);
        uint16_t code = 0;
        if (!heights.take(kGroupOfLowest, code)) return fault_of_groups("heights");
        ldi.heights[begin] = uint16_t(lowest_told_from(ldi, beside, before) + unfolded(code));
        before = ldi.heights[begin];
        NextAbove next(ldi, beside);
        for (uint32_t s = begin + 1; s < end; ++s) {
            int below = ldi.heights[s - 1], steps = next.steps(below);
            if (!heights.take(group_of_height(groups, steps), code)) return fault_of_groups("heights");
            int height = below + 1 + gap_of_code(code, steps);
            if (height > 65535) return {12, fmt::format("sample {} in pixel {} is at step {}", s, p, height)};
            ldi.heights[s] = uint16_t(height);
        }
    }
    return heights.is_done() ? ImageFault() : fault_of_groups("heights");
}

ImageFault read_colours(GroupReader& colours, const GroupCounts& groups, uint32_t most, Ldi& ldi) {
    for (size_t p = 0; p + 1 < ldi.first.size(); ++p) {
        NearestColour nearest(ldi, Beside(ldi, p));
        for (uint32_t s = ldi.first[p]; s < ldi.first[p + 1]; ++s) {
            int colour = nearest.of(s, s == ldi.first[p]);
            uint16_t value = 0;
            if (!colours.take(group_of_colour(groups, ldi, colour, ldi.heights[s], most), value))
                return fault_of_groups("colours");
            ldi.colours[s] = uint8_t(value);
        }
    }
    return colours.is_done() ? ImageFault() : fault_of_groups("colours");
}

}  // namespace

GroupCounts group_counts_of(uint64_t samples) {
    constexpr uint64_t kFew = 1 << 11, kMany = 1 << 15;
    if (samples < kFew) return {1, 2, 1, 1};
    if (samples < kMany) return {4, 10, 4, 2};
    return {8, 12, 8, 4};
}

GroupedBytes grouped_bytes_of(const ImageSet& set, uint32_t level, const Ldi& ldi) {
    size_t samples = ldi.heights.size();
    GroupCounts groups = group_counts_of(samples);
    GroupWriter counts(groups.counts), heights(groups.heights), colours(groups.colours());
    std::vector<std::byte> occupied;
    add_counts(ldi, groups, counts, occupied), add_heights(ldi, groups, heights);
    add_colours(ldi, groups, highest_step(set, level), colours);

    GroupedBytes made;
    made.bytes.reserve(raw_bytes_of(set, ldi.side_px, samples, ldi.palette.size()));
    for (const GroupWriter* of : {&counts, &heights, &colours}) of->put_sizes(made.bytes);
    for (const auto& colour : ldi.palette)
        for (uint8_t channel : colour) made.bytes.push_back(std::byte(channel));
    made.ends.push_back(made.bytes.size());
    made.bytes.insert(made.bytes.end(), occupied.begin(), occupied.end());
    made.ends.push_back(made.bytes.size());
    for (const GroupWriter* of : {&counts, &heights})
        for (int shift : {0, 8}) of->put(samples, shift, made);
    colours.put(samples, 0, made);
    put_normals_and_splats(ldi, made.bytes);
    return made;
}

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

    ldi.first.resize(pixels + 1), ldi.heights.resize(samples), ldi.colours.resize(samples);
    auto low = take(samples), high = take(samples);
    GroupReader counts, heights, colours;
    if (!counts.begin(count_sizes, samples, low, high)) return fault_of_groups("counts");
    if (ImageFault fault = read_counts(occupied, counts, groups, samples, ldi)) return fault;
    low = take(samples), high = take(samples);
    if (!heights.begin(height_sizes, samples, low, high)) return fault_of_groups("heights");
    if (ImageFault fault = read_heights(heights, groups, ldi)) return fault;
    if (!colours.begin(colour_sizes, samples, take(samples), {})) return fault_of_groups("colours");
    if (ImageFault fault = read_colours(colours, groups, highest_step(set, level), ldi)) return fault;
    take_normals_and_splats(bytes, set, ldi);
    return fault_of_ldi(set, level, ldi);
}

}  // namespace overlook::wang_ldi
