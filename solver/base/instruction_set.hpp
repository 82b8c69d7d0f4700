// SPDX-License-Identifier: GPL-3.0-or-later
// The program contains kernels compiled for several instruction sets and chooses one of them at start-up.
#pragma once

#include <cstdint>
#include <span>

#include "solver/base/names.hpp"

namespace crackle {

/// Levels of the x86-64 psABI: v2 with SSE4.2, v3 with AVX2, v4 with AVX-512 (F, BW, CD, DQ, VL); aarch64: Armv8.0 with
/// NEON.
enum class InstructionSet : std::uint8_t { x86_64_v2, x86_64_v3, x86_64_v4, aarch64 };
/// Names accepted in the environment variable CRACKLE_ISA and printed by `crackle doctor`.
constexpr auto list_names(InstructionSet) { return in_order("x86-64-v2", "x86-64-v3", "x86-64-v4", "aarch64"); }

/// Number of doubles that the kernels process at once (solver/base/lanes.hpp).
constexpr int lanes_of(InstructionSet set) {
    return set == InstructionSet::x86_64_v4 ? 8 : set == InstructionSet::x86_64_v3 ? 4 : 2;
}
inline constexpr int most_lanes = 8;

/// Whether this processor and its operating system support an instruction set.
bool runs_here(InstructionSet set);

/// Whether this processor has wider vector registers than the 128 bits of x86-64-v2 (see clear_upper_halves() in
/// lanes.hpp).
bool has_wider_registers();

/// Instruction sets for which kernels were compiled, narrowest first.
std::span<const InstructionSet> built_in_sets();

/// The set given by the environment variable CRACKLE_ISA, or else the widest built-in set that this machine supports.
/// It is determined only once.
InstructionSet chosen_set();

}  // namespace crackle
