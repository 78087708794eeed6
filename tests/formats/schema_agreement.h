// Whether a JSON Schema says what a parser checks, as far as tables can tell: names, kinds, required names, ranges, counts.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string>

#include "formats/json.h"

namespace overlook::test {

inline nlohmann::json schema(const std::string& name) {
    return nlohmann::json::parse(std::ifstream(OVERLOOK_SOURCE_DIR "/samples/schema/" + name));
}

// The part that "$ref": "#/..." leads to, or the part itself.
inline const nlohmann::json& resolved(const nlohmann::json& whole, const nlohmann::json& part) {
    if (!part.contains("$ref")) return part;
    return whole.at(nlohmann::json::json_pointer(part["$ref"].get<std::string>().substr(1)));
}

inline void expect_member_agrees(const nlohmann::json& part, const json::Member& member) {
    static const char* const kTypes[] = {"null", "boolean", "number", "string", "array", "object"};
    EXPECT_EQ(part.at("type"), kTypes[size_t(member.kind)]) << member.name;
    if (member.kind == json::Kind::number) {
        EXPECT_EQ(part.at("minimum").get<double>(), member.least) << member.name;
        EXPECT_EQ(part.at("maximum").get<double>(), member.most) << member.name;
    }
    if (member.kind != json::Kind::array) return;
    bool is_counted = member.count > 0;
    EXPECT_EQ(part.at("minItems").get<double>(), is_counted ? member.count : member.least) << member.name;
    EXPECT_EQ(part.at("maxItems").get<double>(), is_counted ? member.count : member.most) << member.name;
    if (!is_counted) return;
    EXPECT_EQ(part.at("items").at("minimum").get<double>(), member.least) << member.name;
    EXPECT_EQ(part.at("items").at("maximum").get<double>(), member.most) << member.name;
}

inline void expect_object_agrees(const nlohmann::json& whole, const std::string& pointer, std::span<const json::Member> members) {
    const nlohmann::json& object = whole.at(nlohmann::json::json_pointer(pointer));
    EXPECT_EQ(object.at("type"), "object") << pointer;
    EXPECT_EQ(object.at("additionalProperties"), false) << pointer;
    std::set<std::string> required, required_here;
    if (object.contains("required")) required = object["required"].get<std::set<std::string>>();
    EXPECT_EQ(object.at("properties").size(), members.size()) << pointer;
    for (const json::Member& member : members) {
        if (member.is_required) required_here.insert(std::string(member.name));
        ASSERT_TRUE(object["properties"].contains(member.name)) << pointer << ": " << member.name;
        expect_member_agrees(resolved(whole, object["properties"][std::string(member.name)]), member);
    }
    EXPECT_EQ(required, required_here) << pointer;
}

}  // namespace overlook::test
