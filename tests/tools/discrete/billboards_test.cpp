// Levels of billboards lie no farther from the thing than they state, whoever looks: a judge that knows nothing of the baker's
// measurements draws places of the thing and places that are drawn of the cards, and looks for the nearest by trying all.
#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "formats/parallel.h"
#include "tests/formats/scratch_folder.h"
#include "tests/tools/discrete/shapes_for_tests.h"
#include "tools/bake/discrete/card.h"
#include "tools/bake/discrete/drawn_texels.h"
#include "tools/bake/discrete/from_mesh.h"
#include "tools/make_sample/windmill.h"

namespace overlook::discrete {
namespace {

Chain chain_of(const mesh::MeshFile& file, Impostors impostors, MeshChainReport& report) {
    MeshChainOptions options;
    options.bake.simplify.seams.moves = true, options.impostors = impostors;
    auto chain = chain_from_mesh(file, options, report, [](double) {});
    EXPECT_TRUE(chain) << chain.error().message;
    return chain ? *chain : Chain{};
}
Chain chain_of(const mesh::MeshFile& file, Impostors impostors) {
    MeshChainReport report;
    return chain_of(file, impostors, report);
}

mesh::MeshFile windmill_file(const ScratchFolder& folder) {
    std::ofstream(folder / "windmill.glb", std::ios::binary) << sample::glb_text(sample::windmill(2), 8);
    auto file = mesh::open_mesh(folder / "windmill.glb", test::with_motion());
    EXPECT_TRUE(file) << file.error().message;
    return *file;
}

// Of C. Ericson, Real-Time Collision Detection, 2005, section 5.1.5, by regions; shares nothing with the baker's.
double distance_m(const glm::dvec3& p, const caveclod::Triangle& t) {
    glm::dvec3 ab = t[1] - t[0], ac = t[2] - t[0], normal = glm::cross(ab, ac);
    auto to_segment = [&](const glm::dvec3& a, const glm::dvec3& b) {
        double length2 = glm::dot(b - a, b - a);
        double share = length2 > 0 ? std::clamp(glm::dot(p - a, b - a) / length2, 0.0, 1.0) : 0;
        return glm::distance(p, a + share * (b - a));
    };
    double best = std::min({to_segment(t[0], t[1]), to_segment(t[1], t[2]), to_segment(t[2], t[0])});
    double normal2 = glm::dot(normal, normal);
    if (!(normal2 > 0)) return best;
    glm::dvec3 q = p - normal * (glm::dot(p - t[0], normal) / normal2);
    double a = glm::dot(glm::cross(t[1] - q, t[2] - q), normal), b = glm::dot(glm::cross(t[2] - q, t[0] - q), normal),
           c = glm::dot(glm::cross(t[0] - q, t[1] - q), normal);
    return a >= 0 && b >= 0 && c >= 0 ? std::min(best, glm::distance(p, q)) : best;
}

// Places, drawn of a level at a time of the clip.
class Judge {
  public:
    Judge(const Chain& chain, double at_s) : chain_(chain), at_s_(at_s) {
        for (size_t s = chain.surfaces.size() - chain.picture_count; s < chain.surfaces.size(); ++s)
            pictures_.push_back(*picture_rgba8(chain.surfaces[s].texture, chain.surfaces[s].texture_bytes));
    }

