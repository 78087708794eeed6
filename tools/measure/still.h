// What was found to be there before a run, and must be there while it lasts.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "formats/result.h"

namespace overlook::measure {

// Throws std::runtime_error where it no longer is.
template <class Value>
Value still(Result<Value> result) {
    if (!result) throw std::runtime_error(result.error().message + " (it was readable when the run began)");
    if constexpr (!std::is_void_v<Value>) return std::move(*result);
}
inline void still(std::span<const Error> faults) {
    if (!faults.empty()) throw std::runtime_error(faults.front().message + " (it was readable when the run began)");
}

}  // namespace overlook::measure
