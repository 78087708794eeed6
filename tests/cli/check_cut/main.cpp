// check_cut CUT.ply DEM --tolerance-m T [--window X,Y,W,H] [--nodata V]
// Checks a cut exported with `--space raster` against the elevation model, sample by sample. Prints a line of JSON; exit 1 if the
// cut is not sound, 2 if it cannot be checked.

#include <cstdio>
#include <limits>
#include <stdexcept>

#include "tests/cli/check_cut/check.h"

namespace {

struct Args {
    std::string mesh, dem;
    double tolerance_m = -1;
    double nodata = -32768;
    check_cut::Window window;
};

Args parse(int argc, char** argv) {
    Args args;
    for (int i = 1; i < argc; ++i) {
        std::string word = argv[i];
        const char* value = i + 1 < argc ? argv[i + 1] : "";
        if (word == "--tolerance-m")
            args.tolerance_m = std::stod(value), ++i;
        else if (word == "--nodata")
            args.nodata = std::stod(value), ++i;
        else if (word == "--window") {
            if (std::sscanf(value, "%ld,%ld,%ld,%ld", &args.window.x, &args.window.y, &args.window.width, &args.window.height) !=
                4)
                throw std::runtime_error("--window X,Y,W,H");
            ++i;
        } else if (args.mesh.empty())
            args.mesh = word;
        else if (args.dem.empty())
            args.dem = word;
        else
            throw std::runtime_error("what is " + word + "?");
    }
    if (args.dem.empty() || !(args.tolerance_m >= 0)) throw std::runtime_error("check_cut CUT.ply DEM --tolerance-m T");
    return args;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        Args args = parse(argc, argv);
        check_cut::Report report = check_cut::check(check_cut::read_ply(args.mesh),
                                                    check_cut::read_raster(args.dem, args.window, args.nodata), args.tolerance_m);
        std::puts(check_cut::to_json(report).c_str());
        return report.is_sound() ? 0 : 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "check_cut: %s\n", error.what());
        return 2;
    }
}
