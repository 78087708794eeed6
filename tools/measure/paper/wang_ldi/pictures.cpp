#include "tools/measure/paper/wang_ldi/pictures.h"

#include <cmath>
#include <numbers>

#include "runtime/wang_ldi/portraits.h"
#include "tools/measure/page_text.h"

namespace overlook::measure::paper::wang {
namespace {

constexpr uint64_t kSeed = 1;
constexpr uint32_t kRingTiles = 10, kRingTile_px = 24;

Picture picture(const Plants& plants, int figure, const std::string& name, const std::string& caption, ImageRgb8 image) {
    return {figure, name + "-" + plants.name, caption, std::move(image)};
}

void add_sheets(const Subject& subject, Plants& plants) {
    struct Said {
        const char* name;
        int figure;
        std::string caption;
        bool is_of_own;
    };
    auto repeats = [](const BakeReport& report) {
        return fmt::format("greatest correlation over lags 2 to 10: {}", short_number(report.correlation));
    };
    const Said kSaid[] = {{"tiles", 3, "the eight tiles", false},
                          {"tiling-32", 4, "a: 32 x 32 of the eight", false},
                          {"tiling-256", 4, "b: 256 x 256 of the eight, " + repeats(subject.of_paper), false},
                          {"robinson-32", 4, "c: 32 x 32 of Robinson's sixteen", false},
                          {"robinson-256", 4, "d: 256 x 256 of Robinson's sixteen, " + repeats(subject.of_robinson), false},
                          {"tiling-256", 4, "256 x 256 of Overlook's own, " + repeats(subject.of_own), true},
                          {"spectrum", 4, "spectrum of b", false},
                          {"robinson-spectrum", 4, "spectrum of d", false},
                          {"spectrum", 4, "spectrum of Overlook's own", true},
                          {"planting-neighbours", 5, "neighbours across an edge, planted as published", false},
                          {"planting-neighbours", 5, "the same, planted corners first", true},
                          {"planting-tiles", 6, "what stands in and over tiles, planted as published", false},
                          {"planting-tiles", 6, "the same, planted corners first", true}};
    for (const Said& said : kSaid)
        for (const auto& [name, image] : said.is_of_own ? subject.own_sheet : subject.sheet)
            if (name == said.name)
                plants.pictures.push_back(
                    picture(plants, said.figure, name + (said.is_of_own ? "-own" : ""), said.caption, image));
}

Result<void> add_portraits(const Subject& subject, Plants& plants) {
    wang_ldi::PortraitOptions small, large;
    large.width_px = 320;
    int tiles_figure = subject.name == "grass" ? 12 : 11;
    auto add = [&](int figure, const char* name, const std::string& caption, const Bake& bake,
                   Result<ImageRgb8> image) -> Result<void> {
        if (!image) return tl::unexpected(Error{image.error().exit, bake.path + ": " + image.error().message});
        plants.pictures.push_back(picture(plants, figure, name, caption, std::move(*image)));
        return {};
    };
    const Bake &paper = subject.paper, &unlit = subject.unlit;
    auto added = add(8, "figure-8", "images for eyes in the south, west, north and east: from there, and from a quarter turn on",
                     paper, directions_portrait(paper.images(), 0, small));
    if (added)
        added = add(9, "figure-9", "a coarse level from where it is for, the same close up, the right one close up", paper,
                    levels_portrait(paper.images(), 0, large));
    if (added)
        added = add(tiles_figure, "figure-tiles-above", "the tiles among their neighbours from above, without light", unlit,
                    tiles_from_above(unlit.images(), unlit.ground, small));
    if (added)
        added = add(tiles_figure, "figure-tiles-aside", "the tiles from aside, each with its own objects alone", paper,
                    tiles_from_aside(paper.images(), paper.ground, small));
    return added;
}

Result<void> add_rings(const Subject& subject, Plants& plants) {
    for (const Bake* bake : {&subject.paper, &subject.own}) {
        auto wood = Wood::make(*bake, kSeed);
        if (!wood) return tl::unexpected(wood.error());
        bool is_own = bake == &subject.own;
        plants.pictures.push_back(picture(
            plants, 7, is_own ? "figure-7-own" : "figure-7",
            fmt::format("levels (brightness) and directions (hue) of the tiles about an eye, {}: {} levels, {} directions",
                        is_own ? "as Overlook chooses them" : "the paper's", wood->set().levels.size(),
                        wood->set().direction_count),
            wood->rings(wood->camera(kWidth_px, kHeight_px), kRingTiles, kRingTile_px)));
    }
    return {};
}

Size size_of(const Bake& bake) {
    Size size;
    for (const wang_ldi::Entry& entry : bake.images().entries())
        size.samples += entry.sample_count, size.stored_bytes += entry.stored_bytes;
    size.file_bytes = bake.file->file_bytes();
    return size;
}

}  // namespace

Result<Plants> plants_of(const Subject& subject, const std::function<void(double)>& done) {
    Plants plants;
    plants.name = subject.name;
    plants.paper = subject.of_paper, plants.own = subject.of_own, plants.single = subject.of_single;
    plants.robinson = subject.of_robinson, plants.gloss = subject.gloss, plants.gloss_none = subject.gloss_none;
    plants.every = subject.every;
    plants.paper_size = size_of(subject.paper), plants.own_size = size_of(subject.own);
    auto whole = figure_2(subject);
    if (!whole) return tl::unexpected(whole.error());
    plants.figure_2 = std::move(*whole);
    done(0.6);
    if (subject.one && subject.eight) {
        auto directions = compare_directions(*subject.one, *subject.eight, kSeed);
        if (!directions) return tl::unexpected(directions.error());
        plants.directions = *directions;
    }
    add_sheets(subject, plants);
    if (auto added = add_rings(subject, plants); !added) return tl::unexpected(added.error());
    if (auto added = add_portraits(subject, plants); !added) return tl::unexpected(added.error());
    done(1);
    return plants;
}

}  // namespace overlook::measure::paper::wang
