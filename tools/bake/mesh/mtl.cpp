// Material libraries of OBJ files. Source: D. Ramey, L. Rose, L. Tyerman, "MTL material format (Lightwave, OBJ)", 1995.

#include <algorithm>
#include <cmath>

#include "tools/bake/mesh/obj.h"
#include "tools/bake/mesh/text.h"

namespace overlook::mesh {
namespace {

float unit(double value) {
    return std::isfinite(value) ? float(std::clamp(value, 0.0, 1.0)) : 1.0f;
}

// Three numbers, or one for all three; other ways to say a colour (a spectrum) are left.
void read_colour(Text& text, glm::vec4& colour) {
    double red = 0, green = 0, blue = 0;
    if (!text.number(red)) return;
    if (!text.number(green) || !text.number(blue)) green = blue = red;
    colour = {unit(red), unit(green), unit(blue), colour.a};
}

// How many values an option of a texture has at most.
int value_count(std::string_view option) {
    if (option == "-o" || option == "-s" || option == "-t") return 3;
    if (option == "-mm") return 2;
    for (const char* one : {"-blendu", "-blendv", "-cc", "-clamp", "-texres", "-bm", "-boost", "-imfchan", "-type"})
        if (option == one) return 1;
    return 0;
}

// The file name after options, which may hold spaces.
std::string read_map(Text& text) {
    std::string_view rest = text.rest();
    while (rest.starts_with('-')) {
        Text words(std::as_bytes(std::span(rest.data(), rest.size())));
        const std::string_view option = words.word();
        const bool has_words = option != "-o" && option != "-s" && option != "-t" && option != "-mm";
        double ignored = 0;
        for (int i = value_count(option); i > 0; --i) has_words ? void(words.word()) : void(words.number(ignored));
        rest = words.rest();
    }
    return std::string(rest);
}

void read_line(Text& text, std::string_view key, Surface& surface) {
    double value = 0;
    if (key == "Kd") {
        read_colour(text, surface.base_colour);
    } else if (key == "d" && text.number(value)) {
        surface.base_colour.a = unit(value);
    } else if (key == "Tr" && text.number(value)) {
        surface.base_colour.a = unit(1 - value);
    } else if (key == "map_Kd") {
        surface.texture = read_map(text);
    } else if (key == "map_d") {
        surface.is_alpha_masked = true;
    }
}

}  // namespace

void read_mtl(std::span<const uint8_t> bytes, MaterialLibrary& materials) {
    Text text(std::as_bytes(bytes));
    Surface ignored;
    Surface* current = &ignored;
    for (; text.find_line('#'); text.next_line()) {
        const std::string_view key = text.word();
        if (key == "newmtl") {
            const std::string name(text.rest());
            const auto [entry, is_new] = materials.try_emplace(name);
            entry->second.name = name;
            current = is_new ? &entry->second : &ignored;
        } else {
            read_line(text, key, *current);
        }
    }
}

}  // namespace overlook::mesh