    struct Drawn {
        std::vector<caveclod::Triangle> whole;  // without pictures
        std::vector<glm::dvec3> places;         // with
        double apart_m = 0;                     // how far from a place of a card that is drawn one of `places` is at most
    };
    Drawn drawn(const Level& level) const {
        constexpr double kParts = 3;  // places a texel, along either side
        Drawn drawn;
        for (const Draw& draw : level.draws)
            for (uint32_t i = draw.first_index; i < draw.first_index + draw.index_count; i += 3) {
                std::array<const Vertex*, 3> v;
                caveclod::Triangle at_m;
                std::array<glm::dvec2, 3> uv;
                for (size_t c = 0; c < 3; ++c) {
                    v[c] = &level.vertices[level.indices[i + c]];
                    at_m[c] = moved(position_m(chain_, *v[c]), v[c]->part);
                    uv[c] = chain_.uv_low + chain_.uv_step * glm::dvec2(v[c]->uv[0], v[c]->uv[1]);
                }
                const PictureRgba8* picture = picture_of(draw.surface);
                if (picture == nullptr || uv[0] == uv[1]) {
                    drawn.whole.push_back(at_m);
                    continue;
                }
                glm::dvec2 size(picture->width, picture->height);
                double steps =
                    std::ceil(kParts * std::max(glm::length((uv[1] - uv[0]) * size), glm::length((uv[2] - uv[0]) * size)));
                drawn.apart_m =
                    std::max(drawn.apart_m, glm::length(at_m[1] - at_m[0]) / steps + glm::length(at_m[2] - at_m[0]) / steps);
                for (double a = 0; a <= steps; ++a)
                    for (double b = 0; a + b <= steps; ++b) {
                        glm::dvec2 at = uv[0] + a / steps * (uv[1] - uv[0]) + b / steps * (uv[2] - uv[0]);
                        if (opacity(*picture, at * size) < 0.5) continue;
                        drawn.places.push_back(at_m[0] + a / steps * (at_m[1] - at_m[0]) + b / steps * (at_m[2] - at_m[0]));
                    }
            }
        return drawn;
    }

  private:
    glm::dvec3 moved(const glm::dvec3& at_m, uint32_t part) const {
        Pose pose = pose_at(chain_.parts[part], chain_.clip_s, at_s_);
        return glm::dquat(pose.turn) * at_m + glm::dvec3(pose.move_m);
    }
    const PictureRgba8* picture_of(uint32_t surface) const {
        size_t first = chain_.surfaces.size() - chain_.picture_count;
        return surface < first ? nullptr : &pictures_[surface - first];
    }
    static double opacity(const PictureRgba8& picture, const glm::dvec2& texel) {
        double x = texel.x - 0.5, y = texel.y - 0.5, right = x - std::floor(x), down = y - std::floor(y);
        auto at = [&](double i, double j) {
            return picture.pixels[4 * (size_t(std::floor(j)) * picture.width + size_t(std::floor(i))) + 3] / 255.0;
        };
        return (1 - down) * ((1 - right) * at(x, y) + right * at(x + 1, y)) +
               down * ((1 - right) * at(x, y + 1) + right * at(x + 1, y + 1));
    }

