// SPDX-License-Identifier: GPL-3.0-or-later
// Normal force of an unbonded point under the consistent integrator: leapfrog, except in a contact's first and last
// steps.
//
// Leapfrog conserves ½mv²(n+½) + ½kδ(n)δ(n+1) while a linear spring is closed, but not if a contact opens or closes
// within a step. Each bounce then changes the energy by an amount that depends on its time within the step: a random
// walk whose size grows with the square of the step. Here the clipped overlap δ+ = max(δ, 0) takes the place of δ in
// the conserved energy. This requires, only in the first and the last step of a contact, the time-symmetric force
//     f(n) = kδ(n) (δ+(n+1) - δ+(n-1)) / (δ(n+1) - δ(n-1)).
// Let p be the next overlap without this force, κ = k·kick·dt/m, and q, r, x clipped overlaps. The explicit solution is
//     first step, q = max(-δ(n-1), 0):   x = ½(b + √(b² + 4pq)),  b = p - q - κδ
//     last step,  r = max(δ(n-1), 0):    x = ½(p + r - √((p - r)² + 4κe)),  e = rδ + 2D/k;     f = (p - x)k/κ.
// p depends on the other forces on the bodies. Their accelerations in the last step are used as an estimate for this
// step. The resulting energy error is added to the point's defect D, J, and corrected when the contact opens. If
// neither the largest effect of the bodies' last kick nor the change of this point's force can open the contact, the
// force is kδ. stays_closed() decides this from bounds, without reading the accelerations. The method is exact for one
// disc up to the stability limit; for many discs it keeps the error bounded. δ [m], k [N/m], m [kg] effective along the
// normal. The lagged dashpot force is included in p. With dashpots, the error of restitution is of first order in the
// step.
// Tested by tests/solver/contact/opening_test.cpp; the resulting energies are tested by
// tests/verification/claims_test.cpp.
#pragma once

#include <algorithm>
#include <cmath>

#include "solver/base/lanes.hpp"
#include "solver/world/points.hpp"

namespace crackle {

/// Values of a contact point that the consistent integrator needs in a force pass.
struct ClosingPoint {
    double overlap;       // δ(n), m
    double closing;       // m/s, closing velocity v(n-½) along the normal
    double acceleration;  // m/s2, closing acceleration in the last kick, including this point's own force
    double inverse_mass;  // 1/kg; 0 if both sides are held along the normal
    double stiffness;     // N/m
    double dashpot;       // N, normal dashpot force
    double drift;         // s, length of the drift that led to the current positions
    double kick, step;    // s, lengths of the next kick and drift
};

/// Bounds for a point, each the sum over its two bodies: largest acceleration in the last kick, and inverse mass.
template <class Number>
struct PushBounds {
    Number acceleration;  // m/s2
    Number inverse_mass;  // 1/kg
};

/// Whether a closed point certainly does not open in this step: p - κδ > 0 for all accelerations within the bounds.
/// Round-off is about 1e-15 of the terms; the margin is 1e-6 of them.
/// @param last the force of spring and dashpot in the last force pass, N @param dashpot the dashpot force in this pass,
/// N
/// @param kick, step the lengths of the next kick and drift, s
template <class Number>
CRACKLE_INLINE Condition<Number> stays_closed(const Number& stiffness, const Number& overlap, const Number& closing,
                                              const Number& last, const Number& dashpot,
                                              const PushBounds<Number>& bounds, double kick, double step) {
    const Number change = magnitude(last - dashpot - stiffness * overlap);
    const Number parted = kick * step * (bounds.acceleration + bounds.inverse_mass * change);
    return overlap + step * closing - parted > 1e-6 * (overlap + step * magnitude(closing));
}

/// Completes the energy defect of the last step's force. Call it in every force pass of an unbonded point, before
/// opening_force(). @param last the overlap in the last force pass, m; NaN for a new point @return the overlap one step
/// ago, m
inline double settle_opening(OpeningMemory& memory, double last, bool touched, const ClosingPoint& a) {
    const double before = std::isnan(last) ? a.overlap - a.closing * a.drift : last;
    if (touched) {
        memory.defect += 0.5 * memory.extra_force * a.overlap;
        if (a.overlap <= 0.0) memory.defect += 0.5 * a.stiffness * std::max(before, 0.0) * a.overlap;
    }
    memory.extra_force = 0.0;
    return before;
}

/// Spring force at δ(n) > 0, N. @param touched whether the point was in contact in the last force pass @param before
/// δ(n-1), m
/// @param last the force of spring and dashpot in the last force pass, N
inline double opening_force(OpeningMemory& memory, double last, bool touched, double before, const ClosingPoint& a) {
    const double k = a.stiffness, d = a.overlap;
    const double plain = k * d;
    const double u = a.kick * a.step * a.inverse_mass, kappa = k * u;
    // Next overlap without the spring.
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

/// Energy of a point at time n in excess of its spring energy at δ(n), J. It can be non-zero for open points.
/// @param overlap the overlap in the last force pass, m; NaN for a new point
inline double opening_energy(const OpeningMemory& memory, double overlap) {
    return memory.defect + 0.5 * memory.extra_force * (std::isnan(overlap) ? 0.0 : overlap);
}

}  // namespace crackle
