// SPDX-License-Identifier: GPL-3.0-or-later
// Computes a broken face in one step: its contribution to the dilation of its cells, its forces and its energies.
// Symbols are defined in world/faces.hpp and laws/face_bond.hpp.
//
// Energy stored in a broken face. p̄' is the late pressure, which lags behind p̄; u_p is the slip, and Ψ the energy
// from lap_pressure():
//     U = Ψ - (L/k_n) p̄' F + ½ (L²/k_n) p̄'² + ½ k_t (δ_t - u_p)²
// Energy losses in a step. <x> denotes the mean of x before and after the step:
//     friction   k_t <q_t> Δu_p + L <τ> Δu_p', with q_t after the slip Δu_p;  <½ k w²> |Δlap| at the ends of the lap
//     friction   <Ψ> Δ(1 - q) when contact points replace the face (hand_over.hpp), with Ψ without the factor q
//     tearing    <Ψ_pull> ΔD, with Ψ_pull the energy of the tension without damage
//     lag        <F(p̄) - F(p̄')> Δδ_n + <M(p̄) - M(p̄')> Δδ_φ - L <p̄ - p̄'> Δq_n
// Δu_p' is the slip increment of the previous step, with which the cells' pressures were computed. For small increments
// the friction loss tends to <F_t> Δu_p. These losses follow from the forces alone, so the energy account is an
// independent check of them. The part of the friction loss that is due to cohesion above its residual value counts as
// fracture.
//
// A break is detected at the end of a step. By the trapezoidal rule, the forces that the face loses have then done half
// of their work in that step. This half, the sum of ½(F - F_left) Δδ over all forces that change, is counted as lag
// with a negative sign. Tested by tests/solver/faces/broken_face_test.cpp.
#pragma once

#include <algorithm>
#include <cmath>

#include "solver/world/faces.hpp"

namespace crackle {

/// Weights of a face in the two rows of its unknowns q_n and q_t, for each of its cells, m/√(N/m).
struct LagWeights {
    double normal_i, normal_j, shear_i, shear_j;

