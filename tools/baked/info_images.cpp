#include "tools/baked/info_images.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "formats/numbers.h"
#include "runtime/wang_ldi/portraits.h"

namespace overlook::baked {
namespace {

using nlohmann::ordered_json;
using wang_ldi::ImageSet;

struct Total {
    uint64_t images = 0, samples = 0, stored_bytes = 0, raw_bytes = 0;
    double unseen_sum = 0, unseen_most = 0;

    void add(const wang_ldi::Entry& entry) {
        ++images, samples += entry.sample_count, stored_bytes += entry.stored_bytes, raw_bytes += entry.raw_bytes;
        unseen_sum += double(entry.unseen_share), unseen_most = std::max(unseen_most, double(entry.unseen_share));
    }
    double bytes_per_sample() const { return double(stored_bytes) / double(std::max<uint64_t>(1, samples)); }
    double unseen_mean() const { return unseen_sum / double(std::max<uint64_t>(1, images)); }
};

struct Totals {
    Total all;
    std::vector<Total> levels;
};
Totals totals_of(const wang_ldi::ImageReader& images) {
    Totals totals;
    totals.levels.resize(images.set().levels.size());
    for (uint64_t i = 0; i < images.entries().size(); ++i) {
        totals.all.add(images.entries()[i]);
        totals.levels[which_of(images.set(), i).level].add(images.entries()[i]);
    }
    return totals;
}

ordered_json total_json(const Total& total) {
    return {{"images", total.images},
            {"samples", total.samples},
            {"stored_bytes", total.stored_bytes},
            {"raw_bytes", total.raw_bytes},
            {"bytes_per_sample", total.bytes_per_sample()},
            {"unseen_share_mean", total.unseen_mean()},
            {"unseen_share_most", total.unseen_most}};
}

struct TextureTotals {
    double unseen_mean = 0, error_mean = 0, opacity_mean = 0;  // opacity: of the finest texels
};
TextureTotals totals_of(const wang_ldi::TextureSet& set) {
    TextureTotals totals;
    auto count = double(std::max<uint64_t>(1, set.texture_count()));
    size_t texels = size_t(set.side_px) * set.side_px;
    for (const wang_ldi::DirectionalTexture& texture : set.textures) {
        totals.unseen_mean += double(texture.unseen_share) / count, totals.error_mean += double(texture.standard_error) / count;
        for (size_t t = 0; t < texels; ++t) totals.opacity_mean += texture.colours[t][3] / 255.0 / double(texels) / count;
    }
    return totals;
}

}  // namespace

std::string textures_json(const wang_ldi::TextureSet& set) {
    TextureTotals totals = totals_of(set);
    return ordered_json{{"count", set.texture_count()},
                        {"side_px", set.side_px},
                        {"nearest_m", set.nearest_m},
                        {"farthest_m", set.farthest_m},
                        {"unseen_share_mean", totals.unseen_mean},
                        {"standard_error_mean", totals.error_mean},
                        {"opacity_mean", totals.opacity_mean}}
        .dump();
}

void print_textures(const wang_ldi::TextureSet& set) {
    TextureTotals totals = totals_of(set);
    fmt::print("textures: {} of {} texels a side for eyes {:.4g} to {:.4g} m away, opacity {:.2f} on average, {:.2g} % unseen\n",
               with_commas(set.texture_count()), set.side_px, set.nearest_m, set.farthest_m, totals.opacity_mean,
               100 * totals.unseen_mean);
}

std::string images_json(const wang_ldi::ImageReader& images) {
    const ImageSet& set = images.set();
    Totals totals = totals_of(images);
    ordered_json json = total_json(totals.all);
    json["directions"] = set.direction_count, json["contexts"] = set.context_count;
    json["heights_m"] = {set.low_m, set.high_m};
    json["cell"] = {{"eye_low_m", set.cell.eye_low_m},   {"eye_high_m", set.cell.eye_high_m}, {"nearest_m", set.cell.nearest_m},
                    {"farthest_m", set.cell.farthest_m}, {"focal_px", set.cell.focal_px},     {"error_px", set.cell.error_px}};
    json["level_fade"] = double(set.level_fade), json["direction_fade"] = double(set.direction_fade);
    json["has_normals"] = set.has_normals, json["has_splats"] = set.has_splats;
    for (size_t k = 0; k < set.levels.size(); ++k) {
        const wang_ldi::Level& level = set.levels[k];
        ordered_json one{{"side_px", level.side_px},
                         {"nearest_m", double(level.nearest_m)},
                         {"height_step_m", double(level.height_step_m)},
                         {"splat_px", double(level.splat_px)}};
        one.update(total_json(totals.levels[k]));
        json["levels"].push_back(one);
    }
    return json.dump();
}

void print_images(const wang_ldi::ImageReader& images) {
    const ImageSet& set = images.set();
    Totals totals = totals_of(images);
    fmt::print("images: {} of {} levels and {} directions{}, {}: {} samples, {:.2f} bytes each\n", with_commas(totals.all.images),
               set.levels.size(), set.direction_count, set.context_count > 1 ? ", among others and alone" : "",
               set.has_normals ? "unlit, with normals" : "lit", with_commas(totals.all.samples), totals.all.bytes_per_sample());
    for (size_t k = 0; k < set.levels.size(); ++k)
        fmt::print("  level {:<2} {:>5} px a side from {:>8.2f} m on: {:>12} samples, {:>12} bytes, {:.2f} % unseen\n", k,
                   set.levels[k].side_px, double(set.levels[k].nearest_m), with_commas(totals.levels[k].samples),
                   with_commas(totals.levels[k].stored_bytes), 100 * totals.levels[k].unseen_mean());
    fmt::print(
        "right for eyes {:g} to {:g} m up, {:.4g} to {:.4g} m from a tile's middle, {:.4g} px a unit of tangent; for fades of "
        "{:g} "
        "of a level's distance and {:g} of a direction's step\n",
        set.cell.eye_low_m, set.cell.eye_high_m, set.cell.nearest_m, set.cell.farthest_m, set.cell.focal_px, set.level_fade,
        set.direction_fade);
}

Result<std::vector<NamedPicture>> image_sheet(const std::string& file, const wang_ldi::ImageReader& images,
                                              const wang_ldi::PlantedTiles& ground) {
    wang_ldi::PortraitOptions options, large;
    large.width_px = 320;
    std::vector<NamedPicture> sheet;
    auto add = [&](const char* name, Result<ImageRgb8> picture) -> Result<void> {
        if (!picture && picture.error().message.starts_with(file)) return tl::unexpected(picture.error());
        if (!picture) return tl::unexpected(Error{picture.error().exit, file + ": " + picture.error().message});
        sheet.push_back({name, std::move(*picture)});
        return {};
    };
    auto added = add("tiles-above.png", tiles_from_above(images, ground, options));
    if (added) added = add("tiles-aside.png", tiles_from_aside(images, ground, options));
    if (added) added = add("directions.png", directions_portrait(images, 0, options));
    if (added) added = add("levels.png", levels_portrait(images, 0, large));
    if (!added) return tl::unexpected(added.error());
    return sheet;
}

}  // namespace overlook::baked
