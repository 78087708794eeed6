#include <algorithm>
#include <nlohmann/json.hpp>

#include "formats/caveclod.h"
#include "formats/numbers.h"
#include "tools/bake/mesh_provenance.h"
#include "tools/baked/prove_caveclod.h"
#include "tools/baked/verbs.h"

namespace overlook::baked {
namespace {

using nlohmann::ordered_json;

constexpr const char* kName = "baked verify";

// The median of stated over measured, of the cuts that err at all.
double median_looseness(const caveclod::Proof& proof) {
    std::vector<double> ratios;
    for (const caveclod::CutCheck& cut : proof.cuts)
        if (cut.least_m > 0) ratios.push_back(cut.stated_error_m / cut.least_m);
    if (ratios.empty()) return 1;
    std::nth_element(ratios.begin(), ratios.begin() + ptrdiff_t(ratios.size() / 2), ratios.end());
    return ratios[ratios.size() / 2];
}

ordered_json json_of(const caveclod::Proof& proof) {
    ordered_json cuts = ordered_json::array();
    for (const caveclod::CutCheck& cut : proof.cuts)
        cuts.push_back({{"seed", cut.seed},
                        {"triangles", cut.triangle_count},
                        {"stated_error_m", cut.stated_error_m},
                        {"measured_least_m", cut.least_m},
                        {"measured_most_m", cut.most_m}});
    return {{"holds", proof.holds()},
            {"broken_law", proof.broken_law},
            {"triangles", proof.triangle_count},
            {"lost_triangles", proof.lost_triangle_count},
            {"foreign_triangles", proof.foreign_triangle_count},
            {"finest_stated_m", proof.finest_stated_m},
            {"finest_moved_m", proof.finest_moved_m},
            {"broken_cuts", proof.broken_cut_count()},
            {"median_stated_to_measured", median_looseness(proof)},
            {"cuts", cuts}};
}

void print_text(const caveclod::Proof& proof) {
    if (!proof.broken_law.empty()) fmt::print("BROKEN: {}\n", proof.broken_law);
    fmt::print("finest cut: {} triangles of the source, {} lost, {} foreign; no corner moved by more than {:.3g} m, {:.3g} m promised\n",
               with_commas(proof.triangle_count), proof.lost_triangle_count, proof.foreign_triangle_count, proof.finest_moved_m,
               proof.finest_stated_m);
    for (const caveclod::CutCheck& cut : proof.cuts)
        fmt::print("cut {}: {} triangles, {:.4g} m from the source, {:.4g} m promised{}\n", cut.seed,
                   with_commas(cut.triangle_count), cut.least_m, cut.stated_error_m,
                   cut.least_m > cut.stated_error_m * (1 + 1e-9) ? "  BROKEN" : "");
    fmt::print("promised over measured: {:.2f} in the median of {} cuts\n", median_looseness(proof), proof.cuts.size());
    fmt::print("{}\n", proof.holds() ? "every promise holds" : "a promise is broken");
}

// The source must be the very file that was baked; another is no proof of anything.
Result<void> check_source(const container::Provenance& provenance, const mesh::MeshReport& source, const VerifyArgs& args) {
    for (const container::InputIdentity& input : provenance.inputs)
        if (input.hash == source.source_hash) return {};
    std::string name = provenance.inputs.empty() ? "nothing" : provenance.inputs[0].name;
    return bad_input("{}: is not what {} was baked from: that was {} with other bytes", args.source, args.file, name);
}

}  // namespace

int verify_mesh(const VerifyArgs& args, const container::Reader& file, const command::Common& common) {
    auto hierarchy = caveclod::read(file);
    if (!hierarchy) return command::fail(kName, hierarchy.error());
    auto provenance = file.provenance();
    if (!provenance) return command::fail(kName, provenance.error());
    auto choices = mesh::choices_from_words(*provenance);
    if (!choices) return command::fail(kName, Error{choices.error().exit, args.file + ": " + choices.error().message});
    auto source = mesh::open_mesh(args.source, choices->input);
    if (!source) return command::fail(kName, source.error());
    if (auto same = check_source(*provenance, source->report, args); !same) return command::fail(kName, same.error());

    command::Progress progress(common, "proving");
    caveclod::Proof proof =
        caveclod::prove(*hierarchy, source->mesh, args.cuts, common.seed, [&](double done) { progress.set(done); });
    if (common.json)
        fmt::print("{}\n", json_of(proof).dump(2));
    else
        print_text(proof);
    return int(proof.holds() ? Exit::done : Exit::answer_is_no);
}

}  // namespace overlook::baked
