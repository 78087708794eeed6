#include <nlohmann/json.hpp>

#include "formats/caveclod.h"
#include "formats/numbers.h"
#include "tools/bake/mesh_provenance.h"
#include "tools/bake/mesh_textures.h"
#include "tools/baked/prove_caveclod.h"
#include "tools/baked/verbs.h"

namespace overlook::baked {
namespace {

using nlohmann::ordered_json;

constexpr const char* kName = "baked verify";

ordered_json json_of(const caveclod::Proof& proof) {
    const caveclod::CutsProof& cuts = proof.cuts;
    return {{"holds", proof.holds()},
            {"broken_law", proof.broken_law},
            {"triangles", proof.triangle_count},
            {"lost_triangles", proof.lost_triangle_count},
            {"foreign_triangles", proof.foreign_triangle_count},
            {"finest_stated_m", proof.finest_stated_m},
            {"finest_moved_m", proof.finest_moved_m},
            {"cuts",
             {{"count", cuts.cut_count},
              {"broken", cuts.broken_count},
              {"first_broken_seed", cuts.first_broken_seed},
              {"faces", cuts.face_count},
              {"turned_faces", cuts.turned_count},
              {"greatest_share_of_promise_used", cuts.greatest_measured_share},
              {"median_stated_over_measured", cuts.median_stated_over_measured},
              {"greatest_stated_over_measured", cuts.greatest_stated_over_measured}}},
            {"seams",
             {{"corners", proof.seams.corner_count},
              {"carried", proof.seams.carried_count},
              {"wrong", proof.seams.wrong_count},
              {"uv_error_texels", proof.seams.worst.uv_texels},
              {"normal_error_deg", proof.seams.worst.normal_deg},
              {"shift_m", proof.seams.greatest_shift_m}}}};
}

void print_text(const caveclod::Proof& proof) {
    if (!proof.broken_law.empty()) fmt::print("BROKEN: {}\n", proof.broken_law);
    bool is_whole = proof.lost_triangle_count == 0 && proof.foreign_triangle_count == 0;
    fmt::print("finest cut: {} triangles of the source, {} lost, {} foreign{}\n", with_commas(proof.triangle_count),
               proof.lost_triangle_count, proof.foreign_triangle_count, is_whole ? "" : "  BROKEN");
    fmt::print("no corner of it moved by more than {:.3g} m, {:.3g} m promised{}\n", proof.finest_moved_m, proof.finest_stated_m,
               proof.finest_moved_m <= proof.finest_stated_m * (1 + 1e-6) ? "" : "  BROKEN");
    const caveclod::CutsProof& cuts = proof.cuts;
    fmt::print("{} random legal cuts: promises used to {:.1f} % at the most; promised over measured {:.2f} in the median\n",
               cuts.cut_count, 100 * cuts.greatest_measured_share, cuts.median_stated_over_measured);
    if (cuts.broken_count > 0)
        fmt::print("BROKEN: {} cuts are farther from the source than promised, first that of seed {}\n", cuts.broken_count,
                   cuts.first_broken_seed);
    fmt::print("{} of their {} faces are turned by more than 90 degrees from the source under them{}\n",
               with_commas(cuts.turned_count), with_commas(cuts.face_count), cuts.turned_count == 0 ? "" : "  BROKEN");
    const caveclod::SeamsProof& seams = proof.seams;
    fmt::print(
        "{} of their {} corners carry attributes from up to {:.3g} m away, wrong by {:.2f} texels and {:.2f} degrees at the "
        "most; {} beyond what is allowed{}\n",
        with_commas(seams.carried_count), with_commas(seams.corner_count), seams.greatest_shift_m, seams.worst.uv_texels,
        seams.worst.normal_deg, with_commas(seams.wrong_count), seams.wrong_count == 0 ? "" : "  BROKEN");
    fmt::print("{}\n", proof.holds() ? "every promise holds" : "a promise is broken");
}

// The source must be the very file that was baked; another is no proof of anything.
Result<void> check_source(const container::Provenance& provenance, const mesh::MeshReport& source, const VerifyArgs& args) {
    for (const container::InputIdentity& input : provenance.inputs)
        if (input.hash == source.source_hash) return {};
    std::string name = provenance.inputs.empty() ? "nothing" : provenance.inputs[0].name;
    return bad_input("{}: is not what {} was baked from: that was {} with other bytes", args.sources[0], args.file, name);
}

}  // namespace

int verify_mesh(const VerifyArgs& args, const container::Reader& file, const command::Common& common) {
    auto hierarchy = caveclod::read(file);
    if (!hierarchy) return command::fail(kName, hierarchy.error());
    auto provenance = file.provenance();
    if (!provenance) return command::fail(kName, provenance.error());
    auto choices = mesh::choices_from_words(*provenance);
    if (!choices) return command::fail(kName, Error{choices.error().exit, args.file + ": " + choices.error().message});
    auto source = mesh::open_mesh(args.sources[0], choices->input);
    if (!source) return command::fail(kName, source.error());
    if (auto same = check_source(*provenance, source->report, args); !same) return command::fail(kName, same.error());

    command::Progress progress(common, "proving");
    caveclod::ProofOptions options;
    options.cut_count = args.cuts;
    options.seed = common.seed;
    caveclod::SeamBudget seams = choices->bake.simplify.seams;
    auto sizes_px = mesh::texture_sizes_px(source->mesh);
    if (!sizes_px) return command::fail(kName, sizes_px.error());
    seams.texture_px = std::move(*sizes_px);
    caveclod::Proof proof = caveclod::prove(*hierarchy, source->mesh, seams, options, [&](double done) { progress.set(done); });
    if (common.json)
        fmt::print("{}\n", json_of(proof).dump(2));
    else
        print_text(proof);
    return int(proof.holds() ? Exit::done : Exit::answer_is_no);
}

}  // namespace overlook::baked
