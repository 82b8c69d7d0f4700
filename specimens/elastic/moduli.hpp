// SPDX-License-Identifier: GPL-3.0-or-later
// Young's modulus and Poisson's ratio of a bonded specimen, from the linear solution, with strains and stress defined
// as in curve.csv.
// Tested by tests/specimens/elastic/analysis_test.cpp.
#pragma once

#include "solver/linear/elastic.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

/// Moduli of a specimen between its platens, from the linear solution.
struct Moduli {
    double youngs_modulus;     // N/m
    double poissons_ratio;     ///< NaN without side particles
    double gauge_modulus;      ///< stress over the strain of the axial gauge length, N/m; NaN without gauge particles
    ElasticSolution solution;  ///< solution for an axial strain of 1 in tension, with the lower platen fixed
};

/// Moduli, and the strain up to which they hold.
struct SmallStrain {
    Moduli moduli;
    /// Axial strain at which the first points fail in the linear solution; infinite if none ever does.
    double yield_strain;
};

/// Moduli of a specimen. @param world  bonded world with the platens and side particles of `setup`
/// @throws InputError if there is no linear solution, or if the specimen is a mechanism, which carries no load
Moduli solve_moduli(const World& world, const TestSetup& setup);

}  // namespace crackle
