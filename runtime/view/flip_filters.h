// The filters of FLIP: one-dimensional, symmetric or antisymmetric, over rows of floats.
#pragma once

#include <cstddef>
#include <vector>

namespace overlook::view {

// Weights of the offsets 0, 1, .. radius; those of negative offsets are the same, or the opposite of an odd kernel's.
struct Kernel {
    std::vector<float> weights;
    bool is_odd = false;

    int radius() const { return int(weights.size()) - 1; }
};

// What the eye sees of each channel: Gaussians of unit sum whose widths follow its contrast sensitivity. The yellow-blue one is a
// sum of two in the plane, each of which separates; narrow_share + wide_share = 1.
struct EyeKernels {
    Kernel brightness, red_green, yellow_blue_narrow, yellow_blue_wide;
    float narrow_share = 0, wide_share = 0;
};
EyeKernels eye_kernels(double pixels_per_degree);

// Detectors of edges and points on brightness, 0.082 degrees wide: a Gaussian, its first and its second derivative, the
// derivatives scaled so that their positive and their negative weights sum to 1 and -1 each.
struct FeatureKernels {
    Kernel smooth, edge, point;
};
FeatureKernels feature_kernels(double pixels_per_degree);

// out[i] = sum over offsets k of weight_k * taps[radius + k][i], i = 0 .. count - 1. taps: 2 radius + 1 rows; out is none of
// them.
void weighted_sum(const Kernel& kernel, const float* const* taps, size_t count, float* out);

}  // namespace overlook::view
