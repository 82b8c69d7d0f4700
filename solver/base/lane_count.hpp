// SPDX-License-Identifier: GPL-3.0-or-later
// How many doubles the contact kernels compute side by side (solver/base/lanes.hpp).
// Tested by tests/solver/base/lanes_test.cpp.
#pragma once

namespace crackle {

// CRACKLE_EIGHT_LANES is for tests of that form where the machine has no AVX-512.
#if defined(__AVX512F__) || defined(CRACKLE_EIGHT_LANES)
inline constexpr int lane_count = 8;
#else
inline constexpr int lane_count = 4;
#endif

}  // namespace crackle
