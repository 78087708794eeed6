#include "runtime/wang_ldi/plain.h"

#include <cmath>
#include <limits>

namespace overlook::wang_ldi {
namespace {

constexpr uint32_t kSide = 65;
constexpr double kCell_m = 400;

}  // namespace

double plain_side_m() {
    return kCell_m * (kSide - 1);
}

terrain::Terrain plain_terrain() {
    terrain::Terrain plain;
    plain.shape = terrain::shape_of(kSide, kSide);
    plain.frame.metres_per_column = plain.frame.metres_per_row = kCell_m;
    plain.heights.assign(size_t(kSide) * kSide, 0);
    for (uint32_t code = 1; code < 255; ++code) plain.error_m[code] = std::ldexp(1.0f, int(code) / 8) * (1 + float(code % 8) / 8);
    plain.error_m[terrain::kMustSplit] = std::numeric_limits<float>::infinity();
    for (uint32_t level = 0; level < plain.shape.root_log2; ++level) {
        terrain::LevelGrid grid = terrain::level_grid(plain.shape, level);
        plain.codes.emplace_back(size_t(grid.columns) * grid.rows, uint8_t(0));
    }
    plain.texture = {1, 1, {112, 98, 78}};
    return plain;
}

glm::dvec3 plain_origin_m(const glm::dvec3& eye_m) {
    glm::dvec2 middle = glm::round(glm::dvec2(eye_m) / kCell_m) * kCell_m;
    return {middle.x - plain_side_m() / 2, middle.y + plain_side_m() / 2, 0};
}

}  // namespace overlook::wang_ldi
