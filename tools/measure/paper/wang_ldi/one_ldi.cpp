#include "tools/measure/paper/wang_ldi/one_ldi.h"

#include <algorithm>
#include <cmath>

namespace overlook::measure::paper::wang {
namespace {

constexpr float kSameDepth = 0.01f, kWrongDepth = 0.05f;
constexpr int kMostSplat_px = 64;

// Where a camera sees a place: pixels from the picture's corner, and how deep.
struct Projection {
    view::Axes axes;
    double focal;
    const view::Camera& camera;

    explicit Projection(const view::Camera& of) : axes(view::axes_of(of)), focal(view::focal_px(of)), camera(of) {}
    glm::dvec3 operator()(const glm::dvec3& at_m) const {
        glm::dvec3 from = at_m - camera.position_m;
        double depth_m = glm::dot(axes.forward, from);
        return {camera.width_px * 0.5 + focal * glm::dot(axes.right, from) / depth_m,
                camera.height_px * 0.5 - focal * glm::dot(axes.up, from) / depth_m, depth_m};
    }
};

}  // namespace

OneLdi::OneLdi(const view::Camera& camera) : camera_(camera), pixels_(size_t(camera.width_px) * camera.height_px) {}

void OneLdi::add(const view::Camera& camera, const wang_ldi::Warped& seen) {
    Projection there(camera), here(camera_);
    for (uint32_t p = 0; p < seen.colours.size(); ++p) {
        if (seen.colours[p] == 0) continue;
        double right = (p % seen.width_px + 0.5 - seen.width_px * 0.5) / there.focal,
               up = (seen.height_px * 0.5 - p / seen.width_px - 0.5) / there.focal;
        glm::dvec3 along = there.axes.forward + right * there.axes.right + up * there.axes.up;
        glm::dvec3 at_m = camera.position_m + double(seen.depth_m[p]) * along, pixel = here(at_m);
        if (!(pixel.z > camera_.near_m && pixel.x >= 0 && pixel.y >= 0 && pixel.x < camera_.width_px &&
              pixel.y < camera_.height_px))
            continue;
        auto depth_m = float(pixel.z);
        std::vector<Sample>& samples = pixels_[size_t(pixel.y) * camera_.width_px + size_t(pixel.x)];
        bool is_there = std::any_of(samples.begin(), samples.end(), [&](const Sample& sample) {
            return std::abs(sample.depth_m - depth_m) < kSameDepth * depth_m;
        });
        if (!is_there) samples.push_back({at_m, depth_m, seen.colours[p]});
    }
}

void OneLdi::draw(const view::Camera& camera, wang_ldi::Warped& picture) const {
    Projection there(camera);
    double focal = view::focal_px(camera_);
    for (const std::vector<Sample>& samples : pixels_)
        for (const Sample& sample : samples) {
            glm::dvec3 pixel = there(sample.at_m);
            if (!(pixel.z > camera.near_m && std::abs(pixel.x) < 1e6 && std::abs(pixel.y) < 1e6)) continue;
            double wide = double(sample.depth_m) / focal * there.focal / pixel.z;
            int side = std::clamp(int(std::min(wide, 1e4) + 0.5), 1, kMostSplat_px);
            int left = int(std::floor(pixel.x - 0.5 * (side - 1))), top = int(std::floor(pixel.y - 0.5 * (side - 1)));
            for (int y = std::max(top, 0); y < std::min(top + side, int(picture.height_px)); ++y)
                for (int x = std::max(left, 0); x < std::min(left + side, int(picture.width_px)); ++x) {
                    size_t p = size_t(y) * picture.width_px + size_t(x);
                    if (!(float(pixel.z) < picture.depth_m[p])) continue;
                    picture.depth_m[p] = float(pixel.z), picture.colours[p] = sample.colour;
                }
        }
}

uint64_t OneLdi::sample_count() const {
    uint64_t count = 0;
    for (const auto& samples : pixels_) count += samples.size();
    return count;
}

uint32_t OneLdi::most_layers() const {
    size_t most = 0;
    for (const auto& samples : pixels_) most = std::max(most, samples.size());
    return uint32_t(most);
}

Broken broken_of(const wang_ldi::Warped& truth, const wang_ldi::Warped& picture) {
    uint64_t shown = 0, holes = 0, wrong = 0;
    for (size_t p = 0; p < truth.colours.size(); ++p) {
        if (truth.colours[p] == 0) continue;
        ++shown;
        if (picture.colours[p] == 0)
            ++holes;
        else
            wrong += std::abs(picture.depth_m[p] - truth.depth_m[p]) > kWrongDepth * truth.depth_m[p];
    }
    double all = double(std::max<uint64_t>(1, shown));
    return {double(holes) / all, double(wrong) / all};
}

}  // namespace overlook::measure::paper::wang
