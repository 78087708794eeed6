#include "formats/container_rules.h"
#include "formats/wang_ldi_grouped.h"
#include "tests/corrupt/terrain_parts.h"
#include "tests/corrupt/wang_images_fixtures.h"

namespace overlook::wang_ldi::image_fixtures {

ImageSet post() {
    ImageSet set;
    set.tile_m = 2, set.low_m = 0, set.high_m = 1.5;
    set.cell = {1.5, 1.9, 1, 40, 512, 1};
    set.tile_count = 1, set.direction_count = 1;
    set.has_normals = set.has_splats = true;
    set.level_fade = 0.0625f, set.direction_fade = 0.125f;
    set.levels = {{2, 1, 0.25f, 1}, {1, 8, 0.5f, 1.5f}};
    return set;
}

ImageSet grouped_post() {
    ImageSet set = post();
    set.is_grouped = true;
    return set;
}

std::vector<Ldi> images_of_post() {
    Ldi fine;
    fine.side_px = 2, fine.first = {0, 3, 3, 3, 4}, fine.heights = {0, 1, 4, 2}, fine.colours = {0, 0, 1, 1};
    fine.normals = {{0, -127}, {0, -127}, {0, 0}, {90, 3}}, fine.splats = {16, 16, 16, 24};
    fine.palette = {{40, 90, 30}, {200, 180, 20}}, fine.unseen_share = 0.0625f;
    Ldi coarse;
    coarse.side_px = 1, coarse.first = {0, 2}, coarse.heights = {0, 2}, coarse.colours = {0, 0};
    coarse.normals = {{0, -127}, {0, 0}}, coarse.splats = {16, 20}, coarse.palette = {{90, 110, 28}};
    return {fine, coarse};
}

Pieces Pieces::of_raw(const ImageSet& set, const std::vector<Ldi>& ldis, const std::vector<Bytes>& raw) {
    Pieces pieces;
    pieces.directory = bytes_of_head(set);
    for (size_t i = 0; i < ldis.size(); ++i) {
        Bytes frame = terrain::fixtures::frame_of(raw[i]);
        Bytes entry(40);
        store_le<uint64_t>(entry, 0, pieces.images.size()), store_le<uint64_t>(entry, 8, container::checksum_of(frame));
        store_le<uint32_t>(entry, 16, uint32_t(frame.size())), store_le<uint32_t>(entry, 20, uint32_t(raw[i].size()));
        store_le<uint32_t>(entry, 24, ldis[i].sample_count()), store_le<uint32_t>(entry, 28, uint32_t(ldis[i].palette.size()));
        store_f32(entry, 32, ldis[i].unseen_share);
        pieces.directory.insert(pieces.directory.end(), entry.begin(), entry.end());
        pieces.images.insert(pieces.images.end(), frame.begin(), frame.end());
    }
    return pieces;
}

Pieces Pieces::of(const ImageSet& set, const std::vector<Ldi>& ldis) {
    std::vector<Bytes> raw;
    for (size_t i = 0; i < ldis.size(); ++i)
        raw.push_back(set.is_grouped ? grouped_bytes_of(set, which_of(set, i).level, ldis[i]).bytes : bytes_of_ldi(set, ldis[i]));
    return of_raw(set, ldis, raw);
}

Bytes Pieces::file() const {
    std::vector<container::fixtures::RawSection> sections;
    if (without != "WLDS") sections.push_back({"WLDS", image_flags, 0, images, images.size()});
    if (without != "WLDI")
        sections.push_back({"WLDI", 1, directory_codec, directory_codec == 0 ? directory : terrain::fixtures::frame_of(directory),
                            directory.size()});
    Bytes file = container::fixtures::file_of(sections);
    container::fixtures::seal(file);
    return file;
}

}  // namespace overlook::wang_ldi::image_fixtures
