// The machine that benchmarks run on: what it is called, and what it can do.
#pragma once

#include <string>

namespace overlook::bench {

// What the processor calls itself; "unknown processor" where the system does not say.
std::string processor_name();
// Logical processors that this process may use, at least 1.
unsigned core_count();

// Names files of results, so that those of different machines do not overwrite each other: the processor's name in small letters
// and digits, without (R) and (TM), every run of other characters one hyphen, and the cores: "amd-epyc-7b13-8-cores".
std::string machine_kind(const std::string& processor, unsigned cores);

// The most this process held at any time since forget_peak_memory(), in 10^6 bytes.
void forget_peak_memory();
double peak_memory_mb();

}  // namespace overlook::bench
