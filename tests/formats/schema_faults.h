// What of a JSON value its schema does not allow; as much of JSON Schema as ours uses.
#pragma once

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

namespace overlook::test {

class SchemaFaults {
  public:
    explicit SchemaFaults(const nlohmann::json& schema) : schema_(schema) {}

    // "/place: what is wrong" of each fault.
    std::vector<std::string> of(const nlohmann::json& value) {
        faults_.clear();
        check(schema_, value, "");
        return faults_;
    }

  private:
    using Json = nlohmann::json;

    const Json& resolved(const Json& part) const {
        return part.contains("$ref") ? schema_.at(Json::json_pointer(part["$ref"].get<std::string>().substr(1))) : part;
    }
    static bool is_of(const std::string& type, const Json& value) {
        if (type == "object") return value.is_object();
        if (type == "array") return value.is_array();
        if (type == "string") return value.is_string();
        if (type == "boolean") return value.is_boolean();
        if (type == "integer") return value.is_number_integer();
        return type == "null" ? value.is_null() : value.is_number();
    }
    void fault(const std::string& place, const std::string& what) { faults_.push_back(place + ": " + what); }

    void check(const Json& reference, const Json& value, const std::string& place) {
        const Json& part = resolved(reference);
        if (part.contains("type")) {
            bool is_right = false;
            for (const Json& one : part["type"].is_array() ? part["type"] : Json::array({part["type"]}))
                is_right = is_right || is_of(one, value);
            if (!is_right) return fault(place, "another type");
        }
        if (part.contains("const") && part["const"] != value) fault(place, "another value");
        if (part.contains("enum") && !std::count(part["enum"].begin(), part["enum"].end(), value)) fault(place, "no such value");
        if (value.is_number()) check_number(part, value, place);
        if (value.is_string() && part.contains("pattern") &&
            !std::regex_search(value.get<std::string>(), std::regex(part["pattern"].get<std::string>())))
            fault(place, "another form");
        if (value.is_array()) {
            if (value.size() < part.value("minItems", size_t(0))) fault(place, "too few");
            for (const Json& one : value) check(part.at("items"), one, place + "[]");
        }
        if (value.is_object()) check_members(part, value, place);
    }
    void check_number(const Json& part, const Json& value, const std::string& place) {
        double number = value.get<double>();
        if (part.contains("minimum") && number < part["minimum"].get<double>()) fault(place, "too little");
        if (part.contains("exclusiveMinimum") && number <= part["exclusiveMinimum"].get<double>()) fault(place, "too little");
        if (part.contains("maximum") && number > part["maximum"].get<double>()) fault(place, "too much");
    }
    void check_members(const Json& part, const Json& value, const std::string& place) {
        const Json none = Json::object();
        const Json& properties = part.contains("properties") ? part["properties"] : none;
        for (const Json& name : part.value("required", Json::array())) {
            if (!value.contains(name)) fault(place, "lacks " + name.get<std::string>());
        }
        for (const auto& [name, member] : value.items()) {
            if (properties.contains(name))
                check(properties[name], member, place + "/" + name);
            else if (part.at("additionalProperties").is_object())
                check(part["additionalProperties"], member, place + "/" + name);
            else
                fault(place, "has " + name);
        }
    }

    const Json& schema_;
    std::vector<std::string> faults_;
};

// Of a value against samples/schema/NAME.
inline std::vector<std::string> faults_of(const nlohmann::json& value, const std::string& name) {
    nlohmann::json schema = nlohmann::json::parse(std::ifstream(OVERLOOK_SOURCE_DIR "/samples/schema/" + name));
    return SchemaFaults(schema).of(value);
}

}  // namespace overlook::test
