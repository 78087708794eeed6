#include "tools/make_sample/plant_field.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "tools/make_sample/noise.h"
#include "tools/make_sample/plant_shapes.h"
#include "tools/make_sample/plant_textures.h"

namespace overlook::sample {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr double kCovered = 0.5;  // of the field by discs: all find a place
constexpr double kStep_s = 1.0 / 32;
constexpr double kMargin = 1.3;  // the hills are so much larger than the field

// Discs that do not overlap, found by squares as wide as the largest.
class Discs {
  public:
    Discs(double side_m, double cell_m)
        : side_m_(side_m), cell_m_(cell_m), cells_(size_t(side_m / cell_m) + 1), in_(cells_ * cells_) {}

    bool has_room(double x_m, double y_m, double radius_m) const {
        size_t column = cell(x_m), row = cell(y_m);
        for (size_t r = row - std::min<size_t>(row, 1); r <= std::min(row + 1, cells_ - 1); ++r)
            for (size_t c = column - std::min<size_t>(column, 1); c <= std::min(column + 1, cells_ - 1); ++c)
                for (const Disc& disc : in_[r * cells_ + c])
                    if (std::hypot(disc.x_m - x_m, disc.y_m - y_m) < disc.radius_m + radius_m) return false;
        return true;
    }
    void add(double x_m, double y_m, double radius_m) { in_[cell(y_m) * cells_ + cell(x_m)].push_back({x_m, y_m, radius_m}); }

  private:
    struct Disc {
        double x_m, y_m, radius_m;
    };
    size_t cell(double at_m) const { return std::min(cells_ - 1, size_t(std::max(0.0, (at_m + side_m_ / 2) / cell_m_))); }

    double side_m_, cell_m_;
    size_t cells_;
    std::vector<std::vector<Disc>> in_;
};

// Which plant stands how, not yet where.
std::vector<PlantedPlace> drawn_lots(const PlantSet& set, uint32_t count, Dice& dice) {
    std::vector<double> until;
    for (const Plant& plant : set.plants) until.push_back(plant.share + (until.empty() ? 0 : until.back()));
    std::vector<PlantedPlace> places(count);
    for (PlantedPlace& place : places) {
        double lot = dice.unit() * until.back();
        place.plant =
            std::min(uint32_t(std::upper_bound(until.begin(), until.end(), lot) - until.begin()), uint32_t(until.size() - 1));
        const Plant& plant = set.plants[place.plant];
        place.scale = dice.between(plant.least_scale, plant.most_scale);
        place.turn_deg = dice.between(plant.least_turn_deg, plant.most_turn_deg);
    }
    return places;
}

std::string layer_text(const std::string& asset, const std::string& instances) {
    return fmt::format("    {{\n      \"asset\": \"{}.ovl\",\n      \"method\": \"discrete\"{}\n    }}", asset,
                       instances.empty() ? "" : ",\n      \"instances\": [\n" + instances + "\n      ]");
}

}  // namespace

glm::dvec4 soil_at(uint64_t seed, double weeds, double u, double v) {
    double rough = 0, fine = tiled_noise(seed, 64 * u, 64 * v, 64);
    for (uint32_t period = 4, octave = 0; octave < 4; period *= 2, ++octave)
        rough += tiled_noise(seed + period, period * u, period * v, period) / (1 + octave);
    glm::dvec3 earth(0.36, 0.29, 0.20), green(0.29, 0.36, 0.17);
    return {glm::mix(earth, green, smooth_step(0.4 - 1.2 * weeds, 1.0 - 1.2 * weeds, rough)) * (1 + 0.3 * fine), 1};
}

double hill_m(const PlantField& field, double x_m, double y_m) {
    double x = x_m / field.side_m, y = y_m / field.side_m;
    return field.side_m * (0.016 * std::sin(7 * x + 0.4) * std::cos(5 * y) + 0.005 * std::sin(11 * x + 9 * y));
}

