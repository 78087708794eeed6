#include "runtime/terrain/refine.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "formats/parallel.h"
#include "formats/terrain_diamond.h"
#include "runtime/terrain/height_bounds.h"
#include "runtime/terrain/refine_parts.h"
#include "runtime/terrain/screen_test.h"

namespace overlook::terrain {
namespace {

constexpr size_t kSlicesWanted = 4096, kPiecesAtATime = 8;

// A triangle on its way down: `level` and `is_square` tell the diamond that it would be split in; level -1 is the finest.
struct Piece {
    Triangle triangle;
    int level;
    bool is_square;
    bool parent_covers_void;
    uint8_t planes;   // of the view, still to be tested
    double rises[3];  // of apex, left and right over their samples' own heights, in steps; 0 but for those that morph
};

// Splits by the stored error alone.
struct MetreTest {
    const HeightBounds& bounds;
    int greatest_kept_code;

    Answer operator()(GridPoint v, uint32_t level, bool is_square, uint8_t code, uint8_t&, double&) const {
        if (code == kMustSplit && is_square && bounds.of_square(v.x, v.y, level).is_empty()) return {Verdict::leave_out};
        return {code > greatest_kept_code ? Verdict::split : Verdict::keep};
    }
};

template <class Test>
class Walk {
  public:
    Walk(const Terrain& terrain, const Test& test, bool wants_codes, Cut::Part& part)
        : terrain_(terrain), shape_(terrain.shape), test_(test), wants_codes_(wants_codes), part_(part) {
        for (uint32_t level = 0; level < shape_.root_log2; ++level) columns_[level] = level_grid(shape_, level).columns;
    }

    // Everything below a piece; pieces `depth` splits further down are handed to `later` instead.
    template <class Later>
    void descend(const Piece& piece, int depth, const Later& later) {
        if (reaches_edge(piece.triangle) && is_degenerate(shape_, piece.triangle)) return;
        if (piece.level < 0) return emit_finest(piece);
        if (depth == 0) return later(piece);
        const Triangle& t = piece.triangle;
        GridPoint v{(t.left.x + t.right.x) / 2, (t.left.y + t.right.y) / 2};
        uint32_t level = uint32_t(piece.level);
        uint8_t code = terrain_.codes[level][size_t(v.y >> level) * columns_[level] + (v.x >> level)];
        uint8_t planes = piece.planes;
        ++part_.tested_count;
        Answer answer = test_(v, level, piece.is_square, code, planes, part_.predicted_squared);
        if (answer.verdict == Verdict::leave_out) return;
        if (answer.verdict == Verdict::keep) return emit(piece, code);
        int next = piece.is_square ? piece.level : piece.level - 1;
        bool covers_void = code == kMustSplit;
        const double* r = piece.rises;
        double rise = answer.share < 1 ? rise_of(v, piece, answer.share) : 0;
        descend(Piece{{v, t.apex, t.left}, next, !piece.is_square, covers_void, planes, {rise, r[0], r[1]}}, depth - 1, later);
        descend(Piece{{v, t.right, t.apex}, next, !piece.is_square, covers_void, planes, {rise, r[2], r[0]}}, depth - 1, later);
    }
    void descend(const Piece& piece) {
        descend(piece, std::numeric_limits<int>::max(), [](const Piece&) {});
    }

  private:
    bool reaches_edge(const Triangle& t) const {
        return std::max({t.apex.x, t.left.x, t.right.x}) >= shape_.width ||
               std::max({t.apex.y, t.left.y, t.right.y}) >= shape_.height;
    }
    uint32_t index_of(GridPoint p) const {
        GridPoint sample = sample_of(shape_, p);
        return sample.y * shape_.width + sample.x;
    }
    // h(v) - z(v) of a vertex that has come `share` of its way, from the rises of the ends of its edge.
    double rise_of(GridPoint v, const Piece& piece, double share) const {
        double left = terrain_.heights[index_of(piece.triangle.left)], right = terrain_.heights[index_of(piece.triangle.right)];
        double own = terrain_.heights[index_of(v)];
        return (piece.rises[1] + piece.rises[2]) / 2 + (1 - share) * ((left + right) / 2 - own);
    }

