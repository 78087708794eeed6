// Images that are done, kept beside the output until all are: a bake that was stopped, however suddenly, goes on where it was,
// and parts of one may be baked elsewhere.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "formats/result.h"
#include "formats/wang_ldi.h"
#include "tools/bake/wang_ldi/judge.h"

namespace overlook::wang_ldi {

// An image as it is stored, and what was counted when it was made.
struct Shard {
    Packed packed;
    uint64_t rays = 0, hits = 0, eyes = 0;
    Judgement judgement, foreign;
};

// Of a folder, made where there is none: "OUT.ovl.parts" beside OUT.ovl. One file for each image, named by its index and by the
// key, a hash of all that decides its bytes, so that those of another bake are never taken.
class Shards {
  public:
    // An empty folder name: nothing is kept. Fails with Exit::cannot_write: "out/a.ovl.parts: cannot be made: Permission denied".
    static Result<Shards> in(const std::string& folder, uint64_t key);

    // What is there and whole; nothing if it is missing, cut short or damaged.
    std::optional<Shard> find(uint64_t index) const;
    // Any thread. Appears whole or not at all. Fails as write_file.
    Result<void> keep(uint64_t index, const Shard& shard) const;
    // The files of this key, and the folder if it is empty then.
    void remove_all(uint64_t count) const;

  private:
    std::string path_of(uint64_t index) const;
    std::string folder_;
    uint64_t key_ = 0;
};

}  // namespace overlook::wang_ldi
