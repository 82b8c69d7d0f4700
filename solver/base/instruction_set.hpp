// SPDX-License-Identifier: GPL-3.0-or-later
// Kernels are compiled once for each instruction set, into one program; which of them run is chosen at its start.
//
// A source of kernels (crackle_kernels() in CMakeLists.txt) defines functions of InstructionSet::CRACKLE_SET, which
// callers reach by of_chosen_set() of chosen_set.hpp. All else is compiled for what every processor of the family has.
// Any set gives the same bytes: lanes are IEEE arithmetic in the order of the source (solver/base/lanes.hpp).
// Tested by tests/solver/base/instruction_set_test.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace crackle {

/// Levels of the x86-64 psABI: v2 has SSE4.2, v3 AVX2, v4 AVX-512 (F, BW, CD, DQ, VL); aarch64 as of Armv8.0 with NEON.
enum class InstructionSet : std::uint8_t { x86_64_v2, x86_64_v3, x86_64_v4, aarch64 };

/// As CRACKLE_ISA and `crackle doctor` have it: "x86-64-v3".
std::string_view name_of(InstructionSet set);

/// Doubles side by side in the kernels (solver/base/lanes.hpp).
constexpr int lanes_of(InstructionSet set) {
    return set == InstructionSet::x86_64_v4 ? 8 : set == InstructionSet::x86_64_v3 ? 4 : 2;
}
inline constexpr int most_lanes = 8;

/// Whether this processor, and its system, can run it.
bool runs_here(InstructionSet set);

/// Whether its vector registers are wider than those of v2 (clear_upper_halves() of lanes.hpp).
bool has_wider_registers();

/// Those that kernels are compiled for, narrowest first.
std::span<const InstructionSet> built_in_sets();

/// The widest of them that runs here, or the one that the environment variable CRACKLE_ISA names; found once.
/// @throws InputError where that is unknown, not compiled in or does not run here, or no set does
InstructionSet chosen_set();

}  // namespace crackle