    const Chain& chain_;
    double at_s_;
    std::vector<PictureRgba8> pictures_;
};

double distance_m(const glm::dvec3& p, const Judge::Drawn& to) {
    double best = 1e300;
    for (const caveclod::Triangle& t : to.whole) best = std::min(best, distance_m(p, t));
    double best2 = best * best;
    for (const glm::dvec3& q : to.places) best2 = std::min(best2, glm::dot(p - q, p - q));
    return std::sqrt(best2);
}

// The greatest distance found of random places to the other, both ways.
double found_m(const Judge::Drawn& finest, const Judge::Drawn& level, uint64_t seed) {
    constexpr int kPlaces = 250;
    std::mt19937_64 random(seed);
    auto number = [&] { return double(random() >> 11) * 0x1p-53; };
    auto on = [&](const std::vector<caveclod::Triangle>& triangles) {
        const caveclod::Triangle& t = triangles[random() % triangles.size()];
        // Corners as well, which are the farthest most often.
        double a = std::floor(number() * 3) == 0 ? 1 : number(), b = number() * (1 - a);
        return t[0] + a * (t[1] - t[0]) + b * (t[2] - t[0]);
    };
    double most_m = 0;
    for (int i = 0; i < kPlaces; ++i) most_m = std::max(most_m, distance_m(on(finest.whole), level));
    for (int i = 0; i < kPlaces && !level.places.empty(); ++i)
        most_m = std::max(most_m, distance_m(level.places[random() % level.places.size()], finest));
    for (int i = 0; i < kPlaces && !level.whole.empty(); ++i) most_m = std::max(most_m, distance_m(on(level.whole), finest));
    return most_m;
}

void expect_honest(const Chain& chain, std::initializer_list<double> times_s) {
    size_t boards = 0;
    for (double at_s : times_s) {
        Judge judge(chain, at_s);
        Judge::Drawn finest = judge.drawn(chain.levels[0]);
        for (size_t k = 1; k < chain.levels.size(); ++k) {
            if (chain.levels[k].rung != Rung::billboards) continue;
            ++boards;
            Judge::Drawn level = judge.drawn(chain.levels[k]);
            double stated_m = double(chain.levels[k].error_m), off_m = found_m(finest, level, k);
            EXPECT_LE(off_m, stated_m + level.apart_m) << "level " << k << " at " << at_s << " s";
            EXPECT_GE(off_m, 0.3 * stated_m) << "level " << k;
        }
    }
    EXPECT_GE(boards, 2 * times_s.size());
}

TEST(Billboards, OfAWindmillAreNeverFartherThanStatedWhileItsSailsTurn) {
    ScratchFolder folder;
    expect_honest(chain_of(windmill_file(folder), Impostors::automatic), {0.0, 1.3});
}
TEST(Billboards, OfFoliageAreNeverFartherThanStated) {
    expect_honest(chain_of(test::file_of(test::bush(1200)), Impostors::automatic), {0.0});
}
TEST(Billboards, ThatCrossAreNeverFartherThanStated) {
    Chain chain = chain_of(test::file_of(test::bush(1200)), Impostors::cross);
    expect_honest(chain, {0.0});
    EXPECT_LE(chain.levels.back().triangle_count(), 8u);
}

TEST(Billboards, HaveFewerTrianglesThanWhatIsCutWithinAsMuch) {
    ScratchFolder folder;
    for (const mesh::MeshFile& file : {windmill_file(folder), test::file_of(test::bush(1200))}) {
        Chain cut = chain_of(file, Impostors::none), boards = chain_of(file, Impostors::cloud);
        size_t counted = 0;
        for (const Level& level : boards.levels) {
            if (level.rung != Rung::billboards) continue;
            uint64_t fewest = cut.levels[0].triangle_count();
            for (const Level& other : cut.levels)
                if (other.error_m <= level.error_m) fewest = other.triangle_count();
            EXPECT_LE(double(level.triangle_count()) * 1.2, double(fewest));
            ++counted;
        }
        EXPECT_GE(counted, 2u);
        EXPECT_EQ(cut.picture_count, 0u);
        EXPECT_EQ(boards.picture_count, counted);
    }
}

TEST(Billboards, AreDrawnAtOnceWithWhatStaysAMesh) {
    ScratchFolder folder;
    Chain chain = chain_of(windmill_file(folder), Impostors::cloud);
    for (const Level& level : chain.levels) {
        if (level.rung != Rung::billboards) continue;
        ASSERT_EQ(level.draws.size(), 1u);
        EXPECT_GE(level.draws[0].surface, chain.surfaces.size() - chain.picture_count);
    }
}

TEST(Billboards, StateWhatTheyLoseOfTheViewAndAddToIt) {
    Chain chain = chain_of(test::file_of(test::bush(1200)), Impostors::automatic);
    bool adds = false;
    for (const Level& level : chain.levels) {
        adds = adds || level.added_area_share > 0;
        if (level.rung == Rung::mesh) {
            EXPECT_EQ(level.added_area_share, 0);
        }
    }
    EXPECT_TRUE(adds);
}

TEST(Billboards, AreTheSameForAnyNumberOfThreads) {
    ScratchFolder folder;
    mesh::MeshFile file = windmill_file(folder);
    std::vector<Chain> chains;
    for (unsigned threads : {1u, 4u}) {
        set_thread_count(threads);
        chains.push_back(chain_of(file, Impostors::automatic));
    }
    set_thread_count(0);
    EXPECT_GT(chains[0].picture_count, 0u);
    EXPECT_TRUE(chains[0].levels == chains[1].levels);
    EXPECT_TRUE(chains[0].surfaces == chains[1].surfaces);
}

// A plate of 1 m with a hole of half a metre, leaning by 1 cm.
TEST(Card, ShowsWhatIsThereWithItsAreaAndNothingElse) {
    Shape shape;
    auto add = [&](double x0, double z0, double x1, double z1) {
        auto first = uint32_t(shape.vertices.size());
        for (auto [x, z] : {std::pair(x0, z0), {x1, z0}, {x1, z1}, {x0, z1}})
            shape.vertices.push_back({{x, 0.01 * z, z}, 0, {0, -1, 0}, {0, 0}, {255, 128, 0, 255}});
        shape.faces.push_back({first, first + 1, first + 2}), shape.faces.push_back({first, first + 2, first + 3});
        shape.face_surface.insert(shape.face_surface.end(), 2, 0);
    };
    add(0, 0, 0.25, 1), add(0.75, 0, 1, 1), add(0.25, 0, 0.75, 0.25), add(0.25, 0.75, 0.75, 1);
    std::vector<caveclod::Surface> surfaces(1);
    auto looks = Looks::make(surfaces);
    ASSERT_TRUE(looks);
    RayScene rays(shape.triangles());
    CardOrder order{plane_of({0.5, 0, 0.5}, {0, -1, 0}), 0, 0.1, 0, {}, 0};
    Card card = cast_card({shape, rays, *looks}, order, 0.013);
    size_t opaque = 0;
    for (uint32_t y = 0; y < card.height; ++y)
        for (uint32_t x = 0; x < card.width; ++x) {
            if (card.is_opaque[size_t(y) * card.width + x] == 0) continue;
            ++opaque;
            glm::dvec3 at = card.at_m(x + 0.5, y + 0.5);
            bool is_in_hole = std::abs(at.x - 0.5) < 0.25 - 0.013 && std::abs(at.z - 0.5) < 0.25 - 0.013;
            EXPECT_TRUE(!is_in_hole && std::abs(at.x - 0.5) < 0.507 && std::abs(at.z - 0.5) < 0.507);
            glm::dvec3 colour = srgb_of_linear(card.colour[size_t(y) * card.width + x]);
            EXPECT_NEAR(colour.y, 128 / 255.0, 2e-3);
        }
    EXPECT_NEAR(double(opaque) * 0.013 * 0.013, 0.75, 0.01);
    EXPECT_NEAR(card.difference, 0, 1e-6);
    for (const glm::vec3& normal : card.normals) EXPECT_GT(-normal.y, 0.99f);
}

// A red plate before a blue one.
TEST(Card, ShowsEachSideAsItIsSeenFromThere) {
    Shape shape;
    for (int plate = 0; plate < 2; ++plate) {
        auto first = uint32_t(shape.vertices.size());
        for (auto [x, z] : {std::pair(0.0, 0.0), {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}})
            shape.vertices.push_back(
                {{x, plate * 0.02, z}, 0, {0, -1, 0}, {0, 0}, {uint8_t(255 * (1 - plate)), 0, uint8_t(255 * plate), 255}});
        shape.faces.push_back({first, first + 1, first + 2}), shape.faces.push_back({first, first + 2, first + 3});
        shape.face_surface.insert(shape.face_surface.end(), 2, 0);
    }
    std::vector<caveclod::Surface> surfaces(1);
    auto looks = Looks::make(surfaces);
    ASSERT_TRUE(looks);
    RayScene rays(shape.triangles());
    for (int side : {1, -1, 0}) {
        CardOrder order{plane_of({0.5, 0, 0.5}, {0, -1, 0}), 0, 0.1, 0, {}, 0, side};
        Card card = cast_card({shape, rays, *looks}, order, 0.1);
        EXPECT_NEAR(card.difference, 1, 1e-6);
        glm::dvec3 colour = card.colour[size_t(card.height / 2) * card.width + card.width / 2];
        EXPECT_NEAR(colour.x, side == 0 ? 0.5 : side > 0 ? 1 : 0, 1e-6);
        EXPECT_NEAR(colour.z, side == 0 ? 0.5 : side > 0 ? 0 : 1, 1e-6);
    }
}

}  // namespace
}  // namespace overlook::discrete
