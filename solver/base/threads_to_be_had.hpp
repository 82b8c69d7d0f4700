// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/solver/base/threads_to_be_had_test.cpp.
#pragma once

namespace crackle {

/// How many threads the system lets this process have at a time now, this one among them: limits of a user or a
/// container may be far below the number of processors. OpenMP ends the process where it is refused one, so whoever
/// begins a team asks here first.
/// @param most so many are tried @return 1 to most
int threads_to_be_had(int most);

}  // namespace crackle
