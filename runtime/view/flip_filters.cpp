#include "runtime/view/flip_filters.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace overlook::view {
namespace {

constexpr double kSquarePi = std::numbers::pi * std::numbers::pi;

// a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees: the inverse Fourier transform of the sensitivity a exp(-b f^2).
struct Gaussian {
    double a, b;

    double sigma_deg() const { return std::sqrt(b / (2 * kSquarePi)); }
    double height() const { return a * std::sqrt(std::numbers::pi / b); }
};
constexpr Gaussian kBrightness{1, 0.0047}, kRedGreen{1, 0.0053}, kYellowBlueWide{34.1, 0.04}, kYellowBlueNarrow{13.5, 0.025};

constexpr double kFeatureWidthDeg = 0.082;

// The paper cuts all Gaussians at three sigma of the widest. Five sigma of its own change nothing that a float could show.
int radius_of(const Gaussian& gaussian, double pixels_per_degree) {
    double common = std::ceil(3 * kYellowBlueWide.sigma_deg() * pixels_per_degree);
    return int(std::min(common, std::ceil(5 * gaussian.sigma_deg() * pixels_per_degree)));
}

std::vector<double> sampled(int radius, const std::function<double(double offset)>& value) {
    std::vector<double> weights;
    for (int k = 0; k <= radius; ++k) weights.push_back(value(k));
    return weights;
}

double sum_of(const std::vector<double>& weights) {
    double sum = 0;
    for (size_t k = 0; k < weights.size(); ++k) sum += k == 0 ? weights[k] : 2 * weights[k];
    return sum;
}

std::vector<double> sampled(const Gaussian& gaussian, double pixels_per_degree) {
    return sampled(radius_of(gaussian, pixels_per_degree), [&](double offset) {
        double x_deg = offset / pixels_per_degree;
        return std::exp(-kSquarePi * x_deg * x_deg / gaussian.b);
    });
}

Kernel kernel_of(const std::vector<double>& weights, double scale) {
    Kernel kernel;
    for (double weight : weights) kernel.weights.push_back(float(weight * scale));
    return kernel;
}

Kernel unit_kernel(const Gaussian& gaussian, double pixels_per_degree) {
    std::vector<double> weights = sampled(gaussian, pixels_per_degree);
    return kernel_of(weights, 1 / sum_of(weights));
}

// Scales what is positive and what is negative to 1 and -1, each summed over both sides.
Kernel balanced(std::vector<double> weights) {
    double positive = 0, negative = 0;
    for (size_t k = 0; k < weights.size(); ++k) (weights[k] > 0 ? positive : negative) += (k == 0 ? 1 : 2) * std::abs(weights[k]);
    for (double& weight : weights) {
        double sum = weight > 0 ? positive : negative;
        weight = sum > 0 ? weight / sum : 0;
    }
    return kernel_of(weights, 1);
}

}  // namespace

EyeKernels eye_kernels(double pixels_per_degree) {
    EyeKernels kernels;
    kernels.brightness = unit_kernel(kBrightness, pixels_per_degree);
    kernels.red_green = unit_kernel(kRedGreen, pixels_per_degree);
    kernels.yellow_blue_narrow = unit_kernel(kYellowBlueNarrow, pixels_per_degree);
    kernels.yellow_blue_wide = unit_kernel(kYellowBlueWide, pixels_per_degree);

    auto volume = [&](const Gaussian& gaussian) {
        double sum = sum_of(sampled(gaussian, pixels_per_degree));
        return gaussian.height() * sum * sum;
    };
    double narrow = volume(kYellowBlueNarrow), wide = volume(kYellowBlueWide);
    kernels.narrow_share = float(narrow / (narrow + wide));
    kernels.wide_share = float(wide / (narrow + wide));
    return kernels;
}

FeatureKernels feature_kernels(double pixels_per_degree) {
    double sigma = 0.5 * kFeatureWidthDeg * pixels_per_degree;
    int radius = int(std::ceil(3 * sigma));
    auto gaussian = [&](double x) { return std::exp(-x * x / (2 * sigma * sigma)); };

    FeatureKernels kernels;
    std::vector<double> smooth = sampled(radius, gaussian);
    kernels.smooth = kernel_of(smooth, 1 / sum_of(smooth));
    std::vector<double> slope = sampled(radius, [&](double x) { return x * gaussian(x); });
    kernels.edge = kernel_of(slope, 2 / sum_of(slope));  // half the sum over both sides is one side's
    kernels.edge.is_odd = true;
    kernels.point = balanced(sampled(radius, [&](double x) { return (x * x / (sigma * sigma) - 1) * gaussian(x); }));
    return kernels;
}

void weighted_sum(const Kernel& kernel, const float* const* taps, size_t count, float* out) {
    const float* const* middle = taps + kernel.radius();
    for (size_t i = 0; i < count; ++i) out[i] = kernel.weights[0] * middle[0][i];
    for (int k = 1; k <= kernel.radius(); ++k) {
        const float weight = kernel.weights[size_t(k)];
        const float *after = middle[k], *before = middle[-k];
        if (kernel.is_odd)
            for (size_t i = 0; i < count; ++i) out[i] += weight * (after[i] - before[i]);
        else
            for (size_t i = 0; i < count; ++i) out[i] += weight * (after[i] + before[i]);
    }
}

}  // namespace overlook::view
