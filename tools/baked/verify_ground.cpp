// Ground of Wang tiles by itself: what stands on it overlaps nowhere, and each of its images, textures and pictures of a whole
// scene can be read and keeps the rules.
#include <nlohmann/json.hpp>

#include "formats/numbers.h"
#include "formats/wang_ground.h"
#include "formats/wang_scene.h"
#include "formats/wang_textures.h"
#include "tools/bake/wang_ldi/planting_check.h"
#include "tools/baked/verbs.h"

namespace overlook::baked {
namespace {

constexpr const char* kName = "baked verify";

struct Read {
    uint64_t images = 0, samples = 0, textures = 0, scene_pictures = 0;
};

Result<Read> read_all(const container::Reader& file, uint32_t tile_count, const command::Common& common) {
    Read read;
    if (wang_ldi::has_scene(file)) {
        auto scene = wang_ldi::read_scene(file, tile_count);
        if (!scene) return tl::unexpected(scene.error());
        read.scene_pictures = 1 + scene->pictures.size();
    }
    if (!file.find(container::tag("WLDI"))) return read;
    auto images = wang_ldi::ImageReader::open(file);
    if (!images) return tl::unexpected(images.error());
    command::Progress progress(common, "reading");
    for (uint64_t i = 0; i < images->set().ldi_count(); ++i) {
        auto ldi = images->read(i);
        if (!ldi) return tl::unexpected(ldi.error());
        ++read.images, read.samples += ldi->sample_count();
        progress.set(double(i + 1) / double(images->set().ldi_count()));
    }
    if (!wang_ldi::has_textures(file)) return read;
    auto textures = wang_ldi::read_textures(file, images->set());
    if (!textures) return tl::unexpected(textures.error());
    read.textures = textures->texture_count();
    return read;
}

std::string_view in_words(wang_ldi::Verdict verdict) {
    switch (verdict) {
        case wang_ldi::Verdict::hold:
            return "every promise holds";
        case wang_ldi::Verdict::broken:
            return "a promise is broken";
        default:
            return "unproven: so many objects stand so close that looking at all pairs was given up; none looked at overlaps";
    }
}

Exit exit_of(wang_ldi::Verdict verdict) {
    if (verdict == wang_ldi::Verdict::hold) return Exit::done;
    return verdict == wang_ldi::Verdict::broken ? Exit::answer_is_no : Exit::impossible;
}

}  // namespace

int verify_ground(const VerifyArgs& args, const container::Reader& file, const command::Common& common) {
    auto ground = wang_ldi::read(file);
    if (!ground) return command::fail(kName, ground.error());
    auto read = read_all(file, uint32_t(ground->set.tiles.size()), common);
    if (!read) return command::fail(kName, read.error());
    wang_ldi::OverlapReport overlaps = wang_ldi::check_overlaps(ground->set, ground->planting);
    wang_ldi::Verdict verdict = wang_ldi::verdict_of(overlaps);
    if (common.json) {
        nlohmann::ordered_json json{{"file", args.file},
                                    {"holds", verdict == wang_ldi::Verdict::hold},
                                    {"unproven", verdict == wang_ldi::Verdict::unproven},
                                    {"neighbourhoods", overlaps.neighbourhoods},
                                    {"tight_overlaps", overlaps.tight_overlaps},
                                    {"images", read->images},
                                    {"samples", read->samples},
                                    {"textures", read->textures},
                                    {"scene_pictures", read->scene_pictures}};
        fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
    } else {
        fmt::print("{}{} tight radii overlap in any of {} neighbourhoods; {} images of {} samples and {} textures are whole\n",
                   overlaps.tight_overlaps, overlaps.is_cut_short ? " or more" : "", with_commas(overlaps.neighbourhoods),
                   with_commas(read->images), with_commas(read->samples), with_commas(read->textures));
        if (read->scene_pictures > 0)
            fmt::print("a whole scene's image and {} pictures of it are whole\n", read->scene_pictures - 1);
        fmt::print("{}\n", in_words(verdict));
    }
    return int(exit_of(verdict));
}

}  // namespace overlook::baked
