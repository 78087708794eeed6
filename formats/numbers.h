// Numbers as people read them.
#pragma once

#include <cstdint>
#include <string>

namespace overlook {

// 4096 -> "4,096".
std::string with_commas(uint64_t number);

}  // namespace overlook
