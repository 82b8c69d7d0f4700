// SPDX-License-Identifier: GPL-3.0-or-later
// Values that bond laws read and return: the state of a bonded point, its state after a break, and its rates of change
// with strain in a linear solution.
// Tested by tests/solver/laws/bond_law_test.cpp.
#pragma once

#include <limits>
#include <optional>

namespace crackle {

/// A bonded point in a force pass. Values that the law does not need according to its facts are 0.
template <class Number>
struct BondedPoint {
    Number overlap;            // m; measured from the rest overlap if the law has from_rest_overlap
    Number bond_overlap;       // m, δ0
    Number closing, slipping;  // m/s, relative velocities along the normal and tangent
    Number shear_force;        // N, elastic shear force before the last drift
    Number strength_share;     // Points::strength_share, if strengths_are_given
    double drift;              // s, length of the last drift
};

/// Elastic forces of a bonded point, N: normal force (compression positive) and shear force.
template <class Number>
struct BondForces {
    Number normal, shear;
};

/// Strengths of a bond, including its point's strength factor.
template <class Number>
struct BondStrength {
    Number tensile, cohesion;  // N
    Number friction;           // friction coefficient μ
};

/// Values that a point stores about its bond; a value that the world does not store is 0.
struct BondMemory {
    BondForces<double> strong;          // in the last step in which the bond carried at least half its strength
    bool slid;                          // whether the bond has reached its Coulomb limit
    std::optional<double> normal_work;  // J, stored in the normal spring; set only if the normal force has no potential
};

/// State of a point after its bond has broken, and the energy released.
struct BrokenBond {
    bool in_shear, slid;
    double rest_overlap;          // m, overlap at which the force is zero
    double normal, shear;         // N, elastic forces after the break
    double strength;              // N
    double energy;                // J
    BondForces<double> reported;  // forces that the break event reports
};

/// Change of a quantity per unit of strain, with its error. A change smaller than the error counts as 0.
struct Rate {
    double value = 0.0, error = 0.0;
};

/// Strain at which a quantity becomes 0. It is infinite if the quantity increases, or decreases by at most the error of
/// the slope. @param now value at zero strain @param slope change per unit of strain
inline double strain_of_loss(double now, Rate slope) {
    return slope.value < -slope.error ? -now / slope.value : std::numeric_limits<double>::infinity();
}

/// Changes of the overlap (m) and of the elastic forces (N) of a bonded point per unit of strain.
struct BondGrowth {
    Rate closing, normal, shear;  ///< normal: positive in compression; shear: magnitude of the shear force
};

/// Strains at which a bond reaches its limits in a linear solution; infinite if the bond never reaches the limit.
struct ElasticLimits {
    double strength = 0.0;  // N, in tension
    double break_strain = 0.0, slip_strain = 0.0;
};

}  // namespace crackle
