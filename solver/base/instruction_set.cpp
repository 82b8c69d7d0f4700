// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/base/instruction_set.hpp"

#include <algorithm>
#include <cstdlib>
#include <string>

#include "solver/base/errors.hpp"

namespace crackle {
namespace {

/// "x86-64-v2, x86-64-v3".
template <class Wanted>
std::string names_of_sets(Wanted wanted) {
    std::string names;
    for (const InstructionSet set : built_in_sets) {
        if (!wanted(set)) continue;
        if (!names.empty()) names += ", ";
        names += name_of(set);
    }
    return names;
}

std::size_t widest_that_runs() {
    for (std::size_t k = built_in_sets.size(); k-- > 0;)
        if (runs_here(built_in_sets[k])) return k;
    throw InputError("this processor runs none of the instruction sets that this program was built for (" +
                     names_of_sets([](InstructionSet) { return true; }) +
                     "); build it with -DCRACKLE_SETS=... or use a newer machine");
}

std::size_t find_place() {
    const char* const asked = std::getenv("CRACKLE_ISA");
    if (asked == nullptr || *asked == '\0') return widest_that_runs();
    const auto place = std::ranges::find_if(
        built_in_sets, [&](InstructionSet set) { return name_of(set) == asked && runs_here(set); });
    if (place == built_in_sets.end()) {
        throw InputError("CRACKLE_ISA: found '" + std::string(asked) + "', expected one of " +
                         names_of_sets(runs_here) + " on this machine; unset it to take the widest");
    }
    return static_cast<std::size_t>(place - built_in_sets.begin());
}

}  // namespace

std::string_view name_of(InstructionSet set) {
    switch (set) {
        case InstructionSet::x86_64_v2:
            return "x86-64-v2";
        case InstructionSet::x86_64_v3:
            return "x86-64-v3";
        case InstructionSet::x86_64_v4:
            return "x86-64-v4";
        case InstructionSet::aarch64:
            return "aarch64";
    }
    return "unknown";
}

bool runs_here(InstructionSet set) {
#if defined(__x86_64__)
    // What tells a level from the one below; the compiler's function also asks whether the system saves the registers.
    const bool v2 =
        __builtin_cpu_supports("ssse3") && __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("popcnt");
    const bool v3 = v2 && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                    __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
    const bool v4 = v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                    __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
                    __builtin_cpu_supports("avx512vl");
    switch (set) {
        case InstructionSet::x86_64_v2:
            return v2;
        case InstructionSet::x86_64_v3:
            return v3;
        case InstructionSet::x86_64_v4:
            return v4;
        case InstructionSet::aarch64:
            return false;
    }
    return false;
#else
    return set == InstructionSet::aarch64;
#endif
}

bool has_wider_registers() {
#if defined(__x86_64__)
    return __builtin_cpu_supports("avx");
#else
    return false;
#endif
}

std::size_t chosen_place() {
    static const std::size_t place = find_place();
    return place;
}

InstructionSet chosen_set() { return built_in_sets[chosen_place()]; }

}  // namespace crackle
