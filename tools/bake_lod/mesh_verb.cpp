#include "tools/bake_lod/mesh_verb.h"

#include <CLI/CLI.hpp>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "formats/container.h"
#include "formats/numbers.h"
#include "tools/bake/mesh_textures.h"

namespace overlook::bake_lod {
namespace {

constexpr const char* kName = "bake-lod mesh";

// What came in, was made of it and was written.
struct Done {
    mesh::MeshReport input;
    caveclod::BakeReport bake;
    uint32_t base_face_count = 0;
    double finest_error_m = 0, coarsest_error_m = 0;
    uint64_t bytes = 0;
    double read_s = 0, bake_s = 0;

    double bits_per_triangle() const { return 8.0 * double(bytes) / double(bake.source_face_count); }
    double million_triangles_per_s() const { return double(bake.source_face_count) / bake_s / 1e6; }
};

Result<void> check_output(const MeshArgs& args) {
    std::error_code is_no_file;
    if (std::filesystem::equivalent(args.mesh, args.output, is_no_file))
        return bad_command("{}: is read and would be overwritten; give another --output", args.output);
    return {};
}

Result<uint64_t> write_file(const MeshArgs& args, const caveclod::Hierarchy& hierarchy, const mesh::MeshReport& input,
                            const caveclod::BakeReport& bake) {
    container::Provenance provenance{
        kName, command::version(), mesh::options_in_words(args.choices), {{input.source_name, input.source_hash}}};
    if (args.choices.bake.simplify.seams.moves) {
        const caveclod::SimplifyReport& found = bake.simplify;
        provenance.options.emplace_back("found-seam-texels", fmt::format("{}", found.seam_error.uv_texels));
        provenance.options.emplace_back("found-seam-degrees", fmt::format("{}", found.seam_error.normal_deg));
        provenance.options.emplace_back("found-seam-shift-m", fmt::format("{}", found.greatest_seam_shift_m));
    }
    caveclod::Codec codec = args.codec == "draco" ? caveclod::Codec::draco : caveclod::Codec::meshopt;
    if (codec != caveclod::kDefaultCodec) provenance.options.emplace_back("codec", args.codec);
    auto writer = container::Writer::create(args.output, caveclod::kKind);
    if (!writer) return tl::unexpected(writer.error());
    auto written = caveclod::write(*writer, hierarchy, codec);
    if (!written) return tl::unexpected(written.error());
    if (auto added = writer->add_provenance(provenance); !added) return tl::unexpected(added.error());
    return writer->commit();
}

constexpr std::array<const char*, caveclod::kHindranceCount> kHindranceNames{
    "fixed", "seams", "topology", "orientation", "turned", "texels", "degrees", "error", "order"};

nlohmann::ordered_json json_of(const caveclod::HindranceCounts& counts) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    for (size_t h = 0; h < counts.size(); ++h) json[kHindranceNames[h]] = counts[h];
    return json;
}

nlohmann::ordered_json json_of(const MeshArgs& args, const Done& done) {
    const mesh::MeshReport& in = done.input;
    const caveclod::BakeReport& bake = done.bake;
    nlohmann::ordered_json dropped = nlohmann::ordered_json::object();
    for (size_t r = 0; r < mesh::kDropReasonCount; ++r)
        dropped[std::string(mesh::name_of(mesh::DropReason(r)))] = in.dropped_count(mesh::DropReason(r));
    return {{"file", args.output},
            {"form", in.form},
            {"triangles_in_file", in.triangle_count},
            {"triangles", in.face_count},
            {"dropped", dropped},
            {"positions", in.position_count},
            {"components", in.component_count},
            {"welded_positions", in.welded_position_count},
            {"flipped_faces", in.flipped_face_count},
            {"back_sides", in.back_side_count},
            {"complex_edges", in.complex_edge_count},
            {"cut_edges", in.cut_edge_count},
            {"split_positions", in.split_position_count},
            {"notes", in.notes},
            {"positions_by_kind", {{"free", bake.free_count}, {"sharp", bake.sharp_count}, {"rigid", bake.rigid_count}}},
            {"surface_groups", bake.group_count},
            {"packed_ids", bake.packed_count},
            {"clique_bound", bake.clique_bound},
            {"dense_array_populated", bake.dense_population},
            {"dense_array_bytes", bake.dense_bytes},
            {"rows_bytes", bake.rows_bytes},
            {"splits", bake.simplify.collapse_count},
            {"needs", bake.simplify.need_count},
            {"depth", bake.simplify.depth},
            {"triangles_coarsest", done.base_face_count},
            {"positions_kept_by", json_of(bake.simplify.hindrances)},
            {"seams", args.seams},
            {"floor_estimate", bake.floor_face_estimate},
            {"floor_estimate_budgeted", bake.budgeted_floor_face_estimate},
            {"size_m", bake.size_m},
            {"triangles_at_one_percent", bake.face_count_at_one_percent},
            {"positions_at_one_percent_kept_by", json_of(bake.kept_at_one_percent)},
            {"seam_uv_error_texels", bake.simplify.seam_error.uv_texels},
            {"seam_normal_error_deg", bake.simplify.seam_error.normal_deg},
            {"seam_shift_m", bake.simplify.greatest_seam_shift_m},
            {"carried_corners", bake.simplify.carried_count},
            {"finest_error_m", done.finest_error_m},
            {"coarsest_error_m", done.coarsest_error_m},
            {"bytes", done.bytes},
            {"bits_per_triangle", done.bits_per_triangle()},
            {"read_s", done.read_s},
            {"bake_s", done.bake_s}};
}

void report(const MeshArgs& args, const Done& done, const command::Common& common) {
    if (common.json) {
        fmt::print("{}\n", json_of(args, done).dump(2));
        return;
    }
    const caveclod::BakeReport& bake = done.bake;
    for (const std::string& line : mesh::text_of(done.input)) command::detail(common, line);
    uint64_t lost = done.input.dropped.size();
    if (lost > 0)
        command::note(common,
                      fmt::format("{}: {} of {} triangles are not in it, each for a reason; --json lists how many for which",
                                  args.mesh, with_commas(lost), with_commas(done.input.triangle_count)));
    command::detail(common, fmt::format("{} surface groups, {} ids (at least {}); the index array would be {:.1f} % populated",
                                        bake.group_count, bake.packed_count, bake.clique_bound, 100 * bake.dense_population));
    command::detail(common, fmt::format("{} splits of depth {}, {} needs; read in {:.2f} s, baked in {:.2f} s ({:.2f} million "
                                        "triangles a second)",
                                        bake.simplify.collapse_count, bake.simplify.depth, bake.simplify.need_count, done.read_s,
                                        done.bake_s, done.million_triangles_per_s()));
    const caveclod::HindranceCounts& kept = bake.simplify.hindrances;
    command::detail(
        common, fmt::format("the coarsest has {} triangles: of its positions {} must stay, {} are kept by seams, {} by "
                            "topology, {} because a face would fold, {} because one would look away from its source, {} "
                            "because a seam's budget would be passed",
                            with_commas(done.base_face_count), kept[0], kept[1], kept[2], kept[3], kept[4], kept[5] + kept[6]));
    command::detail(common, fmt::format("at an error of 1 % of its diagonal ({:.3g} m) {} triangles are left, {:.1f} %",
                                        0.01 * bake.size_m, with_commas(bake.face_count_at_one_percent),
                                        100 * double(bake.face_count_at_one_percent) / double(bake.source_face_count)));
    if (args.choices.bake.simplify.seams.moves)
        command::detail(common, fmt::format("seams moved by at most {:.3g} m, which the errors hold; {} corners carry attributes "
                                            "along, which are wrong by at most {:.2f} texels and {:.2f} degrees",
                                            bake.simplify.greatest_seam_shift_m, with_commas(bake.simplify.carried_count),
                                            bake.simplify.seam_error.uv_texels, bake.simplify.seam_error.normal_deg));
    command::note(common,
                  fmt::format("{}: {} triangles, down to {}, {:.1f} MB ({:.1f} bits a triangle); keeps any error from "
                              "{:.3g} m, at most {:.3g} m",
                              args.output, with_commas(bake.source_face_count), with_commas(done.base_face_count),
                              double(done.bytes) / 1e6, done.bits_per_triangle(), done.finest_error_m, done.coarsest_error_m));
}

// What no bake can go below, before the long work.
void tell_floors(const MeshArgs& args, const caveclod::BakeReport& bake, const command::Common& common) {
    auto share = [&](uint64_t count) { return 100 * double(count) / double(std::max<uint64_t>(bake.source_face_count, 1)); };
    command::note(common, fmt::format("{}: of {} triangles at least {} ({:.1f} %) stay with strict seams, {} ({:.1f} %) with "
                                      "budgeted ones",
                                      args.mesh, with_commas(bake.source_face_count), with_commas(bake.floor_face_estimate),
                                      share(bake.floor_face_estimate), with_commas(bake.budgeted_floor_face_estimate),
                                      share(bake.budgeted_floor_face_estimate)));
}

double seconds_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

CLI::App* add_mesh_verb(CLI::App& app, MeshArgs& args, command::Common& common) {
    CLI::App* verb = app.add_subcommand(
        "mesh",
        "A mesh (OBJ, PLY, OFF, STL, glTF) into a hierarchy of splits with proven errors, which many cameras refine at once");
    caveclod::GroupOptions& groups = args.choices.bake.groups;
    caveclod::Precision& precision = args.choices.bake.precision;
    verb->add_option("MESH", args.mesh, "The mesh; it is repaired, not refused, and every repair is counted")->required();
    verb->add_option("-o,--output", args.output, "The baked file (.ovl)")->required();
    verb->add_option("--metres-per-unit", args.choices.input.metres_per_unit, "The file's unit of length")
        ->check(command::number_in(1e-9, 1e9))
        ->capture_default_str();
    verb->add_option("--up", args.up,
                     "The file's axis that points up, z in what is baked: y, z, or auto (what the form says: glTF y, others z)")
        ->check(CLI::IsMember({"auto", "y", "z"}))
        ->capture_default_str();
    verb->add_option("--crease-angle", groups.crease_deg,
                     "Degrees by which a surface without normals in its file may turn at an edge and still be shaded smooth")
        ->check(command::number_in(0, 180))
        ->capture_default_str();
    verb->add_option("--weld-normals", groups.weld_normals_deg,
                     "Degrees by which neighbouring normals of the file may differ and be made one: fewer fixed positions")
        ->check(command::number_in(0, 90))
        ->capture_default_str();
    verb->add_flag("--ignore-uv", groups.ignores_uv, "Leave texture coordinates out: their seams fix nothing then");
    verb->add_option("--position-bits", precision.position_bits,
                     "Bits of each coordinate; the rounding counts towards every error")
        ->check(CLI::Range(8, 20))
        ->capture_default_str();
    verb->add_flag(
        "--keep-thin", args.choices.bake.simplify.keeps_thin,
        "Keep masts, railings and wires until they are a fraction of a pixel wide: what would flatten them is stated at 16 "
        "times what it takes");
    caveclod::SeamBudget& seams = args.choices.bake.simplify.seams;
    verb->add_option("--seams", args.seams,
                     "strict: every drawn corner has attributes that the source has there. budgeted: seams may move, by no more "
                     "than the stated error, and what is drawn beside them may be wrong by as much as the next two say")
        ->check(CLI::IsMember({"strict", "budgeted"}))
        ->capture_default_str();
    verb->add_option("--seam-texels", seams.uv_texels,
                     "Of a budgeted seam: texels of the surface's texture (1024 across where it has none) by which texture "
                     "coordinates may be wrong")
        ->check(command::number_in(0, 1e6))
        ->capture_default_str();
    verb->add_option("--seam-degrees", seams.normal_deg, "Of a budgeted seam: degrees by which normals may be wrong")
        ->check(command::number_in(0, 180))
        ->capture_default_str();
    verb->add_option("--codec", args.codec, "How the file is packed: meshopt, draco")
        ->check(CLI::IsMember({"meshopt", "draco"}))
        ->capture_default_str();
    command::add_common(*verb, common);
    return verb;
}

int bake_mesh(MeshArgs args, const command::Common& common) {
    args.choices.input.up = args.up == "y" ? mesh::Up::y : args.up == "z" ? mesh::Up::z : mesh::Up::automatic;
    args.choices.bake.simplify.seams.moves = args.seams == "budgeted";
    if (auto checked = check_output(args); !checked) return command::fail(kName, checked.error());
    auto begin = std::chrono::steady_clock::now();
    auto file = mesh::open_mesh(args.mesh, args.choices.input);
    if (!file) return command::fail(kName, file.error());
    Done done;
    done.input = std::move(file->report);
    caveclod::BakeOptions options = args.choices.bake;
    options.source_rounding_m = done.input.rounding_m;
    if (options.simplify.seams.moves) {
        auto sizes_px = mesh::texture_sizes_px(file->mesh);
        if (!sizes_px) return command::fail(kName, sizes_px.error());
        options.simplify.seams.texture_px = std::move(*sizes_px);
    }
    done.read_s = seconds_since(begin);

    begin = std::chrono::steady_clock::now();
    command::Progress progress(common, "baking");
    auto hierarchy = caveclod::bake(
        file->mesh, options, done.bake, [&](double share) { progress.set(share); },
        [&] { tell_floors(args, done.bake, common); });
    if (!hierarchy) return command::fail(kName, Error{hierarchy.error().exit, args.mesh + ": " + hierarchy.error().message});
    done.bake_s = seconds_since(begin);
    done.base_face_count = hierarchy->base_face_count;
    done.finest_error_m = double(hierarchy->finest_error_m);
    for (float error_m : hierarchy->error_m) done.coarsest_error_m = std::max(done.coarsest_error_m, double(error_m));

    auto bytes = write_file(args, *hierarchy, done.input, done.bake);
    if (!bytes) return command::fail(kName, bytes.error());
    done.bytes = *bytes;
    report(args, done, common);
    return int(Exit::done);
}

}  // namespace overlook::bake_lod
