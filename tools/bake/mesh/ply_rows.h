// The values of a PLY file's rows, one after another, whatever the form.
#pragma once

#include "tools/bake/mesh/ply_header.h"

namespace overlook::mesh {

// Reads values in the order of the header's properties. After the first failure every value is 0 and has_failed() is true.
class PlyRows {
  public:
    PlyRows(Text text, PlyForm form) : text_(text), form_(form) {}

    // Ascii: goes to the next line that holds something.
    void begin_row();
    double value(PlyType type);
    // The length of a list whose items are of a type; that many items are in the file.
    uint64_t list_length(const PlyProperty& list);
    void skip(const PlyProperty& property);
    // Ascii: nothing may be left in the line.
    void end_row();

    bool has_failed() const { return has_failed_; }
    // Where and why, for a message: "line 12: ...".
    std::string failure() const { return failure_; }

  private:
    double fail(const char* why);
    double binary_value(PlyType type);

    Text text_;
    PlyForm form_;
    bool has_failed_ = false;
    std::string failure_;
};

}  // namespace overlook::mesh
