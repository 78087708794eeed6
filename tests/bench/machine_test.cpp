#include "tests/bench/machine.h"

#include <gtest/gtest.h>

namespace overlook::bench {
namespace {

TEST(MachineKind, IsTheProcessorAndItsCoresInSmallLettersAndHyphens) {
    EXPECT_EQ(machine_kind("AMD EPYC 7B13", 8), "amd-epyc-7b13-8-cores");
    EXPECT_EQ(machine_kind("AMD Ryzen 9 5950X 16-Core Processor", 32), "amd-ryzen-9-5950x-16-core-processor-32-cores");
}

TEST(MachineKind, LeavesOutMarksAndWhatNoFileNameShouldHold) {
    EXPECT_EQ(machine_kind("Intel(R) Xeon(R) CPU E5-2680 v4 @ 2.40GHz", 28), "intel-xeon-cpu-e5-2680-v4-2-40ghz-28-cores");
    EXPECT_EQ(machine_kind("  Intel(R) Core(TM) i7 / ../x\t", 4), "intel-core-i7-x-4-cores");
    EXPECT_EQ(machine_kind("Pr\xc3\xb6zessor", 1), "pr-zessor-1-cores");
}

TEST(MachineKind, TellsCoresApartAndNamesTheUnknown) {
    EXPECT_NE(machine_kind("x", 2), machine_kind("x", 4));
    EXPECT_EQ(machine_kind("unknown processor", 2), "unknown-processor-2-cores");
    EXPECT_EQ(machine_kind("", 2), "2-cores");
}

TEST(MachineKind, OfThisMachineIsANameForAFile) {
    std::string kind = machine_kind(processor_name(), core_count());
    EXPECT_EQ(kind.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-"), std::string::npos) << kind;
    EXPECT_GE(core_count(), 1u);
}

}  // namespace
}  // namespace overlook::bench
