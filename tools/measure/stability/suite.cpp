#include "tools/measure/stability/suite.h"

#include <algorithm>

#include "tools/measure/page_text.h"
#include "tools/measure/stability/kept.h"

namespace overlook::measure {
namespace {

struct Ready {
    std::string_view number;
    CaseRunner run;
};
constexpr Ready kReady[] = {
    {"S01", run_dolly},      {"S02", run_jitter},   {"S03", run_yaw},           {"S04", run_teleports},
    {"S05", run_ridge},      {"S06", run_skimming}, {"S07", run_horizon},       {"S08", run_climb},
    {"S09", run_dolly},      {"S10", run_masts},    {"S11", run_slopes},        {"S12", run_moved_world},
    {"S13", run_mismatched}, {"S14", run_crossing}, {"S15", run_turning_back},  {"S16", run_dropping},
    {"S17", run_resize},     {"S18", run_cameras},  {"S19", run_halved_budget}, {"S20", run_back_and_forth},
};

CaseRunner runner_of(const std::string& number) {
    for (const Ready& ready : kReady) {
        if (ready.number == number) return ready.run;
    }
    return nullptr;
}

// As CaseGate::of has it.
std::string_view side_of(const MethodSpec& spec) {
    return draws_plantings(spec) ? "planting" : is_of_chains_alone(spec) ? "chain" : is_image(spec) ? "image" : "geometry";
}

bool has(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

// Found in an earlier run, or now.
Result<std::vector<Finding>> findings_of(Stage& stage, const Case& each, CaseRunner run, std::span<const MethodSpec> specs) {
    Result<scene::Flight> flight = scene::read_flight(each.flight);
    if (!flight) return tl::unexpected(flight.error());
    stage.world.step_s = flight->step_s;
    if (stage.kept_folder.empty()) return run(stage, each, *flight, specs);
    std::string path = stage.kept_folder + "/" + name_of_findings(stage, each, *flight, specs);
    if (std::optional<std::vector<Finding>> kept = read_findings(path, specs.size())) return std::move(*kept);
    Result<std::vector<Finding>> findings = run(stage, each, *flight, specs);
    if (!findings) return findings;
    if (Result<void> written = keep_findings(path, *findings); !written) return tl::unexpected(written.error());
    return findings;
}

// For methods that one world serves.
Result<void> run_case_for(Stage& suite_stage, const Case& each, CaseRunner run, std::span<const MethodSpec> concerned,
                          SuiteResult& result, const WorldOf& world_of) {
    Result<World*> world = world_of ? world_of(each) : &suite_stage.world;
    if (!world) return tl::unexpected(world.error());
    if (Result<void> draws = check_draws(concerned, **world); !draws) return draws;
    Stage stage{**world,
                suite_stage.renderer,
                suite_stage.width_px,
                suite_stage.height_px,
                suite_stage.frames,
                suite_stage.asked_px,
                suite_stage.cache_folder,
                suite_stage.kept_folder,
                suite_stage.program_hash,
                suite_stage.make};
    Result<std::vector<Finding>> findings = findings_of(stage, each, run, concerned);
    if (!findings) return tl::unexpected(findings.error());
    for (size_t i = 0; i < concerned.size(); ++i) {
        Finding& finding = (*findings)[i];
        std::vector<HeldGate> gates = held_gates(each, concerned[i], finding, stage.asked_px);
        result.verdicts.push_back({each.number, each.what, concerned[i], std::move(gates), std::move(finding), each.note});
    }
    return {};
}

Result<void> run_case(Stage& suite_stage, const Case& each, std::span<const MethodSpec> specs, SuiteResult& result,
                      const WorldOf& world_of) {
    CaseRunner run = runner_of(each.number);
    std::vector<MethodSpec> geometry, image, mesh, chain, planting;
    for (const MethodSpec& spec : specs) {
        if (run == nullptr || !has(each.runs, spec.name)) continue;
        if (draws_plantings(spec)) {
            planting.push_back(spec);
            continue;
        }
        if (is_of_chains_alone(spec)) {
            if (!each.chain_scene.empty()) chain.push_back(spec);
            continue;
        }
        if (is_of_meshes_alone(each) && (each.mesh_scene.empty() || !draws_meshes(spec))) continue;
        (is_image(spec) ? image : draws_terrains(spec) ? geometry : mesh).push_back(spec);
    }
    for (const std::string& method : each.methods) {
        if (run == nullptr || !has(each.runs, method)) result.owed.push_back({each.number, each.what, method});
    }
    for (const std::vector<MethodSpec>& concerned : {geometry, image, mesh}) {
        if (concerned.empty()) continue;
        bool is_mesh = is_of_meshes_alone(each) || !draws_terrains(concerned.front());
        Result<void> ran = run_case_for(suite_stage, is_mesh ? for_meshes(each) : each, run, concerned, result, world_of);
        if (!ran) return ran;
    }
    if (!planting.empty()) {
        Result<void> ran = run_case_for(suite_stage, for_plantings(each), run, planting, result, world_of);
        if (!ran) return ran;
    }
    if (chain.empty()) return {};
    return run_case_for(suite_stage, for_chains(each), run, chain, result, world_of);
}

}  // namespace

std::vector<HeldGate> held_gates(const Case& each, const MethodSpec& spec, const Finding& finding, double asked_px) {
    std::vector<HeldGate> gates;
    for (const CaseGate& gate : each.gates) {
        if (gate.of != "all" && gate.of != side_of(spec)) continue;
        HeldGate held{gate.figure, std::nullopt, gate.over_asked_px >= 0 ? asked_px + gate.over_asked_px : gate.most};
        if (auto found = finding.figures.find(gate.figure); found != finding.figures.end()) held.value = found->second;
        gates.push_back(std::move(held));
    }
    return gates;
}

std::string sentence_of(const HeldGate& gate) {
    std::string value = gate.value ? short_number(*gate.value) : "not measured";
    return fmt::format("{} {} (gate {})", gate.figure, value, short_number(gate.limit));
}

std::string_view Verdict::outcome() const {
    return gates.empty() ? "stated" : is_kept() ? "pass" : "miss";
}

std::vector<std::string> Verdict::numbers() const {
    std::vector<std::string> all;
    for (const HeldGate& gate : gates) all.push_back(sentence_of(gate));
    if (!gates.empty()) return all;
    for (const auto& [name, value] : finding.figures) all.push_back(fmt::format("{} {} (no gate)", name, short_number(value)));
    return all;
}

bool Verdict::is_kept() const {
    return std::all_of(gates.begin(), gates.end(), [](const HeldGate& gate) { return gate.is_kept(); });
}

bool is_baseline(const MethodSpec& spec) {
    static constexpr std::string_view kBaselines[] = {
        "terrain:hard",       "lod-sprite:paper", "caveclod:paper", "caveclod:shared", "discrete",     "wang-ldi:paper",
        "discrete:fsi-paper", "discrete:switch",  "discrete:blend", "discrete:dither", "discrete:late"};
    return std::find(std::begin(kBaselines), std::end(kBaselines), family_of(spec)) != std::end(kBaselines);
}

bool is_kept(const SuiteResult& result) {
    return std::all_of(result.verdicts.begin(), result.verdicts.end(),
                       [](const Verdict& verdict) { return is_baseline(verdict.spec) || verdict.is_kept(); });
}

Result<SuiteResult> run_suite(Stage& stage, const std::vector<Case>& cases, std::span<const MethodSpec> specs,
                              const std::function<void(double)>& done, const WorldOf& world_of) {
    SuiteResult result;
    for (size_t i = 0; i < cases.size(); ++i) {
        if (Result<void> ran = run_case(stage, cases[i], specs, result, world_of); !ran) return tl::unexpected(ran.error());
        done(double(i + 1) / double(cases.size()));
    }
    return result;
}

}  // namespace overlook::measure
