// Small meshes as files, and what every mesh that was opened has to keep.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cstdlib>
#include <fstream>
#include <string>

#include "tests/formats/scratch_folder.h"
#include "tools/bake/mesh_input.h"

namespace overlook::mesh::test {

// What stands in OVERLOOK_DATA, or "" if it is not set.
inline std::string data_file(const std::string& name) {
    const char* folder = std::getenv("OVERLOOK_DATA");
    return folder ? std::string(folder) + "/" + name : "";
}
#define OVERLOOK_NEED_DATA(path) \
    if ((path).empty()) GTEST_SKIP() << "OVERLOOK_DATA names no folder of test data"

inline std::string write_file(const ScratchFolder& folder, const std::string& name, const std::string& bytes) {
    std::ofstream(folder / name, std::ios::binary) << bytes;
    return folder / name;
}

// How many of a mesh's faces OpenMesh's TriMesh does not take.
size_t faces_refused_by_openmesh(const Mesh& mesh);

// Every law of Mesh holds, every triangle of the file is there or stands in the report, and OpenMesh takes all of them.
void expect_whole(const MeshFile& file);

// Opens a mesh and expects it whole; an empty one if it is refused.
MeshFile open_whole(const std::string& path, const Options& options = {});

// The file is refused with `exit`, in one line that names it and holds `words`.
void expect_refused(const std::string& path, Exit exit, const std::string& words);

// A number's bytes, lowest or highest first.
template <class T>
std::string bytes_of(T value, bool is_big_endian = false) {
    std::string bytes(reinterpret_cast<const char*>(&value), sizeof(T));
    return is_big_endian == (std::endian::native == std::endian::big) ? bytes : std::string(bytes.rbegin(), bytes.rend());
}

// The area of all faces.
double area_of(const Mesh& mesh);

}  // namespace overlook::mesh::test
