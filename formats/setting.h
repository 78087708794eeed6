// What a method can be set to by people: in a scene's layer, or on a command line.
#pragma once

#include <string_view>

namespace overlook {

// One setting; all are numbers.
struct SettingKind {
    std::string_view name;  // words and hyphens: "low-error-px"; in a scene, whose names have none, "low_error_px"
    double least = 0, most = 0, otherwise = 0;
    bool is_whole = false;
    bool is_seldom = false;  // changed: labels name it only where it is not the default
    bool is_switch = false;  // 0 or 1; in a scene true or false
};

}  // namespace overlook
