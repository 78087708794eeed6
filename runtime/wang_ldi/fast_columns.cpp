#include "runtime/wang_ldi/fast_columns.h"

#include <algorithm>

namespace overlook::wang_ldi {
namespace {

constexpr uint32_t kKept = 1024;   // samples are brought to the picture when there are so many, if more come
constexpr uint32_t kAtOnce = 256;  // and painted, so many that are beside each other

template <Hiding hiding>
inline void put(int64_t& pixel, int64_t key) {
    pixel = hiding == Hiding::by_order ? key : std::min(pixel, key);
}
template <Hiding hiding>
inline void put_square(int64_t* pixel, ptrdiff_t stride, int side, int64_t key) {
    for (int y = 0; y < side; ++y, pixel += stride)
        for (int x = 0; x < side; ++x) put<hiding>(pixel[x], key);
}

void copy(const glm::vec3& from, float (&to)[3]) {
    for (int k = 0; k < 3; ++k) to[k] = from[k];
}

}  // namespace

template <Hiding hiding>
FastColumns<hiding>::FastColumns(const Eye& eye, const ImageSet& set, const PreparedLdi& ldi, uint32_t level,
                                 const SplatRule& rule, const glm::dvec2& south_west_m, FastTools& tools)
    : eye_(eye), ldi_(ldi), tools_(tools), frame_(eye, set, set.levels[level], !ldi.splats.empty(), rule, south_west_m) {
    side_px = ldi.side_px;
    eye_column_ = cell_at((eye.position_m.x - south_west_m.x) / set.tile_m, side_px);
    const Canvas& canvas = *tools.canvas;
    on_plane_ = {};
    copy(frame_.up, on_plane_.up);
    on_plane_.pixel_m = frame_.pixel_m, on_plane_.step_m = frame_.step_m, on_plane_.near_m = eye.near_m;
    on_plane_.middle_px[0] = eye.middle_px.x, on_plane_.middle_px[1] = eye.middle_px.y;
    on_plane_.width_px = int32_t(canvas.width_px()), on_plane_.height_px = int32_t(canvas.height_px());
    on_plane_.most_side = eye.most_splat_px;
    on_plane_.stride = canvas.stride(), on_plane_.origin = canvas.origin(), on_plane_.nowhere = 0;
}

template <Hiding hiding>
void FastColumns<hiding>::stand_on(const Plane& plane) {
    frame_.stand_on(eye_, plane);
    copy(frame_.corner, on_plane_.corner), copy(frame_.east, on_plane_.east), copy(frame_.north, on_plane_.north);
    on_plane_.splat = frame_.splat;
}

template <Hiding hiding>
bool FastColumns<hiding>::may_show(uint32_t row, const Span& columns) const {
    const uint32_t* first = first_of_row(row);
    if (first[columns.from] == first[columns.to]) return false;
    return is_inside || may_be_seen(row, columns, frame_.corner + frame_.middle_m(row) * frame_.north);
}

template <Hiding hiding>
void FastColumns<hiding>::draw_row(uint32_t row, const Span& columns, const uint32_t* shown) {
    const uint32_t* first = first_of_row(row);
    make_room(first[columns.to] - first[columns.from]);
    shown == nullptr ? add_all(row, columns) : add_shown(row, columns, shown);
    if (hiding == Hiding::by_depth) {
        if (tools_.count >= kKept) finish();
        return;
    }
    ProjectedCounts counts = project(kept(0, tools_.count));
    if (counts.drawn > 0) paint_towards(row, columns);
    tools_.count = 0;
}

template <Hiding hiding>
void FastColumns<hiding>::finish() {
    for (uint32_t from = 0; from < tools_.count; from += kAtOnce) {
        SamplesOfRows samples = kept(from, kAtOnce);
        ProjectedCounts counts = project(samples);
        if (counts.drawn > 0) paint(samples, counts);
    }
    tools_.count = 0;
}

template <Hiding hiding>
void FastColumns<hiding>::make_room(size_t more) {
    size_t size = tools_.count + more + size_t(2) * PreparedLdi::kPadding;
    if (tools_.places.size() >= size) return;
    tools_.places.resize(size), tools_.rows.resize(size), tools_.colours.resize(size), tools_.splats.resize(size);
    tools_.pixels.resize(size), tools_.sides.resize(size), tools_.depths_m.resize(size);
}

template <Hiding hiding>
void FastColumns<hiding>::add_all(uint32_t row, const Span& columns) {
    uint32_t from = first_of_row(row)[columns.from], count = first_of_row(row)[columns.to] - from;
    std::copy_n(ldi_.places.data() + from, count, tools_.places.data() + tools_.count);
    std::copy_n(ldi_.colours.data() + from, count, tools_.colours.data() + tools_.count);
    if (!ldi_.splats.empty()) std::copy_n(ldi_.splats.data() + from, count, tools_.splats.data() + tools_.count);
    std::fill_n(tools_.rows.data() + tools_.count, count, uint16_t(row));
    tools_.count += count;
}

// Without a branch: every sample is copied, and stays if its column is shown.
template <Hiding hiding>
void FastColumns<hiding>::add_shown(uint32_t row, const Span& columns, const uint32_t* shown) {
    uint32_t begin = first_of_row(row)[columns.from], end = first_of_row(row)[columns.to];
    const uint32_t* from = ldi_.places.data();
    const uint8_t *colours = ldi_.colours.data(), *splats = ldi_.splats.data();
    uint32_t* places = tools_.places.data();
    uint8_t *kept_colours = tools_.colours.data(), *kept_splats = tools_.splats.data();
    uint32_t count = tools_.count;
    if (ldi_.splats.empty()) {
        for (uint32_t s = begin; s < end; ++s) {
            places[count] = from[s], kept_colours[count] = colours[s];
            count += shown[from[s] & 0xffffu] & 1u;
        }
    } else {
        for (uint32_t s = begin; s < end; ++s) {
            places[count] = from[s], kept_colours[count] = colours[s], kept_splats[count] = splats[s];
            count += shown[from[s] & 0xffffu] & 1u;
        }
    }
    std::fill_n(tools_.rows.data() + tools_.count, count - tools_.count, uint16_t(row));
    tools_.count = count;
}

template <Hiding hiding>
SamplesOfRows FastColumns<hiding>::kept(uint32_t from, uint32_t most) const {
    const uint8_t* splats = ldi_.splats.empty() ? nullptr : tools_.splats.data() + from;
    return {tools_.places.data() + from, tools_.rows.data() + from, tools_.colours.data() + from, splats,
            std::min(most, tools_.count - from)};
}

template <Hiding hiding>
ProjectedCounts FastColumns<hiding>::project(const SamplesOfRows& samples) {
    ProjectedCounts counts;
    tools_.project(on_plane_, samples, {tools_.pixels.data(), tools_.sides.data(), tools_.depths_m.data()}, counts);
    tools_.counts.samples += samples.count, tools_.counts.samples_drawn += counts.drawn;
    tools_.counts.pixels_written += counts.pixels;
    return counts;
}

// A row's samples lie in a rectangle that stands up: not if its corners are all behind one of the picture's sides.
template <Hiding hiding>
bool FastColumns<hiding>::may_be_seen(uint32_t row, const Span& columns, const glm::vec3& foot) const {
    float wide = frame_.splat * (ldi_.splats.empty() ? 1.0f : 255.0f);
    glm::vec2 half_px = eye_.middle_px + 2.0f;
    bool is_left = true, is_right = true, is_above = true, is_below = true, is_near = true;
    for (uint32_t corner = 0; corner < 4; ++corner) {
        float x = frame_.middle_m(corner & 1 ? columns.to : columns.from) - 0.5f * frame_.pixel_m;
        float z = float(corner & 2 ? ldi_.highest[row] : ldi_.lowest[row]) * frame_.step_m;
        glm::vec3 seen = (foot + x * frame_.east) + z * frame_.up;
        glm::vec2 side = half_px * seen.z + wide / 2;
        is_left &= seen.x<-side.x, is_right &= seen.x> side.x;
        is_below &= seen.y<-side.y, is_above &= seen.y> side.y;
        is_near &= seen.z < 0.99f * eye_.near_m;
    }
    return !(is_left || is_right || is_above || is_below || is_near);
}

template <Hiding hiding>
void FastColumns<hiding>::paint(const SamplesOfRows& samples, const ProjectedCounts& counts) {
    if (counts.least_side != counts.most_side || counts.most_side > 4) return paint_uneven(samples);
    switch (counts.most_side) {
        case 1:
            return paint_even<1>(samples);
        case 2:
            return paint_even<2>(samples);
        case 3:
            return paint_even<3>(samples);
        default:
            return paint_even<4>(samples);
    }
}

// Splats of one size; those that are not drawn are painted where nothing is seen.
template <Hiding hiding>
template <int side>
void FastColumns<hiding>::paint_even(const SamplesOfRows& samples) {
    int64_t* keys = tools_.canvas->keys();
    ptrdiff_t stride = on_plane_.stride;
    const uint32_t* palette = ldi_.palette.data();
    for (uint32_t k = 0; k < samples.count; ++k) {
        int64_t key = pixel_key(tools_.depths_m[k], palette[samples.colours[k]]);
        put_square<hiding>(keys + tools_.pixels[k], stride, side, key);
    }
}

template <Hiding hiding>
void FastColumns<hiding>::paint_uneven(const SamplesOfRows& samples) {
    for (uint32_t k = 0; k < samples.count; ++k) paint_one(k, samples.colours[k]);
}

template <Hiding hiding>
inline void FastColumns<hiding>::paint_one(uint32_t projected, uint8_t colour) {
    int64_t key = pixel_key(tools_.depths_m[projected], ldi_.palette[colour]);
    int64_t* pixel = tools_.canvas->keys() + tools_.pixels[projected];
    ptrdiff_t stride = on_plane_.stride;
    switch (int side = tools_.sides[projected]; side) {
        case 1:
            return put_square<hiding>(pixel, stride, 1, key);
        case 2:
            return put_square<hiding>(pixel, stride, 2, key);
        case 3:
            return put_square<hiding>(pixel, stride, 3, key);
        default:
            return put_square<hiding>(pixel, stride, side, key);
    }
}

// All columns of a row that were brought to the picture, towards the eye.
template <Hiding hiding>
void FastColumns<hiding>::paint_towards(uint32_t row, const Span& columns) {
    uint32_t begin = ldi_.first[size_t(row) * side_px + columns.from];
    for (uint32_t i = 0; i < columns.to - columns.from; ++i) paint_column(towards(i, eye_column_, columns), row, begin);
}

template <Hiding hiding>
inline void FastColumns<hiding>::paint_column(uint32_t column, uint32_t row, uint32_t begin) {
    size_t pixel = size_t(row) * side_px + column;
    uint32_t first = ldi_.first[pixel], end = ldi_.first[pixel + 1];
    if (first == end) return;
    double eye_steps = frame_.eye_steps(column, row);
    uint32_t below = end;
    while (below > first && !(double(ldi_.places[below - 1] >> 16) < eye_steps)) --below;
    for (uint32_t s = first; s < below; ++s) paint_one(s - begin, ldi_.colours[s]);
    for (uint32_t s = end; s > below; --s) paint_one(s - 1 - begin, ldi_.colours[s - 1]);
}

template class FastColumns<Hiding::by_order>;
template class FastColumns<Hiding::by_depth>;

}  // namespace overlook::wang_ldi
