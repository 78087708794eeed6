#include "runtime/terrain/refine.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "formats/parallel.h"
#include "formats/terrain_diamond.h"
#include "runtime/terrain/height_bounds.h"
#include "runtime/terrain/screen_test.h"

namespace overlook::terrain {
namespace {

constexpr size_t kPartsWanted = 256;

// A triangle on its way down: `level` and `is_square` tell the diamond that it would be split in; level -1 is the finest.
struct Piece {
    Triangle triangle;
    int level;
    bool is_square;
    bool parent_covers_void;
    uint8_t planes;  // of the view, still to be tested
};

// Splits by the stored error alone.
struct MetreTest {
    const HeightBounds& bounds;
    int greatest_kept_code;

    Verdict operator()(GridPoint v, uint32_t level, bool is_square, uint8_t code, uint8_t&, double&) const {
        if (code == kMustSplit && is_square && bounds.of_square(v.x, v.y, level).is_empty()) return Verdict::leave_out;
        return code > greatest_kept_code ? Verdict::split : Verdict::keep;
    }
};

template <class Test>
class Walk {
  public:
    Walk(const Terrain& terrain, const Test& test, Cut::Part& part)
        : terrain_(terrain), shape_(terrain.shape), test_(test), part_(part) {
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
        Verdict verdict = test_(v, level, piece.is_square, code, planes, part_.predicted_squared);
        if (verdict == Verdict::leave_out) return;
        if (verdict == Verdict::keep) return emit(piece);
        int next = piece.is_square ? piece.level : piece.level - 1;
        bool covers_void = code == kMustSplit;
        descend(Piece{{v, t.apex, t.left}, next, !piece.is_square, covers_void, planes}, depth - 1, later);
        descend(Piece{{v, t.right, t.apex}, next, !piece.is_square, covers_void, planes}, depth - 1, later);
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
    void emit(const Piece& piece) {
        part_.void_rim_triangle_count += piece.parent_covers_void;
        part_.indices.insert(part_.indices.end(),
                             {index_of(piece.triangle.apex), index_of(piece.triangle.left), index_of(piece.triangle.right)});
    }
    void emit_finest(const Piece& piece) {
        const Triangle& t = piece.triangle;
        if (piece.parent_covers_void || shape_.root_log2 == 0)
            for (GridPoint p : {t.apex, t.left, t.right})
                if (terrain_.heights[index_of(p)] == kVoid) return;
        emit(piece);
    }

    const Terrain& terrain_;
    const Shape& shape_;
    const Test& test_;
    Cut::Part& part_;
    uint32_t columns_[32];
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
            pieces.push_back({main ? Triangle{ne, nw, se} : Triangle{nw, sw, ne}, level, true, false, planes});
            pieces.push_back({main ? Triangle{sw, se, nw} : Triangle{se, ne, sw}, level, true, false, planes});
        }
    return pieces;
}

void start(Cut::Part& part) {
    part.indices.clear();
    part.void_rim_triangle_count = part.tested_count = 0;
    part.predicted_squared = 0;
}

// All parts one after the other.
void join(size_t part_count, Cut& out) {
    std::vector<size_t> begins(part_count + 1, 0);
    out.void_rim_triangle_count = out.tested_count = 0;
    double predicted_squared = 0;
    for (size_t i = 0; i < part_count; ++i) {
        const Cut::Part& part = out.parts[i];
        begins[i + 1] = begins[i] + part.indices.size();
        out.void_rim_triangle_count += part.void_rim_triangle_count;
        out.tested_count += part.tested_count;
        predicted_squared = std::max(predicted_squared, part.predicted_squared);
    }
    out.predicted_error_px = std::sqrt(predicted_squared);
    out.indices.resize(begins.back());
    parallel_ranges(part_count, 16, [&](size_t first, size_t end) {
        for (size_t i = first; i < end; ++i)
            std::copy(out.parts[i].indices.begin(), out.parts[i].indices.end(), out.indices.begin() + ptrdiff_t(begins[i]));
    });
}

// The top of the hierarchy in one piece, then what hangs below it in parts of their own.
template <class Test>
void refine(const Terrain& terrain, const Test& test, uint8_t planes, Cut& out) {
    std::vector<Piece> roots = root_pieces(terrain.shape, planes), pieces;
    int depth = 0;
    while ((roots.size() << depth) < kPartsWanted) ++depth;

    if (out.parts.empty()) out.parts.resize(1);
    start(out.parts[0]);
    Walk<Test> top(terrain, test, out.parts[0]);
    for (const Piece& root : roots) top.descend(root, depth, [&](const Piece& piece) { pieces.push_back(piece); });

    if (out.parts.size() < pieces.size() + 1) out.parts.resize(pieces.size() + 1);
    parallel_ranges(pieces.size(), 1, [&](size_t i, size_t) {
        start(out.parts[i + 1]);
        Walk<Test>(terrain, test, out.parts[i + 1]).descend(pieces[i]);
    });
    join(pieces.size() + 1, out);
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

void Refiner::cut_by_pixels(const view::Camera& camera, double error_px, Cut& out) const {
    ScreenTest test(impl_->terrain, impl_->bounds, camera, error_px);
    refine(impl_->terrain, test, ScreenTest::kAllPlanes, out);
}

double Refiner::lowest_m() const {
    return impl_->bounds.whole().low_m;
}
double Refiner::highest_m() const {
    return impl_->bounds.whole().high_m;
}

}  // namespace overlook::terrain