    explicit LagWeights(const FaceSprings& s) {
        const double normal = s.length / std::sqrt(s.normal);
        const double shear = s.shear > 0.0 ? s.length / std::sqrt(s.shear) : 0.0;
        normal_i = normal * std::abs(s.share_i), normal_j = normal * std::abs(s.share_j);
        shear_i = shear * std::abs(s.skew_i), shear_j = shear * std::abs(s.skew_j);
    }
};

/// Fractions by which a broken face approaches its pressure and its slip in one step. Let H = 1 + M be the matrix of
/// second derivatives of the energy with respect to all q_n and q_t, each scaled by √k. If each unknown moves by a
/// fraction w of its change, the energy decreases for 1/w >= (1 + Σ|M|)/2 in its row of M. The sum covers all faces of
/// the two cells, as if all of them were open.
inline FaceLag lag_of(const Faces& faces, FaceIndex k) {
    constexpr double margin = 0.9;
    const CellPressure &i = faces.cells[faces.bodies[k].body_i], &j = faces.cells[faces.bodies[k].body_j];
    const LagWeights w(faces.springs[k]);
    const double of_i = i.per_area * i.lag_weight, of_j = j.per_area * j.lag_weight;
    const auto share = [&](double row) { return std::min(1.0, margin * 2.0 / (1.0 + row)); };
    return {share(w.normal_i * of_i + w.normal_j * of_j), share(w.shear_i * of_i + w.shear_j * of_j)};
}

/// Half the lap of a broken face, m; the lap is the length over which its two edges lie opposite each other. On a rigid
/// body, which extends beyond its faces, the lap is always the whole face.
inline double half_lap_of(const FaceSprings& s, const BondFaceMotion& m) {
    if (s.at_rigid()) return 0.5 * s.length;
    return 0.5 * std::max(0.0, s.length - std::abs(m.sliding));
}

/// Forces and energies of a broken face in contact. @param pressure p̄, Pa @param held 1 - D @param taken 1 - q, the
/// share that contact points have taken over
inline BrokenContact contact_of(const FaceSprings& s, const BondFaceMotion& m, double pressure, double held,
                                double taken) {
    const double stiffness = s.normal / s.length, soft = s.length / s.normal;
    const double a = half_lap_of(s, m), d = m.opening + pressure * soft;
    BrokenContact contact{lap_pressure(stiffness, a, d, m.turn), 0.0, 0.0, 0.0, 0.0};
    LapPressure& lap = contact.lap;
    const double left = 1.0 - taken;
    if (held > 0.0) {
        const LapPressure pull = lap_tension(stiffness, a, d, m.turn);
        lap = {lap.force + held * pull.force, lap.moment + held * pull.moment, lap.energy + held * pull.energy,
               lap.closed + held * pull.closed};
        contact.pull = left * pull.energy;
    }
    contact.whole = lap.energy;
    lap = {left * lap.force, left * lap.moment, left * lap.energy, left * lap.closed};
    contact.stretch = (lap.force - s.length * pressure) / s.normal;
    contact.energy = lap.energy - soft * pressure * lap.force + 0.5 * soft * s.length * pressure * pressure;
    return contact;
}

/// The factor 1 - D on the tension of a broken face, after its motion in this step. @param held 1 - D before the step
/// @param pressure p̄, Pa
inline double held_after(const FaceSprings& s, const FaceLaw& law, double share, const BondFaceMotion& m,
                         double pressure, double held) {
    const double stiffness = s.normal / s.length, a = half_lap_of(s, m);
    if (held == 0.0 || a == 0.0) return 0.0;
    const double d = m.opening + pressure / stiffness;
    // The stress σ of the undamaged face is the sum of k d and 6β M/(2a)², where M = k (2a)³/12 δ_φ.
    const double stress = stiffness * (d + law.moment_share * a * std::abs(m.turn));
    return tension_held(law, held, stiffness, stress, share);
}

/// Mean of ½ k w² at the two ends of the lap, N. w is the overlap or opening there; for an opening, the term is
/// multiplied by 1 - D.
inline double end_closure(const FaceSprings& s, const BondFaceMotion& m, double pressure, double held, double taken) {
    const double a = half_lap_of(s, m), d = m.opening + pressure * s.length / s.normal;
    const auto square = [&](double w) { return (w < 0.0 ? 1.0 : held) * w * w; };
    return (1.0 - taken) * 0.25 * s.normal / s.length * (square(d - a * m.turn) + square(d + a * m.turn));
}

/// Updates the damage D of a broken face under tension, and computes its contact at the late pressure (faces.hpp).
inline BrokenContact late_contact(BrokenFace& face, const FaceSprings& s, const FaceLaw& law, double share,
                                  const BondFaceMotion& m) {
    const double before = face.held;
    face.held = held_after(s, law, share, m, face.last.pressure, before);
    BrokenContact contact = contact_of(s, m, face.last.pressure, face.held, face.taken);
    // The energy of a tension that ends in this step is needed for the fracture loss.
    if (face.held == 0.0 && before > 0.0) contact.pull = contact_of(s, m, face.last.pressure, before, face.taken).pull;
    return contact;
}

/// State of a broken face whose contact was computed at a given pressure. The caller adds the pressure itself and the
/// forces. @param pressure Pa @param skewing τ, Pa
inline BrokenState broken_state(const BrokenFace& face, const FaceSprings& s, const BondFaceMotion& m,
                                const BrokenContact& contact, double pressure, double skewing) {
    BrokenState state;
    state.opening = m.opening, state.sliding = m.sliding, state.turn = m.turn;
    state.half_lap = half_lap_of(s, m);
    state.skewing = skewing;
    state.stretch = contact.stretch;
    state.end_closure = end_closure(s, m, pressure, face.held, face.taken);
    state.taken = face.taken;
    state.whole = contact.whole;
    state.held = face.held;
    state.pull = contact.pull;
    return state;
}

/// Forces of a broken face after a step, and its energy losses in the step.
struct BrokenStep {
    FaceForces forces;
    FaceLosses losses;
    double closed;  // m, length over which the edges press
};

/// Updates a broken face at the end of a step. @param late result of late_contact() for this step @param pressure p̄,
/// Pa
/// @param skewing τ, Pa
inline BrokenStep step_broken(BrokenFace& face, const FaceSprings& s, const FaceLaw& law, double share,
                              const FaceLag& lag, const BondFaceMotion& m, const BrokenContact& late, double pressure,
                              double skewing) {
    const BrokenContact now = contact_of(s, m, pressure, face.held, face.taken);
    BrokenState& last = face.last;
    BrokenState state = broken_state(face, s, m, late, last.pressure, skewing);
    state.pressure = last.pressure + lag.pressure * (pressure - last.pressure);
    state.late_pressure = pressure - last.pressure;
    state.late_force = now.lap.force - late.lap.force;
    state.late_moment = now.lap.moment - late.lap.moment;
    if (face.in_shear) face.glued = std::min(face.glued, now.lap.closed);

    const double trial = s.shear * (m.sliding - face.slip) + s.length * skewing;
    FaceSlip slid = slip_of_face(law, trial, s.shear, std::max(0.0, -now.lap.force), face.glued, face.slipped, share);
    if (lag.slip < 1.0) {
        slid.slip *= lag.slip;
        slid.force = trial - s.shear * slid.slip;
    }
    state.slip = slid.slip;
    state.shear = slid.force;
    face.slip += slid.slip;
    face.slipped += std::abs(slid.slip);

    BrokenStep step;
    step.forces = {now.lap.force, slid.force, now.lap.moment};
    step.closed = now.lap.closed;
    const double rubbed =
        0.5 * ((last.shear + slid.force) * slid.slip + s.length * (last.skewing + skewing) * (last.slip - slid.slip));
    const double cut = slid.of_fracture * std::abs(slid.slip);
    step.losses.fracture = cut + 0.5 * (last.pull + late.pull) * (last.held - face.held);
    step.losses.friction = rubbed - cut + (last.end_closure + state.end_closure) * (last.half_lap - state.half_lap) +
                           0.5 * (last.whole + state.whole) * (state.taken - last.taken);
    const double opened = m.opening - last.opening, turned = m.turn - last.turn;
    step.losses.lag =
        0.5 * ((last.late_force + state.late_force) * opened + (last.late_moment + state.late_moment) * turned -
               s.length * (last.late_pressure + state.late_pressure) * (state.stretch - last.stretch));
    const double bent = m.sliding - face.slip;
    face.energy = late.energy + 0.5 * s.shear * bent * bent;
    last = state;
    return step;
}

/// State of a face after its break, and the pressures of its two cells after the break.
struct BreakResult {
    BrokenFace face;
    FaceForces forces;              // forces that remain after the break
    double pressure_i, pressure_j;  // Pa
    double energy;                  // J, released; never negative
};

// Largest number of iterations after a break, and the relative change below which the iteration has converged.
inline constexpr int most_rounds_of_break = 1000;
inline constexpr double settled_break = 1e-15;

/// Solves p̄ = before + by_normal (q_n(p̄) - δ_n) - slipped for the pressure p̄. The difference of the two sides is
/// convex in p̄, so Newton's method converges from any start. @param pressure the start, Pa
inline double balanced_pressure(const BrokenFace& face, const FaceSprings& s, const BondFaceMotion& m, double pressure,
                                double before, double by_normal, double slipped) {
    for (int round = 0; round < most_rounds_of_break; ++round) {
        const BrokenContact contact = contact_of(s, m, pressure, face.held, face.taken);
        const double rest = pressure - before - by_normal * (contact.stretch - m.opening) + slipped;
        const double slope = 1.0 + by_normal * (s.length - contact.lap.closed) / s.normal;
        pressure -= rest / slope;
        if (std::abs(rest) <= settled_break * (std::abs(pressure) + std::abs(before))) break;
    }
    return pressure;
}

/// Breaks an intact face. Two steps alternate, each of which reduces the energy. The first solves for the contact and
/// the pressures of the cells, the second for the slip if the shear force exceeds its limit. @param cell_i, cell_j
/// pressures of the cells while the face is intact @param taken 1 - q
inline BreakResult break_face(FaceIndex index, const FaceSprings& s, const FaceLaw& law, double share,
                              const BondFaceMotion& m, const CellPressure& cell_i, const CellPressure& cell_j,
                              bool in_shear, double taken = 0.0) {
    BreakResult result{{}, {}, cell_i.pressure, cell_j.pressure, 0.0};
    BrokenFace& face = result.face;
    face.face = index;
    face.in_shear = in_shear;
    face.taken = taken;
    // Change of a_i p_i + a_j p_j per unit of q_n or q_t, if A_i e_i changes by L b_i and A_j e_j by L b_j.
    // It is L (P_i a_i b_i + P_j a_j b_j), with P = per_area.
    const auto answer = [&](double a_i, double a_j, double b_i, double b_j) {
        return s.length * (cell_i.per_area * a_i * b_i + cell_j.per_area * a_j * b_j);
    };
    const double by_normal = answer(s.share_i, s.share_j, s.share_i, s.share_j),
                 by_shear = answer(s.share_i, s.share_j, s.skew_i, -s.skew_j),
                 of_skews = answer(s.skew_i, -s.skew_j, s.skew_i, -s.skew_j);
    const double before = s.share_i * cell_i.pressure + s.share_j * cell_j.pressure,
                 skewing_before = s.skew_i * cell_i.pressure - s.skew_j * cell_j.pressure;
    if (in_shear) face.held = held_after(s, law, share, m, before, 1.0);
    double pressure = before, skewing = skewing_before, slip = 0.0, shear = 0.0;
    BrokenContact contact{};
    for (int turn = 0; turn < most_rounds_of_break; ++turn) {
        pressure = balanced_pressure(face, s, m, pressure, before, by_normal, by_shear * slip);
        contact = contact_of(s, m, pressure, face.held, taken);
        skewing = skewing_before + by_shear * (contact.stretch - m.opening) - of_skews * slip;
        shear = s.shear * (m.sliding - slip) + s.length * skewing;
        face.glued = in_shear ? contact.lap.closed : 0.0;
        // After a failure in tension no shear force remains. The stiffness includes the response of the cells'
        // pressures to slip.
        const double stiffness = s.shear + s.length * of_skews;
        const double more = in_shear ? slip_of_face(law, shear, stiffness, std::max(0.0, -contact.lap.force),
                                                    face.glued, std::abs(slip), share)
                                           .slip
                                     : shear / stiffness;
        if (std::abs(more) <= settled_break * (std::abs(m.sliding) + std::abs(slip))) break;
        slip += more;
    }
    const double normal = s.length * (contact.stretch - m.opening), skewed = -s.length * slip;
    result.pressure_i += cell_i.per_area * (s.share_i * normal + s.skew_i * skewed);
    result.pressure_j += cell_j.per_area * (s.share_j * normal - s.skew_j * skewed);
    result.forces = {contact.lap.force, shear, contact.lap.moment};
    face.slip = slip;
    face.slipped = std::abs(slip);
    const double bent = m.sliding - face.slip;
    face.energy = contact.energy + 0.5 * s.shear * bent * bent;
    face.last = broken_state(face, s, m, contact, pressure, skewing);
    face.last.pressure = pressure;
    face.last.shear = shear;
    const auto in_cell = [](const CellPressure& cell, double p) {
        return cell.per_area > 0.0 ? 0.5 * p * p / cell.per_area : 0.0;
    };
    const double stored =
        0.5 * (s.normal * m.opening * m.opening + s.shear * m.sliding * m.sliding + s.moment() * m.turn * m.turn) +
        in_cell(cell_i, cell_i.pressure) + in_cell(cell_j, cell_j.pressure);
    result.energy = stored - face.energy - in_cell(cell_i, result.pressure_i) - in_cell(cell_j, result.pressure_j);
    return result;
}

}  // namespace crackle
