// One pass after another of collapses that do not touch one another.
#pragma once

#include <vector>

#include "tools/bake/caveclod/collapse_cost.h"
#include "tools/bake/caveclod/simplify.h"
#include "tools/bake/caveclod/source_parts.h"
#include "tools/bake/caveclod/surface_map.h"

namespace overlook::caveclod {

class Passes {
  public:
    // face_count: of the mesh; quadrics and map are made here.
    Passes(WorkingMesh& mesh, const SimplifyOptions& options, SimplifyReport& report);

    // Makes one pass; false when there is nothing left to collapse.
    bool run(uint64_t least_face_count, CollapseLog& log);

    uint64_t face_count() const { return face_count_; }
    // What keeps a position that no pass has taken away.
    Hindrance hindrance_of(uint32_t position) const;

  private:
    struct Chosen {
        uint32_t gone = kNone, kept = kNone, fan = kNone;
        Measured measured;
        double stated_m = 0;     // of the error, what seams shift and what is thinned
        double worst_m = 0;      // of that and what attributes lose
        double fan_error_m = 0;  // of all that is drawn in the fan afterwards
        double seam_shift_m = 0;
        SeamError seam_error;
        uint32_t turned_face = kNone;  // in the fan, if that is why it is refused
        bool is_refused = false, is_made = false;
        Hindrance refused_by = Hindrance::turned;
    };

    struct TurnedFan {
        Fan fan;
        TurnedVertices turned;
    };

    // A pass takes from the cheapest this share of all candidates; those measured worse than so many times its limit wait.
    struct Choosiness {
        double share_of_pass, worst;
    };
    static constexpr size_t kFanGrain = 64;  // of chosen_ in a block
    Choosiness choosiness() const;
    // What a collapse may be measured at and be made in this pass.
    double most_allowed_m() const { return limit_m_ * choosiness().worst; }
    void find_thin_things();
    void find_queue();
    void guess_candidates();
    void raise_limit();
    void check_candidates();
    void sort_queue();
    void select(uint64_t least_face_count);
    bool claim(uint32_t gone, uint32_t kept);
    void prepare(const Chosen& chosen, TurnedFan& prepared) const;
    void measure();
    void measure_one(Chosen& chosen, TurnedFan& prepared, MapChanges& changes);
    void measure_seams(Chosen& chosen, const TurnedFan& prepared, const MapChanges& changes) const;
    uint32_t find_turned_face(const Chosen& chosen, const Fan& fan) const;
    void decide(CollapseLog& log);
    void record(const Chosen& chosen, const TurnedFan& prepared, CollapseLog& log);
    void provide_crossings();
    void apply();
    void forget(uint32_t position);
    void mark_around(const Fan& fan);

    WorkingMesh& mesh_;
    const SeamBudget& seams_;
    SimplifyReport& report_;
    std::vector<Quadric> quadrics_;
    SurfaceMap map_;
    SourceParts source_;
    RefusedFaces refused_;
    double slack_m_ = 0;
    std::vector<float> face_error_m_;  // [F] of all that is drawn where the face is
    uint64_t face_count_ = 0;
    double limit_m_ = 0, size_m_ = 0;  // of the pass; of the mesh

    std::vector<uint32_t> alive_;                   // positions that may still go
    std::vector<Candidate> candidates_;             // [P]
    std::vector<uint8_t> known_;                    // [P] the candidate must be found anew
    std::vector<Hindrance> refused_by_;             // [P] what its collapse was refused for last
    std::vector<uint32_t> touched_in_, target_in_;  // [P] the last pass that changed the position's star, or collapsed into it
    uint32_t pass_ = 0, next_fan_ = 0;
    std::vector<float> costs_;
    std::vector<std::pair<float, uint32_t>> queue_, sorted_;
    std::vector<Chosen> chosen_;
    std::vector<TurnedFan> fans_;      // of chosen_
    std::vector<MapChanges> changes_;  // one for each block of chosen_
};

}  // namespace overlook::caveclod
