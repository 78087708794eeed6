// The options that all commands share, and what stands in a --config file.

#include "runtime/command/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "formats/names.h"
#include "runtime/command/command.h"

namespace overlook::command {
namespace {

bool has(Uses uses, Uses what) {
    return (int(uses) & int(what)) != 0;
}

// "512M": digits, then nothing or one of K, M, G, T (powers of 1024), optionally followed by B or iB.
std::optional<uint64_t> bytes_from_text(const std::string& text) {
    constexpr uint64_t kMost = std::numeric_limits<uint64_t>::max();
    uint64_t value = 0;
    size_t i = 0;
    for (; i < text.size() && text[i] >= '0' && text[i] <= '9'; ++i) {
        uint64_t digit = uint64_t(text[i] - '0');
        if (value > (kMost - digit) / 10) return std::nullopt;
        value = value * 10 + digit;
    }
    if (i == 0) return std::nullopt;

    std::string unit = text.substr(i);
    std::transform(unit.begin(), unit.end(), unit.begin(), [](unsigned char c) { return char(std::toupper(c)); });
    if (unit.empty() || unit == "B") return value;
    size_t power = std::string("KMGT").find(unit[0]);
    std::string rest = unit.substr(1);
    if (power == std::string::npos || (!rest.empty() && rest != "B" && rest != "IB")) return std::nullopt;
    int shift = 10 * int(power + 1);
    if (value > kMost >> shift) return std::nullopt;
    return value << shift;
}

void collect_names(const CLI::App& app, std::vector<std::string>& names) {
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    for (const CLI::App* subcommand : app.get_subcommands(nullptr)) names.push_back(subcommand->get_name());
    for (const CLI::App* chosen : app.get_subcommands()) collect_names(*chosen, names);
}

// Whether a key of the file is meant for this command: it stands above all sections, or in the section of its name.
bool is_for(const CLI::App& app, const CLI::ConfigItem& item) {
    if (item.name == "++" || item.name == "--") return false;  // CLI11's marks of a section's beginning and end
    return item.parents.empty() || (item.parents.size() == 1 && item.parents[0] == app.get_name());
}

bool is_section_of_another_command(const CLI::App& app, const CLI::ConfigItem& item) {
    if (item.parents.empty() || app.get_parent() == nullptr) return false;
    for (const CLI::App* sibling : app.get_parent()->get_subcommands(nullptr)) {
        if (sibling != &app && sibling->get_name() == item.parents[0]) return true;
    }
    return false;
}

void take_config_item(CLI::App& app, const std::string& path, const CLI::ConfigItem& item) {
    CLI::Option* option = is_for(app, item) ? app.get_option_no_throw("--" + item.name) : nullptr;
    if (option == nullptr || !option->get_configurable()) {
        std::string near = nearest_name(app, "--" + item.name);
        std::string hint = near.empty() ? "" : "; did you mean \"" + near.substr(near.find_first_not_of('-')) + "\"?";
        throw CLI::ConfigError(path + ": \"" + item.fullname() + "\" is not a setting of this command" + hint);
    }
    if (!option->empty()) return;  // the command line goes before the file
    if (option->get_expected_min() == 0) {
        option->add_result(option->get_flag_value(item.name, app.get_config_formatter()->to_flag(item)));
    } else {
        option->add_result(item.inputs);
    }
    option->run_callback();
}

// CLI11 reads a configuration for the outermost command only; this one works for a subcommand as well.
void take_config(CLI::App& app, const std::string& path) {
    if (CLI::detail::check_path(path.c_str()) != CLI::detail::path_type::file) throw CLI::FileError::Missing(path);
    for (const CLI::ConfigItem& item : CLI::ConfigTOML().from_file(path)) {
        bool is_mark = item.name == "++" || item.name == "--";
        if (!is_mark && !is_section_of_another_command(app, item)) take_config_item(app, path, item);
    }
}

}  // namespace

std::string version_line() {
    return "overlook " OVERLOOK_VERSION;
}

std::string nearest_name(const CLI::App& app, const std::string& word) {
    std::vector<std::string> names;
    collect_names(app, names);
    std::string typed = word.substr(0, word.find('='));
    std::string nearest;
    size_t least = std::max<size_t>(2, typed.size() / 3) + 1;
    for (const std::string& name : names) {
        size_t distance = edit_distance(typed, name);
        if (distance < least) {
            least = distance;
            nearest = name;
        }
    }
    return nearest;
}

CLI::Validator number_in(double least, double most) {
    auto refusal = [least, most](const std::string& text) {
        double number = 0;
        bool is_in = CLI::detail::lexical_cast(text, number) && number >= least && number <= most;
        return is_in ? std::string() : fmt::format("{} is not a number from {:g} to {:g}", text, least, most);
    };
    return CLI::Validator(refusal, fmt::format("{:g}..{:g}", least, most), "number_in");
}

CLI::Option* add_bytes_option(CLI::App& app, const std::string& name, uint64_t& bytes, const std::string& help) {
    auto take = [&bytes, name](const std::string& text) {
        std::optional<uint64_t> read = bytes_from_text(text);
        if (!read) throw CLI::ValidationError(name, text + " is not a size such as 2000000, 512M or 4G");
        bytes = *read;
    };
    return app.add_option_function<std::string>(name, take, help)->type_name("BYTES");
}

void add_common(CLI::App& app, Common& common, Uses uses) {
    constexpr unsigned kMostThreads = 4096;
    const char* const group = "Common options";
    app.add_option("--threads", common.threads, "Threads to use; 0 = all. Never changes the result")
        ->check(CLI::Range(0u, kMostThreads))
        ->group(group);
    if (has(uses, Uses::memory)) {
        add_bytes_option(app, "--memory", common.memory_bytes, "Most memory to use: bytes, or with K, M, G, T; 0 = no cap")
            ->group(group);
    }
    if (has(uses, Uses::seed)) {
        app.add_option("--seed", common.seed, "Where random numbers begin; the same seed gives the same result")->group(group);
    }
    app.add_option_function<std::string>(
           "--config", [&app](const std::string& path) { take_config(app, path); },
           "TOML file with values for these options; the command line goes before it")
        ->type_name("FILE.toml")
        ->configurable(false)
        ->group(group);
    app.add_flag("--json", common.json, "Report in JSON on standard output")->group(group);
    CLI::Option* quiet = app.add_flag("--quiet", common.quiet, "Say nothing but errors")->group(group);
    app.add_flag("--verbose", common.verbose, "Say more")->excludes(quiet)->group(group);
    app.add_option("--progress", common.progress, "Show progress: auto (on a terminal), always or never")
        ->check(CLI::IsMember({"auto", "always", "never"}))
        ->group(group);
    if (app.get_version_ptr() == nullptr) app.set_version_flag("--version", version_line());
}

}  // namespace overlook::command