PlantField plant_field(const PlantSet& set, uint32_t count, uint64_t seed) {
    Dice dice(hash_of(seed, 500, 0));
    PlantField field;
    field.places = drawn_lots(set, count, dice);
    std::vector<double> packing_m;
    for (const Plant& plant : set.plants) packing_m.push_back(packing_radius_m(plant));
    auto radius_m = [&](const PlantedPlace& place) { return place.scale * packing_m[place.plant]; };
    std::stable_sort(field.places.begin(), field.places.end(),
                     [&](const PlantedPlace& a, const PlantedPlace& b) { return radius_m(a) > radius_m(b); });
    double discs_m2 = 0;
    for (const PlantedPlace& place : field.places) discs_m2 += kPi * radius_m(place) * radius_m(place);
    field.side_m = std::sqrt(discs_m2 / kCovered);
    Discs discs(field.side_m, 2 * radius_m(field.places.front()));
    for (PlantedPlace& place : field.places) {
        // Where nothing has room the field grows: places beyond its rim are in its outermost squares.
        for (uint32_t tries = 0;; ++tries) {
            double half_m = field.side_m / 2 * (1 + 0.01 * (tries / 1000));
            place.at_m.x = dice.between(-half_m, half_m), place.at_m.y = dice.between(-half_m, half_m);
            if (discs.has_room(place.at_m.x, place.at_m.y, radius_m(place))) break;
        }
        discs.add(place.at_m.x, place.at_m.y, radius_m(place));
        place.at_m.z = hill_m(field, place.at_m.x, place.at_m.y);
    }
    return field;
}

Result<GlbNode> hills_of(const PlantField& field, double weeds, uint64_t seed) {
    constexpr uint32_t kCells = 96;
    constexpr double kRepeats = 12;
    auto soil = painted("soil", Skin::two_sided, 256, 256, [=](double u, double v) { return soil_at(seed, weeds, u, v); });
    if (!soil) return tl::unexpected(soil.error());
    PlantMaker maker({std::move(*soil)});
    maker.add_sheet(0, kCells, kCells, [&](uint32_t row, uint32_t column) {
        double x = double(column) / kCells, y = double(row) / kCells, side_m = kMargin * field.side_m;
        glm::dvec2 at_m(side_m * (x - 0.5), side_m * (y - 0.5));
        return Place{{at_m.x, at_m.y, hill_m(field, at_m.x, at_m.y)}, {kRepeats * x, kRepeats * (1 - y)}};
    });
    return GlbNode{"hills", maker.take(), {0, 0, 0}, {0, 0, 0}};
}

std::string scene_of_field(const PlantSet& set, const PlantField& field) {
    std::vector<std::string> instances(set.plants.size());
    for (const PlantedPlace& place : field.places) {
        std::string& text = instances[place.plant];
        fmt::format_to(std::back_inserter(text),
                       "{}        {{\"translation_m\": [{:.3f}, {:.3f}, {:.3f}], \"rotation_z_deg\": {:.1f}, \"scale\": {:.3f}}}",
                       text.empty() ? "" : ",\n", place.at_m.x, place.at_m.y, place.at_m.z, place.turn_deg, place.scale);
    }
    std::string layers = layer_text("hills", "");
    for (size_t i = 0; i < instances.size(); ++i) {
        const std::string& file = set.plants[i].file;
        if (!instances[i].empty()) layers += ",\n" + layer_text(file.substr(0, file.find('.')), instances[i]);
    }
    return fmt::format(
        "{{\n  \"version\": {},\n  \"layers\": [\n{}\n  ],\n  \"camera\": {{\"fov_y_deg\": 60, \"near_m\": 0.1}},\n  "
        "\"error_px\": 1\n}}\n",
        scene::kSceneVersion, layers);
}

scene::Flight flight_of_field(const PlantField& field, double eye_m) {
    constexpr int kKeys = 12;
    scene::Flight flight{kStep_s, scene::Interpolation::smooth, {}};
    for (int i = 0; i <= kKeys; ++i) {
        double share = double(i) / kKeys;
        glm::dvec2 at_m(0.03 * field.side_m * std::sin(5 * share), field.side_m * (-0.52 + 0.5 * share));
        scene::Key key;
        key.time_s = 20 * share;
        key.position_m = {at_m.x, at_m.y, hill_m(field, at_m.x, at_m.y) + eye_m};
        key.heading_deg = 10 * std::sin(4 * share);
        key.pitch_deg = -4;
        flight.keys.push_back(key);
    }
    return flight;
}

}  // namespace overlook::sample
