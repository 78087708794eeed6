#include "tools/measure/paper/fsi/pictures.h"

#include <algorithm>
#include <cmath>

#include "runtime/discrete/poses.h"
#include "runtime/discrete/visibility.h"
#include "tools/measure/paper/fsi/easel.h"

namespace overlook::measure::paper::fsi {
namespace {

using discrete::Placement;

constexpr uint32_t kCell_px = 288;
constexpr double kFills = 0.85;  // of a picture's height, by a thing

const discrete::Chain& printed_chain(const Subject& subject) {
    return *things_of(subject.by_hand ? *subject.by_hand : subject.world).chain;
}
std::string levels_of(const Subject& subject) {
    return title_of(subject.name) + (subject.by_hand ? ", levels by hand" : "");
}

// One thing half-way by the paper's form: its two buffers and what it makes of them, below in true colours, above in false ones.
Result<std::vector<std::vector<ImageRgb8>>> buffers_of(Easel& easel, const Midway& at) {
    std::vector<std::vector<ImageRgb8>> rows(2);
    std::vector<ImageRgb8> masks;
    for (Paint paint : {Paint::false_colours, Paint::true_colours, Paint::mask}) {
        for (const discrete::FrameList* list : {&at.older, &at.newer}) {
            Result<ImageRgb8> picture = easel.paint(*list, at.placements, at.camera, 0, paint);
            if (!picture) return tl::unexpected(picture.error());
            (paint == Paint::mask ? masks : rows[paint == Paint::true_colours]).push_back(std::move(*picture));
        }
    }
    rows[0].push_back(put_together(rows[0][0], masks[0], rows[0][1], masks[1]));
    rows[1].push_back(at.picture);
    return rows;
}

Result<Picture> figure_1(const Subject& subject) {
    auto easel = Easel::make(printed_chain(subject), kCell_px, kCell_px);
    if (!easel) return tl::unexpected(easel.error());
    Placement one;
    view::Camera camera = (*easel)->camera_at(one, kFills);
    auto at = midway(**easel, discrete::Variant::fsi_paper, 0, 1.001 * away_m(**easel, camera, one), {&one, 1}, camera, 0.375);
    if (!at) return tl::unexpected(at.error());
    auto rows = buffers_of(**easel, *at);
    if (!rows) return tl::unexpected(rows.error());
    return Picture{1, "figure-1",
                   levels_of(subject) +
                       ": the buffers of two frames, and what fsi:paper makes of them, three eighths on the way from "
                       "level 1 to level 0. Above: level 0 red, level 1 blue.",
                   montage(*rows)};
}

Result<Picture> figure_2(const Subject& subject) {
    auto easel = Easel::make(printed_chain(subject), kCell_px / 2, kCell_px / 2);
    if (!easel) return tl::unexpected(easel.error());
    Placement one;
    view::Camera camera = (*easel)->camera_at(one, kFills);
    std::vector<std::vector<ImageRgb8>> rows(2);
    for (double phase : {0.125, 0.25, 0.5, 0.75, 0.875}) {
        auto at =
            midway(**easel, discrete::Variant::fsi_paper, 0, 1.001 * away_m(**easel, camera, one), {&one, 1}, camera, phase);
        if (!at) return tl::unexpected(at.error());
        auto buffers = buffers_of(**easel, *at);
        if (!buffers) return tl::unexpected(buffers.error());
        rows[0].push_back((*buffers)[1][2]);
        rows[1].push_back((*buffers)[0][2]);
    }
    return Picture{2, "figure-2-levels",
                   levels_of(subject) +
                       ": an eighth, a quarter, half, three quarters and seven eighths on the way. Below: level 0 "
                       "red, level 1 blue; where both are, their mean.",
                   montage(rows)};
}

// Things one behind the other and beside one another, some of which are at the distance where levels change.
std::vector<Placement> crowd(const discrete::Chain& chain, double apart) {
    std::vector<Placement> all;
    for (int row = 0; row < 5; ++row)
        for (int column = -2; column <= 2; ++column) {
            if (row == 0 && column != 0) continue;
            Placement one;
            one.translation_m = apart * chain.radius_m * glm::dvec3(column + 0.25 * (row % 2), row, 0);
            all.push_back(one);
        }
    return all;
}

Result<Picture> figure_3(const Subject& subject) {
    auto easel = Easel::make(printed_chain(subject), kCell_px + 96, kCell_px);
    if (!easel) return tl::unexpected(easel.error());
    std::vector<Placement> all = crowd((*easel)->chain(), 3.2);
    view::Camera camera = (*easel)->camera_at(all.front(), 0.35);
    camera.position_m.z += 4 * (*easel)->chain().radius_m;
    camera.pitch_deg = -20;
    // The second row's middle three: nearer than all others but the first.
    std::vector<double> distances;
    for (const Placement& one : all) distances.push_back(away_m(**easel, camera, one));
    std::sort(distances.begin(), distances.end());
    auto at = midway(**easel, discrete::Variant::fsi_paper, 0, 0.5 * (distances[2] + distances[3]), all, camera, 0.5);
    if (!at) return tl::unexpected(at.error());
    for (discrete::FrameList* list : {&at->older, &at->newer})
        for (discrete::Item& item : list->items) item.change = 0;
    std::vector<std::vector<ImageRgb8>> rows(1);
    for (const discrete::FrameList* list : {&at->older, &at->newer}) {
        Result<ImageRgb8> picture = (*easel)->paint(*list, all, camera, 0, Paint::true_colours);
        if (!picture) return tl::unexpected(picture.error());
        rows[0].push_back(std::move(*picture));
    }
    rows[0].push_back(at->picture);
    return Picture{3, "figure-3",
                   fmt::format("{}: the buffers of two frames differ in the {} things that change; right: put together.",
                               levels_of(subject), at->newer.fading.size()),
                   montage(rows)};
}

// How many translucent levels are mixed into each pixel of a blended frame, as shades; the greatest number.
Result<ImageRgb8> layers_of(Easel& easel, const Midway& at, uint32_t& most) {
    std::vector<uint32_t> counts(size_t(easel.target().width_px()) * easel.target().height_px());
    ImageRgb8 shades;
    for (const discrete::Item& item : at.newer.translucent) {
        discrete::FrameList one = at.newer;
        one.translucent = {item};
        Result<ImageRgb8> mask = easel.paint(one, at.placements, at.camera, 0, Paint::translucent);
        if (!mask) return mask;
        shades = std::move(*mask);
        for (size_t i = 0; i < counts.size(); ++i) counts[i] += shades.pixels[3 * i] >= 128;
    }
    most = counts.empty() ? 0 : *std::max_element(counts.begin(), counts.end());
    for (size_t i = 0; i < counts.size() && !shades.pixels.empty(); ++i)
        for (size_t k = 0; k < 3; ++k) shades.pixels[3 * i + k] = uint8_t(255 - 200 * counts[i] / std::max(1u, most));
    return shades;
}

Result<Picture> figure_4(const Subject& subject) {
    auto easel = Easel::make(printed_chain(subject), kCell_px + 96, kCell_px);
    if (!easel) return tl::unexpected(easel.error());
    std::vector<Placement> row;
    for (int i = 0; i < 4; ++i) {
        row.emplace_back().translation_m = (*easel)->chain().radius_m * glm::dvec3(0.5 * i - 0.75, 1.5 * i, 0);
    }
    view::Camera camera = (*easel)->camera_at(row.front(), 0.6);
    double farthest_m = away_m(**easel, camera, row.back());
    // Chosen so far away that all four change, whose distances differ, at once.
    Midway at{{}, {}, row, camera, {}};
    discrete::FrameOptions options = discrete::defaults_of(discrete::Variant::blend);
    options.select.criterion = discrete::Criterion::distance;
    options.select.distance_m = 0.5 * away_m(**easel, camera, row.front());
    auto frames = discrete::FrameDrawer::make((*easel)->drawing(), row, options);
    if (!frames) return tl::unexpected(frames.error());
    (*frames)->decide(camera, 0, 0);
    options.select.distance_m = 2 * farthest_m;
    if (Result<void> changed = (*frames)->change(options); !changed) return tl::unexpected(changed.error());
    for (int i = 0; i < 5; ++i) (*frames)->decide(camera, 0.05 * options.fade_s, 0);
    if (Result<discrete::FrameCounts> drawn = (*frames)->draw((*easel)->target(), {}); !drawn)
        return tl::unexpected(drawn.error());
    at.picture = (*easel)->target().read();
    at.newer = (*frames)->director().frame();
    uint32_t most = 0;
    Result<ImageRgb8> layers = layers_of(**easel, at, most);
    if (!layers) return tl::unexpected(layers.error());
    return Picture{
        4, "figure-4",
        fmt::format("{}: four things that change, by blend; right: how many translucent levels are mixed into a pixel, {} "
                    "at most. A buffer holds one.",
                    levels_of(subject), most),
        montage({{at.picture, *layers}})};
}

// Whole at one level, or as much of it as is visible.
discrete::FrameList list_of(const discrete::Chain& chain, uint32_t level, double share) {
    discrete::FrameList list;
    list.items = {{0, level, discrete::Show::visible, share, std::min(level, uint32_t(chain.levels.size()) - 2), 1}};
    return list;
}

Result<Picture> figure_5(const Subject& subject) {
    discrete::Chain chain = *things_of(subject.world).chain;
    discrete::Visibility board{discrete::Visibility::Lookup::paper, 2, 2, 1, float(0.3 * chain.radius_m), {0, 255, 255, 0}};
    chain.visibility = {board};
    auto easel = Easel::make(chain, kCell_px, kCell_px);
    if (!easel) return tl::unexpected(easel.error());
    Placement one;
    view::Camera camera = (*easel)->camera_at(one, kFills);
    std::vector<std::vector<ImageRgb8>> rows(2);
    for (double turned : {0.0, 0.05, 0.1})
        for (Paint paint : {Paint::true_colours, Paint::turned}) {
            auto picture = (*easel)->paint(list_of(chain, 0, 0.5), {&one, 1}, camera, turned * chain.clip_s, paint);
            if (!picture) return tl::unexpected(picture.error());
            rows[paint == Paint::turned].push_back(std::move(*picture));
        }
    return Picture{5, "figure-5",
                   title_of(subject.name) +
                       ": a checkerboard as visibility, half of it visible, while the thing turns. Above: looked "
                       "up where a place rests; below: where the animation has moved it.",
                   montage(rows)};
}

ImageRgb8 texture_picture(const discrete::Visibility& visibility, uint32_t side_px) {
    ImageRgb8 picture{side_px, side_px, std::vector<uint8_t>(size_t(3) * side_px * side_px)};
    for (uint32_t y = 0; y < side_px; ++y)
        for (uint32_t x = 0; x < side_px; ++x) {
            size_t from = size_t(y * visibility.height / side_px) * visibility.width + x * visibility.width / side_px;
            for (size_t k = 0; k < 3; ++k) picture.pixels[3 * (size_t(y) * side_px + x) + k] = visibility.values[from];
        }
    return picture;
}

Result<Picture> figure_6(const std::vector<Subject>& subjects) {
    std::vector<std::vector<ImageRgb8>> rows(1);
    std::string names;
    for (const Subject& subject : subjects) {
        discrete::Chain chain = printed_chain(subject);
        chain.visibility = {discrete::uniform_noise(chain.radius_m)};
        if (rows[0].empty()) rows[0].push_back(texture_picture(chain.visibility.front(), kCell_px));
        auto easel = Easel::make(chain, kCell_px, kCell_px);
        if (!easel) return tl::unexpected(easel.error());
        Placement one;
        auto picture =
            (*easel)->paint(list_of(chain, 0, 0.5), {&one, 1}, (*easel)->camera_at(one, kFills), 0, Paint::true_colours);
        if (!picture) return tl::unexpected(picture.error());
        rows[0].push_back(std::move(*picture));
        names += (names.empty() ? "" : ", ") + title_of(subject.name);
    }
    return Picture{6, "figure-6", "64 x 64 values of uniform noise as visibility (left), half of them visible: " + names + ".",
                   montage(rows)};
}

Result<Picture> figure_7(const Subject& subject) {
    std::vector<std::vector<ImageRgb8>> rows(1);
    auto add = [&](const discrete::Chain& chain, discrete::Variant variant) -> Result<void> {
        auto easel = Easel::make(chain, kCell_px, kCell_px);
        if (!easel) return tl::unexpected(easel.error());
        Placement one;
        view::Camera camera = (*easel)->camera_at(one, kFills);
        auto at = midway(**easel, variant, 0, 1.001 * away_m(**easel, camera, one), {&one, 1}, camera, 0.3);
        if (!at) return tl::unexpected(at.error());
        rows[0].push_back(std::move(at->picture));
        return {};
    };
    const discrete::Chain& chain = *things_of(subject.world).chain;
    for (discrete::Variant variant : {discrete::Variant::fsi_paper, discrete::Variant::fsi})
        if (Result<void> added = add(chain, variant); !added) return tl::unexpected(added.error());
    if (subject.optimised)
        if (Result<void> added = add(*things_of(*subject.optimised).chain, discrete::Variant::fsi); !added)
            return tl::unexpected(added.error());
    return Picture{7, "figure-7",
                   title_of(subject.name) + ": where outlines do not match, noise can be seen. fsi:paper, fsi" +
                       (subject.optimised ? ", fsi with a visibility that was optimised." : "."),
                   montage(rows)};
}

}  // namespace

Result<std::vector<Picture>> pictures_of(const std::vector<Subject>& subjects) {
    const Subject* by_hand = &subjects.back();
    const Subject* moving = nullptr;
    for (const Subject& subject : subjects) {
        if (subject.by_hand) by_hand = &subject;
        if (moving == nullptr && discrete::is_animated(*things_of(subject.world).chain)) moving = &subject;
    }
    std::vector<Result<Picture>> made;
    made.push_back(figure_1(*by_hand));
    made.push_back(figure_2(*by_hand));
    made.push_back(figure_3(subjects.front()));
    made.push_back(figure_4(subjects.front()));
    if (moving != nullptr) made.push_back(figure_5(*moving));
    made.push_back(figure_6(subjects));
    made.push_back(figure_7(subjects.front()));
    std::vector<Picture> pictures;
    for (Result<Picture>& one : made) {
        if (!one) return tl::unexpected(one.error());
        pictures.push_back(std::move(*one));
    }
    return pictures;
}

}  // namespace overlook::measure::paper::fsi