    uint32_t vertex_of(GridPoint p, double rise) {
        uint32_t sample = index_of(p);
        if (rise == 0) return sample;
        Known& known = known_[(sample * 0x9e3779b1u) >> 24];
        if (known.place >= part_.morphs.size() || part_.morphs[known.place].sample != sample) {
            known.place = uint32_t(part_.morphs.size());
            part_.morphs.push_back({sample, float(rise * terrain_.height_step_m)});
        }
        return Cut::kMorphBit | known.place;
    }
    void emit(const Piece& piece, uint8_t code) {
        const Triangle& t = piece.triangle;
        part_.void_rim_triangle_count += piece.parent_covers_void;
        if (wants_codes_) part_.codes.push_back(code);
        part_.indices.insert(part_.indices.end(), {vertex_of(t.apex, piece.rises[0]), vertex_of(t.left, piece.rises[1]),
                                                   vertex_of(t.right, piece.rises[2])});
    }
    void emit_finest(const Piece& piece) {
        const Triangle& t = piece.triangle;
        if (piece.parent_covers_void || shape_.root_log2 == 0)
            for (GridPoint p : {t.apex, t.left, t.right})
                if (terrain_.heights[index_of(p)] == kVoid) return;
        emit(piece, 0);
    }

    // Where a sample's morph was put lately: most vertices of a triangle were those of the one before.
    struct Known {
        uint32_t place = ~0u;
    };

