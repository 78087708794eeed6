#include <array>

#include "formats/caveclod.h"

namespace overlook::caveclod {
namespace {

constexpr std::array<std::string_view, 19> kRules{
    "The file's kind is CAVE and it has the sections MINF, MBLK, MDIR and MSUR.",
    "MINF is 128 bytes long.",
    "There is a position, a face, a group and a surface; no count is above 2^28, groups are no more than faces, surfaces at most "
    "65,536.",
    "The origin, the lowest uv and all steps are finite, steps above 0; positions have 8 to 20 bits, uv 8 to 16, normals 6 to "
    "16.",
    "Flags, codec and error codes are known ones, reserved numbers are 0.",
    "MSUR decodes to exactly the surfaces stated, with printable names of at most 4,096 bytes.",
    "MDIR, uncompressed, has an entry of 32 bytes for the base and for each block of 1 to 16,384 splits, in their order, all "
    "splits "
    "in one of them.",
    "MBLK, uncompressed, is its blocks: the first begins at 0, each where the one before ends, and the last ends with MBLK.",
    "A block's bytes match their checksum.",
    "A block decodes to exactly the rows of numbers that its splits ask for, at most 256 for each of its bytes.",
    "A position is a whole number of steps that its bits can hold.",
    "An attribute is within its grid, a position has at most 65,535 vertices, and every corner stands at one of them.",
    "A face of the coarsest cut stands at three different positions that are there, in a group that is there, of a surface that "
    "is "
    "there.",
    "A split is of a position that is there, with at most 1,024 faces, and moves some of these.",
    "A split adds at most two faces, in groups that are there, each between its owner, its new position and a third one before "
    "it.",
    "A split needs splits before it, each once.",
    "No error is below none.",
    "The error that an entry of MDIR states is the greatest of its block and of all after it.",
    "The counts of faces and vertices are those stated.",
};

}  // namespace

std::string_view rule_text(int rule) {
    return rule >= 1 && rule <= rule_count() ? kRules[size_t(rule - 1)] : std::string_view();
}
int rule_count() {
    return int(kRules.size());
}

}  // namespace overlook::caveclod
