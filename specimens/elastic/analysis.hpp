// SPDX-License-Identifier: GPL-3.0-or-later
// What the linear solution gives for a bonded specimen between its platens: moduli, the bonds that give way first, the
// stable time step, free motions, vibration modes. No time stepping.
//
// With ε the axial strain in the sense of the test and a_n, a_t a point's growth of overlap and slip per unit of it,
//     break:  δ0 + ε a_n = 0                         (linear, no slip)
//     slip:   k_s |a_t| ε = μ k_n (δ0 + ε a_n)       (Coulomb limit, solver/MODEL.md 4.2)
// A point that opens slips before it breaks unless it does not shear at all, for its limit goes with its overlap.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "solver/linear/elastic.hpp"
#include "specimens/elastic/moduli.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

/// A bonded point under the linear solution; forces and closing at `ElasticAnalysis::strain`.
struct LinearBond {
    int body_i = 0, body_j = 0;  ///< input ids
    Vec2 position;               // m
    double strength = 0.0;       ///< N, in tension: k_n δ0, or a coulomb bond's own; infinite where it cannot break
    double overlap = 0.0;        // m, δ0
    double closing = 0.0;        // m, growth of the overlap
    double normal_force = 0.0;   // N, compression positive
    double shear_force = 0.0;    // N, on body_i along the normal from i to j turned by +90 degrees
    double break_strain = 0.0;   ///< infinite where the point is squeezed
    double slip_strain = 0.0;    ///< infinite where it sticks forever

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("body_i", s.body_i);
        visit("body_j", s.body_j);
        visit("position", s.position);
        visit("strength", s.strength);
        visit("overlap", s.overlap);
        visit("closing", s.closing);
        visit("normal_force", s.normal_force);
        visit("shear_force", s.shear_force);
        visit("break_strain", s.break_strain);
        visit("slip_strain", s.slip_strain);
    }
};

struct FirstEvent {
    double strain = 0.0;  ///< axial, positive in the sense of the test
    double stress = 0.0;  // N/m
    std::size_t bond = 0;
};

struct ElasticAnalysis {
    double youngs_modulus = 0.0, poissons_ratio = 0.0;  // N/m, -
    double residual = 0.0;                              ///< of the solve, over its load
    double strain = 0.0;                                ///< of the bond forces
    std::vector<LinearBond> bonds;
    std::optional<FirstEvent> first_break, first_slip;
    double stable_time_step = 0.0;  // s, exact
    bool stable_time_step_proved = false;
    double time_step_bound = 0.0, time_step = 0.0;  // s, guaranteed without an eigenvalue solve; what a test would take
    FreeMotions free;
    std::vector<int> free_ids;        ///< input ids of the bodies that can move without resistance
    std::vector<double> frequencies;  // rad/s, lowest modes that store energy
    std::int64_t unknowns = 0;
};

/// Axial strain at which a share of the bonded points (at least one) slide or, where they do not slide, break by the
/// linear solution; infinite where they never do. @param moduli of a world with bonded platens, `world` itself or its
/// twin with the same bodies
double yield_strain(const World& world, const TestSetup& setup, const Moduli& moduli, double share);

/// Axial strain at which half of the points of closed open joints slide by the linear solution, from the forces that
/// they bear now; infinite where they never do, or none bears any.
double joint_slip_strain(const World& world, const TestSetup& setup, const Moduli& moduli);

/// @param world bonded with its platens, not yet loaded, with the platens and side particles of `setup`
/// @param moduli of this world (solve_moduli())
/// @param strain at which bond forces are given (sense of the test)
/// @param modes lowest vibration modes to find, platens held
ElasticAnalysis analyse_elastic(const World& world, const TestSetup& setup, const Moduli& moduli, double strain,
                                int modes);

}  // namespace crackle
