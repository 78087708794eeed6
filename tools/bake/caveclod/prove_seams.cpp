#include "tools/bake/caveclod/prove_seams.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "formats/parallel.h"

namespace overlook::caveclod {
namespace {

// What float32 attributes and the grid's rounding cannot tell apart.
constexpr double kTexelSlack = 1e-3, kAngleSlack_deg = 1e-2;
constexpr uint64_t kCutsAtOnce = 16;  // between two words of progress

// A corner of the finest cut, by its group.
struct SourceCorner {
    uint32_t group = 0;
    float x_m = 0;
    uint32_t position = 0, vertex = 0;
    auto key() const { return std::tie(group, x_m, position, vertex); }
};

bool looks_the_same(const RenderVertex& a, const RenderVertex& b) {
    return a.normal == b.normal && a.uv == b.uv && a.colour == b.colour;
}

class Judge {
  public:
    Judge(const Hierarchy& h, const SeamBudget& budget) : h_(h), budget_(budget) {
        CutFaces finest = faces_of(h, Applied(h.split_count(), 1));
        for (size_t f = 0; f < finest.face.size(); ++f)
            for (size_t c = 0; c < 3; ++c)
                corners_.push_back({h.face_group[finest.face[f]], h.positions_m[finest.positions[f][c]].x, finest.positions[f][c],
                                    finest.vertices[f][c]});
        auto is_before = [](const SourceCorner& a, const SourceCorner& b) { return a.key() < b.key(); };
        auto is_same = [](const SourceCorner& a, const SourceCorner& b) { return a.key() == b.key(); };
        std::sort(corners_.begin(), corners_.end(), is_before);
        corners_.erase(std::unique(corners_.begin(), corners_.end(), is_same), corners_.end());
    }

    SeamsProof judge(const Applied& applied) const {
        SeamsProof found;
        CutFaces cut = faces_of(h_, applied);
        double stated_m = stated_error_m(h_, applied);
        for (size_t f = 0; f < cut.face.size(); ++f) {
            Face face{h_.face_group[cut.face[f]], {}, {}};
            for (size_t c = 0; c < 3; ++c) {
                face.at[c] = glm::dvec3(h_.positions_m[cut.positions[f][c]]);
                face.looks[c] = &h_.vertices[cut.vertices[f][c]];
            }
            for (size_t c = 0; c < 3; ++c) judge_corner(face, c, cut.positions[f][c], stated_m, found);
        }
        return found;
    }

  private:
    struct Face {
        uint32_t group = 0;
        std::array<glm::dvec3, 3> at;
        std::array<const RenderVertex*, 3> looks;
    };

    // Those of the group whose x lies between.
    template <class Visit>
    void visit(uint32_t group, float low_m, float high_m, const Visit& visit) const {
        auto is_before = [](const SourceCorner& a, const std::pair<uint32_t, float>& b) {
            return std::tie(a.group, a.x_m) < std::tie(b.first, b.second);
        };
        auto it = std::lower_bound(corners_.begin(), corners_.end(), std::pair(group, low_m), is_before);
        for (; it != corners_.end() && it->group == group && it->x_m <= high_m; ++it) visit(*it);
    }

    void judge_corner(const Face& face, size_t c, uint32_t position, double stated_m, SeamsProof& found) const {
        ++found.corner_count;
        float x_m = h_.positions_m[position].x;
        bool is_own = false;
        visit(face.group, x_m, x_m, [&](const SourceCorner& corner) {
            is_own |= corner.position == position && looks_the_same(h_.vertices[corner.vertex], *face.looks[c]);
        });
        if (is_own) return;
        ++found.carried_count;
        SeamError least{std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
        double least_share = std::numeric_limits<double>::max(), shift_m = 0, reach_m = stated_m * (1 + 1e-6);
        visit(face.group, float(double(x_m) - reach_m), float(double(x_m) + reach_m), [&](const SourceCorner& corner) {
            glm::dvec3 from(h_.positions_m[corner.position]);
            double away_m = glm::distance(from, face.at[c]);
            if (away_m > reach_m) return;
            SeamError error = error_against(face, c, from, h_.vertices[corner.vertex]);
            if (share_of(error) < least_share) least_share = share_of(error), least = error, shift_m = away_m;
        });
        bool is_right = budget_.moves && least.uv_texels <= budget_.uv_texels + kTexelSlack &&
                        least.normal_deg <= budget_.normal_deg + kAngleSlack_deg;
        found.wrong_count += !is_right;
        if (least_share == std::numeric_limits<double>::max()) return;
        found.worst.include(least);
        found.greatest_shift_m = std::max(found.greatest_shift_m, shift_m);
    }

    // Of the budget; a budget of nothing is used up by the smallest error.
    double share_of(const SeamError& error) const {
        return std::max(error.uv_texels / (budget_.uv_texels + kTexelSlack),
                        error.normal_deg / (budget_.normal_deg + kAngleSlack_deg));
    }

    SeamError error_against(const Face& face, size_t c, const glm::dvec3& from, const RenderVertex& look) const {
        uint32_t surface = h_.group_surface[face.group];
        glm::dvec2 texture_px = surface < budget_.texture_px.size() ? budget_.texture_px[surface] : glm::dvec2(kTextureSize_px);
        SeamError error = between(*face.looks[c], look, texture_px);
        error.include(between(interpolated(from, face.at, face.looks), look, texture_px));
        return error;
    }

    const Hierarchy& h_;
    const SeamBudget& budget_;
    std::vector<SourceCorner> corners_;
};

}  // namespace

SeamsProof prove_seams(const Hierarchy& h, const SeamBudget& budget, const ProofOptions& options,
                       const std::function<void(double)>& progress) {
    Judge judge(h, budget);
    SeamsProof proof;
    for (uint64_t begin = 0; begin < options.cut_count; begin += kCutsAtOnce) {
        progress(double(begin) / double(options.cut_count));
        uint64_t count = std::min<uint64_t>(kCutsAtOnce, options.cut_count - begin);
        std::vector<SeamsProof> found(count);
        parallel_ranges(count, 1, [&](size_t i, size_t) { found[i] = judge.judge(proof_cut(h, options, begin + i)); });
        for (const SeamsProof& one : found) {
            proof.corner_count += one.corner_count, proof.carried_count += one.carried_count,
                proof.wrong_count += one.wrong_count;
            proof.worst.include(one.worst);
            proof.greatest_shift_m = std::max(proof.greatest_shift_m, one.greatest_shift_m);
        }
    }
    return proof;
}

}  // namespace overlook::caveclod
