#include "tools/measure/paper/lod_sprite/remedies.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tools/measure/figures.h"
#include "tools/measure/methods.h"
#include "tools/measure/page_text.h"

namespace overlook::measure::paper::sprite {
namespace {

constexpr std::array<Remedy, 14> kRemedies = {{
    {"keys in slices", "keyframe=at-once",
     "A key is drawn a slice a frame, for a pose predicted ahead; here whole, in the frame that finds the old one too bad."},
    {"keys in slices", "keyframe=thread",
     "A key is drawn a slice a frame, for a pose predicted ahead; here whole, by a thread in a second context."},
    {"cache of keys", "slots=2", "Four keys are kept for a way back; without, only the one in use and the one being drawn."},
    {"guard band", "guard=1", "A key is 15 % wider and higher than the frame, so that turning does not leave it at once."},
    {"cross-fade", "fade-frames=0", "A new key takes over from the old one within eight frames; without, at once."},
    {"outlines kept", "outlines=0",
     "The coarse surface is raised until it covers the true one, so that crests show the key's outline and not their own."},
    {"slab test", "slab-test=0", "A texel's depth must lie where the coarse surface's own promise allows it."},
    {"place test", "place-test=0", "A texel counts only within half a pixel of its own place in this frame."},
    {"look-ups", "look-ups=0", "The key is asked again where the depth that it shows puts the point, until that place rests."},
    {"open parts closed", "open-parts=0",
     "What no key is proven to show is drawn as fine as a key is shown again, not by the coarse cut."},
    {"near geometry", "near=0", "What is too near for a key to serve is drawn as geometry, as fine as asked."},
    {"keys that give way before they blur", "most-grown=3",
     "A new key is made when texels have become 1.6 times as wide, not three times."},
    {"keys of twice the resolution", "key-scale=1", "Four texels a pixel carry the antialiasing into the frames between keys."},
    {"geomorph (here on)", "morph=0.5",
     "Vertices of the coarse surface can glide into place. By default they do not: what is seen of it lies in the key."},
}};

struct Held {
    const char* name;
    const char* purpose;
};
constexpr std::array<Held, RemedyTable::kWhole + 1> kHeldAgainst = {{
    {"everything at the high cut", "What keys are made of."},
    {"the paper's form", "Chen, Swan and Kuo, 1999: lod-sprite:paper."},
    {"all remedies", "lod-sprite."},
}};

// The middle of the frames that are over the highest ground.
uint32_t crest_frame(const Flying& flying) {
    std::vector<PathPoint> path = path_of(flying, RemedyTable::kStepFrames);
    auto below = [](const PathPoint& point) { return point.is_over_terrain ? point.ground_m : -1e9; };
    auto highest = std::max_element(path.begin(), path.end(), [&](auto& a, auto& b) { return below(a) < below(b); });
    return uint32_t(highest - path.begin());
}

std::vector<view::Camera> to_and_fro(const Flying& flying, const RemedyTable& table) {
    std::vector<view::Camera> all = cameras_of(flying, RemedyTable::kStepFrames);
    auto first = all.begin() + table.first_frame, last = first + table.forward_frames;
    std::vector<view::Camera> cameras(first, last);
    std::reverse_copy(last - 1 - table.back_frames, last - 1, std::back_inserter(cameras));
    return cameras;
}

std::vector<view::Camera> lead_of(const Flying& flying, const RemedyTable& table) {
    std::vector<view::Camera> all = cameras_of(flying, RemedyTable::kStepFrames);
    auto first = all.begin() + table.first_frame;
    return {first - table.lead_frames, first};
}

Result<Cast> cast_of_rows(const Plan& plan) {
    std::vector<std::string> methods = {"lod-sprite:paper", "lod-sprite"};
    for (const Remedy& remedy : remedies()) methods.push_back("lod-sprite@" + std::string(remedy.off));
    return cast_from(plan, methods);
}

// "W x 1.2" where `least` is passed both as a share of the whole method's and, so that noise about nothing is not told, by
// itself.
struct Change {
    const char* what;
    double whole, without, least_share, least;
};
bool is_worth_telling(const Change& change) {
    double difference = std::abs(change.without - change.whole);
    return difference >= change.least_share * change.whole && difference >= change.least;
}
std::string told(const Change& change) {
    return fmt::format("{} x {:.2f}", change.what, change.without / change.whole);
}

}  // namespace

std::span<const Remedy> remedies() {
    return kRemedies;
}

Result<RemedyTable> fly_remedies(const Flying& flying, const Plan& plan, uint32_t frames,
                                 const std::function<void(double)>& done) {
    Result<Cast> cast = cast_of_rows(plan);
    if (!cast) return tl::unexpected(cast.error());
    RemedyTable table;
    table.back_frames = frames / 3;
    table.forward_frames = frames - table.back_frames;
    uint32_t half = table.forward_frames / 2, crest = crest_frame(flying);
    table.first_frame = std::min(crest - std::min(crest, half), RemedyTable::kStepFrames - table.forward_frames);

    table.lead_frames = std::min(RemedyTable::kLeadFrames, table.first_frame);

    Course course{{cast->high}, to_and_fro(flying, table), step_s(flying, RemedyTable::kStepFrames), Compared::steps};
    course.lead = lead_of(flying, table);
    course.specs.insert(course.specs.end(), cast->sprites.begin(), cast->sprites.end());
    add_floors(course.specs);
    Result<CourseResult> flown = run_course(flying.world, course, flying.renderer, flying.cache_folder, done);
    if (!flown) return tl::unexpected(flown.error());

    for (size_t i = 0; i < kHeldAgainst.size(); ++i)
        table.rows.push_back({kHeldAgainst[i].name, "", kHeldAgainst[i].purpose, std::move(flown->runs[i])});
    for (size_t i = 0; i < remedies().size(); ++i) {
        const Remedy& remedy = remedies()[i];
        RunResult& run = flown->runs[kHeldAgainst.size() + i];
        table.rows.push_back({std::string(remedy.name), std::string(remedy.off), std::string(remedy.purpose), std::move(run)});
    }
    table.floor = std::move(flown->runs.back());
    return table;
}

RemedyFigures figures_of(const RunResult& run) {
    RemedyFigures figures;
    Percentiles times_ms = percentiles_of(run, "frame_ms");
    figures.mean_ms = mean_ms(run);
    figures.p99_ms = times_ms.p99;
    figures.triangles = mean_of(run, "triangles").value_or(0);
    figures.key_pixels = mean_of(run, "key_pixels").value_or(0);
    figures.keys = swept_from(run, nullptr, kThreshold_px).keyframes;
    figures.e_mean = mean_of(run, "e_mean_flip").value_or(0);
    figures.e_p99 = percentiles_of(run, "e_p99_flip").p99;
    figures.w_mean = mean_of(run, "w_luma").value_or(0);
    figures.pop_index = run.pop.index;
    figures.ghost_share = mean_of(run, "ghost_share").value_or(0);
    figures.loss_share = mean_of(run, "loss_share").value_or(0);
    figures.hole_px = percentiles_of(run, "hole_px").max;
    return figures;
}

std::string change_of(const RemedyFigures& whole, const RemedyFigures& without) {
    constexpr double kMeanTime = 0.15, kP99Time = 0.5, kExact = 0.05;
    const Change ratios[] = {
        {"mean time", whole.mean_ms, without.mean_ms, kMeanTime, 0.1},
        {"p99 time", whole.p99_ms, without.p99_ms, kP99Time, 0.1},
        {"triangles", whole.triangles, without.triangles, kExact, 10},
        {"key pixels", whole.key_pixels, without.key_pixels, kExact, 10},
        {"E", whole.e_mean, without.e_mean, kExact, 1e-4},
        {"E p99", whole.e_p99, without.e_p99, kExact, 1e-3},
        {"W", whole.w_mean, without.w_mean, kExact, 1e-5},
        {"pop index", whole.pop_index, without.pop_index, kExact, 0.05},
    };
    std::string text;
    auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
    for (const Change& change : ratios) {
        if (is_worth_telling(change)) add(told(change));
    }
    auto add_share = [&](const char* what, double before, double after) {
        if (is_worth_telling({what, before, after, kExact, 1e-4}))
            add(fmt::format("{} {:.2f} to {:.2f} %", what, 100 * before, 100 * after));
    };
    add_share("ghosts", whole.ghost_share, without.ghost_share);
    add_share("losses", whole.loss_share, without.loss_share);
    if (whole.hole_px != without.hole_px) add(fmt::format("holes {:.0f} to {:.0f} px", whole.hole_px, without.hole_px));
    return text.empty() ? "nothing that could be measured here" : text;
}

std::string remedies_csv(const RemedyTable& table) {
    std::string csv =
        "row,off,mean_ms,p99_ms,triangles_mean,key_pixels_mean,keys,e_mean_flip,e_p99_flip,w_luma_mean,pop_index,pop_frame,ghost_"
        "share,"
        "loss_share,hole_px_max\n";
    for (const RemedyRow& row : table.rows) {
        RemedyFigures f = figures_of(row.run);
        csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", row.name, row.off, f.mean_ms, f.p99_ms, f.triangles,
                           f.key_pixels, f.keys, f.e_mean, f.e_p99, f.w_mean, f.pop_index, row.run.pop.frame, f.ghost_share,
                           f.loss_share, f.hole_px);
    }
    return csv;
}

}  // namespace overlook::measure::paper::sprite
