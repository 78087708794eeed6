#include <nlohmann/json.hpp>

#include "formats/container.h"
#include "formats/terrain.h"
#include "tools/bake/dem.h"
#include "tools/bake/dem_provenance.h"
#include "tools/baked/prove_terrain.h"
#include "tools/baked/verbs.h"

namespace overlook::baked {
namespace {

using nlohmann::ordered_json;

const std::vector<double> kDefaultTolerances_m{100, 50, 20, 5, 1};

ordered_json places_json(const terrain::Places& places) {
    ordered_json worst = ordered_json::array();
    for (const terrain::Place& place : places.worst())
        worst.push_back({{"column", place.column},
                         {"row", place.row},
                         {"measured_m", place.measured_m},
                         {"promised_m", place.promised_m},
                         {"what", place.what}});
    return {{"count", places.count()}, {"worst", worst}};
}

ordered_json proof_json(const terrain::Proof& proof) {
    ordered_json cuts = ordered_json::array();
    for (const terrain::CutProof& cut : proof.cuts)
        cuts.push_back({{"error_m", cut.tolerance_m},
                        {"triangles", cut.report.triangle_count},
                        {"void_rim_triangles", cut.void_rim_triangle_count},
                        {"greatest_deviation_m", cut.report.greatest_deviation_m},
                        {"samples_covered", cut.report.covered_samples},
                        {"valid_samples_uncovered", cut.report.uncovered_valid_samples},
                        {"open_interior_edges", cut.report.open_interior_edges},
                        {"overused_edges", cut.report.overused_edges},
                        {"wrongly_covered_cells", cut.report.wrongly_covered_cells},
                        {"violations", places_json(cut.report.places)}});
    return {{"holds", proof.holds()},
            {"samples", proof.sample_count},
            {"voids", proof.void_count},
            {"triangles_checked", proof.triangle_count},
            {"greatest_stored_height_error_m", proof.greatest_stored_m},
            {"greatest_share_of_promise_used", proof.tightest},
            {"mean_share_of_promise_used", proof.mean_tightness},
            {"height_violations", places_json(proof.heights)},
            {"triangle_violations", places_json(proof.triangles)},
            {"cuts", cuts}};
}

void print_places(const char* what, const terrain::Places& places) {
    if (places.count() == 0) return;
    fmt::print("BROKEN: {} {}\n", places.count(), what);
    for (const terrain::Place& place : places.worst())
        fmt::print("  column {}, row {}: {}: {:.6g} m, promised {:.6g} m\n", place.column, place.row, place.what,
                   place.measured_m, place.promised_m);
}

void print_text(const terrain::Proof& proof) {
    fmt::print("{} samples, {} voids; {} triangles of the hierarchy checked against every sample they cover\n",
               proof.sample_count, proof.void_count, proof.triangle_count);
    fmt::print("promises used to {:.1f} % on the mean, {:.1f} % at the most\n", 100 * proof.mean_tightness, 100 * proof.tightest);
    print_places("stored heights beyond the finest error", proof.heights);
    print_places("triangles beyond their stated error", proof.triangles);
    if (proof.codes_above_parent > 0) fmt::print("BROKEN: an error code is above its parent's: cuts may crack\n");
    for (const terrain::CutProof& cut : proof.cuts) {
        const terrain::CutReport& r = cut.report;
        fmt::print(
            "cut at {:g} m: {} triangles ({} on void rims), worst sample {:.6g} m, {} open interior edges, {} valid samples "
            "uncovered{}\n",
            cut.tolerance_m, r.triangle_count, cut.void_rim_triangle_count, r.greatest_deviation_m, r.open_interior_edges,
            r.uncovered_valid_samples, r.is_sound() ? "" : "  BROKEN");
        print_places("places of this cut", r.places);
        if (r.overused_edges > 0 || r.wrongly_covered_cells > 0)
            fmt::print("  BROKEN: {} edges used wrongly, {} cells covered wrongly\n", r.overused_edges, r.wrongly_covered_cells);
    }
    fmt::print("{}\n", proof.holds() ? "every promise holds" : "a promise is broken");
}

// The source must be the very file that was baked; another is no proof of anything.
Result<void> check_source(const container::Provenance& provenance, const dem::Raster& dem, const terrain::Terrain& terrain,
                          const std::string& file, const std::string& source) {
    bool is_an_input = false;
    for (const container::InputIdentity& input : provenance.inputs) is_an_input = is_an_input || input.hash == dem.source_hash;
    if (!is_an_input) {
        std::string name = provenance.inputs.empty() ? "nothing" : provenance.inputs[0].name;
        return bad_input("{}: is not what {} was baked from: that was {} with other bytes", source, file, name);
    }
    if (dem.width != terrain.shape.width || dem.height != terrain.shape.height)
        return bad_input("{}: has {} x {} samples, {} has {} x {}", source, dem.width, dem.height, file, terrain.shape.width,
                         terrain.shape.height);
    return {};
}

}  // namespace

int verify_terrain(const VerifyArgs& args, const container::Reader& file, const command::Common& common) {
    const char* name = "baked verify";
    auto terrain = terrain::read(file);
    if (!terrain) return command::fail(name, terrain.error());
    auto provenance = file.provenance();
    if (!provenance) return command::fail(name, provenance.error());
    auto options = dem::options_from_words(*provenance);
    if (!options) return command::fail(name, Error{options.error().exit, args.file + ": " + options.error().message});
    auto dem = dem::open(args.sources[0], *options);
    if (!dem) return command::fail(name, dem.error());
    if (auto same = check_source(*provenance, *dem, *terrain, args.file, args.sources[0]); !same)
        return command::fail(name, same.error());

    command::Progress progress(common, "proving");
    const std::vector<double>& tolerances = args.error_m.empty() ? kDefaultTolerances_m : args.error_m;
    terrain::Proof proof =
        terrain::prove(*terrain, terrain::source_of(*dem), tolerances, [&](double done) { progress.set(done); });
    if (common.json)
        fmt::print("{}\n", proof_json(proof).dump(2));
    else
        print_text(proof);
    return int(proof.holds() ? Exit::done : Exit::answer_is_no);
}

}  // namespace overlook::baked
