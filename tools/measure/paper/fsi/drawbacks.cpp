#include "tools/measure/paper/fsi/drawbacks.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "runtime/gl/objects.h"
#include "tools/measure/paper/fsi/easel.h"

namespace overlook::measure::paper::fsi {
namespace {

using discrete::Chain;
using discrete::Placement;
using discrete::Variant;

constexpr std::array<Variant, 3> kVariants = {Variant::blend, Variant::fsi_paper, Variant::fsi};
constexpr uint32_t kSide_px = 256;
constexpr double kFills = 0.7, kPhase = 0.25;
constexpr int kSeen = 8;  // of 255

// A thing a quarter of the way by one method, and what it took.
struct Quarter {
    Midway at;
    double triangles = 0, calls_more = 0, fragments = 0;
};

bool counts_fragments() {
    return epoxy_gl_version() >= 46 || epoxy_has_gl_extension("GL_ARB_pipeline_statistics_query");
}

// Of what `work` draws.
double fragments_of(const std::function<void()>& work) {
    if (!counts_fragments()) return work(), 0;
    GLuint query = 0, count = 0;
    glGenQueries(1, &query);
    glBeginQuery(GL_FRAGMENT_SHADER_INVOCATIONS_ARB, query);
    work();
    glEndQuery(GL_FRAGMENT_SHADER_INVOCATIONS_ARB);
    glGetQueryObjectuiv(query, GL_QUERY_RESULT, &count);
    glDeleteQueries(1, &query);
    return count;
}

Result<Quarter> quarter(Easel& easel, Variant variant, const view::Camera& camera) {
    discrete::FrameOptions options = discrete::defaults_of(variant);
    options.select.criterion = discrete::Criterion::distance;
    Placement one;
    double thing_m = away_m(easel, camera, one);
    options.select.distance_m = 0.5 * thing_m, options.select.refine_share = 1;
    auto frames = discrete::FrameDrawer::make(easel.drawing(), {&one, 1}, options);
    if (!frames) return tl::unexpected(frames.error());
    Quarter made;
    Result<discrete::FrameCounts> counts;
    auto draw = [&] { counts = (*frames)->draw(easel.target(), {}); };
    (*frames)->decide(camera, 0, 0);
    draw();
    if (!counts) return tl::unexpected(counts.error());
    double calls_at_rest = double(counts->draw_call_count);
    options.select.distance_m = 1.5 * thing_m;
    if (Result<void> changed = (*frames)->change(options); !changed) return tl::unexpected(changed.error());
    constexpr int kSteps = 4;
    for (int i = 0; i < kSteps; ++i) {
        (*frames)->decide(camera, kPhase / kSteps * options.fade_s, 0);
        made.fragments = fragments_of(draw);
        if (!counts) return tl::unexpected(counts.error());
        made.triangles = std::max(made.triangles, double(counts->triangle_count));
    }
    made.calls_more = double(counts->draw_call_count) - calls_at_rest;
    // Drawn again, frames by turns are only put together.
    if (discrete::draws_by_turns(variant)) made.fragments -= fragments_of(draw);
    made.at = {{}, (*frames)->director().frame(), {one}, camera, easel.target().read()};
    return made;
}

// Pixels of a that differ from b's in any channel by more than `least`, where the mask is white.
size_t differing(const ImageRgb8& a, const ImageRgb8& b, const ImageRgb8& mask, int least) {
    size_t count = 0;
    for (size_t i = 0; i < a.pixels.size(); i += 3) {
        int most = 0;
        for (size_t k = i; k < i + 3; ++k) most = std::max(most, std::abs(int(a.pixels[k]) - int(b.pixels[k])));
        count += mask.pixels[i] > 0 && most > least;
    }
    return count;
}
size_t white_count(const ImageRgb8& mask) {
    size_t count = 0;
    for (size_t i = 0; i < mask.pixels.size(); i += 3) count += mask.pixels[i] > 0;
    return count;
}

discrete::FrameList whole(uint32_t level) {
    discrete::FrameList list;
    list.items = {{0, level, discrete::Show::whole, 1, 0, 1}};
    return list;
}

// A level alone: its picture, its mask, what shading it takes.
struct Alone {
    ImageRgb8 picture, mask;
    double fragments = 0;
};
Result<Alone> alone(Easel& easel, uint32_t level, const view::Camera& camera) {
    Placement one;
    Alone made;
    Result<ImageRgb8> picture;
    double background = fragments_of([&] { picture = easel.paint({}, {&one, 1}, camera, 0, Paint::true_colours); });
    made.fragments = fragments_of([&] { picture = easel.paint(whole(level), {&one, 1}, camera, 0, Paint::true_colours); });
    if (!picture) return tl::unexpected(picture.error());
    made.picture = std::move(*picture);
    Result<ImageRgb8> mask = easel.paint(whole(level), {&one, 1}, camera, 0, Paint::mask);
    if (!mask) return tl::unexpected(mask.error());
    made.mask = std::move(*mask);
    made.fragments = std::max(1.0, made.fragments - background + double(white_count(made.mask)));
    return made;
}

// Of the pixels that are of one level alone: those that show neither that level nor what lies behind it.
double mixed_share(const ImageRgb8& picture, const Alone& fine, const Alone& coarse, const ImageRgb8& behind) {
    size_t all = 0, mixed = 0;
    auto is_far = [&](const ImageRgb8& from, size_t i) {
        int most = 0;
        for (size_t k = i; k < i + 3; ++k) most = std::max(most, std::abs(int(picture.pixels[k]) - int(from.pixels[k])));
        return most > kSeen;
    };
    for (size_t i = 0; i < picture.pixels.size(); i += 3) {
        bool in_fine = fine.mask.pixels[i] > 0, in_coarse = coarse.mask.pixels[i] > 0;
        if (in_fine == in_coarse) continue;
        ++all;
        mixed += is_far(in_fine ? fine.picture : coarse.picture, i) && is_far(behind, i);
    }
    return double(mixed) / double(std::max<size_t>(1, all));
}

Chain reversed(Chain chain) {
    for (discrete::Level& level : chain.levels)
        for (const discrete::Draw& draw : level.draws)
            for (uint32_t i = 0; i < draw.index_count / 2; i += 3)
                std::swap_ranges(level.indices.begin() + draw.first_index + i, level.indices.begin() + draw.first_index + i + 3,
                                 level.indices.begin() + draw.first_index + draw.index_count - 3 - i);
    return chain;
}

// Each triangle as four, in another colour; every place stays on its plane of the grid.
discrete::Level quartered(const discrete::Level& from) {
    discrete::Level made;
    for (const discrete::Draw& draw : from.draws) {
        auto first = uint32_t(made.indices.size());
        for (uint32_t i = draw.first_index; i < draw.first_index + draw.index_count; i += 3) {
            std::array<discrete::Vertex, 6> corners;
            for (uint32_t k = 0; k < 3; ++k) corners[k] = from.vertices[from.indices[i + k]];
            for (size_t k = 0; k < 3; ++k) {
                corners[3 + k] = corners[k];
                for (size_t axis = 0; axis < 3; ++axis)
                    corners[3 + k].position[axis] =
                        uint16_t((uint32_t(corners[k].position[axis]) + corners[(k + 1) % 3].position[axis]) / 2);
            }
            auto base = uint32_t(made.vertices.size());
            for (discrete::Vertex& corner : corners) {
                corner.colour = {255, 255, 255, 255};
                made.vertices.push_back(corner);
            }
            for (uint32_t k : {0, 3, 5, 3, 1, 4, 5, 4, 2, 3, 4, 5}) made.indices.push_back(base + k);
        }
        made.draws.push_back({draw.surface, first, uint32_t(made.indices.size()) - first});
    }
    return made;
}

// The last level and the same in other triangles.
Chain coplanar(const Chain& from) {
    Chain chain = from;
    discrete::Level last = from.levels.back();
    for (discrete::Vertex& vertex : last.vertices) vertex.colour = {60, 60, 60, 255};
    chain.levels = {quartered(from.levels.back()), last};
    chain.levels[1].error_m = 0;
    chain.visibility.clear();
    for (caveclod::Surface& surface : chain.surfaces) surface.colour = {230, 120, 60, 255}, surface.texture_bytes.clear();
    return chain;
}

using Numbers = Result<std::array<double, 3>>;

Result<std::vector<Drawback>> first_four(Easel& easel, const view::Camera& camera) {
    Result<Alone> fine = alone(easel, 0, camera), coarse = alone(easel, 1, camera);
    if (!fine) return tl::unexpected(fine.error());
    if (!coarse) return tl::unexpected(coarse.error());
    Placement one;
    Result<ImageRgb8> behind = easel.paint({}, {&one, 1}, camera, 0, Paint::true_colours);
    if (!behind) return tl::unexpected(behind.error());
    std::vector<Drawback> all = {
        {1, "both levels are drawn", "triangles, times those of the finer level"},
        {2, "fragments of both levels are shaded", "fragments, times those of the finer level"},
        {3, "state changes", "draw calls more than at rest"},
        {4, "outlines that do not match are translucent", "% of the pixels that one level alone covers"}};
    double background = double(kSide_px) * kSide_px - double(white_count(fine->mask));
    for (size_t way = 0; way < kVariants.size(); ++way) {
        Result<Quarter> at = quarter(easel, kVariants[way], camera);
        if (!at) return tl::unexpected(at.error());
        all[0].of_way[way] = at->triangles / double(easel.chain().levels[0].triangle_count());
        all[1].of_way[way] = (at->fragments - background) / fine->fragments;
        all[2].of_way[way] = at->calls_more;
        all[3].of_way[way] = 100 * mixed_share(at->at.picture, *fine, *coarse, *behind);
    }
    if (!counts_fragments()) all.erase(all.begin() + 1);
    return all;
}

Numbers order_shares(Easel& easel, const view::Camera& camera) {
    auto other = Easel::make(reversed(easel.chain()), kSide_px, kSide_px, 1);
    if (!other) return tl::unexpected(other.error());
    Result<Alone> fine = alone(easel, 0, camera);
    if (!fine) return tl::unexpected(fine.error());
    std::array<double, 3> shares{};
    for (size_t way = 0; way < kVariants.size(); ++way) {
        Result<Quarter> a = quarter(easel, kVariants[way], camera), b = quarter(**other, kVariants[way], camera);
        if (!a) return tl::unexpected(a.error());
        if (!b) return tl::unexpected(b.error());
        size_t changed = differing(a->at.picture, b->at.picture, fine->mask, kSeen);
        shares[way] = 100 * double(changed) / double(std::max<size_t>(1, white_count(fine->mask)));
    }
    return shares;
}

Numbers coplanar_shares(const Chain& chain) {
    auto easel = Easel::make(coplanar(chain), kSide_px, kSide_px, 1);
    if (!easel) return tl::unexpected(easel.error());
    view::Camera camera = (*easel)->camera_at({}, kFills), moved;
    camera.position_m += (*easel)->chain().radius_m * glm::dvec3(1, -0.2, 0.9);
    camera.heading_deg = -24, camera.pitch_deg = -16;
    moved = camera;
    moved.position_m.x += 0.01 * glm::length(camera.position_m - (*easel)->chain().middle_m) / view::focal_px(camera);
    Result<Alone> fine = alone(**easel, 0, camera);
    if (!fine) return tl::unexpected(fine.error());
    std::array<double, 3> shares{};
    for (size_t way = 0; way < kVariants.size(); ++way) {
        Result<Quarter> a = quarter(**easel, kVariants[way], camera), b = quarter(**easel, kVariants[way], moved);
        if (!a) return tl::unexpected(a.error());
        if (!b) return tl::unexpected(b.error());
        size_t changed = differing(a->at.picture, b->at.picture, fine->mask, kSeen);
        shares[way] = 100 * double(changed) / double(std::max<size_t>(1, white_count(fine->mask)));
    }
    return shares;
}

}  // namespace

Result<std::vector<Drawback>> drawbacks_of(const World& scene) {
    const Chain& chain = *things_of(scene).chain;
    auto easel = Easel::make(chain, kSide_px, kSide_px, 1);
    if (!easel) return tl::unexpected(easel.error());
    view::Camera camera = (*easel)->camera_at({}, kFills);
    Result<std::vector<Drawback>> all = first_four(**easel, camera);
    if (!all) return all;
    Numbers order = order_shares(**easel, camera), fighting = coplanar_shares(chain);
    if (!order) return tl::unexpected(order.error());
    if (!fighting) return tl::unexpected(fighting.error());
    all->push_back(
        {5, "what is translucent must be sorted, triangle by triangle", "% of its pixels that change with the order", *order});
    all->push_back({6, "coplanar levels fight", "% of their pixels that change when the eye moves by 0.01 px", *fighting});
    return all;
}

}  // namespace overlook::measure::paper::fsi
