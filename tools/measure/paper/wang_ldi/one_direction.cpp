#include "tools/measure/paper/wang_ldi/one_direction.h"

#include <algorithm>
#include <cmath>

#include "formats/caveclod_octahedral.h"
#include "tools/measure/paper/wang_ldi/pictures.h"
#include "tools/measure/paper/wang_ldi/wood.h"

namespace overlook::measure::paper::wang {
namespace {

Result<DirectionsRow> row_of(const Bake& bake, uint64_t seed, bool skips, wang_ldi::Warped& picture) {
    if (!bake.set().has_normals) return bad_input("{}: has no normals; bake it with --light later", bake.path);
    auto wood = Wood::make(bake, seed);
    if (!wood) return tl::unexpected(wood.error());
    wood->skip_what_faces_away(skips);
    view::Camera camera = wood->camera(kWidth_px, kHeight_px);
    picture.clear(kWidth_px, kHeight_px);
    auto counts = wood->draw(camera, picture);
    if (!counts) return tl::unexpected(counts.error());
    DirectionsRow row;
    for (const wang_ldi::Entry& entry : bake.images().entries()) row.bytes += entry.stored_bytes;
    row.tiles = counts->tiles, row.samples = counts->samples, row.kept = counts->kept;
    row.warp_ms = counts->warp_ms, row.shown_px = counts->pixels;
    return row;
}

}  // namespace

wang_ldi::Ldi facing(const wang_ldi::ImageSet& set, uint32_t level, const wang_ldi::Ldi& ldi, const glm::dvec3& eye_m,
                     const glm::dvec2& south_west_m) {
    wang_ldi::Ldi kept;
    kept.side_px = ldi.side_px, kept.palette = ldi.palette, kept.unseen_share = ldi.unseen_share, kept.first = {0};
    double pixel_m = set.tile_m / ldi.side_px;
    for (size_t p = 0; p + 1 < ldi.first.size(); ++p) {
        glm::dvec2 at_m = south_west_m + pixel_m * (glm::dvec2(p % ldi.side_px, p / ldi.side_px) + 0.5);
        for (uint32_t s = ldi.first[p]; s < ldi.first[p + 1]; ++s) {
            double height_m = set.low_m + ldi.heights[s] * double(set.levels[level].height_step_m);
            glm::dvec3 normal = caveclod::vector_of_octahedral(glm::dvec2(ldi.normals[s][0], ldi.normals[s][1]) / 127.0);
            if (glm::dot(normal, eye_m - glm::dvec3(at_m, height_m)) < 0) continue;
            kept.heights.push_back(ldi.heights[s]), kept.colours.push_back(ldi.colours[s]),
                kept.normals.push_back(ldi.normals[s]);
            if (!ldi.splats.empty()) kept.splats.push_back(ldi.splats[s]);
        }
        kept.first.push_back(kept.sample_count());
    }
    return kept;
}

Result<OneDirection> compare_directions(const Bake& one, const Bake& eight, uint64_t seed) {
    OneDirection found;
    wang_ldi::Warped by_eight, picture;
    auto of_eight = row_of(eight, seed, false, by_eight);
    if (!of_eight) return tl::unexpected(of_eight.error());
    found.eight = *of_eight;
    for (bool skips : {false, true}) {
        auto row = row_of(one, seed, skips, picture);
        if (!row) return tl::unexpected(row.error());
        row->beside_eight = broken_of(by_eight, picture);
        (skips ? found.one_facing : found.one) = *row;
    }
    return found;
}

}  // namespace overlook::measure::paper::wang
