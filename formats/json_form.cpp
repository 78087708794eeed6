// The form of a JSON document, checked with the place of the first mistake.
#include <algorithm>
#include <cmath>

#include "formats/json.h"
#include "formats/names.h"

namespace overlook::json {
namespace {

std::string_view kind_name(Kind kind) {
    switch (kind) {
        case Kind::null:
            return "null";
        case Kind::boolean:
            return "true or false";
        case Kind::number:
            return "a number";
        case Kind::text:
            return "text";
        case Kind::array:
            return "an array";
        case Kind::object:
            return "an object";
    }
    return "";
}

std::string wanted(const Member& member) {
    if (member.kind == Kind::number) return fmt::format("a number from {} to {}", member.least, member.most);
    if (member.kind == Kind::array && member.count > 0) return fmt::format("an array of {} numbers", member.count);
    return std::string(kind_name(member.kind));
}

std::string escaped(std::string_view name) {
    std::string out;
    for (char c : name) {
        if (c == '~')
            out += "~0";
        else if (c == '/')
            out += "~1";
        else
            out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
    return out;
}

const Member* find(std::span<const Member> members, std::string_view name) {
    auto found = std::find_if(members.begin(), members.end(), [&](const Member& member) { return member.name == name; });
    return found == members.end() ? nullptr : &*found;
}

std::string unknown_name(std::string_view name, std::span<const Member> members) {
    std::vector<std::string_view> names;
    for (const Member& member : members) names.push_back(member.name);
    std::string_view near = nearest(name.substr(0, 64), names);
    return near.empty() ? "is not known here" : fmt::format("is not known here; did you mean {}?", near);
}

}  // namespace

void Form::fail_at(Place place, const std::string& pointer, const std::string& what) {
    if (!is_right()) return;
    mistake_ = fmt::format("{}:{}:{}: {}{}{}", name_, place.line, place.column, pointer, pointer.empty() ? "" : ": ", what);
}

void Form::fail(const Node& node, const std::string& what) {
    if (node.value != nullptr) fail_at(node.value->place, node.pointer, what);
}

void Form::check_member(const Node& node, const Member& member) {
    const Value& value = *node.value;
    if (value.kind != member.kind) return fail(node, fmt::format("is {}; {} is wanted", kind_name(value.kind), wanted(member)));
    auto check_number = [&](const Node& number) {
        double given = number.value->number;
        if (!(given >= member.least && given <= member.most))
            fail(number, fmt::format("{} is outside {}..{}", given, member.least, member.most));
    };
    if (member.kind == Kind::number) check_number(node);
    if (member.kind != Kind::array) return;

    size_t count = value.items.size();
    if (member.count == 0) {
        if (double(count) < member.least || double(count) > member.most)
            fail(node, fmt::format("has {} items; {} to {} are wanted", count, member.least, member.most));
        return;
    }
    if (count != member.count) return fail(node, fmt::format("has {} items; {} numbers are wanted", count, member.count));
    for (const Node& item : items(node)) {
        if (item.value->kind != Kind::number)
            return fail(item, fmt::format("is {}; a number is wanted", kind_name(item.value->kind)));
        check_number(item);
    }
}

void Form::expect(const Node& object, std::span<const Member> members) {
    if (object.value == nullptr || !is_right()) return;
    const Value& value = *object.value;
    if (value.kind != Kind::object) return fail(object, fmt::format("is {}; an object is wanted", kind_name(value.kind)));
    for (size_t i = 0; i < value.names.size(); ++i) {
        std::string pointer = object.pointer + "/" + escaped(value.names[i]);
        const Member* known = find(members, value.names[i]);
        if (known == nullptr) return fail_at(value.name_places[i], pointer, unknown_name(value.names[i], members));
        check_member({&value.items[i], pointer}, *known);
    }
    for (const Member& known : members) {
        if (known.is_required && member(object, known.name).value == nullptr) fail(object, fmt::format("has no {}", known.name));
    }
}

Node Form::member(const Node& object, std::string_view name) const {
    if (object.value == nullptr || object.value->kind != Kind::object) return {};
    const std::vector<std::string>& names = object.value->names;
    auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) return {};
    return {&object.value->items[size_t(found - names.begin())], object.pointer + "/" + escaped(name)};
}

std::vector<Node> Form::items(const Node& node) const {
    std::vector<Node> nodes;
    if (node.value == nullptr || !is_right()) return nodes;
    const Value& value = *node.value;
    for (size_t i = 0; i < value.items.size(); ++i) {
        std::string name = value.kind == Kind::object ? escaped(value.names[i]) : std::to_string(i);
        nodes.push_back({&value.items[i], node.pointer + "/" + name});
    }
    return nodes;
}

double Form::number(const Node& object, std::string_view name, double otherwise) const {
    Node node = member(object, name);
    return node.value != nullptr && node.value->kind == Kind::number ? node.value->number : otherwise;
}

std::string Form::text(const Node& object, std::string_view name, const std::string& otherwise) const {
    Node node = member(object, name);
    return node.value != nullptr && node.value->kind == Kind::text ? node.value->text : otherwise;
}

void check_version(Form& form, int known) {
    Node node = form.member(form.root(), "version");
    if (node.value == nullptr || node.value->kind != Kind::number) return;
    double version = node.value->number;
    if (version != std::floor(version)) return form.fail(node, fmt::format("{} is no whole number", version));
    if (version > known) form.fail(node, fmt::format("{} is newer than this program, which reads up to {}", version, known));
}

std::string_view nearest(std::string_view wrong, std::span<const std::string_view> known) {
    std::string_view best;
    size_t best_edits = 0;
    for (std::string_view name : known) {
        size_t edits = edit_distance(wrong, name);
        if (best.empty() || edits < best_edits) {
            best = name;
            best_edits = edits;
        }
    }
    return best;
}

}  // namespace overlook::json
