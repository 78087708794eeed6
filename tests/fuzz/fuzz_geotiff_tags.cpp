// Any bytes as a GeoTIFF's tags, and what they say as a place on the Earth. Nothing may crash, leak or take memory without bound.
#include <cmath>
#include <cstdint>
#include <span>

#include "tools/bake/georeference.h"

namespace {

using namespace overlook;
using namespace overlook::dem;

void place(const GeoTiffTags& tags) {
    (void)height_scale_from_keys(tags, "fuzz");
    Result<Crs> crs = crs_from_keys(tags, "fuzz");
    Result<GridPlacement> grid = placement_from_tags(tags, "fuzz");
    if (!crs || !grid) return;
    const GridPlacement upright = mirrored(*grid, mirroring_of(*grid), tags.width, tags.height);
    Result<terrain::Frame> frame = frame_of(*crs, upright, tags.width, tags.height, "fuzz");
    if (frame && !(frame->metres_per_column > 0 && std::isfinite(frame->metres_per_row))) __builtin_trap();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    Result<GeoTiffTags> tags = read_geotiff_tags(std::as_bytes(std::span(data, size)), "fuzz");
    if (!tags) return 0;
    if (tags->width == 0 || tags->height == 0) __builtin_trap();
    place(*tags);
    return 0;
}
