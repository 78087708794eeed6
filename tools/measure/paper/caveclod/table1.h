// Table 1: memory by equation 1, term by term, what the paper prints beside what is counted here.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/measure/paper/caveclod/subject.h"

namespace overlook::measure::paper::cameras {

// What section 4 prints of a terrain.
struct PrintedTerrain {
    std::string_view name, title;  // name: of make-sample's folder
    uint64_t polygons = 0, static_bytes = 0, camera_bytes = 0;
    uint64_t ids = 0, positions = 0;  // s and e; e 0: not printed
    double population = 0;            // share of the index array that is in use
};
inline constexpr PrintedTerrain kThreeLakes{"three-lakes", "Three Lakes", 80'000, 6'284'962, 643'064, 5, 40'401, 0.21};
inline constexpr PrintedTerrain kCliff{"cliff", "Cliff", 107'184, 8'261'168, 861'088, 4, 54'056, 0.26};
inline constexpr PrintedTerrain kCanyon{"canyon", "Grand Canyon", 126'480, 9'297'526, 1'016'184, 1, 0, 1};
// Nothing for a terrain that the paper has not.
const PrintedTerrain* printed_of(std::string_view name);

// The numbers of nodes and of vertices that a printed row holds: n = (4n + 4p + 16) / 4 - 4 - p, and d from 44n + 12p + 32d + 2se.
// Where e is not printed the array has one id and an entry a vertex, so that e = d.
struct Solved {
    double nodes = 0, vertices = 0;
    bool is_whole() const;  // a number of vertices is a whole one
};
Solved solved(const PrintedTerrain& terrain);

// Equation 1 of a mesh baked here, in its printed structures.
struct Counted {
    uint64_t nodes = 0, polygons = 0, vertices = 0, ids = 0, positions = 0;  // n, p, d, s, e
    caveclod::paper::Equation1 terms;                                        // of one camera, nothing active
    double population = 0;
    uint64_t own_static_bytes = 0, own_camera_bytes = 0;  // the same of Overlook's form
};
Counted counted_of(const Subject& subject);

struct Table1Row {
    std::string name;
    const PrintedTerrain* printed = nullptr;
    Counted counted;
};
std::string table1_csv(const std::vector<Table1Row>& rows);
std::string table1_html(const std::vector<Table1Row>& rows);

}  // namespace overlook::measure::paper::cameras
