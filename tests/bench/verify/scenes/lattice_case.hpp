// SPDX-License-Identifier: GPL-3.0-or-later
// A case for a triangular lattice of discs, given as a particle file, or for their cells, which are regular hexagons.
// Tested by tests/verification/claims_test.cpp.
#pragma once

#include <string>

#include "specimens/loading/virtual_test.hpp"

namespace crackle::verification {

struct LatticeCase {
    static constexpr double radius = 1e-3, overlap = 1e-5, spacing = 2.0 * radius - overlap;  // m
    static constexpr double kn = 1e9, share = 0.5;                                            // N/m, k_s/k_n

    int columns = 0, rows = 0;
    std::string loading;     ///< table [loading] and any further tables, as TOML
    bool hexagons = false;   ///< whether the particles are hexagons with coulomb bonds
    std::string shape = {};  ///< table [shape], as TOML
    /// Additional width of the packing's box at its right side, so that its middle lies between the centres of every
    /// row.
    double room = 0.0;  // m

    /// The specimen, bonded, with its linear solution; it is not loaded. Its files have been removed.
    VirtualTest bonded() const;
    /// E of the infinite lattice, N/m (assembly/triangular_lattice.cpp); hexagons have four points per face.
    double modulus() const;
};

}  // namespace crackle::verification
