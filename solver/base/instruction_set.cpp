// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/base/instruction_set.hpp"

namespace crackle {

bool runs_here(InstructionSet set) {
#if defined(__x86_64__)
    // Features that each level adds to the one below. __builtin_cpu_supports() also checks that the operating system
    // saves the vector registers.
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

}  // namespace crackle
