#include <array>

#include "formats/terrain.h"

namespace overlook::terrain {
namespace {

constexpr std::array<std::string_view, 20> kRules{
    "The file's kind is TERR and it has the sections TINF, TDIR and TBLK.",
    "TINF is 1,152 bytes long.",
    "Width and height are at least 2 and their product is at most 2^31.",
    "Metres per column and row are finite and between 1e-6 and 1e7.",
    "Height step is finite and above 0, height offset is finite, and no height of 2^28 steps is beyond 1e12 metres.",
    "The finest error is finite, at least 0, and error code 0 is it, rounded up.",
    "Error codes 1 to 254 are finite and never below the one before; code 255 is infinite.",
    "Flags, reserved numbers and what follows the reference system's name are as documented; it is printable; the reference is a "
    "place on Earth.",
    "TDIR, uncompressed, has one entry of 32 bytes for each block that the raster's size asks for.",
    "TBLK, uncompressed, is its blocks: the first begins at 0, each where the one before ends, and the last ends with TBLK.",
    "A block's bytes match their checksum.",
    "A block decodes to exactly the bytes that its vertices need.",
    "A block's heights span exactly the range that its entry states.",
    "No error code is above that of a diamond whose splitting it follows from.",
    "A diamond of level 0 that covers a void has code 255.",
    "The number of voids is that stated.",
    "The texture has 1 to 32,768 pixels a side and three bytes for each.",
    "TTIL and TTLD, uncompressed, are both there or neither; TTLD has one entry of 24 bytes for each block, and TTIL is its "
    "tiles.",
    "A tile's bytes match their checksum and decode to what its squares and its vertices beyond the raster need.",
    "What tiles say of squares, of the raster's edge and of the heights' sum is what the heights say.",
};

}  // namespace

std::string_view rule_text(int rule) {
    return rule >= 1 && rule <= rule_count() ? kRules[size_t(rule - 1)] : std::string_view();
}
int rule_count() {
    return int(kRules.size());
}

}  // namespace overlook::terrain
