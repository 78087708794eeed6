// What a PLY file says of its rows before they begin.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/result.h"
#include "tools/bake/mesh/text.h"

namespace overlook::mesh {

enum class PlyType : uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
size_t size_bytes(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float32;
    PlyType count_type = PlyType::uint8;  // of a list
    bool is_list = false;
};

struct PlyElement {
    std::string name;
    uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

enum class PlyForm : uint8_t { ascii, little_endian, big_endian };

struct PlyHeader {
    PlyForm form = PlyForm::ascii;
    std::vector<PlyElement> elements;
    std::vector<std::string> textures;  // "comment TextureFile NAME", as MeshLab writes it
};

// Reads the header; `text` is left at the first byte after it. Every count has been checked against the bytes that follow: a row
// takes a byte at least for each of its values. `name` is the file's.
// Fails with Exit::bad_input: "a.ply:7: ..." for each line that breaks the form.
Result<PlyHeader> read_ply_header(Text& text, const std::string& name);

}  // namespace overlook::mesh
