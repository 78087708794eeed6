#include "tools/measure/paper/wang_ldi/fields.h"

#include <cmath>
#include <filesystem>

namespace overlook::measure::paper::wang {
namespace {

constexpr double kPitch_deg = -4, kFlight_s = 16, kRise_m = 60, kDown_deg = -80;
constexpr int kGrid = 48, kHeadings = 16;  // places and headings that are tried
constexpr double kAhead_m = kDriveSpeed_m_s * kFlight_s, kStep_m = 10, kFarthest_m = 4000;
constexpr double kPlanted = 0.97;  // of what lies ahead, at least
// What lies ahead is looked at so far to both sides of the way. A rise for a way of the horizon is worth so much more than the
// same of what lies before the eye costs, which is to be level; a horizon higher than that is not in the picture.
constexpr double kAside_deg[] = {-24, -8, 8, 24}, kCostOfSlopes = 2, kHighest = 0.35, kOfLight = 0.15;
constexpr int kSidesteps = 6;     // in a tile, each way
constexpr double kClear_m = 1.5;  // nothing stands nearer before the eye, if that can be

glm::dvec2 direction(double heading_deg) {
    double heading = heading_deg * M_PI / 180;
    return {std::sin(heading), std::cos(heading)};
}

}  // namespace

Result<std::vector<Land>> read_lands(const std::string& folder) {
    std::vector<Land> lands;
    for (auto [name, file] : {std::pair("hills", "planting.json"), std::pair("valley", "valley.json")}) {
        std::string path = folder + "/" + file;
        if (!std::filesystem::exists(path)) continue;
        Result<World> world = read_world(path);
        if (!world) return tl::unexpected(world.error());
        if (!world->is_planted()) return bad_input("{}: plants nothing", path);
        lands.push_back({name, path, std::move(*world)});
    }
    return lands;
}

Guide::Guide(const Land& land) : land_(land), eye_m_(land.world.planted->eye_height_m()) {
    wang_ldi::Rect extent = land.planted().ground().extent();
    if (land.world.planted->is_plain()) extent = {glm::dvec2(-1000), glm::dvec2(1000)};
    double best = -INFINITY;
    for (int row = 1; row < kGrid; ++row)
        for (int column = 1; column < kGrid; ++column) {
            glm::dvec2 at_m = extent.low_m + (extent.high_m - extent.low_m) * glm::dvec2(column, row) / double(kGrid);
            if (!is_planted(at_m)) continue;
            for (int h = 0; h < kHeadings; ++h) {
                double heading_deg = 360.0 * h / kHeadings, worth_here = worth(at_m, heading_deg, best);
                if (worth_here <= best) continue;
                best = worth_here, start_m_ = at_m, heading_deg_ = heading_deg;
            }
        }
}

bool Guide::is_planted(const glm::dvec2& at_m) const {
    glm::dvec2 tile = glm::floor(at_m / land_.planted().placement().tile_m());
    return land_.planted().placement().is_planted(int64_t(tile.x), int64_t(tile.y));
}

double Guide::planted_share(const glm::dvec2& at_m, double heading_deg) const {
    double planted = 0, all = 0;
    for (double aside_deg : kAside_deg)
        for (double ahead_m = 0; ahead_m < kAhead_m; ahead_m += kStep_m, ++all)
            planted += is_planted(at_m + ahead_m * direction(heading_deg + aside_deg));
    return planted / all;
}

// How far the ground before the eye rises or falls for its distance, on the average; what falls is hidden, and costs twice.
double Guide::slope_ahead(const glm::dvec2& at_m, double heading_deg) const {
    const wang_ldi::Ground& ground = land_.planted().ground();
    double from_m = ground.height_m(at_m), sum = 0, all = 0;
    for (double aside_deg : kAside_deg)
        for (double ahead_m = kStep_m; ahead_m < kAhead_m; ahead_m += kStep_m, ++all) {
            double rise = (ground.height_m(at_m + ahead_m * direction(heading_deg + aside_deg)) - from_m) / ahead_m;
            sum += std::isfinite(rise) ? std::max(rise, -2 * rise) : kHighest;
        }
    return sum / all;
}

double Guide::horizon(const glm::dvec2& at_m, double heading_deg) const {
    const wang_ldi::Ground& ground = land_.planted().ground();
    double from_m = ground.height_m(at_m), steepest = 0;
    for (double ahead_m = kAhead_m; ahead_m < kFarthest_m; ahead_m *= 1.1) {
        glm::dvec2 there_m = at_m + ahead_m * direction(heading_deg);
        if (!ground.extent().contains({there_m, there_m})) break;
        double height_m = ground.height_m(there_m);
        if (std::isfinite(height_m)) steepest = std::max(steepest, (height_m - from_m) / ahead_m);
    }
    return std::min(steepest, kHighest);
}

// Of ways that are planted: the more that rises behind them, the more level they are and the more the sun is behind the eye the
// better; of others the more is planted.
double Guide::worth(const glm::dvec2& at_m, double heading_deg, double best) const {
    glm::dvec2 to_sun(land_.images().to_sun);
    double lit = -kOfLight * glm::dot(to_sun, direction(heading_deg));
    double worth = 1 + kHighest + lit + horizon(at_m, heading_deg) - kCostOfSlopes * slope_ahead(at_m, heading_deg);
    worth = std::max(worth, 0.0);
    if (worth <= best) return worth;
    double planted = planted_share(at_m, heading_deg);
    return planted < kPlanted ? planted - 1 : worth;
}

view::Camera Guide::camera(double ahead_m, double up_m, double turned_deg, double pitch_deg, uint32_t width_px,
                           uint32_t height_px) const {
    glm::dvec2 at_m = start_m_ + ahead_m * direction(heading_deg_);
    view::Camera camera = land_.world.base;
    camera.position_m = {at_m, land_.planted().ground().height_m(at_m) + eye_m_ + up_m};
    camera.heading_deg = heading_deg_ + turned_deg, camera.pitch_deg = pitch_deg;
    camera.width_px = width_px, camera.height_px = height_px;
    return wang_ldi::with_clear_near_plane(land_.world.planted->terrain(), land_.world.planted->is_plain(), camera);
}

view::Camera Guide::cleared(const view::Camera& camera) const {
    const wang_ldi::Ground& ground = land_.planted().ground();
    double step_m = land_.planted().placement().tile_m() / kSidesteps, above_m = camera.position_m.z;
    above_m -= ground.height_m(glm::dvec2(camera.position_m));
    view::Camera clearest = camera;
    double farthest_m = -1;
    for (int y = 0; y < kSidesteps; ++y)
        for (int x = 0; x < kSidesteps; ++x) {
            view::Camera beside = camera;
            glm::dvec2 at_m = glm::dvec2(camera.position_m) + step_m * glm::dvec2(x, y);
            double height_m = ground.height_m(at_m);
            if (!std::isfinite(height_m) || !is_planted(at_m)) continue;
            beside.position_m = {at_m, height_m + above_m};
            double nearest_m = kClear_m;
            for (const wang_ldi::PlantPlaces& model : wang_ldi::plants_in_sight(land_.planted(), beside, kClear_m))
                for (const discrete::Placement& plant : model.placements)
                    nearest_m = std::min(nearest_m, glm::length(glm::dvec2(plant.translation_m) - at_m));
            if (nearest_m <= farthest_m) continue;
            farthest_m = nearest_m, clearest = beside;
        }
    return clearest;
}

std::vector<Walk> Guide::walks(uint32_t frames, uint32_t width_px, uint32_t height_px) const {
    std::vector<Walk> walks = {{"walk", {}}, {"drive", {}}, {"rise", {}}, {"turn", {}}, {"look down", {}}};
    for (uint32_t frame = 0; frame < frames; ++frame) {
        double share = frames > 1 ? double(frame) / (frames - 1) : 0, time_s = kFlight_s * share;
        auto add = [&](size_t walk, double ahead_m, double up_m, double turned_deg, double pitch_deg) {
            walks[walk].cameras.push_back(camera(ahead_m, up_m, turned_deg, pitch_deg, width_px, height_px));
        };
        add(0, kWalkSpeed_m_s * time_s, 0, 0, kPitch_deg);
        add(1, kDriveSpeed_m_s * time_s, 0, 0, kPitch_deg);
        add(2, 0, kRise_m * share * share, 0, kPitch_deg - 26 * share);
        add(3, 0, 0, 360 * share, kPitch_deg);
        add(4, 0, 0, 0, kPitch_deg + (kDown_deg - kPitch_deg) * share);
    }
    return walks;
}

std::vector<view::Camera> Guide::steps(uint32_t frames, uint32_t width_px, uint32_t height_px) const {
    std::vector<view::Camera> cameras;
    for (uint32_t frame = 0; frame < frames; ++frame)
        cameras.push_back(camera(kWalkSpeed_m_s * kWalkStep_s * frame, 0, 0, kPitch_deg, width_px, height_px));
    return cameras;
}

}  // namespace overlook::measure::paper::wang
