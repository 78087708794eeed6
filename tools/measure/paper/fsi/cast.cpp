#include "tools/measure/paper/fsi/cast.h"

#include <cassert>

#include "tools/measure/methods.h"

namespace overlook::measure::paper::fsi {

MethodSpec spec_of(const Way& way, const std::string& settings) {
    Result<MethodSpec> spec = parse_method(std::string(way.method) + settings);
    assert(spec);
    return *spec;
}

}  // namespace overlook::measure::paper::fsi
