#include "runtime/terrain/refine_parts.h"

#include <algorithm>
#include <cmath>

#include "formats/parallel.h"

namespace overlook::terrain {

void start(Cut::Part& part) {
    part.indices.clear(), part.morphs.clear(), part.codes.clear();
    part.void_rim_triangle_count = part.tested_count = part.stopped_count = 0;
    part.predicted_squared = 0;
}

namespace {

// Where each part's share begins in the whole.
struct Begins {
    std::vector<size_t> indices{0}, morphs{0};
};

}  // namespace

void join(size_t part_count, size_t sample_count, Cut& out) {
    Begins begins;
    out.void_rim_triangle_count = out.tested_count = out.stopped_count = 0;
    double predicted_squared = 0;
    for (size_t i = 0; i < part_count; ++i) {
        const Cut::Part& part = out.parts[i];
        begins.indices.push_back(begins.indices.back() + part.indices.size());
        begins.morphs.push_back(begins.morphs.back() + part.morphs.size());
        out.void_rim_triangle_count += part.void_rim_triangle_count;
        out.tested_count += part.tested_count;
        out.stopped_count += part.stopped_count;
        predicted_squared = std::max(predicted_squared, part.predicted_squared);
    }
    out.predicted_error_px = std::sqrt(predicted_squared);
    out.indices.resize(begins.indices.back());
    out.morphs.resize(begins.morphs.back());
    out.codes.resize(out.wants_codes ? begins.indices.back() / 3 : 0);
    parallel_ranges(part_count, 16, [&](size_t first, size_t end) {
        for (size_t i = first; i < end; ++i) {
            const Cut::Part& part = out.parts[i];
            uint32_t* index = out.indices.data() + begins.indices[i];
            uint32_t morph_base = uint32_t(sample_count + begins.morphs[i]);
            for (uint32_t local : part.indices)
                *index++ = (local & Cut::kMorphBit) != 0 ? morph_base + (local & ~Cut::kMorphBit) : local;
            std::copy(part.morphs.begin(), part.morphs.end(), out.morphs.begin() + ptrdiff_t(begins.morphs[i]));
            std::copy(part.codes.begin(), part.codes.end(), out.codes.begin() + ptrdiff_t(begins.indices[i] / 3));
        }
    });
}

}  // namespace overlook::terrain
