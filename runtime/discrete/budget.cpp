#include "runtime/discrete/budget.h"

#include <algorithm>
#include <cmath>

namespace overlook::discrete {
namespace {

constexpr double kRestFrom = 0.95, kAim = 0.975;  // shares of the budget
constexpr double kMostError_px = 1024;
constexpr int kHalvings = 20;
constexpr double kMostCorrection = 2;

}  // namespace

double predicted_triangles(const Director& director, const view::Camera& camera, double error_px) {
    const ChainFacts& facts = director.facts();
    SelectSettings select = director.options().select;
    select.error_px = error_px;
    Selector selector(facts, select, camera);
    const std::vector<Placement>& placements = director.placements();
    double sum = 0;
    for (uint32_t instance = 0; instance < placements.size(); ++instance) {
        if (!selector.is_in_view(placements[instance])) continue;
        uint32_t level = selector.wanted(placements[instance], director.transition(instance).to);
        sum += double(facts.levels[level].triangle_count);
    }
    return sum;
}

double BudgetKeeper::error_px(std::span<const Director* const> directors, const view::Camera& camera) {
    auto at = [&](double error_px) {
        double sum = 0;
        for (const Director* director : directors) sum += predicted_triangles(*director, camera, error_px);
        return sum;
    };
    double allowed = triangles_ / correction_;
    predicted_ = at(error_px_);
    bool rests = predicted_ <= allowed && (predicted_ >= kRestFrom * allowed || error_px_ <= least_px_);
    if (!rests) {
        // The cost never grows with the error.
        double low = std::log(least_px_), high = std::log(std::max(kMostError_px, least_px_));
        if (at(least_px_) <= kAim * allowed) high = low;
        for (int i = 0; i < kHalvings && low < high; ++i) {
            double middle = (low + high) / 2;
            (at(std::exp(middle)) <= kAim * allowed ? high : low) = middle;
        }
        error_px_ = std::max(std::exp(high), least_px_);
        predicted_ = at(error_px_);
    }
    return error_px_;
}

void BudgetKeeper::frame_done(double settled_triangles) {
    if (predicted_ > 0 && settled_triangles > 0)
        correction_ = std::clamp(settled_triangles / predicted_, 1 / kMostCorrection, kMostCorrection);
}

}  // namespace overlook::discrete
