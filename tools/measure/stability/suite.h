// The stability suite: every case for every method that it concerns, and whether its gates were kept.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/measure/stability/stage.h"

namespace overlook::measure {

struct HeldGate {
    std::string figure;
    std::optional<double> value;  // none if the case's runner has not found it, which keeps no gate
    double limit = 0;
    bool is_kept() const { return value && *value <= limit; }
};

// The gates of the case that hold such a method, each with the finding's figure of its name.
std::vector<HeldGate> held_gates(const Case& each, const MethodSpec& spec, const Finding& finding, double asked_px);

// "pop_index 1.31 (gate 1.2)"; "pop_index not measured (gate 1.2)".
std::string sentence_of(const HeldGate& gate);

// One case and one method.
struct Verdict {
    std::string number, what;  // of the case
    MethodSpec spec;
    std::vector<HeldGate> gates;
    Finding finding;
    std::string note{};  // the case's
    bool is_kept() const;
    // "pass" or "miss"; "stated" where no gate of the case holds the method, whose figures are said for their own sake.
    std::string_view outcome() const;
    // Of the gates one by one; without any of the figures: "path_difference_grey 2.3 (no gate)".
    std::vector<std::string> numbers() const;
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
