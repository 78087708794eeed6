#include <charconv>
#include <nlohmann/json.hpp>

#include "formats/discrete.h"
#include "formats/numbers.h"
#include "tools/bake/mesh_provenance.h"
#include "tools/baked/prove_discrete.h"
#include "tools/baked/verbs.h"

namespace overlook::baked {
namespace {

using nlohmann::ordered_json;

constexpr const char* kName = "baked verify";

ordered_json json_of(const discrete::ChainProof& proof) {
    ordered_json json{{"holds", proof.holds()},
                      {"finest_stated_m", proof.finest_stated_m},
                      {"finest_least_m", proof.finest.least_m},
                      {"finest_most_m", proof.finest.most_m},
                      {"out_of_sphere_m", proof.moved_most_m},
                      {"proven_levels", proof.proven_count()},
                      {"levels", ordered_json::array()}};
    for (const discrete::LevelProof& level : proof.levels)
        json["levels"].push_back({{"rung", level.rung == discrete::Rung::billboards ? "billboards" : "mesh"},
                                  {"triangles", level.triangle_count},
                                  {"stated_m", level.stated_m},
                                  {"least_m", level.measured.least_m},
                                  {"most_m", level.measured.most_m},
                                  {"broken", level.is_broken},
                                  {"proven", level.is_proven},
                                  {"stated_lost_area_share", level.stated_lost},
                                  {"area_less_share", level.lost},
                                  {"stated_added_area_share", level.stated_added},
                                  {"area_more_share", level.added},
                                  {"area_broken", level.area_is_broken}});
    return json;
}

void print_text(const discrete::ChainProof& proof) {
    fmt::print("level 0 is within {:.3g} m of its source (some point is off by {:.3g} m), {:.3g} m promised{}\n",
               proof.finest.most_m, proof.finest.least_m, proof.finest_stated_m, proof.finest_is_broken ? "  BROKEN" : "");
    for (size_t k = 1; k < proof.levels.size(); ++k) {
        const discrete::LevelProof& level = proof.levels[k];
        fmt::print(
            "level {}: {:>9} triangles{}, off by {:.4g} to {:.4g} m, {:.4g} m promised{}; {:.1f} % less area, {:.1f} % stated", k,
            with_commas(level.triangle_count), level.rung == discrete::Rung::billboards ? " with billboards" : "",
            level.measured.least_m, level.measured.most_m, level.stated_m,
            level.is_broken   ? "  BROKEN"
            : level.is_proven ? ", proven anew"
                              : "",
            100 * level.lost, 100 * level.stated_lost);
        if (level.rung == discrete::Rung::billboards)
            fmt::print("; {:.1f} % more, {:.1f} % stated", 100 * level.added, 100 * level.stated_added);
        fmt::print("{}\n", level.area_is_broken ? "  BROKEN" : "");
    }
    fmt::print("{} of {} levels proven anew\n", proof.proven_count(), proof.levels.size() - 1);
    if (proof.moved_most_m > 0) fmt::print("what moves reaches {:.3g} m out of its sphere\n", proof.moved_most_m);
    fmt::print("{}\n", proof.holds() ? "every promise holds" : "a promise is broken");
}

std::string option_of(const container::Provenance& provenance, const std::string& name) {
    for (const auto& [key, value] : provenance.options)
        if (key == name) return value;
    return "";
}

// The sources must be the very files that were baked, in their order.
Result<std::vector<mesh::MeshFile>> read_sources(const VerifyArgs& args, const container::Provenance& provenance,
                                                 const mesh::Options& input) {
    if (args.sources.size() != provenance.inputs.size())
        return bad_command("{}: was baked from {} files, {} are given as --source", args.file, provenance.inputs.size(),
                           args.sources.size());
    std::vector<mesh::MeshFile> sources;
    auto read = [&](const std::string& path, const mesh::Options& options, const std::string& hash) -> Result<void> {
        auto source = mesh::open_mesh(path, options);
        if (!source) return tl::unexpected(source.error());
        if (source->report.source_hash != hash)
            return bad_input("{}: is not what {} was baked from: that had other bytes", path, args.file);
        sources.push_back(std::move(*source));
        return {};
    };
    for (size_t i = 0; i < args.sources.size(); ++i)
        if (auto ok = read(args.sources[i], input, provenance.inputs[i].hash); !ok) return tl::unexpected(ok.error());
    std::string lods = option_of(provenance, "lods");
    uint32_t count = 0;
    (void)std::from_chars(lods.data(), lods.data() + lods.size(), count);
    mesh::Options options = input;
    for (options.lod = 1; args.sources.size() == 1 && options.lod < std::min(count, discrete::kMostLevels); ++options.lod)
        if (auto ok = read(args.sources[0], options, provenance.inputs[0].hash); !ok) return tl::unexpected(ok.error());
    return sources;
}

}  // namespace

int verify_discrete(const VerifyArgs& args, const container::Reader& file, const command::Common& common) {
    auto chain = discrete::read(file);
    if (!chain) return command::fail(kName, chain.error());
    auto provenance = file.provenance();
    if (!provenance) return command::fail(kName, provenance.error());
    auto choices = mesh::choices_from_words(*provenance);
    if (!choices) return command::fail(kName, Error{choices.error().exit, args.file + ": " + choices.error().message});
    choices->input.reads_motion = true;
    auto sources = read_sources(args, *provenance, choices->input);
    if (!sources) return command::fail(kName, sources.error());
    if (sources->size() > chain->levels.size())
        return command::fail(kName, Error{Exit::bad_input, fmt::format("{}: has {} levels, but was baked from {} meshes",
                                                                       args.file, chain->levels.size(), sources->size())});
    command::Progress progress(common, "proving");
    auto proof = discrete::prove(*chain, *sources, [&](double done) { progress.set(done); });
    if (!proof) return command::fail(kName, Error{proof.error().exit, args.file + ": " + proof.error().message});
    if (common.json)
        fmt::print("{}\n", json_of(*proof).dump(2));
    else
        print_text(*proof);
    return int(proof->holds() ? Exit::done : Exit::answer_is_no);
}

}  // namespace overlook::baked
