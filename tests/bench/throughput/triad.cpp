// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/throughput/triad.hpp"

#include "solver/base/lanes.hpp"

namespace crackle::throughput {

template <>
void triad_of<InstructionSet::CRACKLE_SET>(double* a, const double* b, const double* c, double s, std::size_t count) {
    clear_upper_halves();
    for (std::size_t k = 0; k < count; ++k) a[k] = b[k] + s * c[k];
    asm volatile("" : : "r"(a) : "memory");
}

}  // namespace crackle::throughput
