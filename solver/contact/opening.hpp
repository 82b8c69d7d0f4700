// SPDX-License-Identifier: GPL-3.0-or-later
// Normal force of an unbonded point under the consistent integrator: leapfrog, but for a contact's first and last step.
//
// Leapfrog conserves ½mv²(n+½) + ½kδ(n)δ(n+1) while a linear spring is closed. It loses count where a contact opens or
// closes within a step: a bounce changes the energy by what depends on where in the step it falls, a random walk that
// grows with the square of the step. Here the invariant is taken with the clipped overlap δ+ = max(δ, 0), which asks of
// the first and the last step of a contact, and of no other, for the time-symmetric force
//     f(n) = kδ(n) (δ+(n+1) - δ+(n-1)) / (δ(n+1) - δ(n-1)),
// explicitly: with p the next overlap without this force, κ = k·kick·dt/m and q, r, x the clipped overlaps,
//     first step, q = max(-δ(n-1), 0):   x = ½(b + √(b² + 4pq)),  b = p - q - κδ
//     last step,  r = max(δ(n-1), 0):    x = ½(p + r - √((p - r)² + 4κe)),  e = rδ + 2D/k;     f = (p - x)k/κ.
// p needs what else pushes at the point: its bodies' accelerations of the last step stand in for those of this one.
// What the energy misses by that goes into the point's defect D, J, and is made good in its next last step.
// Where what the bodies' last kick has done at most, and the change of this point's own force, cannot part the point,
// the force is kδ: stays_closed() says so without a look at the accelerations.
// Exact for one disc up to the limit; for many it keeps the error bounded. δ [m], k [N/m], m [kg] effective along the
// normal. A dashpot is the lagged one, inside p. Restitution stays first order in the step with it.
// Tested by tests/solver/contact/opening_test.cpp and, with the energies that follow, by
// tests/verification/claims_test.cpp.
#pragma once

#include <algorithm>
#include <cmath>

#include "solver/base/lanes.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// What a point of the consistent integrator meets in a force pass.
struct ClosingPoint {
    double overlap;       // δ(n), m
    double closing;       // v(n-½) along the normal, m/s
    double acceleration;  // closing, of the last kick, m/s2: this point's own force included
    double inverse_mass;  // 1/kg; 0: both sides held along the normal
    double stiffness;     // N/m
    double dashpot;       // N
    double drift;         // s, that led here
    double kick, step;    // s, coming kick and drift
};

/// What the bodies of a point have done in their last kick at most, and their inverse masses, summed.
template <class Number>
struct PushBounds {
    Number acceleration;  // m/s2
    Number inverse_mass;  // 1/kg
};

/// Whether a closed point surely is not in its last step: p - κδ > 0 whatever its bodies' accelerations are within the
/// bounds. Rounding is some 1e-15 of the terms; a millionth of them is left for it.
/// @param last, dashpot N, of the last force pass and of this one  @param kick, step s
template <class Number>
CRACKLE_INLINE Condition<Number> stays_closed(const Number& stiffness, const Number& overlap, const Number& closing,
                                              const Number& last, const Number& dashpot,
                                              const PushBounds<Number>& bounds, double kick, double step) {
    const Number change = magnitude(last - dashpot - stiffness * overlap);
    const Number parted = kick * step * (bounds.acceleration + bounds.inverse_mass * change);
    return overlap + step * closing - parted > 1e-6 * (overlap + step * magnitude(closing));
}

/// Closes the account of the last step's force. To be called at every force pass of an unbonded point, before
/// opening_force(). @param last overlap in the last force pass, m; unset in a new point @return the overlap one step
/// ago
inline double settle_opening(OpeningMemory& memory, double last, bool touched, const ClosingPoint& a) {
    const double before = std::isnan(last) ? a.overlap - a.closing * a.drift : last;
    if (touched) {
        memory.defect += 0.5 * memory.extra_force * a.overlap;
        if (a.overlap <= 0.0) memory.defect += 0.5 * a.stiffness * std::max(before, 0.0) * a.overlap;
    }
    memory.extra_force = 0.0;
    return before;
}

/// Spring force at δ(n) > 0, N. @param touched in contact in the last pass too  @param before δ(n-1), m
/// @param last force of spring and dashpot in the last force pass, N
inline double opening_force(OpeningMemory& memory, double last, bool touched, double before, const ClosingPoint& a) {
    const double k = a.stiffness, d = a.overlap;
    const double plain = k * d;
    const double u = a.kick * a.step * a.inverse_mass, kappa = k * u;
    // Overlap to come without the spring.
    const double others = a.acceleration + last * a.inverse_mass;
    const double p = d + (a.closing + others * a.kick) * a.step - u * a.dashpot;
    double force = plain;
    if (!touched) {
        const double q = std::max(-before, 0.0);
        if (u > 0.0) {
            const double b = p - q - kappa * d;
            const double x = 0.5 * (b + std::sqrt(b * b + 4.0 * p * q));
            force = p > 0.0 ? std::max((p - x) / u, 0.0) : 0.0;
        }
        memory.extra_force = force - plain;
        memory.defect += 0.5 * memory.extra_force * q + 0.5 * plain * q;
    } else if (u > 0.0 && p - kappa * d <= 0.0) {
        const double r = std::max(before, 0.0);
        const double e = std::max(d * r + 2.0 * memory.defect / k, 0.0);
        const double x = 0.5 * (p + r - std::sqrt((p - r) * (p - r) + 4.0 * kappa * e));
        force = std::max((p - x) / u, 0.0);
        memory.extra_force = force - plain;
        memory.defect -= 0.5 * memory.extra_force * before;
    }
    return force;
}

/// Energy of a point at time n beyond that of its spring at δ(n), J; open points may still have some to settle.
/// @param overlap m; unset in a new point
inline double opening_energy(const OpeningMemory& memory, double overlap) {
    return memory.defect + 0.5 * memory.extra_force * (std::isnan(overlap) ? 0.0 : overlap);
}

}  // namespace crackle
