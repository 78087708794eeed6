#include "formats/setting.h"

#include <fmt/format.h>

#include <algorithm>

namespace overlook {

std::optional<double> value_of_word(const SettingKind& kind, std::string_view word) {
    auto found = std::find(kind.words.begin(), kind.words.end(), word);
    return found != kind.words.end() ? std::optional(double(found - kind.words.begin())) : std::nullopt;
}

std::string text_of(const SettingKind& kind, double value) {
    return kind.words.empty() ? fmt::format("{}", value) : std::string(kind.words[size_t(value)]);
}

std::string listed_words(const SettingKind& kind) {
    std::string list;
    for (size_t i = 0; i < kind.words.size(); ++i) {
        if (i > 0) list += i + 1 == kind.words.size() ? " or " : ", ";
        list += kind.words[i];
    }
    return list;
}

}  // namespace overlook
