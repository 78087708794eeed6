#include "tests/fuzz/fuzz_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    return overlook::mesh::fuzz_reader(overlook::mesh::read_obj, data, size);
}
