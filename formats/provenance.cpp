// The seam to nlohmann-json in this room: provenance to canonical JSON and back.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "formats/container_rules.h"

namespace overlook::container {
namespace {

using nlohmann::json;  // keeps the keys of an object in order
using Reason = tl::unexpected<std::string>;

std::string canonical(const json& document) {
    return document.dump(-1, ' ', false, json::error_handler_t::replace);
}

bool has_exactly_keys(const json& value, std::initializer_list<const char*> keys) {
    return value.is_object() && value.size() == keys.size() &&
           std::all_of(keys.begin(), keys.end(), [&](const char* key) { return value.contains(key); });
}

bool is_hash(const std::string& text) {
    return text.size() == 32 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

bool is_bare_name(const std::string& text) {
    return !text.empty() && text.find('/') == std::string::npos;
}

// Why a document is not provenance; empty if it is. Leaves no value deeper than three levels, so that walking it is safe.
std::string fault_of(const json& document) {
    if (!has_exactly_keys(document, {"inputs", "options", "program", "version"})) {
        return "it is not an object of exactly inputs, options, program and version";
    }
    if (!document["program"].is_string() || !document["version"].is_string()) return "program or version is not a string";
    if (!document["options"].is_object()) return "options is not an object";
    for (const auto& [name, value] : document["options"].items()) {
        if (!value.is_string()) return "an option's value is not a string";
    }
    if (!document["inputs"].is_array()) return "inputs is not an array";
    for (const json& input : document["inputs"]) {
        if (!has_exactly_keys(input, {"hash", "name"}) || !input["hash"].is_string() || !input["name"].is_string()) {
            return "an input is not an object of exactly the strings hash and name";
        }
        if (!is_hash(input["hash"].get_ref<const std::string&>())) return "an input's hash is not 32 hex digits";
        if (!is_bare_name(input["name"].get_ref<const std::string&>())) return "an input's name is empty or holds a folder";
    }
    return "";
}

}  // namespace

Result<std::string> json_from_provenance(const Provenance& provenance) {
    json options = json::object();
    for (const auto& [name, value] : provenance.options) options[name] = value;
    json inputs = json::array();
    for (const InputIdentity& input : provenance.inputs) inputs.push_back({{"hash", input.hash}, {"name", input.name}});
    json document = {{"inputs", std::move(inputs)},
                     {"options", std::move(options)},
                     {"program", provenance.program},
                     {"version", provenance.version}};

    std::string fault = fault_of(document);
    if (document["options"].size() != provenance.options.size()) fault = "an option's name stands twice";
    std::string text = canonical(document);
    if (text.size() > kMaxProvenanceBytes) fault = "it is longer than " + with_commas(kMaxProvenanceBytes) + " bytes";
    if (!fault.empty()) return tl::unexpected(Error{Exit::our_bug, "provenance cannot be written: " + fault});
    return text;
}

tl::expected<Provenance, std::string> provenance_from_json(std::string_view text) {
    json document = json::parse(text, nullptr, false);  // false: a discarded value instead of an exception
    if (document.is_discarded()) return Reason("it is not JSON");
    if (std::string fault = fault_of(document); !fault.empty()) return Reason(fault);
    if (canonical(document) != text)
        return Reason("its JSON is not in canonical form (keys in order, no key twice, no white space)");

    Provenance provenance;
    provenance.program = document["program"].get<std::string>();
    provenance.version = document["version"].get<std::string>();
    for (const auto& [name, value] : document["options"].items()) {
        provenance.options.emplace_back(name, value.get<std::string>());
    }
    for (const json& input : document["inputs"]) {
        provenance.inputs.push_back({input["name"].get<std::string>(), input["hash"].get<std::string>()});
    }
    return provenance;
}

}  // namespace overlook::container
