// SPDX-License-Identifier: GPL-3.0-or-later
// Results from the linear solution of a bonded specimen between its platens: moduli, the bonds that fail first, the
// stable time step, free motions and vibration modes. No time stepping is needed.
//
// Let ε be the axial strain in the direction of loading, and a_n and a_t the increases in a point's overlap and slip
// per unit of ε:
//       break:  δ0 + ε a_n = 0                         (linear, no slip)
//       slip:   k_s |a_t| ε = μ k_n (δ0 + ε a_n)       (Coulomb limit, solver/MODEL.md 4.2)
// The Coulomb limit of an opening point falls with its overlap, so the point slips before it breaks, unless its shear
// force is zero.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "solver/base/fields.hpp"
#include "solver/linear/elastic.hpp"
#include "specimens/elastic/moduli.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

/// A bonded point or intact face in the linear solution. `closing` and forces refer to ElasticAnalysis::strain.
struct LinearBond {
    int body_i = 0, body_j = 0;  ///< input ids
    Vec2 position;               // m
    /// Strength of the bond in tension, N: k_n δ0, or the tensile strength of a coulomb bond; infinite if the bond
    /// cannot break.
    double strength = 0.0;
    double overlap = 0.0;       // m, δ0, initial overlap
    double closing = 0.0;       // m, increase in the overlap under `strain`
    double normal_force = 0.0;  // N, compression positive
    double shear_force = 0.0;   // force on body_i, N; positive along the normal from i to j turned by +90 degrees
    double break_strain = 0.0;  ///< axial strain at which the point breaks; infinite if it closes
    double slip_strain = 0.0;   ///< axial strain at which the point slides; infinite if it never does

    CRACKLE_FIELDS(body_i, body_j, position, strength, overlap, closing, normal_force, shear_force, break_strain,
                   slip_strain);
};

/// The first bond to break or slide.
struct FirstEvent {
    double strain = 0.0;  ///< axial strain, positive in the direction of loading
    double stress = 0.0;  // N/m
    std::size_t bond = 0;
};

/// Results of the linear solution for a specimen.
struct ElasticAnalysis {
    double youngs_modulus = 0.0, poissons_ratio = 0.0;  // N/m, -
    double residual = 0.0;                              ///< residual of the solve, relative to its load
    double strain = 0.0;                                ///< axial strain for which the bond forces are listed
    std::vector<LinearBond> bonds;
    std::optional<FirstEvent> first_break, first_slip;
    double stable_time_step = 0.0;  // s, exact limit
    bool stable_time_step_proved = false;
    // s; lower bound on the stable time step, found without an eigenvalue solve; time step that a test would use
    double time_step_bound = 0.0, time_step = 0.0;
    FreeMotions free;
    std::vector<int> free_ids;        ///< input ids of the bodies that can move without resistance
    std::vector<double> frequencies;  // angular frequencies of the lowest modes that store elastic energy, rad/s
    std::int64_t unknowns = 0;
};

/// Axial strain at which a given fraction of the bonded points (at least one) fail in the linear solution: they slide
/// or, if they do not slide, break. Infinite if fewer ever fail.
/// @param moduli  solution for a world with bonded platens, either `world` itself or one with the same bodies
double yield_strain(const World& world, const PlacedApparatus& apparatus, const Moduli& moduli, double share);

/// Axial strain at which half of the points that touch on unbonded joints slide in the linear solution, starting from
/// their present forces. Infinite if they never do, or if no such point carries a force.
double joint_slip_strain(const World& world, const PlacedApparatus& apparatus, const Moduli& moduli);

/// Linear results of a specimen that is bonded but not yet loaded.
/// @param world  world with the platens and side particles of `setup`
/// @param moduli  result of solve_moduli() for this world
/// @param strain  axial strain for which bond forces are listed, positive in the direction of loading
/// @param modes  number of lowest vibration modes to find, with the platens held
ElasticAnalysis analyse_elastic(const World& world, const TestSetup& setup, const Moduli& moduli, double strain,
                                int modes);

}  // namespace crackle
