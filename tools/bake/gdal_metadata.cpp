#include "tools/bake/gdal_metadata.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace overlook::dem {
namespace {

bool has(std::string_view text, std::string_view what) {
    return text.find(what) != std::string_view::npos;
}

// The text of the first item of the first channel with a role; none if there is none.
std::optional<std::string_view> item_text(std::string_view xml, std::string_view role) {
    for (size_t at = xml.find("<Item"); at != std::string_view::npos; at = xml.find("<Item", at + 1)) {
        size_t head_end = xml.find('>', at);
        if (head_end == std::string_view::npos) return std::nullopt;
        std::string_view head = xml.substr(at, head_end - at);
        bool is_first_channel = !has(head, "sample=") || has(head, "sample=\"0\"");
        size_t text_end = xml.find('<', head_end);
        if (!is_first_channel || !has(head, role) || text_end == std::string_view::npos) continue;
        return xml.substr(head_end + 1, text_end - head_end - 1);
    }
    return std::nullopt;
}

// Leaves `value` as it is where the item is missing; false if its text is no finite number.
bool read_item(std::string_view xml, std::string_view role, double& value, std::string& shown) {
    std::optional<std::string_view> text = item_text(xml, role);
    if (!text) return true;
    shown.assign(text->substr(0, 40));
    std::replace_if(
        shown.begin(), shown.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    auto [end, problem] = std::from_chars(text->data(), text->data() + text->size(), value);
    return problem == std::errc() && end == text->data() + text->size() && std::isfinite(value);
}

}  // namespace

Result<ValueScale> value_scale_of(std::string_view xml, const std::string& name) {
    ValueScale result;
    std::string shown;
    if (!read_item(xml, "role=\"scale\"", result.scale, shown) || result.scale == 0)
        return bad_input("{}: GDAL_METADATA gives a scale of \"{}\"; a number other than 0 is wanted", name, shown);
    if (!read_item(xml, "role=\"offset\"", result.offset, shown))
        return bad_input("{}: GDAL_METADATA gives an offset of \"{}\"; a number is wanted", name, shown);
    return result;
}

}  // namespace overlook::dem
