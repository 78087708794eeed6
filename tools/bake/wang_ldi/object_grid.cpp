#include "tools/bake/wang_ldi/object_grid.h"

#include <map>

namespace overlook::wang_ldi {
namespace {

constexpr double kMostSquares_a_side = 4096;

double radius_of(const Planting& planting, const Planted& object) {
    return double(planting.models[object.model].packing_radius_m) * double(object.scale);
}

}  // namespace

ObjectGrid::ObjectGrid(const Planting& planting, size_t tile) : size_m_(planting.tile_size_m) {
    std::map<int, std::vector<uint32_t>> by_size;
    const std::vector<Planted>& objects = planting.tiles[tile];
    for (uint32_t o = 0; o < objects.size(); ++o) by_size[std::ilogb(radius_of(planting, objects[o]))].push_back(o);
    for (const auto& [size, of_size] : by_size) add_class(planting, tile, of_size);
}

void ObjectGrid::add_class(const Planting& planting, size_t tile, const std::vector<uint32_t>& objects) {
    const std::vector<Planted>& all = planting.tiles[tile];
    Class made;
    for (uint32_t o : objects) made.most_radius_m = std::max(made.most_radius_m, radius_of(planting, all[o]));
    most_radius_m_ = std::max(most_radius_m_, made.most_radius_m);
    // No squares smaller than the discs, and no more of them than there are discs.
    double side = std::min({size_m_ / (2 * made.most_radius_m), std::sqrt(double(objects.size())), kMostSquares_a_side});
    made.side = uint32_t(std::max(1.0, std::floor(side))), made.squares_per_m = made.side / size_m_;
    auto square_of = [&](uint32_t o) {
        return made.square_of(double(all[o].y_m)) * made.side + made.square_of(double(all[o].x_m));
    };
    made.first.assign(size_t(made.side) * made.side + 1, 0), made.objects.resize(objects.size());
    for (uint32_t o : objects) ++made.first[square_of(o) + 1];
    for (size_t s = 1; s < made.first.size(); ++s) made.first[s] += made.first[s - 1];
    std::vector<uint32_t> next(made.first.begin(), made.first.end() - 1);
    for (uint32_t o : objects) made.objects[next[square_of(o)]++] = o;
    classes_.push_back(std::move(made));
}

}  // namespace overlook::wang_ldi
