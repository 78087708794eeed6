// The methods that are held beside each other.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "tools/measure/method.h"

namespace overlook::measure::paper::fsi {

struct Way {
    std::string_view name;    // as it stands on the page: "fsi:paper"
    std::string_view method;  // as of measure's --method: "discrete:fsi-paper"
    bool fades = true;        // takes its time from level to level
};
inline constexpr std::array<Way, 6> kWays = {{{"switch", "discrete:switch", false},
                                              {"blend", "discrete:blend", true},
                                              {"dither", "discrete:dither", true},
                                              {"late", "discrete:late", false},
                                              {"fsi:paper", "discrete:fsi-paper", true},
                                              {"fsi", "discrete", true}}};
constexpr size_t kSwitch = 0, kBlend = 1, kDither = 2, kLate = 3, kPaper = 4, kOwn = 5;

// settings: "@error-px=2@samples=1"; must be of the way (asserted).
MethodSpec spec_of(const Way& way, const std::string& settings);

}  // namespace overlook::measure::paper::fsi
