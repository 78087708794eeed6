// The header of PLY files. Source: G. Turk, "The PLY Polygon File Format", 1994.

#include "tools/bake/mesh/ply_header.h"

#include <algorithm>

namespace overlook::mesh {
namespace {

constexpr size_t kMostElements = 100, kMostProperties = 1000;

bool type_from(std::string_view word, PlyType& type) {
    static constexpr std::string_view kNames[][2] = {{"char", "int8"},     {"uchar", "uint8"},   {"short", "int16"},
                                                     {"ushort", "uint16"}, {"int", "int32"},     {"uint", "uint32"},
                                                     {"float", "float32"}, {"double", "float64"}};
    for (size_t i = 0; i < std::size(kNames); ++i) {
        if (word != kNames[i][0] && word != kNames[i][1]) continue;
        type = PlyType(i);
        return true;
    }
    return false;
}

class HeaderReader {
  public:
    HeaderReader(Text& text, const std::string& name) : text_(text), name_(name) {}

    Result<PlyHeader> read() {
        if (text_.word() != "ply") return bad_input("{}: does not begin with the line ply", name_);
        text_.next_line();
        for (;; text_.next_line()) {
            if (text_.is_at_end()) return bad_input("{}: ends within its header; was it cut short?", name_);
            const std::string_view key = text_.word();
            if (key == "end_header") break;
            if (auto r = read_line(key); !r) return tl::unexpected(r.error());
        }
        if (!has_format_) return bad_input("{}: its header does not say its format", name_);
        text_.next_line();
        return check_counts();
    }

  private:
    tl::unexpected<Error> mistake(const char* what) const { return bad_input("{}:{}: {}", name_, text_.line(), what); }

    Result<void> read_line(std::string_view key) {
        if (key == "format") return read_format();
        if (key == "element") return read_element();
        if (key == "property") return read_property();
        if (key == "comment" && text_.word() == "TextureFile") header_.textures.emplace_back(text_.rest());
        if (key == "comment" || key == "obj_info" || key.empty()) return {};
        return mistake("is no line of a PLY header: format, comment, element, property or end_header is expected");
    }

    Result<void> read_format() {
        const std::string_view form = text_.word();
        has_format_ = true;
        if (form == "ascii")
            header_.form = PlyForm::ascii;
        else if (form == "binary_little_endian")
            header_.form = PlyForm::little_endian;
        else if (form == "binary_big_endian")
            header_.form = PlyForm::big_endian;
        else
            return mistake("the format is none of ascii, binary_little_endian and binary_big_endian");
        if (text_.word() != "1.0") return mistake("only PLY 1.0 is read");
        return {};
    }

    Result<void> read_element() {
        PlyElement element;
        element.name = text_.word();
        int64_t count = -1;
        if (element.name.empty() || !text_.integer(count) || count < 0) return mistake("an element is a name and a count");
        if (header_.elements.size() == kMostElements) return mistake("more than 100 elements");
        element.count = uint64_t(count);
        header_.elements.push_back(std::move(element));
        return {};
    }

    Result<void> read_property() {
        if (header_.elements.empty()) return mistake("a property before the first element");
        PlyProperty property;
        std::string_view word = text_.word();
        property.is_list = word == "list";
        if (property.is_list) {
            if (!type_from(text_.word(), property.count_type)) return mistake("the type of a list's count is not known");
            if (property.count_type >= PlyType::float32) return mistake("a list's count is a whole number, not a float");
            word = text_.word();
        }
        if (!type_from(word, property.type)) return mistake("the type of a property is not known");
        property.name = text_.word();
        if (property.name.empty()) return mistake("a property without a name");
        std::vector<PlyProperty>& properties = header_.elements.back().properties;
        if (properties.size() == kMostProperties) return mistake("more than 1000 properties");
        properties.push_back(std::move(property));
        return {};
    }

    // Before anything is set aside for rows, they are known to fit into the file.
    Result<PlyHeader> check_counts() {
        for (const PlyElement& element : header_.elements) {
            size_t least_bytes = 0;
            for (const PlyProperty& property : element.properties) {
                const PlyType type = property.is_list ? property.count_type : property.type;
                least_bytes += header_.form == PlyForm::ascii ? 2 : size_bytes(type);
            }
            const uint64_t most = least_bytes == 0 ? 0 : (text_.bytes_left() + 1) / least_bytes;
            if (element.count > most && !element.properties.empty())
                return bad_input("{}: has {} rows of {}, but the {} bytes after the header hold {} at most; was it cut short?",
                                 name_, element.count, element.name, text_.bytes_left(), most);
        }
        return std::move(header_);
    }

    Text& text_;
    const std::string& name_;
    PlyHeader header_;
    bool has_format_ = false;
};

}  // namespace

size_t size_bytes(PlyType type) {
    static constexpr size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
    return kSizes[size_t(type)];
}

Result<PlyHeader> read_ply_header(Text& text, const std::string& name) {
    return HeaderReader(text, name).read();
}

}  // namespace overlook::mesh
