#include "tools/bake/discrete/billboards.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "formats/parallel.h"
#include "tools/bake/discrete/card_planes.h"
#include "tools/bake/discrete/components.h"

namespace overlook::discrete {
namespace {

constexpr double kPlaneShare = 0.6, kTexelShare = 0.3;  // of the distance allowed
constexpr double kLeastWorth = 4;                       // triangles that a card of two has to save
constexpr int kStride = 2;
constexpr double kLeastCosine = 0.35;  // of faces on slices that stand apart
constexpr double kCrossTexels = 96;    // across the thing
constexpr double kOneColour = 0.03;    // what a card's two sides may differ by and be one
constexpr double kApartTexels = 0.1;   // from the middle of two cards that show a side each

struct Box {
    glm::dvec3 low_m{1e300}, high_m{-1e300};

    explicit Box(const Shape& shape) {
        for (const ShapeVertex& v : shape.vertices) low_m = glm::min(low_m, v.at_m), high_m = glm::max(high_m, v.at_m);
    }
    glm::dvec3 middle_m() const { return (low_m + high_m) / 2.0; }
    double size_m() const { return glm::length(high_m - low_m); }
};

bool is_within(const Shape& shape, size_t face, const CardPlane& plane, double distance_m) {
    return std::all_of(shape.faces[face].begin(), shape.faces[face].end(), [&](uint32_t v) {
        return std::abs(glm::dot(shape.vertices[v].at_m - plane.middle_m, plane.normal)) <= distance_m;
    });
}

// A card as four vertices and two faces. Its rim ends in the middle of the picture's outermost texels, which are not opaque.
void add_card(const Card& card, const PackedPicture::Place& place, const PackedPicture& picture, Shape& shape) {
    auto first = uint32_t(shape.vertices.size());
    double right = card.width - 0.5, bottom = card.height - 0.5;
    const std::array<glm::dvec2, 4> corners{glm::dvec2(0.5, bottom), {right, bottom}, {right, 0.5}, {0.5, 0.5}};
    for (size_t c = 0; c < 4; ++c) {
        glm::dvec2 texel = corners[c] + glm::dvec2(place.left, place.top);
        glm::dvec2 uv = texel / glm::dvec2(picture.picture.width, picture.picture.height);
        shape.vertices.push_back(
            {card.at_m(corners[c].x, corners[c].y), card.part, card.normals[c], glm::vec2(uv), {255, 255, 255, 255}});
    }
    shape.faces.push_back({first, first + 1, first + 2});
    shape.faces.push_back({first, first + 2, first + 3});
    shape.face_surface.insert(shape.face_surface.end(), 2, kPictureSurface);
}

std::array<uint8_t, 4> product(const std::array<uint8_t, 4>& a, const std::array<uint8_t, 4>& b) {
    auto linear = [](const std::array<uint8_t, 4>& c) { return linear_of_srgb(glm::dvec3(c[0], c[1], c[2]) / 255.0); };
    glm::dvec3 encoded = srgb_of_linear(linear(a) * linear(b));
    return {uint8_t(std::lround(255 * encoded.x)), uint8_t(std::lround(255 * encoded.y)), uint8_t(std::lround(255 * encoded.z)),
            255};
}

// What has no picture takes the cards' one where that is white, its colour at the vertices: one draw for all.
void take_white(Shape& shape, const std::vector<caveclod::Surface>& surfaces, const glm::dvec2& white) {
    std::vector<uint32_t> user(shape.vertices.size(), kPictureSurface);
    for (size_t f = 0; f < shape.faces.size(); ++f) {
        uint32_t s = shape.face_surface[f];
        if (s == kPictureSurface) continue;
        const caveclod::Surface& surface = surfaces[s];
        if (!surface.texture.empty() || surface.is_alpha_masked || surface.colour[3] != 255) continue;
        for (uint32_t& v : shape.faces[f]) {
            ShapeVertex vertex = shape.vertices[v];
            if (user[v] != kPictureSurface && user[v] != s) {
                shape.vertices.push_back(vertex), user.push_back(kPictureSurface);
                v = uint32_t(shape.vertices.size() - 1);
            }
            if (user[v] == s) continue;
            user[v] = s;
            vertex.colour = product(vertex.colour, surface.colour), vertex.uv = glm::vec2(white);
            shape.vertices[v] = vertex;
        }
        shape.face_surface[f] = kPictureSurface;
    }
}

}  // namespace

Result<BillboardMaker> BillboardMaker::make(const Family& family) {
    BillboardMaker made(family);
    auto looks = Looks::make(family.surfaces());
    if (!looks) return tl::unexpected(looks.error());
    made.looks_ = std::move(*looks);
    for (Family::PartPieces& pieces : family.pieces(0)) {
        std::vector<caveclod::Triangle> triangles = pieces.finest.triangles();
        made.finest_.add(pieces.finest);
        made.parts_.push_back({pieces.part, std::move(pieces.finest), RayScene(triangles)});
    }
    Box box(made.finest_);
    made.middle_m_ = box.middle_m(), made.radius_m_ = box.size_m() / 2;
    made.seen_m2_ = seen_areas_m2(made.finest_, made.looks_, made.middle_m_, made.radius_m_);
    return made;
}

void BillboardMaker::add_slices(const Part& part, double distance_m, BillboardPlan& plan) const {
    std::vector<CardPlane> planes = slabs(part.finest, distance_m, kStride);
    glm::dvec3 first = planes.front().normal;
    for (const CardPlane& plane : planes) {
        bool is_first = plane.normal == first;
        plan.orders.push_back({plane, part.part, distance_m * (1 + 1e-6), is_first ? 0 : kLeastCosine, {}, plan.orders.size()});
    }
}

void BillboardMaker::add_covering(const Part& part, const Shape& cut, double distance_m, BillboardPlan& plan) const {
    const Shape& finest = part.finest;
    Components components = components_by_place(finest);
    std::vector<uint32_t> of_cut = components_of_cut(finest, components, cut);
    std::vector<double> worth(components.count, 0);
    for (uint32_t component : of_cut)
        if (component < components.count) worth[component] += 1;
    Covering covering = cover(finest, components, worth, kPlaneShare * distance_m, kLeastWorth);
    for (const CardPlane& plane : covering.planes) {
        CardOrder order{plane, part.part, kPlaneShare * distance_m * (1 + 1e-6), 0, {}, plan.orders.size()};
        for (size_t f = 0; f < finest.faces.size(); ++f)
            order.takes.push_back(covering.is_covered[components.of_face[f]] != 0 &&
                                  is_within(finest, f, plane, kPlaneShare * distance_m * (1 + 1e-9)));
        plan.orders.push_back(std::move(order));
    }
    std::vector<uint8_t> is_gone;
    for (uint32_t component : of_cut)
        is_gone.push_back(component < components.count && covering.is_covered[component] != 0 && !covering.planes.empty());
    plan.rest.add(cut.without(is_gone));
}

BillboardPlan BillboardMaker::cloud(double distance_m) const {
    BillboardPlan plan;
    plan.kind = "cloud", plan.texel_m = kTexelShare * distance_m;
    std::vector<Family::PartPieces> pieces = family_->pieces(distance_m);
    for (size_t p = 0; p < pieces.size(); ++p) {
        bool has_foliage = pieces[p].solid_face_count < pieces[p].finest.faces.size();
        if (has_foliage)
            add_slices(parts_[p], kPlaneShare * distance_m, plan);
        else
            add_covering(parts_[p], pieces[p].cut, distance_m, plan);
    }
    return plan;
}

BillboardPlan BillboardMaker::cross(int upright_count, bool has_level) const {
    constexpr double kFlat = 0.2;
    BillboardPlan plan;
    plan.kind = "cross", plan.texel_m = 2 * radius_m_ / kCrossTexels;
    for (const Part& part : parts_) {
        Box box(part.finest);
        double reach_m = box.size_m();
        auto add = [&](const glm::dvec3& normal) {
            plan.orders.push_back({plane_of(box.middle_m(), normal), part.part, reach_m, 0, {}, plan.orders.size()});
        };
        glm::dvec3 size = box.high_m - box.low_m;
        int thinnest = size.x <= size.y && size.x <= size.z ? 0 : size.y <= size.z ? 1 : 2;
        if (size[thinnest] <= kFlat * std::max({size.x, size.y, size.z})) {
            glm::dvec3 normal(0);
            normal[thinnest] = 1;
            add(normal);
            continue;
        }
        for (int i = 0; i < upright_count; ++i) {
            double angle = std::numbers::pi * i / upright_count;
            add({std::sin(angle), -std::cos(angle), 0});
        }
        if (has_level) add({0, 0, 1});
    }
    return plan;
}

Shape BillboardMaker::shape_of(const BillboardPlan& plan, const std::vector<Card>& cards, const PackedPicture& picture) const {
    Shape shape = plan.rest;
    take_white(shape, family_->surfaces(), picture.white);
    for (size_t i = 0; i < cards.size(); ++i) add_card(cards[i], picture.places[i], picture, shape);
    return shape;
}

double BillboardMaker::error_m(const Shape& shape, const Mask& mask) const {
    constexpr double kGap = 0.02, kFloorShare = 1e-5;
    constexpr uint64_t kMostSteps = 1 << 18;
    double most_m = 0;
    for (const Part& part : parts_) {
        DrawnSets sets;
        for (size_t f = 0; f < shape.faces.size(); ++f) {
            DrawnTriangle triangle;
            for (size_t c = 0; c < 3; ++c) {
                const ShapeVertex& v = shape.vertices[shape.faces[f][c]];
                triangle.at_m[c] = v.at_m, triangle.uv[c] = glm::dvec2(v.uv);
            }
            if (shape.vertices[shape.faces[f][0]].part != part.part) continue;
            if (shape.face_surface[f] == kPictureSurface)
                add_drawn(mask, triangle, sets);
            else
                sets.least.push_back(triangle.at_m), sets.most.push_back(triangle.at_m);
        }
        most_m =
            std::max(most_m, most_distance_to_drawn(part.finest.triangles(), sets, kGap, kFloorShare * radius_m_, kMostSteps));
    }
    return most_m;
}

const BillboardMaker::Part& BillboardMaker::part_of(const CardOrder& order) const {
    return *std::find_if(parts_.begin(), parts_.end(), [&](const Part& part) { return part.part == order.part; });
}

// One that looks the same from both sides; else two, each a little in front of the other, its back unseen.
void BillboardMaker::add_cards(const CardOrder& order, double texel_m, std::vector<Card>& cards) const {
    const Part& part = part_of(order);
    Card card = cast_card({part.finest, part.rays, looks_}, order, texel_m);
    if (card.width == 0) return;
    if (card.difference < kOneColour) {
        cards.push_back(std::move(card));
        return;
    }
    for (int side : {1, -1}) {
        CardOrder one = order;
        one.side = side;
        Card seen = cast_card({part.finest, part.rays, looks_}, one, texel_m);
        seen.plane.middle_m += side * kApartTexels * texel_m * seen.plane.normal;
        cards.push_back(std::move(seen));
    }
}

std::optional<Billboards> BillboardMaker::build(const BillboardPlan& plan) const {
    uint64_t texel_count = 0;
    for (const CardOrder& order : plan.orders) {
        texel_count += texels_of_card(part_of(order).finest, order, plan.texel_m);
        if (texel_count > kMostTexels) return std::nullopt;
    }
    std::vector<Card> cards;
    for (const CardOrder& order : plan.orders) add_cards(order, plan.texel_m, cards);
    if (cards.empty()) return std::nullopt;
    auto picture = pack(cards);
    if (!picture) return std::nullopt;
    Billboards made{plan.kind, shape_of(plan, cards, *picture), std::move(*picture), 0, {}};
    made.error_m = error_m(made.shape, made.picture.mask);
    Looks looks = looks_;
    uint32_t surface = looks.add_picture(made.picture.picture, 0.5);
    Shape shown = made.shape;
    std::replace(shown.face_surface.begin(), shown.face_surface.end(), kPictureSurface, surface);
    made.seen = seen_change(seen_m2_, seen_areas_m2(shown, looks, middle_m_, radius_m_), finest_.area_m2());
    return made;
}

}  // namespace overlook::discrete
