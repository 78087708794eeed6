// What groups::NextAbove and groups::NearestColour say, of eight heights of a column at a time and without a branch.
#pragma once

#include "formats/wang_ldi_groups.h"

namespace overlook::wang_ldi::groups {

inline constexpr uint32_t kLanes = 8;

// Heights less 32,768, in the order of their column, from below.
using Lanes = int16_t __attribute__((vector_size(16)));

using Words = uint16_t __attribute__((vector_size(16)));

inline Lanes all_lanes(int value) {
    auto v = int16_t(value);
    return Lanes{v, v, v, v, v, v, v, v};
}
inline Lanes lesser(const Lanes& a, const Lanes& b) {
    return a < b ? a : b;
}
inline int least_of(Lanes lanes) {
    lanes = lesser(lanes, __builtin_shufflevector(lanes, lanes, 4, 5, 6, 7, 0, 1, 2, 3));
    lanes = lesser(lanes, __builtin_shufflevector(lanes, lanes, 2, 3, 0, 1, 6, 7, 4, 5));
    return std::min(lanes[0], lanes[1]);
}

// As much of a column as tells what is next to a height in it, which ascends from call to call.
class Window {
  public:
    static constexpr int kNoHeight = 32767;

    // heights: of the image, and kLanes more that may be anything.
    Window(const uint16_t* heights, const Column& column) : all_(heights), begin_(column.begin), end_(column.end) { load(); }
    // From the last sample at or below `height` on, where not all of the column fits.
    void go_to(int height) {
        while (end_ - begin_ > kLanes && all_[begin_ + kLanes - 1] <= height) begin_ += kLanes - 1, load();
    }
    const Lanes& heights() const { return heights_; }  // kNoHeight beyond the last
    const Lanes& beyond() const { return beyond_; }    // all bits where there is no sample
    uint32_t begin() const { return begin_; }

  private:
    void load() {
        static constexpr int16_t kBeyond[2 * kLanes] = {0, 0, 0, 0, 0, 0, 0, 0, -1, -1, -1, -1, -1, -1, -1, -1};
        __builtin_memcpy(&heights_, all_ + begin_, sizeof heights_);
        __builtin_memcpy(&beyond_, kBeyond + kLanes - std::min(end_ - begin_, kLanes), sizeof beyond_);
        heights_ = ((heights_ ^ all_lanes(-32768)) & ~beyond_) | (all_lanes(kNoHeight) & beyond_);
    }
    Lanes heights_, beyond_;
    const uint16_t* all_;
    uint32_t begin_, end_;
};

// The columns in the west and in the south of a pixel, whose samples come from below. For each first nearest(), then steps().
class WindowsBeside {
  public:
    static constexpr int kFar = 2047;  // distances from there on are not told apart

    WindowsBeside(const uint16_t* heights, const Beside& beside) : west_(heights, beside.west), south_(heights, beside.south) {}

    // The sample that is nearest in height, in the order of NearestColour, and how far from it; kFar: not told.
    uint32_t nearest(int height, int& distance) {
        constexpr Lanes kNumbers{0, 1, 2, 3, 4, 5, 6, 7};
        west_.go_to(height), south_.go_to(height);
        Lanes from = all_lanes(height - 32768);
        int least = least_of(lesser(away(west_, from) | kNumbers, away(south_, from) | kNumbers | all_lanes(kLanes)));
        distance = least >> 4;
        const uint32_t begins[2] = {west_.begin(), south_.begin()};
        return begins[(least >> 3) & 1] + uint32_t(least & 7);
    }
    // As NextAbove::steps, where no sample is at 65,535 steps.
    int steps(int below) const {
        Lanes from = all_lanes(below - 32768), none = all_lanes(Window::kNoHeight);
        Lanes west = west_.heights() > from ? west_.heights() : none, south = south_.heights() > from ? south_.heights() : none;
        int next = least_of(lesser(west, south));
        return next == Window::kNoHeight ? -1 : next + 32768 - below - 1;
    }

  private:
    // Sixteen times the distance, up to kFar.
    static Lanes away(const Window& column, const Lanes& from) {
        Lanes above = Lanes(Words(column.heights()) - Words(from)), below = Lanes(Words(from) - Words(column.heights()));
        Lanes apart = column.heights() > from ? above : below;
        Lanes is_far = ((apart & all_lanes(~kFar)) != Lanes{}) | column.beyond();
        return ((apart & ~is_far) | (all_lanes(kFar) & is_far)) << 4;
    }
    Window west_, south_;
};

}  // namespace overlook::wang_ldi::groups
