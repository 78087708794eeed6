#include "tools/measure/paper/wang_ldi/subject.h"

#include <filesystem>

#include "formats/mapped_file.h"
#include "formats/numbers.h"
#include "runtime/gl/png.h"

namespace overlook::measure::paper::wang {
namespace {

Result<void> open(const std::string& path, Bake& bake) {
    auto file = container::Reader::open(path);
    if (!file) return tl::unexpected(file.error());
    bake.path = path, bake.file = std::make_unique<container::Reader>(std::move(*file));
    auto ground = wang_ldi::read(*bake.file);
    if (!ground) return tl::unexpected(ground.error());
    auto images = wang_ldi::ImageReader::open(*bake.file);
    if (!images) return tl::unexpected(images.error());
    bake.ground = std::move(*ground), bake.opened = std::move(*images);
    const wang_ldi::ImageSet& set = bake.set();
    if (set.tile_count != bake.ground.set.tiles.size() || set.tile_m != bake.ground.planting.tile_size_m)
        return bad_input("{}: images of {} tiles of {:g} m, planted are {} of {:g} m", path, set.tile_count, set.tile_m,
                         bake.ground.set.tiles.size(), bake.ground.planting.tile_size_m);
    return {};
}

Result<void> read_scene_of(const std::string& path, const Bake& bake, SceneFile& into) {
    auto file = container::Reader::open(path);
    if (!file) return tl::unexpected(file.error());
    auto ground = wang_ldi::read(*file);
    if (!ground) return tl::unexpected(ground.error());
    auto scene = wang_ldi::read_scene(*file, uint32_t(ground->set.tiles.size()));
    if (!scene) return tl::unexpected(scene.error());
    if (!(ground->set == bake.ground.set) || !(ground->planting == bake.ground.planting))
        return bad_input("{}: is of other ground than {}", path, bake.path);
    if (scene->image.is_unlit || scene->pictures.empty())
        return bad_input("{}: is unlit or has no pictures by rays; bake it without --light later and --scene-views 0", path);
    into = {path, std::move(*scene), wang_ldi::stored_bytes_of_scene_image(*file)};
    return {};
}

Result<void> read_report_of(const std::string& path, const Bake* bake, BakeReport& into) {
    auto report = read_report(path);
    if (!report) return tl::unexpected(report.error());
    into = std::move(*report);
    if (!bake) return {};
    uint64_t samples = 0, said = into.images ? into.images->all.samples : 0;
    for (const wang_ldi::Entry& entry : bake->images().entries()) samples += entry.sample_count;
    if (said == samples) return {};
    return bad_input("{}: is of another bake: {} samples, {} has {}", path, with_commas(said), bake->path, with_commas(samples));
}

Result<void> read_sheet(const std::string& folder, std::vector<std::pair<std::string, ImageRgb8>>& into) {
    for (const std::string& name : sheet_names()) {
        std::string path = folder + "/" + name + ".png";
        auto file = MappedFile::open(path);
        if (!file) return tl::unexpected(file.error());
        auto decoded = decode_png(path, file->bytes());
        if (!decoded) return tl::unexpected(decoded.error());
        ImageRgb8 picture{decoded->width, decoded->height, {}};
        for (size_t p = 0; p < decoded->pixels.size(); p += 4)
            picture.pixels.insert(picture.pixels.end(), decoded->pixels.begin() + long(p), decoded->pixels.begin() + long(p) + 3);
        into.emplace_back(name, std::move(picture));
    }
    return {};
}

}  // namespace

const std::vector<std::string>& sheet_names() {
    static const std::vector<std::string> kNames = {"tiles",          "tiling-32", "tiling-256",        "robinson-32",
                                                    "robinson-256",   "spectrum",  "robinson-spectrum", "planting-neighbours",
                                                    "planting-tiles", "planting"};
    return kNames;
}

Result<Subject> read_subject(const std::string& folder) {
    Subject subject;
    subject.name = std::filesystem::path(folder + "/").lexically_normal().parent_path().filename().string();
    auto at = [&](const char* name) { return folder + "/" + name; };
    auto done = open(at("paper.ovl"), subject.paper);
    if (done) done = open(at("own.ovl"), subject.own);
    if (done) done = open(at("single.ovl"), subject.single);
    if (done) done = open(at("unlit.ovl"), subject.unlit);
    if (done) done = read_report_of(at("paper.json"), &subject.paper, subject.of_paper);
    if (done) done = read_report_of(at("own.json"), &subject.own, subject.of_own);
    if (done) done = read_report_of(at("single.json"), &subject.single, subject.of_single);
    if (done) done = read_report_of(at("robinson.json"), nullptr, subject.of_robinson);
    if (done) done = read_scene_of(at("scene.ovl"), subject.paper, subject.scene);
    if (done) done = read_scene_of(at("single-scene.ovl"), subject.single, subject.single_scene);
    if (done) done = read_scene_of(at("own-scene.ovl"), subject.own, subject.own_scene);
    for (auto [name, report] :
         {std::pair("gloss.json", &subject.gloss), {"gloss-none.json", &subject.gloss_none}, {"every.json", &subject.every}})
        if (done && std::filesystem::exists(at(name))) done = read_report_of(at(name), nullptr, report->emplace());
    if (done) done = read_sheet(at("sheet"), subject.sheet);
    if (done) done = read_sheet(at("sheet-own"), subject.own_sheet);
    bool has_directions = std::filesystem::exists(at("one.ovl")) && std::filesystem::exists(at("eight.ovl"));
    if (has_directions && done) done = open(at("one.ovl"), subject.one.emplace());
    if (has_directions && done) done = open(at("eight.ovl"), subject.eight.emplace());
    if (subject.eight && done)
        for (auto [name, bake, wanted] : {std::tuple("one.ovl", &*subject.one, 1u), std::tuple("eight.ovl", &*subject.eight, 8u)})
            if (bake->set().direction_count != wanted)
                return bad_input("{}: has {} directions; {} are compared", at(name), bake->set().direction_count, wanted);
    if (!done) return tl::unexpected(done.error());
    return subject;
}

}  // namespace overlook::measure::paper::wang
