#include "tools/bake/discrete/from_levels.h"

#include <algorithm>
#include <cmath>

#include "formats/parallel.h"
#include "tools/bake/discrete/family.h"
#include "tools/bake/mesh_repair.h"

namespace overlook::discrete {
namespace {

// Numbers of the surfaces of all levels, equal ones once.
uint32_t number_of(std::vector<caveclod::Surface>& surfaces, const caveclod::Surface& surface) {
    auto found = std::find(surfaces.begin(), surfaces.end(), surface);
    if (found == surfaces.end()) found = surfaces.insert(surfaces.end(), surface);
    return uint32_t(found - surfaces.begin());
}

// Number in `parts` of each part of a file's motion, the resting one first. Of one name, the n-th is the n-th.
Result<std::vector<uint32_t>> parts_by_name(const std::vector<Part>& parts, const mesh::MeshFile& file,
                                            const mesh::MeshFile& first) {
    std::vector<uint32_t> numbers{0};
    std::vector<uint8_t> is_taken(parts.size(), 0);
    for (const mesh::Motion::Part& part : file.motion.parts) {
        uint32_t p = 1;
        while (p < parts.size() && (is_taken[p] != 0 || parts[p].name != part.name)) ++p;
        if (p == parts.size())
            return bad_input("{}: its part {} is not in {}", file.report.source_name, part.name, first.report.source_name);
        is_taken[p] = 1;
        numbers.push_back(p);
    }
    return numbers;
}

// A file as it is, with normals where it has none.
class ShapeReader {
  public:
    ShapeReader(const LevelsChainOptions& options, Chain& chain) : options_(options), chain_(chain) {}

    Result<Shape> read(const mesh::MeshFile& file, const std::vector<uint32_t>& part_numbers) {
        Shape shape;
        for (uint32_t part = 0; part < part_numbers.size(); ++part) {
            std::vector<uint8_t> takes(file.mesh.faces.size());
            for (size_t f = 0; f < takes.size(); ++f) takes[f] = file.motion.part_of(file.mesh.face_source[f]) == part;
            if (std::count(takes.begin(), takes.end(), 1) == 0) continue;
            mesh::Mesh piece = part_numbers.size() == 1 ? file.mesh : part_of(file.mesh, takes);
            mesh::MeshReport repaired;
            if (part_numbers.size() > 1) mesh::repair(piece, repaired);
            auto added = read_piece(piece, part_numbers[part], file.report.rounding_m);
            if (!added) return tl::unexpected(added.error());
            shape.add(*added);
        }
        return shape;
    }
    double error_m() const { return error_m_; }

  private:
    Result<Shape> read_piece(const mesh::Mesh& piece, uint32_t part, double rounding_m) {
        caveclod::BakeOptions options = options_.bake;
        options.precision.position_bits = kFineBits, options.simplify.seams.moves = false;
        options.simplify.least_face_count = piece.faces.size(), options.source_rounding_m = rounding_m;
        caveclod::BakeReport report;
        auto hierarchy = caveclod::bake(piece, options, report, [](double) {});
        if (!hierarchy) return tl::unexpected(hierarchy.error());
        error_m_ = std::max(error_m_, double(hierarchy->finest_error_m));
        caveclod::Attributes& has = chain_.attributes;
        has = {has.normals || hierarchy->attributes.normals, has.uvs || hierarchy->attributes.uvs,
               has.colours || hierarchy->attributes.colours};
        Shape shape = shape_of(*hierarchy, std::vector<uint8_t>(hierarchy->split_count(), 1), part);
        for (uint32_t& surface : shape.face_surface) surface = number_of(chain_.surfaces, hierarchy->surfaces[surface]);
        return shape;
    }

    const LevelsChainOptions& options_;
    Chain& chain_;
    double error_m_ = 0;
};

}  // namespace

caveclod::Distance distance_of_levels(const Chain& chain, const Level& a, const Level& b, const LevelsChainOptions& options) {
    caveclod::Distance worst;
    for (uint32_t part = 0; part < chain.parts.size(); ++part) {
        std::vector<caveclod::Triangle> of_a = triangles_of(chain, a, part), of_b = triangles_of(chain, b, part);
        if (of_a.empty() && of_b.empty()) continue;
        caveclod::Distance distance{0, 2 * chain.radius_m};
        if (!of_a.empty() && !of_b.empty())
            distance = caveclod::two_sided_distance(caveclod::TriangleTree(of_a), caveclod::TriangleTree(of_b), options.gap,
                                                    options.floor_share * chain.radius_m, options.most_steps, options.enough_m);
        worst = {std::max(worst.least_m, distance.least_m), std::max(worst.most_m, distance.most_m)};
    }
    return worst;
}

Result<Chain> chain_from_levels(std::span<const mesh::MeshFile> files, const LevelsChainOptions& options,
                                std::vector<MeasuredLevel>& measured, const std::function<void(double)>& progress) {
    Chain chain;
    chain.parts = parts_of(files[0].motion), chain.clip_s = files[0].motion.clip_s;
    if (chain.parts.size() > kMostParts) return impossible("{} parts move, {} can", chain.parts.size() - 1, kMostParts - 1);
    ShapeReader reader(options, chain);
    std::vector<Shape> shapes;
    for (const mesh::MeshFile& file : files) {
        auto numbers = parts_by_name(chain.parts, file, files[0]);
        if (!numbers) return tl::unexpected(numbers.error());
        auto shape = reader.read(file, *numbers);
        if (!shape) return tl::unexpected(Error{shape.error().exit, file.report.source_name + ": " + shape.error().message});
        shapes.push_back(std::move(*shape));
    }
    Grid grid = grid_of(shapes);
    chain.origin_m = grid.origin_m, chain.position_step_m = grid.position_step_m;
    chain.uv_low = grid.uv_low, chain.uv_step = grid.uv_step;
    double rounding_m = 0;
    for (const Shape& shape : shapes) chain.levels.push_back(level_of(shape, grid, rounding_m));
    chain.finest_error_m = reader.error_m() + rounding_m;
    fit_sphere(chain);
    progress(0.2);

    std::vector<caveclod::Distance> distances(files.size());
    parallel_ranges(files.size(), 1, [&](size_t k, size_t) {
        if (k > 0) distances[k] = distance_of_levels(chain, chain.levels[0], chain.levels[k], options);
    });
    for (size_t k = 0; k < files.size(); ++k) {
        measured.push_back({chain.levels[k].triangle_count(), distances[k].least_m, distances[k].most_m});
        if (k > 0) chain.levels[k].error_m = std::max(chain.levels[k - 1].error_m, rounded_up(distances[k].most_m));
    }
    progress(1);
    return chain;
}

}  // namespace overlook::discrete
