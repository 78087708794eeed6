#include "tools/measure/paper/fsi/variations.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tools/measure/page_text.h"

namespace overlook::measure::paper::fsi {
namespace {

constexpr std::array<Variation, 20> kVariations = {{
    {"switch", kSwitch, "", "At once.", false},
    {"fsi:paper", kPaper, "", "As printed.", false},
    {"fsi:paper@reproject=0", kPaper, "@reproject=0", "The older buffer is looked up at the same pixel.", false},
    {"fsi:paper@half-precision=1", kPaper, "@half-precision=1", "Ids and depth are 16-bit floats.", false},
    {"fsi", kOwn, "", "As it is.", false},
    {"fsi@reproject=0", kOwn, "@reproject=0", "The older buffer is looked up at the same pixel.", false},
    {"fsi@keep-hidden=0", kOwn, "@keep-hidden=0", "What is not visible yet is discarded, with its depth and id.", true},
    {"fsi@wide-depth=0", kOwn, "@wide-depth=0", "Depths are 16-bit floats, near 0.", true},
    {"fsi@wide-ids=0", kOwn, "@wide-ids=0", "Ids are 16-bit floats.", true},
    {"fsi@weigh-by-phase=0", kOwn, "@weigh-by-phase=0", "Where both levels are seen, half of each colour.", true},
    {"fsi@split-parities=0", kOwn, "@split-parities=0", "All draw their finer level in the same frames.", true},
    {"fsi@split-things=0", kOwn, "@split-things=0", "One thing's finer level is drawn in one frame, its coarser in the next.",
     true},
    {"fsi@search=0", kOwn, "@search=0", "One lookup in the older buffer, by the newer one's depth.", true},
    {"fsi@suit-grain=0", kOwn, "@suit-grain=0", "The visibility's grain is as it was baked, however far the thing.", true},
    {"fsi@softness=0", kOwn, "@softness=0", "A place appears at once, not over as long as the ramp.", true},
    {"fsi@copy-rest=0", kOwn, "@copy-rest=0", "Two frames are put together in all of the picture, which costs time alone.", true},
    {"fsi@sieve=0", kOwn, "@sieve=0", "All of the squares in which something may change is searched, which costs time alone.",
     true},
    {"fsi@know-cuts=0", kOwn, "@know-cuts=0", "After a cut levels take their time, which no film here has: holes of S04.", true},
    {"fsi@ease-ends=0", kOwn, "@ease-ends=0", "The first frame of a change and the last differ as much as those between.", true},
    {"fsi@long-ramps=0", kOwn, "@long-ramps=0", "One level's ramp after the other's, as in the paper.", true},
}};

struct Change {
    const char* what;
    double before, after, least;  // least: what could be seen
};

}  // namespace

std::span<const Variation> variations() {
    return kVariations;
}

Script script_of_variations(const std::string& name, const std::string& chain, const Stand& stand) {
    Script script{name, chain, stand, {}};
    for (const Variation& one : kVariations) {
        Take take{std::string(one.name), {}};
        take.run.spec = spec_of(kWays[one.way], settings_of(stand, kWays[one.way]) + std::string(one.setting));
        script.takes.push_back(std::move(take));
    }
    return script;
}

std::string change_of(const Seen& whole, const Seen& without) {
    constexpr double kTold = 0.05;
    const Change changes[] = {{"W entering", whole.entering_w, without.entering_w, 0.02},
                              {"W leaving", whole.leaving_w, without.leaving_w, 0.02},
                              {"W of the change", whole.integrated_w, without.integrated_w, 0.1},
                              {"pop index", whole.pop, without.pop, 0.05},
                              {"frame to frame, %", 100 * whole.odd_even, 100 * without.odd_even, 0.5}};
    std::string text;
    for (const Change& one : changes) {
        double moved = std::abs(one.after - one.before);
        if (moved < one.least || moved < kTold * std::abs(one.before)) continue;
        text +=
            fmt::format("{}{} {} to {}", text.empty() ? "" : ", ", one.what, short_number(one.before), short_number(one.after));
    }
    return text.empty() ? "nothing that could be measured here" : text;
}

}  // namespace overlook::measure::paper::fsi
