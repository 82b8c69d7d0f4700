// SPDX-License-Identifier: GPL-3.0-or-later
// Young's modulus and Poisson's ratio of a bonded specimen by the definitions of the curve, from the linear solution.
// Tested by tests/specimens/elastic/analysis_test.cpp.
#pragma once

#include "solver/linear/elastic.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

struct Moduli {
    double youngs_modulus;     // N/m
    double poissons_ratio;     ///< not a number without side particles
    double gauge_modulus;      ///< N/m, over the strain of the axial gauge length; not a number without its particles
    ElasticSolution solution;  ///< for an axial strain of 1 in tension, the lower platen in place
};

struct SmallStrain {
    Moduli moduli;
    double yield_strain;  ///< axial, where the first points have given way by the linear solution; infinite: never
};

/// @param world bonded, with the platens and side particles of `setup`
/// @throws InputError where there is no linear solution, or one of a mechanism, which bears nothing
Moduli solve_moduli(const World& world, const TestSetup& setup);

}  // namespace crackle
