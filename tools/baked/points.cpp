#include "tools/baked/points.h"

#include <algorithm>

#include "formats/atomic_file.h"
#include "formats/caveclod_octahedral.h"
#include "formats/little_endian.h"

namespace overlook::baked {
namespace {

struct Place {
    uint32_t pixel = 0;
    uint16_t step = 0;
    uint32_t ldi = 0, sample = 0;
};

std::vector<Place> places_of(std::span<const wang_ldi::Ldi> ldis) {
    std::vector<Place> places;
    for (uint32_t i = 0; i < ldis.size(); ++i)
        for (uint32_t p = 0; p + 1 < ldis[i].first.size(); ++p)
            for (uint32_t s = ldis[i].first[p]; s < ldis[i].first[p + 1]; ++s) places.push_back({p, ldis[i].heights[s], i, s});
    auto key = [](const Place& place) { return std::pair(place.pixel, place.step); };
    std::stable_sort(places.begin(), places.end(), [&](const Place& a, const Place& b) { return key(a) < key(b); });
    auto same = std::unique(places.begin(), places.end(), [&](const Place& a, const Place& b) { return key(a) == key(b); });
    places.erase(same, places.end());
    return places;
}

}  // namespace

Points points_of(const wang_ldi::ImageSet& set, uint32_t level, std::span<const wang_ldi::Ldi> ldis) {
    const wang_ldi::Level& finely = set.levels[level];
    double pixel_m = set.tile_m / finely.side_px;
    Points points;
    for (const Place& place : places_of(ldis)) {
        const wang_ldi::Ldi& ldi = ldis[place.ldi];
        points.positions_m.emplace_back((place.pixel % finely.side_px + 0.5) * pixel_m,
                                        (place.pixel / finely.side_px + 0.5) * pixel_m,
                                        set.low_m + double(finely.height_step_m) * place.step);
        points.colours.push_back(ldi.palette[ldi.colours[place.sample]]);
        if (set.has_normals) {
            const auto& code = ldi.normals[place.sample];
            points.normals.emplace_back(caveclod::vector_of_octahedral({code[0] / 127.0, code[1] / 127.0}));
        }
        double splat_px = set.has_splats ? ldi.splats[place.sample] / 16.0 : double(finely.splat_px);
        points.splats_m.push_back(float(splat_px * pixel_m));
    }
    return points;
}

Result<uint64_t> write_points(const std::string& path, const Points& points) {
    bool has_normals = !points.normals.empty();
    std::string head = fmt::format(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty "
        "double z\n{}property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float splat_m\n"
        "end_header\n",
        points.positions_m.size(), has_normals ? "property float nx\nproperty float ny\nproperty float nz\n" : "");
    size_t row_bytes = (has_normals ? 36 : 24) + 3 + 4, at = head.size();
    std::vector<std::byte> bytes(head.size() + points.positions_m.size() * row_bytes);
    for (size_t i = 0; i < head.size(); ++i) bytes[i] = std::byte(head[i]);
    for (size_t i = 0; i < points.positions_m.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis, at += 8) store_f64(bytes, at, points.positions_m[i][axis]);
        for (int axis = 0; has_normals && axis < 3; ++axis, at += 4) store_f32(bytes, at, points.normals[i][axis]);
        for (uint8_t channel : points.colours[i]) bytes[at++] = std::byte(channel);
        store_f32(bytes, at, points.splats_m[i]), at += 4;
    }
    if (auto written = write_file(path, bytes); !written) return tl::unexpected(written.error());
    return uint64_t(bytes.size());
}

}  // namespace overlook::baked
