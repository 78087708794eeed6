// Plants through the commands: made, baked as a mesh and as a chain of levels, and proven.

#include <gtest/gtest.h>

#include "tests/cli/run_command.h"
#include "tests/formats/scratch_folder.h"

namespace overlook::cli {
namespace {

void expect_kept_promises(const std::string& kind, const std::string& mesh, const std::string& baked) {
    expect_done(run({"bake-lod", kind, mesh, "-o", baked, "--quiet"}));
    std::vector<std::string> proof = {"baked", "verify", baked, "--source", mesh, "--quiet"};
    if (kind == "mesh") proof.insert(proof.end(), {"--cuts", "3"});
    expect_done(run(proof));
}

TEST(PlantCommands, BakeAndProveASunflowerWithLeafCards) {
    ScratchFolder folder;
    expect_done(run({"make-sample", "sunflowers", "-o", folder.path(), "--quiet"}));
    expect_kept_promises("mesh", folder / "sunflower-05.glb", folder / "sunflower.ovl");
}

TEST(PlantCommands, BakeAndProveAMeadow) {
    ScratchFolder folder;
    expect_done(run({"make-sample", "grass", "-o", folder.path(), "--quiet"}));
    expect_kept_promises("mesh", folder / "dandelion-02.glb", folder / "dandelion.ovl");
    expect_kept_promises("discrete", folder / "buttercup-00.glb", folder / "buttercup.ovl");
}

}  // namespace
}  // namespace overlook::cli
