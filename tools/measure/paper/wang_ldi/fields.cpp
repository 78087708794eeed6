#include "tools/measure/paper/wang_ldi/fields.h"

#include <cmath>
#include <filesystem>

namespace overlook::measure::paper::wang {
namespace {

constexpr double kPitch_deg = -4, kFlight_s = 16, kRise_m = 60, kDown_deg = -80;
constexpr int kGrid = 24, kHeadings = 16;  // places and headings that are tried
constexpr double kAhead_m = kDriveSpeed_m_s * kFlight_s, kStep_m = 10, kFarthest_m = 4000;
constexpr double kPlanted = 0.97;  // of the way ahead, at least

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
                double heading_deg = 360.0 * h / kHeadings, worth_here = worth(at_m, heading_deg);
                if (worth_here <= best) continue;
                best = worth_here, start_m_ = at_m, heading_deg_ = heading_deg;
            }
        }
}

bool Guide::is_planted(const glm::dvec2& at_m) const {
    glm::dvec2 tile = glm::floor(at_m / land_.planted().placement().tile_m());
    return land_.planted().placement().is_planted(int64_t(tile.x), int64_t(tile.y));
}

// The more that rises ahead the better, of ways that are planted; of others the more is planted.
double Guide::worth(const glm::dvec2& at_m, double heading_deg) const {
    glm::dvec2 along = direction(heading_deg);
    double from_m = land_.planted().ground().height_m(at_m), planted = 0, steepest = 0;
    for (double ahead_m = 0; ahead_m < kAhead_m; ahead_m += kStep_m)
        planted += is_planted(at_m + ahead_m * along) * kStep_m / kAhead_m;
    if (planted < kPlanted) return planted - 1;
    wang_ldi::Rect extent = land_.planted().ground().extent();
    for (double ahead_m = kAhead_m; ahead_m < kFarthest_m; ahead_m *= 1.1) {
        glm::dvec2 there_m = at_m + ahead_m * along;
        if (!extent.contains({there_m, there_m})) break;
        double height_m = land_.planted().ground().height_m(there_m);
        if (std::isfinite(height_m)) steepest = std::max(steepest, (height_m - from_m) / ahead_m);
    }
    return steepest;
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
