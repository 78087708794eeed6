#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "tests/cli/check_cut/files.h"

namespace check_cut {
namespace {

struct Header {
    size_t vertex_count = 0, face_count = 0;
    std::vector<std::pair<std::string, std::string>> properties;  // of a vertex: type, name
    size_t data_begin = 0;
};

Header read_header(const std::string& bytes) {
    size_t end = bytes.find("end_header\n");
    if (bytes.rfind("ply\nformat binary_little_endian 1.0\n", 0) != 0 || end == std::string::npos)
        throw std::runtime_error("is not a binary PLY");
    Header header;
    header.data_begin = end + 11;
    std::istringstream lines(bytes.substr(0, end));
    std::string line, element;
    while (std::getline(lines, line)) {
        std::istringstream words(line);
        std::string first, second, third, fourth;
        words >> first >> second >> third >> fourth;
        if (first == "element")
            element = second, (element == "vertex" ? header.vertex_count : header.face_count) = std::stoul(third);
        if (first == "property" && element == "vertex") header.properties.emplace_back(second, third);
        if (first == "property" && element == "face" &&
            (second != "list" || third != "uchar" || (fourth != "int" && fourth != "uint")))
            throw std::runtime_error("its faces are not lists of int with a uchar before");
    }
    return header;
}

class Bytes {
  public:
    Bytes(const std::string& bytes, size_t at) : bytes_(bytes), at_(at) {}
    template <class T>
    T take() {
        if (bytes_.size() - at_ < sizeof(T)) throw std::runtime_error("is cut short");
        T value;
        std::memcpy(&value, bytes_.data() + at_, sizeof(T));
        at_ += sizeof(T);
        return value;
    }
    bool at_end() const { return at_ == bytes_.size(); }

  private:
    const std::string& bytes_;
    size_t at_;
};

double take_number(Bytes& bytes, const std::string& type) {
    if (type == "float") return double(bytes.take<float>());
    if (type == "double") return bytes.take<double>();
    if (type == "uchar") return bytes.take<uint8_t>();
    throw std::runtime_error("has a property of type " + type);
}

}  // namespace

Mesh read_ply(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error(path + ": cannot be opened");
    std::ostringstream all;
    all << file.rdbuf();
    std::string bytes = all.str();
    Header header = read_header(bytes);
    Bytes data(bytes, header.data_begin);

    Mesh mesh;
    for (size_t v = 0; v < header.vertex_count; ++v) {
        std::array<double, 3> position{};
        for (const auto& [type, name] : header.properties) {
            double number = take_number(data, type);
            if (name == "x" || name == "y" || name == "z") position[size_t(name[0] - 'x')] = number;
        }
        mesh.vertices.push_back(position);
    }
    for (size_t f = 0; f < header.face_count; ++f) {
        if (data.take<uint8_t>() != 3) throw std::runtime_error("has a face that is no triangle");
        std::array<uint32_t, 3> triangle{};
        for (uint32_t& corner : triangle) {
            corner = data.take<uint32_t>();
            if (corner >= mesh.vertices.size()) throw std::runtime_error("has a face with a vertex that is not there");
        }
        mesh.triangles.push_back(triangle);
    }
    if (!data.at_end()) throw std::runtime_error("has bytes after its last face");
    return mesh;
}

}  // namespace check_cut
