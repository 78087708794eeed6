#include "runtime/terrain/refine_tiles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "formats/parallel.h"
#include "runtime/terrain/refine_parts.h"
#include "runtime/terrain/screen_test.h"

namespace overlook::terrain {
namespace {

using Test = BasicScreenTest<TileBounds>;

// A corner: its place in the slots, its sample's height in steps, and its rise over that.
struct Corner {
    uint32_t place = 0;
    int32_t height = 0;
    double rise = 0;
};

// The diamond that a triangle comes from.
struct Origin {
    GridPoint v;
    uint32_t level = 0;
    bool is_square = false;
    uint8_t code = 0;
};

// A triangle on its way down, as in refine.cpp.
struct Piece {
    Triangle triangle;
    int level;
    bool is_square, parent_covers_void;
    uint8_t planes;
    Corner apex, left, right;
    Origin origin;
};

class Walk {
  public:
    Walk(const Tiles& tiles, const Test& test, bool wants_codes, Cut::Part& part)
        : tiles_(tiles), shape_(tiles.head().shape), test_(test), wants_codes_(wants_codes), part_(part) {}

    // Everything below a piece; pieces `depth` splits further down are handed to `later` instead.
    template <class Later>
    void descend(const Piece& piece, int depth, const Later& later) {
        if (is_degenerate(shape_, piece.triangle)) return;
        if (piece.level < 0) return emit_finest(piece);
        if (depth == 0) return later(piece);
        const Triangle& t = piece.triangle;
        GridPoint v{(t.left.x + t.right.x) / 2, (t.left.y + t.right.y) / 2};
        uint32_t level = uint32_t(piece.level), top = tiles_.grid().top();
        if (level < top && !tiles_.is_available(v, level, piece.is_square)) return stop(piece, v);
        uint32_t tile = tiles_.grid().at(std::min(level, top), v.x, v.y), local = tiles_.grid().local(tile, v.x, v.y);
        const Tiles::View& view = tiles_.view(tile);
        uint8_t code = view.codes[local], planes = piece.planes;
        ++part_.tested_count;
        Answer answer = test_(v, level, piece.is_square, code, planes, part_.predicted_squared);
        if (answer.verdict == Verdict::leave_out) return;
        if (answer.verdict == Verdict::keep) return emit(piece, code);
        int next = piece.is_square ? piece.level : piece.level - 1;
        bool covers_void = code == kMustSplit;
        Corner own{view.slot * kTileSamples + local, view.heights[local], 0};
        if (answer.share < 1) own.rise = rise_of(own, piece, answer.share);
        Origin origin{v, level, piece.is_square, code};
        descend(Piece{{v, t.apex, t.left}, next, !piece.is_square, covers_void, planes, own, piece.apex, piece.left, origin},
                depth - 1, later);
        descend(Piece{{v, t.right, t.apex}, next, !piece.is_square, covers_void, planes, own, piece.right, piece.apex, origin},
                depth - 1, later);
    }
    void descend(const Piece& piece) {
        descend(piece, std::numeric_limits<int>::max(), [](const Piece&) {});
    }

