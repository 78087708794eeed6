#include "tools/make_sample/sample_flight.h"

#include <algorithm>
#include <cmath>

#include "tools/make_sample/flight_lift.h"

namespace overlook::sample {
namespace {

using scene::Flight;
using scene::Interpolation;

constexpr double kStep_s = 1.0 / 32;

// A key by its place on the map: shares of the extent from west to east and from north to south, height above the ground.
struct Stop {
    double time_s, east, south, above_m, heading_deg, pitch_deg;
};

struct Map {
    const Landscape& landscape;
    double cell_size_m;

    double extent_m() const { return cell_size_m * (landscape.side - 1); }
    scene::Key key_at(const Stop& stop) const {
        scene::Key key;
        double x_m = stop.east * extent_m(), y_m = -stop.south * extent_m();
        double z_m = ground_m(landscape, cell_size_m, x_m, y_m) + stop.above_m;
        key.time_s = stop.time_s;
        key.position_m = {std::round(x_m), std::round(y_m), std::ceil(z_m)};
        key.heading_deg = stop.heading_deg;
        key.pitch_deg = stop.pitch_deg;
        return key;
    }
    Flight flight(Interpolation interpolation, const std::vector<Stop>& stops) const {
        Flight made{kStep_s, interpolation, {}};
        for (const Stop& stop : stops) made.keys.push_back(key_at(stop));
        return made;
    }
};

void lift(Flight& flight, const Map& map, double clearance_m) {
    sample::lift(
        flight, [&](double x_m, double y_m) { return ground_m(map.landscape, map.cell_size_m, x_m, y_m); }, clearance_m);
}

// Level and straight: from one place towards a heading at a speed.
Flight straight(const Map& map, double duration_s, double speed_m_s, double course_deg, Stop from, double clearance_m) {
    Flight flight = map.flight(Interpolation::linear, {from, from});
    double course = course_deg * 3.14159265358979 / 180;
    flight.keys[1].time_s = duration_s;
    flight.keys[1].position_m[0] += std::round(std::sin(course) * speed_m_s * duration_s);
    flight.keys[1].position_m[1] += std::round(std::cos(course) * speed_m_s * duration_s);
    lift(flight, map, clearance_m);
    double z_m = std::max(flight.keys[0].position_m[2], flight.keys[1].position_m[2]);
    for (scene::Key& key : flight.keys) key.position_m[2] = z_m;
    return flight;
}

// Four seconds of a hundredth of its height up and down at every frame, then four of rest.
Flight jitter(const Map& map) {
    scene::Key rest = map.key_at({0, 0.55, 0.74, 400, 40, -20});
    Flight flight{kStep_s, Interpolation::constant, {}};
    for (int frame = 0; frame < 128; ++frame) {
        scene::Key key = rest;
        key.time_s = frame * kStep_s;
        key.position_m[2] += frame % 2 == 0 ? 4 : -4;
        flight.keys.push_back(key);
    }
    rest.time_s = 4;
    flight.keys.push_back(rest);
    rest.time_s = 8;
    flight.keys.push_back(rest);
    return flight;
}

Flight yaw(const Map& map) {
    return map.flight(Interpolation::linear, {{0, 0.6, 0.6, 300, 0, -8},
                                              {1, 0.6, 0.6, 300, 90, -8},
                                              {2, 0.6, 0.6, 300, 180, -8},
                                              {3, 0.6, 0.6, 300, 270, -8},
                                              {4, 0.6, 0.6, 300, 360, -8}});
}

Flight teleports(const Map& map) {
    Flight flight = map.flight(Interpolation::constant, {{0, 0.3, 0.9, 600, 50, -12},
                                                         {0.75, 0.8, 0.2, 400, 200, -20},
                                                         {1.5, 0.65, 0.5, 150, 60, -5},
                                                         {2.25, 0.1, 0.1, 2500, 135, -35},
                                                         {3, 0.9, 0.3, 300, 300, -10},
                                                         {3.75, 0.5, 0.75, 60, 10, 0},
                                                         {4.5, 0.25, 0.35, 500, 90, -25},
                                                         {5.25, 0.7, 0.7, 1000, 0, -60},
                                                         {6, 0.95, 0.95, 800, 315, -8},
                                                         {6.75, 0.45, 0.55, 200, 30, -10}});
    scene::Key last = flight.keys.back();
    last.time_s = 7.5;
    flight.keys.push_back(last);
    return flight;
}

// Along a row of samples from west to east, a key over each, so that the way lies in the full surface's own edges.
Flight skim(const Map& map) {
    Flight flight{kStep_s, Interpolation::linear, {}};
    uint32_t side = map.landscape.side, row = side * 3 / 5, first = side / 2, cells = std::min(60u, side / 2 - 1);
    for (uint32_t i = 0; i <= cells; ++i) {
        scene::Key key;
        double height_m = map.landscape.height_m[size_t(row) * side + first + i];
        key.time_s = i / 8.0;
        key.position_m = {(first + i) * map.cell_size_m, -(row * map.cell_size_m), height_m + 0.6};
        key.heading_deg = 90;
        flight.keys.push_back(key);
    }
    return flight;
}

// Four legs of two seconds with a leap between: over the ground northwards, over the same place looking down, southwards from it,
// and towards it from the far corner.
Flight opposites(const Map& map) {
    const double leg_s = 2, last_s = leg_s - kStep_s;
    return map.flight(Interpolation::linear, {{0, 0.5, 0.6, 90, 0, -3},
                                              {last_s, 0.5, 0.58, 110, 0, -3},
                                              {leg_s, 0.5, 0.6, 6000, 0, -85},
                                              {leg_s + last_s, 0.51, 0.6, 6000, 20, -85},
                                              {2 * leg_s, 0.5, 0.6, 90, 180, -3},
                                              {2 * leg_s + last_s, 0.5, 0.62, 110, 180, -3},
                                              {3 * leg_s, 0.95, 0.95, 1500, 315, -12},
                                              {3 * leg_s + last_s, 0.9, 0.9, 1200, 315, -12}});
}

}  // namespace

scene::Scene sample_scene() {
    scene::Scene made;
    scene::Layer layer;
    layer.asset = "sample.ovl";
    layer.method = "terrain";
    made.layers.push_back(layer);
    return made;
}

double ground_m(const Landscape& landscape, double cell_size_m, double x_m, double y_m) {
    double last = landscape.side - 1;
    double column = std::clamp(x_m / cell_size_m, 0.0, last), row = std::clamp(-y_m / cell_size_m, 0.0, last);
    uint32_t left = std::min(uint32_t(column), landscape.side - 2), top = std::min(uint32_t(row), landscape.side - 2);
    const float* corner = &landscape.height_m[size_t(top) * landscape.side + left];
    return std::max({corner[0], corner[1], corner[landscape.side], corner[landscape.side + 1]});
}

double least_clearance_m(const Flight& flight, const Landscape& landscape, double cell_size_m) {
    return least_clearance_m(flight, [&](double x_m, double y_m) { return ground_m(landscape, cell_size_m, x_m, y_m); });
}

Flight overview_flight(const Landscape& landscape, double cell_size_m) {
    Map map{landscape, cell_size_m};
    Flight flight = map.flight(Interpolation::smooth, {{0, 0.38, 0.86, 520, 60, -9},
                                                       {3, 0.40, 0.845, 500, 58, -9},
                                                       {5.5, 0.455, 0.805, 400, 52, -9},
                                                       {8, 0.53, 0.745, 320, 44, -8},
                                                       {10.5, 0.61, 0.655, 340, 40, -7},
                                                       {12.5, 0.665, 0.57, 400, 42, -7},
                                                       {14.5, 0.735, 0.485, 420, 48, -6},
                                                       {16.6, 0.815, 0.425, 600, 40, -6},
                                                       {599 * kStep_s, 0.855, 0.355, 800, 22, -6}});
    lift(flight, map, kLeastClearance_m + 70);
    return flight;
}

std::vector<std::pair<std::string, Flight>> suite_flights(const Landscape& landscape, double cell_size_m) {
    Map map{landscape, cell_size_m};
    const double clear_m = kLeastClearance_m, length_s = 7.5;
    Flight climb = map.flight(Interpolation::smooth, {{0, 0.5, 0.55, 300, 30, -5},
                                                      {2, 0.5, 0.53, 1500, 30, -30},
                                                      {5, 0.5, 0.50, 12000, 30, -65},
                                                      {length_s, 0.5, 0.48, 40000, 30, -80}});
    lift(climb, map, clear_m);
    Flight four = opposites(map);
    lift(four, map, clear_m);
    return {
        {"s01", straight(map, length_s, 64, 40, {0, 0.55, 0.74, 300, 40, -10}, clear_m)},
        {"s02", jitter(map)},
        {"s03", yaw(map)},
        {"s04", teleports(map)},
        {"s05", straight(map, length_s, 200, 90, {0, 0.55, 0.60, 250, 0, -5}, clear_m)},
        {"s06", skim(map)},
        {"s07", straight(map, length_s, 64, 45, {0, 0.35, 0.78, 30, 45, 0}, 30)},
        {"s08", climb},
        {"s18", four},
    };
}

}  // namespace overlook::sample
