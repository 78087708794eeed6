// Values of a glTF file's JSON with the place of the first mistake. Templates, so that no header names the JSON library.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "formats/result.h"
#include "tools/bake/mesh.h"

namespace overlook::mesh::gltf {

// Json is the library's value type.
template <class Json>
class Values {
  public:
    explicit Values(std::string name) : name_(std::move(name)) {}

    bool is_right() const { return mistake_.empty(); }
    tl::unexpected<Error> mistake() const { return tl::unexpected(Error{Exit::bad_input, mistake_}); }
    void fail(const std::string& place, const std::string& what) {
        if (is_right()) mistake_ = fmt::format("{}: {}: {}", name_, place, what);
    }

    // A member, or a null value if it is not there.
    static const Json& member(const Json& object, const char* key) {
        static const Json kNull;
        if (!object.is_object()) return kNull;
        const auto found = object.find(key);
        return found == object.end() ? kNull : *found;
    }
    // A member that must be an array; an empty one if it is not there.
    const Json& array(const Json& object, const char* key, const std::string& place) {
        static const Json kEmpty = Json::array();
        const Json& value = member(object, key);
        if (value.is_null()) return kEmpty;
        if (value.is_array()) return value;
        fail(place + "/" + key, "is no array");
        return kEmpty;
    }
    double number(const Json& object, const char* key, double otherwise, const std::string& place) {
        const Json& value = member(object, key);
        if (value.is_null()) return otherwise;
        if (value.is_number()) return value.template get<double>();
        fail(place + "/" + key, "is no number");
        return otherwise;
    }
    // A whole number of 0..2^53.
    uint64_t whole(const Json& object, const char* key, uint64_t otherwise, const std::string& place) {
        const double value = number(object, key, double(otherwise), place);
        if (value >= 0 && value <= 0x1p53 && value == std::floor(value)) return uint64_t(value);
        fail(place + "/" + key, "is no whole number of 0 or more");
        return otherwise;
    }
    // The number of one of `count` things; kNone if it is not there.
    uint32_t reference(const Json& object, const char* key, size_t count, const std::string& place) {
        if (member(object, key).is_null()) return kNone;
        const uint64_t value = whole(object, key, 0, place);
        if (value < count) return uint32_t(value);
        fail(place + "/" + key, fmt::format("{} does not exist, there are {}", value, count));
        return kNone;
    }
    uint32_t needed_reference(const Json& object, const char* key, size_t count, const std::string& place) {
        if (member(object, key).is_null()) fail(place, fmt::format("has no {}", key));
        return reference(object, key, count, place);
    }
    std::string text(const Json& object, const char* key) {
        const Json& value = member(object, key);
        return value.is_string() ? value.template get<std::string>() : std::string();
    }
    bool boolean(const Json& object, const char* key) {
        const Json& value = member(object, key);
        return value.is_boolean() && value.template get<bool>();
    }
    // `count` numbers; false, and `to` stays, if there is no such member.
    bool numbers(const Json& object, const char* key, double* to, size_t count, const std::string& place) {
        const Json& value = member(object, key);
        if (value.is_null()) return false;
        bool is_right = value.is_array() && value.size() == count;
        for (size_t i = 0; is_right && i < count; ++i) is_right = value[i].is_number();
        if (!is_right) {
            fail(place + "/" + key, fmt::format("is not {} numbers", count));
            return false;
        }
        for (size_t i = 0; i < count; ++i) to[i] = value[i].template get<double>();
        return true;
    }

  private:
    std::string name_;
    std::string mistake_;
};

}  // namespace overlook::mesh::gltf
