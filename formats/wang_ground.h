// Baked ground of Wang tiles: the set and what is planted on it, as sections of a file. What is drawn of it are other sections
// of the same file.
#pragma once

#include "formats/container.h"
#include "formats/result.h"
#include "formats/wang_tiles.h"

namespace overlook::wang_ldi {

constexpr container::Tag kKind = container::tag("WANG");

struct PlantedTiles {
    TileSet set;
    Planting planting;
};

// Whether a planting is no larger than a file holds (rule W6: 2^28 bytes). Exit::impossible: "12000000 objects of 3 models on 12
// tiles take 288000112 bytes of a file, ...".
Result<void> check_size(const Planting& planting);

// Adds the sections of a set and its planting (WTIL, WPLT) to a baked file. Same ground, same bytes. Exit::our_bug if it breaks a
// rule of its own: "ground to write: W8: ...".
Result<void> write(container::Writer& writer, const PlantedTiles& ground);

// The file may be hostile; every failure is Exit::bad_input and names file, rule and place: "meadow.ovl: W5: tile 3 has a south
// edge of colour 7, there are 2". Exit::impossible if there is not so much memory.
Result<PlantedTiles> read(const std::string& path);
Result<PlantedTiles> read(const container::Reader& file);

// What each rule of these sections says, as container::rule_text.
std::string_view rule_text(int rule);
int rule_count();

}  // namespace overlook::wang_ldi
