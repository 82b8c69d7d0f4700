// SPDX-License-Identifier: GPL-3.0-or-later
// Program run by CMake for CRACKLE_SETS=NATIVE. It prints, as a CMake list, the narrowest instruction set of this
// processor's family and the widest one that runs on it.
// Tested by tests/solver/base/instruction_set_test.cpp.
#include <algorithm>
#include <iostream>
#include <string>
#include <vector>

#include "solver/base/instruction_set.hpp"

int main() {
    using crackle::InstructionSet;
#if defined(__x86_64__)
    const std::vector<InstructionSet> family{InstructionSet::x86_64_v2, InstructionSet::x86_64_v3,
                                             InstructionSet::x86_64_v4};
#else
    const std::vector<InstructionSet> family{InstructionSet::aarch64};
#endif
    InstructionSet widest = family.front();
    for (const InstructionSet set : family)
        if (runs_here(set)) widest = set;
    const auto print = [](InstructionSet set) {
        std::string name(name_of(set));
        std::ranges::replace(name, '-', '_');
        std::cout << name;
    };
    print(family.front());
    if (widest == family.front()) return 0;
    std::cout << ';';
    print(widest);
    return 0;
}