  private:
    static double rise_of(const Corner& own, const Piece& piece, double share) {
        double left = piece.left.height, right = piece.right.height;
        return (piece.left.rise + piece.right.rise) / 2 + (1 - share) * ((left + right) / 2 - double(own.height));
    }
    double origin_squared(const Piece& piece) const {
        const Origin& o = piece.origin;
        return test_.bound_squared(o.v, o.level, o.is_square, o.code);
    }
    uint32_t vertex_of(const Corner& corner) {
        if (corner.rise == 0) return corner.place;
        uint32_t& known = known_[(corner.place * 0x9e3779b1u) >> 24];
        if (known >= part_.morphs.size() || part_.morphs[known].sample != corner.place) {
            known = uint32_t(part_.morphs.size());
            part_.morphs.push_back({corner.place, float(corner.rise * tiles_.head().height_step_m)});
        }
        return Cut::kMorphBit | known;
    }
    void emit(const Piece& piece, uint8_t code) {
        part_.void_rim_triangle_count += piece.parent_covers_void;
        if (wants_codes_) part_.codes.push_back(code);
        part_.indices.insert(part_.indices.end(), {vertex_of(piece.apex), vertex_of(piece.left), vertex_of(piece.right)});
    }
    static bool has_void_corner(const Piece& piece) {
        return piece.apex.height == kVoid || piece.left.height == kVoid || piece.right.height == kVoid;
    }
    void emit_finest(const Piece& piece) {
        if ((piece.parent_covers_void || shape_.root_log2 == 0) && has_void_corner(piece)) return;
        emit(piece, 0);
    }
    void stop(const Piece& piece, GridPoint v) {
        double kept_squared = origin_squared(piece);
        tiles_.ask_for(v, uint32_t(piece.level), piece.is_square, float(std::sqrt(kept_squared)));
        ++part_.stopped_count;
        part_.predicted_squared = std::max(part_.predicted_squared, kept_squared);
        if (!has_void_corner(piece)) emit(piece, piece.origin.code);
    }

    const Tiles& tiles_;
    const Shape& shape_;
    const Test& test_;
    bool wants_codes_;
    Cut::Part& part_;
    uint32_t known_[256] = {};  // where a place's morph was put lately
};

// The two triangles of every root square.
std::vector<Piece> root_pieces(const Tiles& tiles) {
    std::vector<Piece> pieces;
    const Shape& shape = tiles.head().shape;
    uint32_t side = 1u << shape.root_log2;
    auto corner = [&](GridPoint p) {
        uint32_t tile = tiles.grid().at(tiles.grid().top(), p.x, p.y), local = tiles.grid().local(tile, p.x, p.y);
        return Corner{tiles.view(tile).slot * kTileSamples + local, tiles.view(tile).heights[local], 0};
    };
    for (uint32_t j = 0; j < shape.root_rows; ++j)
        for (uint32_t i = 0; i < shape.root_columns; ++i) {
            GridPoint nw{i * side, j * side}, ne{nw.x + side, nw.y}, sw{nw.x, nw.y + side}, se{ne.x, sw.y};
            bool main = is_main_diagonal(i, j);
            for (const Triangle& t :
                 {main ? Triangle{ne, nw, se} : Triangle{nw, sw, ne}, main ? Triangle{sw, se, nw} : Triangle{se, ne, sw}})
                pieces.push_back({t, int(shape.root_log2) - 1, true, false, Test::kAllPlanes, corner(t.apex), corner(t.left),
                                  corner(t.right), Origin{}});
        }
    return pieces;
}

}  // namespace

void TileRefiner::cut_by_pixels(const view::Camera& camera, double error_px, Cut& out, double morph) const {
    Test test(tiles_.head(), bounds_, camera, view::PixelDetail{error_px, morph, 0, error_px, {}, {}});
    std::vector<Piece> roots = root_pieces(tiles_), pieces;
    int depth = 0;
    while ((roots.size() << depth) < kPartsWanted) ++depth;

    // The top of the hierarchy in one piece, then what hangs below it in parts of their own.
    if (out.parts.empty()) out.parts.resize(1);
    start(out.parts[0]);
    Walk top(tiles_, test, out.wants_codes, out.parts[0]);
    for (const Piece& root : roots) top.descend(root, depth, [&](const Piece& piece) { pieces.push_back(piece); });
    if (out.parts.size() < pieces.size() + 1) out.parts.resize(pieces.size() + 1);
    parallel_ranges(pieces.size(), 1, [&](size_t i, size_t) {
        start(out.parts[i + 1]);
        Walk(tiles_, test, out.wants_codes, out.parts[i + 1]).descend(pieces[i]);
    });
    join(pieces.size() + 1, size_t(tiles_.slot_count()) * kTileSamples, out);
}

}  // namespace overlook::terrain
