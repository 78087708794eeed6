#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "formats/container.h"
#include "formats/terrain.h"
#include "tools/baked/verbs.h"

namespace overlook::baked {
namespace {

using nlohmann::ordered_json;

bool have_same_bytes(const container::Reader& a, const container::Section& in_a, const container::Reader& b,
                     const container::Section& in_b) {
    auto bytes_a = a.stored(in_a), bytes_b = b.stored(in_b);
    return in_a.flags == in_b.flags && in_a.codec == in_b.codec && in_a.raw_bytes == in_b.raw_bytes &&
           std::equal(bytes_a.begin(), bytes_a.end(), bytes_b.begin(), bytes_b.end());
}

// One line a section that is not the same in both.
std::vector<std::string> section_differences(const container::Reader& a, const container::Reader& b) {
    std::vector<std::string> lines;
    for (const container::Section& section : a.sections()) {
        const container::Section* other = b.find(section.tag);
        std::string tag = container::tag_text(section.tag);
        if (other == nullptr)
            lines.push_back(fmt::format("section {} is in the first only", tag));
        else if (!have_same_bytes(a, section, b, *other))
            lines.push_back(fmt::format("section {} differs: {} and {} bytes", tag, section.stored_bytes, other->stored_bytes));
    }
    for (const container::Section& section : b.sections())
        if (a.find(section.tag) == nullptr)
            lines.push_back(fmt::format("section {} is in the second only", container::tag_text(section.tag)));
    return lines;
}

// What the differing bytes mean, where both are terrains of one size.
void terrain_differences(const terrain::Terrain& a, const terrain::Terrain& b, std::vector<std::string>& lines) {
    if (a.shape.width != b.shape.width || a.shape.height != b.shape.height) {
        lines.push_back(fmt::format("{} x {} samples and {} x {}", a.shape.width, a.shape.height, b.shape.width, b.shape.height));
        return;
    }
    uint64_t voids = 0, heights = 0, codes = 0;
    double greatest_m = 0;
    for (uint32_t row = 0; row < a.shape.height; ++row)
        for (uint32_t column = 0; column < a.shape.width; ++column) {
            bool a_is_void = a.is_void(column, row), b_is_void = b.is_void(column, row);
            voids += a_is_void != b_is_void;
            if (a_is_void || b_is_void) continue;
            double difference_m = std::abs(a.height_m(column, row) - b.height_m(column, row));
            heights += difference_m != 0;
            greatest_m = std::max(greatest_m, difference_m);
        }
    for (size_t level = 0; level < a.codes.size(); ++level)
        for (size_t i = 0; i < a.codes[level].size(); ++i) codes += a.error_m[a.codes[level][i]] != b.error_m[b.codes[level][i]];
    if (voids > 0) lines.push_back(fmt::format("{} samples are void in one only", voids));
    if (heights > 0) lines.push_back(fmt::format("{} heights differ, by {:.6g} m at the most", heights, greatest_m));
    if (codes > 0) lines.push_back(fmt::format("{} stored errors differ", codes));
}

}  // namespace

int diff(const DiffArgs& args, const command::Common& common) {
    const char* name = "baked diff";
    auto a = container::Reader::open(args.a);
    if (!a) return command::fail(name, a.error());
    auto b = container::Reader::open(args.b);
    if (!b) return command::fail(name, b.error());

    std::vector<std::string> lines;
    if (a->kind() != b->kind())
        lines.push_back(fmt::format("kinds {} and {}", container::tag_text(a->kind()), container::tag_text(b->kind())));
    for (std::string& line : section_differences(*a, *b)) lines.push_back(std::move(line));
    if (!lines.empty() && a->kind() == terrain::kKind && b->kind() == terrain::kKind) {
        auto terrain_a = terrain::read(*a);
        if (!terrain_a) return command::fail(name, terrain_a.error());
        auto terrain_b = terrain::read(*b);
        if (!terrain_b) return command::fail(name, terrain_b.error());
        terrain_differences(*terrain_a, *terrain_b, lines);
    }
    if (common.json) {
        fmt::print("{}\n", ordered_json{{"same", lines.empty()}, {"differences", lines}}.dump(2));
    } else {
        for (const std::string& line : lines) fmt::print("{}\n", line);
        fmt::print("{}\n", lines.empty() ? "the same" : "different");
    }
    return int(lines.empty() ? Exit::done : Exit::answer_is_no);
}

}  // namespace overlook::baked
