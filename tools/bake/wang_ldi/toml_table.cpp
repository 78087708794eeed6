#include "tools/bake/wang_ldi/toml_table.h"

#include <toml++/toml.h>
#include <algorithm>
#include <cmath>

#include "formats/mapped_file.h"
#include "formats/names.h"

namespace overlook::wang_ldi {

struct TomlTable::Node {
    std::shared_ptr<const toml::table> root;  // owns what table points to
    const toml::table* table;
};

Result<TomlTable> TomlTable::open(const std::string& path) {
    auto file = MappedFile::open(path);
    if (!file) return tl::unexpected(file.error());
    std::string_view text(reinterpret_cast<const char*>(file->bytes().data()), file->bytes().size());
    TomlTable made;
    try {
        auto root = std::make_shared<const toml::table>(toml::parse(text, path));
        made.node_ = std::make_shared<const Node>(Node{root, root.get()});
    } catch (const toml::parse_error& error) {
        std::string why(error.description());
        std::replace(why.begin(), why.end(), '\n', ' ');
        return bad_input("{}:{}: {}", path, error.source().begin.line, why);
    }
    made.path_ = path;
    return made;
}

void TomlTable::need(const std::string& key) {
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
}

bool TomlTable::has(const std::string& key) const {
    return node_->table->contains(key);
}

void TomlTable::refuse(const std::string& key, const std::string& text) {
    if (error_) return;
    const toml::node* node = node_->table->get(key);
    const toml::source_region& at = node ? node->source() : node_->table->source();
    std::string line = at.begin.line > 0 ? fmt::format(":{}", at.begin.line) : "";
    error_ = Error{Exit::bad_input, fmt::format("{}{}: {}{}: {}", path_, line, place_, key, text)};
}

double TomlTable::number(const std::string& key, double otherwise, double least, double most) {
    need(key);
    const toml::node* node = node_->table->get(key);
    if (!node) return otherwise;
    std::optional<double> value = node->is_number() ? node->value<double>() : std::nullopt;
    if (value && *value >= least && *value <= most) return *value;
    refuse(key, value ? fmt::format("{:g} is not a number from {:g} to {:g}", *value, least, most)
                      : fmt::format("a number from {:g} to {:g} is wanted", least, most));
    return otherwise;
}

uint64_t TomlTable::count(const std::string& key, uint64_t otherwise, uint64_t least, uint64_t most) {
    need(key);
    const toml::node* node = node_->table->get(key);
    if (!node) return otherwise;
    std::optional<int64_t> value = node->is_integer() ? node->value<int64_t>() : std::nullopt;
    if (value && *value >= 0 && uint64_t(*value) >= least && uint64_t(*value) <= most) return uint64_t(*value);
    refuse(key, fmt::format("a whole number from {} to {} is wanted", least, most));
    return otherwise;
}

bool TomlTable::flag(const std::string& key, bool otherwise) {
    need(key);
    const toml::node* node = node_->table->get(key);
    if (!node) return otherwise;
    if (node->is_boolean()) return *node->value<bool>();
    refuse(key, "true or false is wanted");
    return otherwise;
}

std::string TomlTable::text(const std::string& key, const std::string& otherwise) {
    need(key);
    const toml::node* node = node_->table->get(key);
    if (!node) return otherwise;
    if (node->is_string()) return *node->value<std::string>();
    refuse(key, "a text in quotes is wanted");
    return otherwise;
}

std::string TomlTable::word(const std::string& key, const std::string& otherwise) {
    const toml::node* node = node_->table->get(key);
    if (!node || !node->is_integer()) return text(key, otherwise);
    need(key);
    return fmt::format("{}", *node->value<int64_t>());
}

std::vector<double> TomlTable::numbers(const std::string& key, double least, double most) {
    need(key);
    std::vector<double> values;
    const toml::node* node = node_->table->get(key);
    if (!node) return values;
    const toml::array* array = node->as_array();
    if (!array) {
        refuse(key, "numbers in brackets are wanted");
        return values;
    }
    for (const toml::node& each : *array) {
        std::optional<double> value = each.is_number() ? each.value<double>() : std::nullopt;
        if (!value || !(*value >= least && *value <= most)) {
            refuse(key, fmt::format("numbers from {:g} to {:g} are wanted", least, most));
            return {};
        }
        values.push_back(*value);
    }
    return values;
}

std::array<double, 2> TomlTable::range(const std::string& key, std::array<double, 2> otherwise, double least, double most) {
    need(key);
    const toml::node* node = node_->table->get(key);
    if (!node) return otherwise;
    if (!node->is_array()) {
        double value = number(key, otherwise[0], least, most);
        return {value, value};
    }
    std::vector<double> values = numbers(key, least, most);
    if (values.size() != 2) {
        refuse(key, fmt::format("two numbers from {:g} to {:g} are wanted, the smaller first", least, most));
        return otherwise;
    }
    if (values[0] > values[1])
        refuse(key, fmt::format("{:g} to {:g} is no range: the smaller comes first", values[0], values[1]));
    return {values[0], values[1]};
}

std::vector<TomlTable> TomlTable::tables(const std::string& key) {
    need(key);
    std::vector<TomlTable> made;
    const toml::node* node = node_->table->get(key);
    if (!node) return made;
    const toml::array* array = node->as_array();
    if (!array || !array->is_array_of_tables()) {
        refuse(key, fmt::format("tables are wanted: [[{}]]", key));
        return made;
    }
    for (const toml::node& each : *array) {
        TomlTable& table = made.emplace_back(TomlTable());
        table.node_ = std::make_shared<const Node>(Node{node_->root, each.as_table()});
        table.path_ = path_, table.place_ = fmt::format("{}{} {}: ", place_, key, made.size());
    }
    return made;
}

Result<void> TomlTable::finish() {
    for (const auto& [key, node] : *node_->table) {
        std::string name(key.str());
        if (error_ || std::find(known_.begin(), known_.end(), name) != known_.end()) continue;
        auto nearest = std::min_element(known_.begin(), known_.end(), [&](const std::string& a, const std::string& b) {
            return edit_distance(name, a) < edit_distance(name, b);
        });
        bool is_near = nearest != known_.end() && edit_distance(name, *nearest) <= std::max<size_t>(2, name.size() / 2);
        std::string hint = is_near ? fmt::format("; did you mean \"{}\"?", *nearest) : "";
        error_ = Error{Exit::bad_input,
                       fmt::format("{}:{}: {}\"{}\" is not a key here{}", path_, key.source().begin.line, place_, name, hint)};
    }
    if (error_) return tl::unexpected(*error_);
    return {};
}

}  // namespace overlook::wang_ldi
