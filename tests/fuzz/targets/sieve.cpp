// SPDX-License-Identifier: GPL-3.0-or-later
// A sieve curve, from which radii are drawn.

#include <cmath>
#include <random>
#include <stdexcept>

#include "specimens/packing/size_distribution.hpp"
#include "tests/fuzz/input.hpp"
#include "tests/fuzz/targets.hpp"

void crackle::fuzz::sieve(std::string_view bytes) {
    const SieveCurve curve = read_sieve_curve(write_file("sieve.csv", bytes));
    std::mt19937_64 generator(1);
    for (const double radius : sample_radii(curve, 5, generator)) {
        if (!(radius > 0.0) || !std::isfinite(radius)) throw std::logic_error("a radius that no circle can have");
    }
}
