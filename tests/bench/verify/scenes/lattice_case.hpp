// SPDX-License-Identifier: GPL-3.0-or-later
// A triangular lattice of discs as the particle file of a case that tests it, or their cells, regular hexagons.
// Tested by tests/verification/claims_test.cpp.
#pragma once

#include <string>

#include "specimens/loading/virtual_test.hpp"

namespace crackle::verification {

struct LatticeCase {
    static constexpr double radius = 1e-3, overlap = 1e-5, spacing = 2.0 * radius - overlap;  // m
    static constexpr double kn = 1e9, share = 0.5;                                            // N/m, k_s/k_n

    int columns = 0, rows = 0;
    std::string loading;     ///< [loading] and tables after it
    bool hexagons = false;   ///< with coulomb bonds: they end where an outline does
    std::string shape = {};  ///< [shape] and its keys
    /// By which the packing's box is wider at its right side: its middle then lies between centres in every row.
    double room = 0.0;  // m

    /// Made and bonded, with its linear solution; not loaded. Its files are gone.
    VirtualTest bonded() const;
    /// E of the infinite lattice, N/m (assembly/triangular_lattice.cpp); a face of hexagons has four points.
    double modulus() const;
};

}  // namespace crackle::verification
