// glTF files made in code.
#pragma once

#include <string>
#include <vector>

#include "tests/tools/mesh_test_files.h"

namespace overlook::mesh::test {

// A binary buffer with a view for each part, and the JSON that names them.
class GltfMaker {
  public:
    // Adds bytes as a view; returns its number. `extra` are further members of the view (", \"byteStride\": 8").
    int view(const std::string& bytes, const std::string& extra = "") {
        binary_.resize((binary_.size() + 3) / 4 * 4);
        views_.push_back(fmt::format(R"({{"buffer":0,"byteOffset":{},"byteLength":{}{}}})", binary_.size(), bytes.size(), extra));
        binary_ += bytes;
        return int(views_.size()) - 1;
    }
    int raw_view(const std::string& json) {
        views_.push_back(json);
        return int(views_.size()) - 1;
    }
    int accessor(int view, int component, const char* type, size_t count, const std::string& extra = "") {
        const std::string which = view < 0 ? "" : fmt::format(R"("bufferView":{},)", view);
        accessors_.push_back(
            fmt::format(R"({{{}"componentType":{},"type":"{}","count":{}{}}})", which, component, type, count, extra));
        return int(accessors_.size()) - 1;
    }
    int floats(const std::vector<float>& values, const char* type, int width) {
        std::string bytes;
        for (const float value : values) bytes += bytes_of(value);
        return accessor(view(bytes), 5126, type, values.size() / size_t(width));
    }
    int indices(const std::vector<uint16_t>& values) {
        std::string bytes;
        for (const uint16_t value : values) bytes += bytes_of(value);
        return accessor(view(bytes), 5123, "SCALAR", values.size());
    }
    const std::string& binary() const { return binary_; }

    // `rest`: meshes, nodes and so on, as members of the root.
    std::string json(const std::string& rest, const std::string& uri = "", const std::string& more_buffers = "") const {
        const auto joined = [](const std::vector<std::string>& parts) {
            std::string text;
            for (const std::string& part : parts) text += (text.empty() ? "" : ",") + part;
            return text;
        };
        const std::string where = uri.empty() ? "" : R"("uri":")" + uri + "\",";
        return fmt::format(
            R"({{"asset":{{"version":"2.0"}},"buffers":[{{{}"byteLength":{}}}{}],"bufferViews":[{}],"accessors":[{}],{}}})",
            where, binary_.size(), more_buffers, joined(views_), joined(accessors_), rest);
    }
    std::string glb(const std::string& rest, const std::string& more_buffers = "") const {
        std::string text = json(rest, "", more_buffers), chunk = binary_;
        text.resize((text.size() + 3) / 4 * 4, ' ');
        chunk.resize((chunk.size() + 3) / 4 * 4, '\0');
        const std::string body =
            bytes_of(uint32_t(text.size())) + "JSON" + text + bytes_of(uint32_t(chunk.size())) + std::string("BIN\0", 4) + chunk;
        return "glTF" + bytes_of(uint32_t(2)) + bytes_of(uint32_t(12 + body.size())) + body;
    }

  private:
    std::string binary_;
    std::vector<std::string> views_, accessors_;
};

}  // namespace overlook::mesh::test
