// A folder of plants, baked in several ways: what the paper's figures are made of.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "formats/image.h"
#include "formats/wang_ground.h"
#include "formats/wang_ldi.h"
#include "formats/wang_scene.h"
#include "tools/measure/paper/wang_ldi/report.h"

namespace overlook::measure::paper::wang {

// A baked file with images, open.
struct Bake {
    std::string path;
    std::unique_ptr<container::Reader> file;  // the images refer to it
    wang_ldi::PlantedTiles ground;
    std::optional<wang_ldi::ImageReader> opened;

    const wang_ldi::ImageReader& images() const { return *opened; }
    const wang_ldi::ImageSet& set() const { return opened->set(); }
};

// A ground as one perspective image, and pictures of it by rays.
struct SceneFile {
    std::string path;
    wang_ldi::Scene scene;
    uint64_t image_bytes = 0;  // of the image, stored
};

struct Subject {
    std::string name;  // of the folder: "sunflowers"
    // With the paper's tiles, planting and constants; as Overlook bakes by itself; a single tile that repeats; the paper's tiles
    // without light.
    Bake paper, own, single, unlit;
    SceneFile scene, single_scene, own_scene;  // of the grounds of paper, single and own
    std::optional<Bake> one, eight;            // without light, of one direction and of eight, the same levels; both or neither
    BakeReport of_paper, of_own, of_single, of_robinson;
    std::optional<BakeReport> gloss, gloss_none;  // of glossy plants, as each direction sees them, and without gloss
    std::optional<BakeReport> every;              // of one tile, with all samples that eyes meet
    std::vector<std::pair<std::string, ImageRgb8>> sheet, own_sheet;  // sheet_names(), of paper and own
};

// Figures 3 to 6 of `baked info --sheet`.
const std::vector<std::string>& sheet_names();

// Reads paper.ovl, own.ovl, single.ovl and unlit.ovl, their reports (paper.json and so on, without unlit's; robinson.json of a
// bake of Robinson's tiles; gloss.json, gloss-none.json and every.json, if they are there), scene.ovl, single-scene.ovl and
// own-scene.ovl of --only scene, and the sheets (sheet/, sheet-own/). Fails as their readers do, and with Exit::bad_input:
// "a/paper.json: is of another bake: 1,200 samples, paper.ovl has 900", "a/scene.ovl: is of other ground than a/paper.ovl".
Result<Subject> read_subject(const std::string& folder);

}  // namespace overlook::measure::paper::wang
