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

}  // namespace

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

}  // namespace overlook::wang_ldi
