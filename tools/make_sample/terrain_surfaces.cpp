#include "tools/make_sample/terrain_surfaces.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "tools/bake/caveclod/groups.h"
#include "tools/bake/images.h"

namespace overlook::sample {

namespace {

constexpr uint32_t kFirstVariants = 12, kVariants = 48;
constexpr double kPopulationSlack = 0.01;

}  // namespace

Result<mesh::Mesh> nearest_to_paper(const PaperTerrain& paper, uint64_t seed,
                                    const std::function<mesh::Mesh(uint32_t variant)>& make) {
    std::optional<mesh::Mesh> best;
    int64_t best_off = 0;
    for (uint32_t variant = 0; variant < kVariants && !(best && variant >= kFirstVariants); ++variant) {
        mesh::Mesh mesh = make(variant);
        Result<caveclod::Groups> groups = caveclod::find_groups(mesh, {});
        if (!groups) return tl::unexpected(groups.error());
        int64_t off = std::llabs(int64_t(groups->vertices.size()) - int64_t(paper.vertex_count()));
        bool is_like = groups->packed_count == paper.packed_count && groups->clique_bound == paper.packed_count &&
                       std::abs(groups->dense_population - paper.dense_population) < kPopulationSlack;
        if (!is_like || (best && off >= best_off)) continue;
        best_off = off;
        best = std::move(mesh);
    }
    if (best) return std::move(*best);
    return impossible("{}: seed {} makes no ground that needs {} ids; take another seed", paper.name, seed, paper.packed_count);
}

Result<void> dress_surfaces(std::span<const GroundKind> kinds, uint64_t seed, mesh::Mesh& mesh) {
    for (GroundKind kind : kinds) {
        Result<std::vector<std::byte>> png = png_bytes(ground_texture(kind, kTexture_px, seed));
        if (!png) return tl::unexpected(png.error());
        mesh::Surface surface;
        surface.name = name_of(kind);
        surface.texture = surface.name + ".png";
        for (std::byte byte : *png) surface.texture_bytes.push_back(uint8_t(byte));
        mesh.surfaces.push_back(std::move(surface));
    }
    return {};
}

std::string terrain_recipe(const PaperTerrain& paper, uint64_t seed, const std::string& made_from) {
    std::string text = fmt::format(
        "# Written by make-sample; the same lines give the same bytes.\n"
        "sample = \"{}\"\nversion = \"{}\"\nseed = {}\n",
        paper.name, OVERLOOK_VERSION, seed);
    if (!made_from.empty()) text += fmt::format("source = \"{}\"\n", made_from);
    return text + fmt::format("\n[mesh]\nfile = \"{}.obj\"\npositions = [{}, {}]\nextent_m = [{}, {}]\n", paper.name,
                              paper.columns, paper.rows, paper.width_m, paper.height_m);
}

std::vector<double> box_mean(std::span<const double> values, uint32_t columns, uint32_t rows, uint32_t reach) {
    // Along one axis after the other, by running sums.
    auto along = [&](std::span<const double> from, uint32_t count, uint32_t stride, uint32_t lines, uint32_t line_stride) {
        std::vector<double> to(from.size());
        std::vector<double> sums(count + 1, 0);
        for (uint32_t line = 0; line < lines; ++line) {
            const double* first = &from[size_t(line) * line_stride];
            for (uint32_t i = 0; i < count; ++i) sums[i + 1] = sums[i] + first[size_t(i) * stride];
            for (uint32_t i = 0; i < count; ++i) {
                uint32_t begin = i > reach ? i - reach : 0, end = std::min(count, i + reach + 1);
                to[size_t(line) * line_stride + size_t(i) * stride] = (sums[end] - sums[begin]) / (end - begin);
            }
        }
        return to;
    };
    std::vector<double> half = along(values, columns, 1, rows, columns);
    return along(half, rows, columns, columns, 1);
}

}  // namespace overlook::sample
