// Errors in metres as 8-bit codes that keep the bound: each code stands for an error at least as large as any that it was given
// for.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace overlook::terrain {

struct ErrorCodes {
    std::array<float, 256> error_m{};         // as Terrain::error_m
    std::vector<std::vector<uint8_t>> codes;  // as Terrain::codes
};

// errors_in_steps: as measure_split_errors gives them; the error in metres is finest_error_m + step_m * errors_in_steps.
//
// Code 0 is finest_error_m and 255 infinity; the others divide the range between the least and greatest error evenly on a
// logarithmic scale, with borders at every 1, 2 and 5 times a power of ten: a tolerance that a person asks for loses nothing to
// the coding. Each code's error is the greatest that was given it, so that coding never lowers an error, keeps their order and
// raises few.
ErrorCodes encode_errors(const std::vector<std::vector<float>>& errors_in_steps, double step_m, double finest_error_m);

}  // namespace overlook::terrain
