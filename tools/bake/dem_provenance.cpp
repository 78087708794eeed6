#include "tools/bake/dem_provenance.h"

#include <array>
#include <charconv>
#include <cmath>

namespace overlook::dem {
namespace {

template <class Number>
bool parse_all(const std::string& text, Number& number) {
    auto [after, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
    return problem == std::errc() && after == text.data() + text.size();
}

// Shortest text that reads back as the same number.
std::string words_of(double number) {
    return fmt::format("{}", number);
}

}  // namespace

Result<Window> parse_window(const std::string& text) {
    std::array<uint32_t, 4> numbers{};
    size_t begin = 0;
    for (size_t i = 0; i < 4; ++i) {
        size_t end = i < 3 ? text.find(',', begin) : text.size();
        if (end == std::string::npos || !parse_all(text.substr(begin, end - begin), numbers[i]))
            return bad_command("--window {}: four whole numbers are wanted: X,Y,W,H in samples", text);
        begin = end + 1;
    }
    return Window{numbers[0], numbers[1], numbers[2], numbers[3]};
}

std::vector<std::pair<std::string, std::string>> options_in_words(const Options& options, const terrain::BakeOptions& bake) {
    std::vector<std::pair<std::string, std::string>> words;
    if (options.window)
        words.emplace_back("window", fmt::format("{},{},{},{}", options.window->x, options.window->y, options.window->width,
                                                 options.window->height));
    if (options.cell_size_m) words.emplace_back("cell-size-m", words_of(*options.cell_size_m));
    if (options.height_scale_m) words.emplace_back("height-scale-m", words_of(*options.height_scale_m));
    if (options.nodata) words.emplace_back("nodata", words_of(*options.nodata));
    if (bake.height_step_m != 0) words.emplace_back("height-step-m", words_of(bake.height_step_m));
    return words;
}

Result<Options> options_from_words(const container::Provenance& provenance) {
    Options options;
    for (const auto& [name, words] : provenance.options) {
        double number = 0;
        bool is_number = parse_all(words, number);
        if (name == "window") {
            auto window = parse_window(words);
            if (!window) return bad_input("its provenance has a window of \"{}\"", words);
            options.window = *window;
        } else if (name == "cell-size-m" || name == "height-scale-m" || name == "nodata") {
            if (!is_number) return bad_input("its provenance has a {} of \"{}\"", name, words);
            (name == "nodata" ? options.nodata : name == "cell-size-m" ? options.cell_size_m : options.height_scale_m) = number;
        }
    }
    return options;
}

}  // namespace overlook::dem
