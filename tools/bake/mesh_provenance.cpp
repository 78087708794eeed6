#include "tools/bake/mesh_provenance.h"

#include <charconv>

namespace overlook::mesh {
namespace {

// One option that is a number: its name, where it is kept, and between what it makes sense.
struct Choice {
    const char* name;
    double (*get)(const BakeChoices&);
    void (*set)(BakeChoices&, double);
    double least, most;
};

const Choice kChoices[] = {
    {"metres-per-unit", [](const BakeChoices& c) { return c.input.metres_per_unit; },
     [](BakeChoices& c, double v) { c.input.metres_per_unit = v; }, 1e-9, 1e9},
    {"up-axis", [](const BakeChoices& c) { return double(c.input.up); },
     [](BakeChoices& c, double v) { c.input.up = Up(uint8_t(v)); }, 0, 2},
    {"crease-deg", [](const BakeChoices& c) { return c.bake.groups.crease_deg; },
     [](BakeChoices& c, double v) { c.bake.groups.crease_deg = v; }, 0, 180},
    {"weld-normals-deg", [](const BakeChoices& c) { return c.bake.groups.weld_normals_deg; },
     [](BakeChoices& c, double v) { c.bake.groups.weld_normals_deg = v; }, 0, 90},
    {"ignore-uv", [](const BakeChoices& c) { return double(c.bake.groups.ignores_uv); },
     [](BakeChoices& c, double v) { c.bake.groups.ignores_uv = v != 0; }, 0, 1},
    {"position-bits", [](const BakeChoices& c) { return double(c.bake.precision.position_bits); },
     [](BakeChoices& c, double v) { c.bake.precision.position_bits = uint32_t(v); }, 8, 20},
    {"seams-move", [](const BakeChoices& c) { return double(c.bake.simplify.seams.moves); },
     [](BakeChoices& c, double v) { c.bake.simplify.seams.moves = v != 0; }, 0, 1},
    {"seam-texels", [](const BakeChoices& c) { return c.bake.simplify.seams.uv_texels; },
     [](BakeChoices& c, double v) { c.bake.simplify.seams.uv_texels = v; }, 0, 1e6},
    {"seam-deg", [](const BakeChoices& c) { return c.bake.simplify.seams.normal_deg; },
     [](BakeChoices& c, double v) { c.bake.simplify.seams.normal_deg = v; }, 0, 180},
    {"keep-thin", [](const BakeChoices& c) { return double(c.bake.simplify.keeps_thin); },
     [](BakeChoices& c, double v) { c.bake.simplify.keeps_thin = v != 0; }, 0, 1},
    {"uv-bits", [](const BakeChoices& c) { return double(c.bake.precision.uv_bits); },
     [](BakeChoices& c, double v) { c.bake.precision.uv_bits = uint32_t(v); }, 8, 20},
    {"normal-bits", [](const BakeChoices& c) { return double(c.bake.precision.normal_bits); },
     [](BakeChoices& c, double v) { c.bake.precision.normal_bits = uint32_t(v); }, 6, 16},
};

const Choice* find_choice(const std::string& name) {
    for (const Choice& choice : kChoices)
        if (name == choice.name) return &choice;
    return nullptr;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> options_in_words(const BakeChoices& choices) {
    std::vector<std::pair<std::string, std::string>> words;
    const BakeChoices defaults;
    for (const Choice& choice : kChoices)
        if (choice.get(choices) != choice.get(defaults)) words.emplace_back(choice.name, fmt::format("{}", choice.get(choices)));
    return words;
}

Result<BakeChoices> choices_from_words(const container::Provenance& provenance) {
    BakeChoices choices;
    for (const auto& [name, words] : provenance.options) {
        const Choice* choice = find_choice(name);
        if (choice == nullptr) continue;
        double number = 0;
        auto [after, problem] = std::from_chars(words.data(), words.data() + words.size(), number);
        bool is_number = problem == std::errc() && after == words.data() + words.size();
        if (!is_number || !(number >= choice->least && number <= choice->most))
            return bad_input("its provenance has a {} of \"{}\"", name, words);
        choice->set(choices, number);
    }
    return choices;
}

}  // namespace overlook::mesh
