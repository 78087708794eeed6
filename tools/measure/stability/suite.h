// The stability suite: every case for every method that it concerns, and whether its gates were kept.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tools/measure/stability/stage.h"

namespace overlook::measure {

struct HeldGate {
    std::string figure;
    double value = 0, limit = 0;
    bool is_kept() const { return value <= limit; }
};

// One case and one method.
struct Verdict {
    std::string number, what;  // of the case
    MethodSpec spec;
    std::vector<HeldGate> gates;
    Finding finding;
    std::string note{};  // the case's
    bool is_kept() const;
};

// A case that a method owes.
struct Owed {
    std::string number, what, method;
};

struct SuiteResult {
    std::vector<Verdict> verdicts;  // in the cases' order
    std::vector<Owed> owed;
};

// The world of a case's scene, uploaded; outlives the run.
using WorldOf = std::function<Result<World*>(const Case&)>;

// Runs the cases that are ready for the specs' methods; the rest is owed. Each case flies its own flight over the stage's world,
// or over that of its own scene if `world_of` is given.
// done: told the share of work done. Fails as scene::read_flight, Exit::impossible (targets), Exit::cannot_write (reference
// frames, kept findings), and as world_of does.
Result<SuiteResult> run_suite(Stage& stage, const std::vector<Case>& cases, std::span<const MethodSpec> specs,
                              const std::function<void(double)>& done, const WorldOf& world_of = {});

// terrain:hard and discrete, which exchange their levels at once, the papers' own forms, caveclod:shared, and what
// discrete:fsi is compared with: what the remedied forms are seen beside; their misses are shown and not held against them.
bool is_baseline(const MethodSpec& spec);

// Whether all but the baselines kept their gates.
bool is_kept(const SuiteResult& result);

}  // namespace overlook::measure
