// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/base/chosen_set.hpp"

#include <algorithm>
#include <cstdlib>
#include <string>

#include "solver/base/errors.hpp"

namespace crackle {
namespace {

/// Names of the instruction sets for which `wanted` returns true, for example "x86-64-v2, x86-64-v3".
template <class Wanted>
std::string names_of_sets(Wanted wanted) {
    std::string names;
    for (const InstructionSet set : sets_of_this_program) {
        if (!wanted(set)) continue;
        if (!names.empty()) names += ", ";
        names += name_of(set);
    }
    return names;
}

std::size_t widest_that_runs() {
    for (std::size_t k = sets_of_this_program.size(); k-- > 0;)
        if (runs_here(sets_of_this_program[k])) return k;
    throw InputError("this processor supports none of the instruction sets that this program was built for (" +
                     names_of_sets([](InstructionSet) { return true; }) +
                     "); build the program with -DCRACKLE_SETS=NATIVE or use a newer machine");
}

std::size_t find_place() {
    const char* const asked = std::getenv("CRACKLE_ISA");
    if (asked == nullptr || *asked == '\0') return widest_that_runs();
    const auto place = std::ranges::find_if(sets_of_this_program, [&](InstructionSet set) {
        return from_name<InstructionSet>(asked) == set && runs_here(set);
    });
    if (place == sets_of_this_program.end()) {
        throw InputError("CRACKLE_ISA: found '" + std::string(asked) + "', expected one of " +
                         names_of_sets(runs_here) +
                         " on this machine; unset CRACKLE_ISA to use the widest instruction set");
    }
    return static_cast<std::size_t>(place - sets_of_this_program.begin());
}

}  // namespace

std::span<const InstructionSet> built_in_sets() { return sets_of_this_program; }

std::size_t chosen_place() {
    static const std::size_t place = find_place();
    return place;
}

InstructionSet chosen_set() { return sets_of_this_program[chosen_place()]; }

}  // namespace crackle
