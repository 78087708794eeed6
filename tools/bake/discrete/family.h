// All levels that a mesh can have, by the distance that they may be off.
#pragma once

#include <functional>
#include <vector>

#include "tools/bake/discrete/from_mesh.h"

namespace overlook::discrete {

constexpr uint32_t kFineBits = 20;  // of positions on the way: the chain's own 16 are taken from these

class Family {
  public:
    static Result<Family> make(const mesh::MeshFile& file, const MeshChainOptions& options,
                               const std::function<void(double)>& progress);

    struct Member {
        Shape shape;
        double error_m = 0;  // bounds the two-sided distance to member(0)
        double lost_m2 = 0;
    };
    Member member(double distance_m) const;

    // What can be had of a part for a level of billboards.
    struct PartPieces {
        uint32_t part = 0;
        Shape finest;                 // all of it, as in member(0), what is solid first
        size_t solid_face_count = 0;  // of finest
        Shape cut;                    // of what is solid, within the distance
    };
    std::vector<PartPieces> pieces(double distance_m) const;
    double size_m() const { return size_m_; }
    double finest_error_m() const { return finest_error_m_; }  // of member(0), from the source
    const std::vector<caveclod::Surface>& surfaces() const { return surfaces_; }
    const caveclod::Attributes& attributes() const { return attributes_; }
    uint64_t card_count() const;
    uint64_t card_triangle_count() const;

  private:
    // What can be cut and what can be lost of a part.
    struct Piece {
        uint32_t part = 0;
        caveclod::Hierarchy solid;  // no faces: the part has nothing solid
        Foliage foliage;
    };
    Member member_of(const Piece& piece, double distance_m) const;
    Result<void> add_part(const mesh::Mesh& mesh, uint32_t part, const MeshChainOptions& options,
                          const std::function<void(double)>& progress);
    Result<caveclod::Hierarchy> bake(const mesh::Mesh& mesh, caveclod::BakeOptions options,
                                     const std::function<void(double)>& progress);

    std::vector<Piece> pieces_;
    std::vector<caveclod::Surface> surfaces_;
    caveclod::Attributes attributes_;
    double finest_error_m_ = 0, size_m_ = 0;
    bool grows_ = true, loses_ = true;
};

// What a legal cut draws, as a shape of one part.
Shape shape_of(const caveclod::Hierarchy& hierarchy, const std::vector<uint8_t>& applied, uint32_t part);

}  // namespace overlook::discrete