    const Terrain& terrain_;
    const Shape& shape_;
    const Test& test_;
    bool wants_codes_;
    Cut::Part& part_;
    uint32_t columns_[32];
    Known known_[256];
};

// The two triangles of every root square.
std::vector<Piece> root_pieces(const Shape& shape, uint8_t planes) {
    std::vector<Piece> pieces;
    uint32_t side = 1u << shape.root_log2;
    for (uint32_t j = 0; j < shape.root_rows; ++j)
        for (uint32_t i = 0; i < shape.root_columns; ++i) {
            GridPoint nw{i * side, j * side}, ne{nw.x + side, nw.y}, sw{nw.x, nw.y + side}, se{ne.x, sw.y};
            bool main = is_main_diagonal(i, j);
            int level = int(shape.root_log2) - 1;
            pieces.push_back({main ? Triangle{ne, nw, se} : Triangle{nw, sw, ne}, level, true, false, planes, {0, 0, 0}});
            pieces.push_back({main ? Triangle{sw, se, nw} : Triangle{se, ne, sw}, level, true, false, planes, {0, 0, 0}});
        }
    return pieces;
}

// Goes down from the roots far enough to leave at least parts_wanted pieces, if nothing were left out; what ends above goes to
// the cut's first part.
template <class Test>
std::vector<Piece> top_of(const Terrain& terrain, const Test& test, uint8_t planes, size_t parts_wanted, Cut& out) {
    std::vector<Piece> roots = root_pieces(terrain.shape, planes), pieces;
    int depth = 0;
    while ((roots.size() << depth) < parts_wanted) ++depth;

    if (out.parts.empty()) out.parts.resize(1);
    start(out.parts[0]);
    Walk<Test> top(terrain, test, out.wants_codes, out.parts[0]);
    for (const Piece& root : roots) top.descend(root, depth, [&](const Piece& piece) { pieces.push_back(piece); });
    return pieces;
}

// All that hangs below each of the pieces, into the cut's parts from `first` on.
template <class Test>
void descend_all(const Terrain& terrain, const Test& test, std::span<const Piece> pieces, size_t first, Cut& out) {
    if (out.parts.size() < first + pieces.size()) out.parts.resize(first + pieces.size());
    parallel_ranges(pieces.size(), 1, [&](size_t i, size_t) {
        start(out.parts[first + i]);
        Walk<Test>(terrain, test, out.wants_codes, out.parts[first + i]).descend(pieces[i]);
    });
}

// The top of the hierarchy in one piece, then what hangs below it in parts of their own.
template <class Test>
void refine(const Terrain& terrain, const Test& test, uint8_t planes, Cut& out) {
    std::vector<Piece> pieces = top_of(terrain, test, planes, kPartsWanted, out);
    descend_all(terrain, test, std::span<const Piece>(pieces), 1, out);
    join(pieces.size() + 1, terrain.heights.size(), out);
}

}  // namespace

struct Refiner::Impl {
    const Terrain& terrain;
    HeightBounds bounds;
};

Refiner::Refiner(const Terrain& terrain) : impl_(new Impl{terrain, HeightBounds(terrain)}) {}
Refiner::~Refiner() = default;
Refiner::Refiner(Refiner&&) noexcept = default;

void Refiner::cut_by_metres(double tolerance_m, Cut& out) const {
    const auto& errors = impl_->terrain.error_m;
    auto above = std::upper_bound(errors.begin(), errors.begin() + kMustSplit, tolerance_m,
                                  [](double tolerance, float error) { return tolerance < double(error); });
    refine(impl_->terrain, MetreTest{impl_->bounds, int(above - errors.begin()) - 1}, 0, out);
}

void Refiner::cut_by_pixels(const view::Camera& camera, double error_px, Cut& out, double morph) const {
    cut_by_pixels(camera, view::PixelDetail{error_px, morph, 0, error_px}, out);
}

void Refiner::cut_by_pixels(const view::Camera& camera, const view::PixelDetail& detail, Cut& out) const {
    ScreenTest test(impl_->terrain, impl_->bounds, camera, detail);
    refine(impl_->terrain, test, ScreenTest::kAllPlanes, out);
}

glm::dvec3 Refiner::vertex_m(const Cut& cut, uint32_t index) const {
    const Terrain& terrain = impl_->terrain;
    uint32_t sample = index;
    double rise_m = 0;
    if (index >= terrain.heights.size()) {
        const Cut::Morph& morph = cut.morphs[index - terrain.heights.size()];
        sample = morph.sample;
        rise_m = morph.rise_m;
    }
    uint32_t column = sample % terrain.shape.width, row = sample / terrain.shape.width;
    return {column * terrain.frame.metres_per_column, -(row * terrain.frame.metres_per_row),
            terrain.height_offset_m + terrain.height_step_m * terrain.heights[sample] + rise_m};
}

struct SlicedCut::Impl {
    const Terrain& terrain;
    ScreenTest test;
    std::vector<Piece> pieces;
    size_t done_count = 0;
    Cut::Part top;  // what ends above the pieces; goes with the first slice
    bool is_top_out = false;
    std::vector<uint32_t> rest;  // indices that the slice before had no place for
    std::vector<uint8_t> rest_codes;
};

SlicedCut::SlicedCut(const Refiner& refiner, const view::Camera& camera, double error_px) {
    const Refiner::Impl& from = *refiner.impl_;
    impl_.reset(new Impl{
        from.terrain, ScreenTest(from.terrain, from.bounds, camera, {error_px, 0, 0, error_px}), {}, 0, {}, false, {}, {}});
    Cut top;
    impl_->pieces = top_of(from.terrain, impl_->test, ScreenTest::kAllPlanes, kSlicesWanted, top);
    impl_->top = std::move(top.parts[0]);
}
SlicedCut::~SlicedCut() = default;
SlicedCut::SlicedCut(SlicedCut&&) noexcept = default;
SlicedCut& SlicedCut::operator=(SlicedCut&&) noexcept = default;

void SlicedCut::next(uint64_t triangles_wanted, Cut& out) {
    if (out.parts.empty()) out.parts.resize(1);
    if (impl_->is_top_out)
        start(out.parts[0]);
    else
        out.parts[0] = std::move(impl_->top);
    impl_->is_top_out = true;
    size_t part_count = 1;
    Cut::Part& first = out.parts[0];
    first.indices.insert(first.indices.begin(), impl_->rest.begin(), impl_->rest.end());
    first.codes.insert(first.codes.begin(), impl_->rest_codes.begin(), impl_->rest_codes.end());
    impl_->rest.clear(), impl_->rest_codes.clear();
    uint64_t index_count = first.indices.size();
    while (!is_done() && index_count / 3 < triangles_wanted) {
        std::span<const Piece> left = std::span<const Piece>(impl_->pieces).subspan(impl_->done_count);
        std::span<const Piece> group = left.first(std::min(left.size(), kPiecesAtATime));
        descend_all(impl_->terrain, impl_->test, group, part_count, out);
        for (size_t i = 0; i < group.size(); ++i) index_count += out.parts[part_count + i].indices.size();
        part_count += group.size();
        impl_->done_count += group.size();
    }
    join(part_count, impl_->terrain.heights.size(), out);
    if (out.triangle_count() <= triangles_wanted) return;
    impl_->rest.assign(out.indices.begin() + ptrdiff_t(3 * triangles_wanted), out.indices.end());
    out.indices.resize(3 * triangles_wanted);
    if (!out.wants_codes) return;
    impl_->rest_codes.assign(out.codes.begin() + ptrdiff_t(triangles_wanted), out.codes.end());
    out.codes.resize(triangles_wanted);
}

bool SlicedCut::is_done() const {
    return impl_->is_top_out && impl_->done_count == impl_->pieces.size() && impl_->rest.empty();
}

double SlicedCut::share_done() const {
    if (impl_->pieces.empty()) return impl_->is_top_out ? 1 : 0;
    return double(impl_->done_count) / double(impl_->pieces.size());
}

const Terrain& Refiner::terrain() const {
    return impl_->terrain;
}
double Refiner::lowest_m() const {
    return impl_->bounds.whole().low_m;
}
double Refiner::highest_m() const {
    return impl_->bounds.whole().high_m;
}

}  // namespace overlook::terrain
