// What a method can be set to by people: in a scene's layer, or on a command line.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace overlook {

// One setting; all are kept as numbers.
struct SettingKind {
    std::string_view name;  // words and hyphens: "low-error-px"; in a scene, whose names have none, "low_error_px"
    double least = 0, most = 0, otherwise = 0;
    bool is_whole = false;
    bool is_seldom = false;  // changed: labels name it only where it is not the default
    bool is_switch = false;  // 0 or 1; in a scene true or false
    // Of one that is chosen by word, everywhere: words[i] stands for i; then least is 0 and most their count less one.
    std::span<const std::string_view> words = {};
};

// The number that a word stands for, if the setting has the word.
std::optional<double> value_of_word(const SettingKind& kind, std::string_view word);
// As people write it: "0.5", "sliced". value: one of the setting's.
std::string text_of(const SettingKind& kind, double value);
// "at-once, thread or sliced"; of a setting that has words.
std::string listed_words(const SettingKind& kind);

}  // namespace overlook
