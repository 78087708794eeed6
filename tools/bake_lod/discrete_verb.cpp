#include "tools/bake_lod/discrete_verb.h"

#include <CLI/CLI.hpp>
#include <filesystem>

#include "formats/container.h"
#include "tools/bake_lod/discrete_report.h"

namespace overlook::bake_lod {
namespace {

constexpr const char* kName = "bake-lod discrete";

Result<void> check_output(const DiscreteArgs& args) {
    for (const std::string& mesh : args.meshes) {
        std::error_code is_no_file;
        if (std::filesystem::equivalent(mesh, args.output, is_no_file))
            return bad_command("{}: is read and would be overwritten; give another --output", args.output);
    }
    if (args.meshes.size() > discrete::kMostLevels)
        return bad_command("{} meshes are given, a chain has at most {} levels", args.meshes.size(), discrete::kMostLevels);
    if (args.levels_from == "cut" && args.meshes.size() > 1)
        return bad_command("levels are cut from one mesh, {} are given; leave --levels-from cut out", args.meshes.size());
    return {};
}

// The meshes, or the levels that one glTF file names (MSFT_lod).
Result<std::vector<mesh::MeshFile>> read_meshes(const DiscreteArgs& args) {
    std::vector<mesh::MeshFile> files;
    for (const std::string& path : args.meshes) {
        auto file = mesh::open_mesh(path, args.choices.input);
        if (!file) return tl::unexpected(file.error());
        files.push_back(std::move(*file));
    }
    uint32_t lods = files[0].report.lod_count;
    if (args.meshes.size() > 1 || args.levels_from == "cut" || lods == 0) return files;
    if (lods >= discrete::kMostLevels)
        return bad_input("{}: names {} levels, a chain has at most {}", args.meshes[0], lods + 1, discrete::kMostLevels);
    mesh::Options options = args.choices.input;
    for (options.lod = 1; options.lod <= lods; ++options.lod) {
        auto file = mesh::open_mesh(args.meshes[0], options);
        if (!file) return tl::unexpected(file.error());
        files.push_back(std::move(*file));
    }
    return files;
}

Result<uint64_t> write_file(const DiscreteArgs& args, const DiscreteDone& done, uint64_t seed) {
    container::Provenance provenance{kName, command::version(), mesh::options_in_words(args.choices), {}};
    auto add = [&](const char* name, const std::string& value) { provenance.options.emplace_back(name, value); };
    add("levels-from", done.is_cut ? "cut" : "files");
    if (!done.is_cut && args.meshes.size() == 1) add("lods", fmt::format("{}", done.inputs.size()));
    add("visibility", std::filesystem::path(args.visibility).filename().string()), add("seed", fmt::format("{}", seed));
    if (args.visibility_period_m != 1) add("visibility-period-m", fmt::format("{}", args.visibility_period_m));
    if (done.is_cut) {
        const discrete::LadderOptions& ladder = args.ladder;
        add("foliage", args.foliage), add("impostors", args.impostors), add("factor", fmt::format("{}", ladder.factor));
        add("least-triangles", fmt::format("{}", ladder.least_triangles)),
            add("least-saving", fmt::format("{}", ladder.least_saving)),
            add("most-levels", fmt::format("{}", ladder.most_levels));
        if (args.plain_px > 0) add("plain-px", fmt::format("{}", args.plain_px));
        add("view",
            fmt::format("{} px, {} deg, {} px allowed", ladder.view.height_px, ladder.view.fov_y_deg, ladder.view.error_px));
    }
    for (size_t i = 0; i < args.meshes.size(); ++i)
        provenance.inputs.push_back({done.inputs[i].source_name, done.inputs[i].source_hash});
    auto writer = container::Writer::create(args.output, discrete::kKind);
    if (!writer) return tl::unexpected(writer.error());
    if (auto written = discrete::write(*writer, done.chain); !written) return tl::unexpected(written.error());
    if (auto added = writer->add_provenance(provenance); !added) return tl::unexpected(added.error());
    return writer->commit();
}

Result<discrete::Chain> bake(const DiscreteArgs& args, std::vector<mesh::MeshFile> files, DiscreteDone& done,
                             const command::Common& common) {
    command::Progress progress(common, "baking");
    auto say = [&](double share) { progress.set(share); };
    if (!done.is_cut) {
        discrete::LevelsChainOptions options;
        options.bake = args.choices.bake;
        return discrete::chain_from_levels(files, options, done.measured, say);
    }
    discrete::MeshChainOptions options;
    options.bake = args.choices.bake, options.ladder = args.ladder;
    options.impostors = args.impostors == "none"    ? discrete::Impostors::none
                        : args.impostors == "cross" ? discrete::Impostors::cross
                        : args.impostors == "cloud" ? discrete::Impostors::cloud
                                                    : discrete::Impostors::automatic;
    options.plain_px = args.plain_px;
    options.thins_foliage = args.foliage != "keep", options.grows_foliage = args.foliage == "grow";
    auto chain = discrete::chain_from_mesh(files[0], options, done.cut, say);
    if (!chain) return tl::unexpected(Error{chain.error().exit, args.meshes[0] + ": " + chain.error().message});
    return chain;
}

double seconds_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void add_mesh_options(CLI::App& verb, DiscreteArgs& args) {
    caveclod::GroupOptions& groups = args.choices.bake.groups;
    caveclod::SeamBudget& seams = args.choices.bake.simplify.seams;
    verb.add_option("--metres-per-unit", args.choices.input.metres_per_unit, "The files' unit of length")
        ->check(command::number_in(1e-9, 1e9))
        ->capture_default_str();
    verb.add_option("--up", args.up, "The files' axis that points up, z in what is baked: y, z, or auto (glTF y, others z)")
        ->check(CLI::IsMember({"auto", "y", "z"}))
        ->capture_default_str();
    verb.add_option("--crease-angle", groups.crease_deg,
                    "Degrees by which a surface without normals in its file may turn at an edge and still be shaded smooth")
        ->check(command::number_in(0, 180))
        ->capture_default_str();
    verb.add_option("--weld-normals", groups.weld_normals_deg,
                    "Degrees by which neighbouring normals of the file may differ and be made one")
        ->check(command::number_in(0, 90))
        ->capture_default_str();
    verb.add_flag("--ignore-uv", groups.ignores_uv, "Leave texture coordinates out: their seams fix nothing then");
    verb.add_flag("--keep-thin", args.choices.bake.simplify.keeps_thin,
                  "Of levels that are cut, as of bake-lod mesh: masts, railings and wires stay until they are a fraction of a pixel "
                  "wide; their errors are those that cutting proves, not measured anew");
    verb.add_option("--seams", args.seams,
                    "Of levels that are cut, as of bake-lod mesh: budgeted lets seams move, which goes further")
        ->check(CLI::IsMember({"strict", "budgeted"}))
        ->capture_default_str();
    verb.add_option("--seam-texels", seams.uv_texels, "Texels by which texture coordinates may be wrong beside a seam that moved")
        ->check(command::number_in(0, 1e6))
        ->capture_default_str();
    verb.add_option("--seam-degrees", seams.normal_deg, "Degrees by which normals may be wrong beside a seam that moved")
        ->check(command::number_in(0, 180))
        ->capture_default_str();
}

void add_level_options(CLI::App& verb, DiscreteArgs& args) {
    discrete::LadderOptions& ladder = args.ladder;
    verb.add_option(
            "--levels-from", args.levels_from,
            "auto: several meshes, and a glTF file that names levels (MSFT_lod), are levels made by hand, finest first; from "
            "one mesh levels are cut. cut, files: that")
        ->check(CLI::IsMember({"auto", "cut", "files"}))
        ->capture_default_str();
    verb.add_option("--factor", ladder.factor, "Of levels that are cut: in triangles, from one that is tried to the next")
        ->check(command::number_in(1.05, 100))
        ->capture_default_str();
    verb.add_option("--least-saving", ladder.least_saving,
                    "A level stays only if it has so many times fewer triangles than the one before")
        ->check(command::number_in(1, 100))
        ->capture_default_str();
    verb.add_option("--most-levels", ladder.most_levels, "No more levels than this")
        ->check(CLI::Range(1u, discrete::kMostLevels))
        ->capture_default_str();
    verb.add_option("--least-triangles", ladder.least_triangles, "No level of fewer triangles is tried")
        ->check(CLI::Range(1, 1000000000))
        ->capture_default_str();
    verb.add_option("--height-px", ladder.view.height_px, "Of the picture that levels are chosen for: pixels from top to bottom")
        ->check(command::number_in(1, 1e6))
        ->capture_default_str();
    verb.add_option("--fov-y-deg", ladder.view.fov_y_deg, "Its field of view from top to bottom")
        ->check(command::number_in(1, 170))
        ->capture_default_str();
    verb.add_option("--error-px", ladder.view.error_px, "What may be displaced in it")
        ->check(command::number_in(0.001, 10000))
        ->capture_default_str();
    verb.add_option(
            "--foliage", args.foliage,
            "Small pieces that hang together with nothing, cards of alpha-masked or two-sided surfaces above all. grow: some are "
            "lost where what stays is near enough, and the cards that stay grow to keep the area. thin: lost only. keep: none is "
            "lost")
        ->check(CLI::IsMember({"grow", "thin", "keep"}))
        ->capture_default_str();
    verb.add_option("--impostors", args.impostors,
                    "Levels of billboards, tried beside those that are cut: cards with pictures of the thing, each part's by "
                    "itself, and a "
                    "proven bound like any other's. cloud: flat pieces on cards that lie along them, foliage on slices across "
                    "it, what is "
                    "solid stays a mesh. cross: two or three upright cards that cross. auto: both. none: no billboards")
        ->check(CLI::IsMember({"auto", "none", "cross", "cloud"}))
        ->capture_default_str();
    verb.add_option(
            "--plain-px", args.plain_px,
            "Levels that are cut and asked for only where the thing is less than so many pixels wide are drawn by a simpler "
            "shader, without textures and with one normal a face, but for those with alpha masks; 0: none")
        ->check(command::number_in(0, 1e6))
        ->capture_default_str();
    verb.add_flag("--why", args.why, "Say what was tried, and which distances ask for each level");
    verb.add_option("--visibility", args.visibility,
                    "What comes first when a level fades in: " + discrete::visibility_names() + ", or a picture file")
        ->capture_default_str();
    verb.add_option("--visibility-period-m", args.visibility_period_m, "Metres after which a picture of visibility repeats")
        ->check(command::number_in(1e-6, 1e6))
        ->capture_default_str();
}

}  // namespace

CLI::App* add_discrete_verb(CLI::App& app, DiscreteArgs& args, command::Common& common) {
    CLI::App* verb =
        app.add_subcommand("discrete",
                           "A mesh (or levels of it made by hand, finest first) into a chain of few whole levels, to be drawn by "
                           "the thousand; each has a "
                           "proven bound of how far it is from the finest. What moves rigidly in a glTF file moves in the chain");
    verb->add_option("MESH", args.meshes, "The mesh, or the levels from fine to coarse (OBJ, PLY, OFF, STL, glTF)")->required();
    verb->add_option("-o,--output", args.output, "The baked file (.ovl)")->required();
    add_mesh_options(*verb, args);
    add_level_options(*verb, args);
    command::add_common(*verb, common, command::Uses::seed);
    return verb;
}

int bake_discrete(DiscreteArgs args, const command::Common& common) {
    args.choices.input.up = args.up == "y" ? mesh::Up::y : args.up == "z" ? mesh::Up::z : mesh::Up::automatic;
    args.choices.bake.simplify.seams.moves = args.seams == "budgeted";
    args.choices.input.reads_motion = true;
    if (auto checked = check_output(args); !checked) return command::fail(kName, checked.error());
    auto begin = std::chrono::steady_clock::now();
    auto files = read_meshes(args);
    if (!files) return command::fail(kName, files.error());
    bool is_cut = files->size() == 1 && args.levels_from != "files";
    if (!is_cut && (args.impostors != "none" || args.plain_px > 0))
        return command::fail(kName, Error{Exit::bad_command,
                                          "levels made by hand are drawn as they are; leave --impostors and "
                                          "--plain-px out"});
    DiscreteDone done;
    done.is_cut = is_cut;
    for (const mesh::MeshFile& file : *files) done.inputs.push_back(file.report);
    done.read_s = seconds_since(begin);

    begin = std::chrono::steady_clock::now();
    auto chain = bake(args, std::move(*files), done, common);
    if (!chain) return command::fail(kName, chain.error());
    discrete::VisibilityOptions visibility{common.seed, args.visibility_period_m};
    if (auto set = discrete::set_visibility(*chain, args.visibility, visibility); !set) return command::fail(kName, set.error());
    done.chain = std::move(*chain);
    done.bake_s = seconds_since(begin);

    auto bytes = write_file(args, done, common.seed);
    if (!bytes) return command::fail(kName, bytes.error());
    done.bytes = *bytes;
    report_discrete(args, done, common);
    return int(Exit::done);
}

}  // namespace overlook::bake_lod
