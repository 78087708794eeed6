#include "tools/bake/discrete/family.h"

#include <algorithm>
#include <cmath>

#include "tools/bake/caveclod/cut.h"
#include "tools/bake/discrete/components.h"
#include "tools/bake/mesh_repair.h"
#include "tools/bake/mesh_textures.h"

namespace overlook::discrete {
namespace {

// The splits without which more than distance_m would be off. What a split needs has at least its error, so the set is closed.
std::vector<uint8_t> applied_within(const caveclod::Hierarchy& h, double distance_m) {
    std::vector<uint8_t> applied(h.split_count());
    for (uint32_t i = 0; i < h.split_count(); ++i) applied[i] = double(h.error_m[i]) > distance_m;
    return applied;
}

double size_of(const mesh::Mesh& mesh) {
    glm::dvec3 low(1e300), high(-1e300);
    for (const glm::vec3& p : mesh.positions_m) low = glm::min(low, glm::dvec3(p)), high = glm::max(high, glm::dvec3(p));
    return glm::length(high - low);
}

}  // namespace

Shape shape_of(const caveclod::Hierarchy& h, const std::vector<uint8_t>& applied, uint32_t part) {
    caveclod::CutFaces cut = caveclod::faces_of(h, applied);
    std::vector<uint32_t> number(h.vertices.size(), ~0u);
    Shape shape;
    for (size_t f = 0; f < cut.face.size(); ++f) {
        std::array<uint32_t, 3> face{};
        for (size_t c = 0; c < 3; ++c) {
            uint32_t v = cut.vertices[f][c];
            if (number[v] == ~0u) {
                number[v] = uint32_t(shape.vertices.size());
                const caveclod::RenderVertex& from = h.vertices[v];
                shape.vertices.push_back(
                    {h.origin_m + glm::dvec3(h.positions_m[from.position]), part, from.normal, from.uv, from.colour});
            }
            face[c] = number[v];
        }
        shape.faces.push_back(face);
        shape.face_surface.push_back(h.group_surface[h.face_group[cut.face[f]]]);
    }
    return shape;
}

Result<caveclod::Hierarchy> Family::bake(const mesh::Mesh& mesh, caveclod::BakeOptions options,
                                         const std::function<void(double)>& progress) {
    options.precision.position_bits = kFineBits;
    caveclod::BakeReport report;
    auto hierarchy = caveclod::bake(mesh, options, report, progress);
    if (!hierarchy) return hierarchy;
    finest_error_m_ = std::max(finest_error_m_, double(hierarchy->finest_error_m));
    const caveclod::Attributes& has = hierarchy->attributes;
    attributes_ = {attributes_.normals || has.normals, attributes_.uvs || has.uvs, attributes_.colours || has.colours};
    surfaces_ = hierarchy->surfaces;
    return hierarchy;
}

Result<void> Family::add_part(const mesh::Mesh& mesh, uint32_t part, const MeshChainOptions& options,
                              const std::function<void(double)>& progress) {
    Piece piece;
    piece.part = part;
    std::vector<uint8_t> is_card(mesh.faces.size(), 0);
    if (options.thins_foliage) is_card = find_cards(mesh, options.cards);
    auto card_count = size_t(std::count(is_card.begin(), is_card.end(), 1));
    if (card_count > 0) {
        caveclod::BakeOptions whole = options.bake;
        whole.simplify.least_face_count = card_count, whole.simplify.seams.moves = false;
        auto cards = bake(part_of(mesh, is_card), whole, [](double) {});
        if (!cards) return tl::unexpected(cards.error());
        piece.foliage = Foliage(shape_of(*cards, std::vector<uint8_t>(cards->split_count(), 1), part));
    }
    if (card_count < mesh.faces.size()) {
        for (uint8_t& mark : is_card) mark = mark == 0;
        auto solid = bake(part_of(mesh, is_card), options.bake, progress);
        if (!solid) return tl::unexpected(solid.error());
        piece.solid = std::move(*solid);
    }
    pieces_.push_back(std::move(piece));
    return {};
}

Result<Family> Family::make(const mesh::MeshFile& file, const MeshChainOptions& options,
                            const std::function<void(double)>& progress) {
    Family family;
    family.grows_ = options.grows_foliage, family.loses_ = options.thins_foliage;
    family.size_m_ = size_of(file.mesh);
    MeshChainOptions chosen = options;
    chosen.bake.source_rounding_m = file.report.rounding_m;
    if (chosen.bake.simplify.seams.moves) {
        auto sizes_px = mesh::texture_sizes_px(file.mesh);
        if (!sizes_px) return tl::unexpected(sizes_px.error());
        chosen.bake.simplify.seams.texture_px = std::move(*sizes_px);
    }
    auto part_count = uint32_t(file.motion.parts.size() + 1);
    if (part_count > kMostParts) return impossible("more than {} parts move, {} can", part_count - 1, kMostParts - 1);
    double done = 0;
    for (uint32_t part = 0; part < part_count; ++part) {
        std::vector<uint8_t> takes(file.mesh.faces.size());
        for (size_t f = 0; f < takes.size(); ++f) takes[f] = file.motion.part_of(file.mesh.face_source[f]) == part;
        double share = double(std::count(takes.begin(), takes.end(), 1)) / double(takes.size());
        if (share == 0) continue;
        mesh::Mesh piece = part_count == 1 ? file.mesh : part_of(file.mesh, takes);
        mesh::MeshReport repaired;
        if (part_count > 1) mesh::repair(piece, repaired);
        if (auto ok = family.add_part(piece, part, chosen, [&](double p) { progress(done + share * p); }); !ok)
            return tl::unexpected(ok.error());
        done += share;
    }
    return family;
}

// What is left out of a cut is off by the cut's error and its own distance from what stays.
Family::Member Family::member_of(const Piece& piece, double distance_m) const {
    Member member;
    Shape leaves;
    if (piece.foliage.card_count() > 0) {
        Foliage::Thinned thinned = piece.foliage.thinned(piece.foliage.kept_within(distance_m), grows_ ? distance_m : 0);
        member.error_m = thinned.error_m, member.lost_m2 = thinned.lost_m2;
        leaves = std::move(thinned.shape);
    }
    if (piece.solid.face_positions.empty()) {
        member.shape = std::move(leaves);
        return member;
    }
    std::vector<uint8_t> applied = applied_within(piece.solid, distance_m);
    bool is_finest = std::count(applied.begin(), applied.end(), 0) == 0;
    double error_m = is_finest ? 0 : caveclod::stated_error_m(piece.solid, applied);
    member.shape = shape_of(piece.solid, applied, piece.part);
    if (loses_ && distance_m > 0) {
        WithoutComponents without = without_small_components(member.shape, leaves, distance_m);
        error_m += without.distance_m, member.lost_m2 += without.lost_m2;
        member.shape = std::move(without.shape);
    }
    member.error_m = std::max(member.error_m, error_m);
    member.shape.add(leaves);
    return member;
}

Family::Member Family::member(double distance_m) const {
    Member member;
    for (const Piece& piece : pieces_) {
        Member part = member_of(piece, distance_m);
        member.error_m = std::max(member.error_m, part.error_m);
        member.lost_m2 += part.lost_m2;
        member.shape.add(part.shape);
    }
    return member;
}

std::vector<Family::PartPieces> Family::pieces(double distance_m) const {
    std::vector<PartPieces> all;
    for (const Piece& piece : pieces_) {
        PartPieces& made = all.emplace_back();
        made.part = piece.part;
        if (!piece.solid.face_positions.empty()) {
            made.finest = shape_of(piece.solid, applied_within(piece.solid, 0), piece.part);
            made.cut = shape_of(piece.solid, applied_within(piece.solid, distance_m), piece.part);
        }
        made.solid_face_count = made.finest.faces.size();
        made.finest.add(piece.foliage.shape());
    }
    return all;
}

uint64_t Family::card_count() const {
    uint64_t count = 0;
    for (const Piece& piece : pieces_) count += piece.foliage.card_count();
    return count;
}
uint64_t Family::card_triangle_count() const {
    uint64_t count = 0;
    for (const Piece& piece : pieces_) count += piece.foliage.shape().faces.size();
    return count;
}

}  // namespace overlook::discrete
