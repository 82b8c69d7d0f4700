// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that the bytes of a run of 20,000 discs with many rebuilds and breaks depend neither on the number of threads
// nor on where it was stopped and resumed.

#include "tests/verification/bursting_specimens.hpp"

namespace crackle {
namespace {

using namespace testing;

TEST(DeterminismAtSize, ThreadsDoNotChangeABitForTwentyThousandDiscs) {
    check_threads(bursting_discs(142, 141, 0.02, 0.01), 400, 10, 100);
}

TEST(DeterminismAtSize, StoppingAndTakingUpAgainDoesNotChangeABitForTwentyThousandDiscs) {
    check_restarts(bursting_discs(142, 141, 0.02, 0.01), 400, 23);
}

}  // namespace
}  // namespace crackle
