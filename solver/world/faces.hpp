// SPDX-License-Identifier: GPL-3.0-or-later
// The faces of a world of bonded polygons, as flat arrays: a rigid-body spring network (laws/face_bond.hpp). Each face
// has one set of springs (normal, shear, moment), and each cell one pressure.
//
// Motion of a face between cells i and j. q_i and q_j are the positions of the face's midpoint, as carried along by
// cell i and by cell j:
//     δ_n = (q_j - q_i)·n     δ_t = (q_j - q_i)·t     δ_φ = θ_j - θ_i
// n is the initial normal from i to j, rotated by ½(θ_i + θ_j), and t is n rotated by +90 degrees. Forces act midway
// between q_i and q_j: F_n n + F_t t and the moment +M on i, and the opposite on j. They are thus the gradient of an
// energy for any rotation.
//
// Dilation e_i and pressure p_i of a cell of area A_i. s_i, s_j are the shares and m_i, m_j the skews of a face
// (faces/bond_faces.hpp):
//     A_i e_i = Σ_intact L (s_i δ_n ± m_i δ_t) + Σ_broken L (s_i q_n ± m_i q_t) + Σ_side L h_b (-p_i)/E_c
//     p_i = λ e_i     p̄ = s_i p_i + s_j p_j     τ = m_i p_i - m_j p_j
//     F_n = k_n δ_n + L p̄     F_t = k_t δ_t + L τ     M = k_φ δ_φ
// The upper sign applies to cell i of a face, the lower one to cell j. The term of the free sides contains the unknown
// p_i. Solving for p_i therefore gives the divisor A_i + λ Σ L h_b/E_c.
//
// A broken face transmits the pressure of lap_pressure(), for the opening d = δ_n + p̄ L/k_n and the lap L - |δ_t|, and
// slides by u_p:
//     F_n = F(d, δ_φ)     q_n = (F_n - L p̄)/k_n     F_t = k_t (δ_t - u_p) + L τ     q_t = δ_t - u_p
// q_n and q_t are computed from the motion in this step, but with the slip of the previous step and a late pressure,
// which lags behind p̄. Closed faces have q_n = δ_n and therefore no lag. Open faces lose energy to the lag, which is
// recorded separately. In each step the late pressure approaches p̄, and u_p its limit, by the fractions in FaceLag. A
// fraction is 1 if the lag then decays, as in most Voronoi cells, and otherwise less. At fixed positions, each step
// thus reduces the energy.
//
// Strains are assumed to be small; displacements and rotations may be large. Source: solver/MODEL.md 5.5.
// Tested by tests/solver/faces/face_pass_test.cpp.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "solver/base/array.hpp"
#include "solver/base/fields.hpp"
#include "solver/laws/face_bond.hpp"
#include "solver/world/bodies.hpp"
#include "solver/world/points.hpp"

namespace crackle {

using FaceIndex = std::uint32_t;  // index into the arrays of Faces
inline constexpr FaceIndex no_face = 0xffffffff;

/// Records of doubles. Each member is stored as one column, so that a SIMD load reads it from several consecutive
/// records.
template <class Record>
struct FaceColumns {
    static_assert(std::is_trivially_copyable_v<Record>);
    static constexpr std::size_t width = sizeof(Record) / sizeof(double);
    using Row = std::array<double, width>;

    Array<double> numbers;  // one column after the other
    std::size_t count = 0;  // number of records

    /// Number of records, which is the length of each column.
    std::size_t size() const { return count; }
    /// Values of one member in all records. @param c index of the member within a record
    const double* column(std::size_t c) const { return numbers.data() + c * count; }
    /// Values of one member in all records, for changes.
    double* column(std::size_t c) { return numbers.data() + c * count; }
    /// A record.
    Record operator[](std::size_t k) const {
        Row row;
        for (std::size_t c = 0; c < width; ++c) row[c] = column(c)[k];
        return std::bit_cast<Record>(row);
    }
    /// Replaces a record.
    void set(std::size_t k, const Record& record) {
        const Row row = std::bit_cast<Row>(record);
        for (std::size_t c = 0; c < width; ++c) column(c)[k] = row[c];
    }
    /// Changes the number of records, and sets all members to 0.
    void assign(std::size_t records) {
        count = records;
        numbers.assign(width * records, 0.0);
    }

    CRACKLE_FIELDS(numbers, count);
};

/// Position of a face on its two bodies, in the body frames.
struct FacePlace {
    Vec2 normal_i, normal_j;  // unit vector from i to j at bonding
    Vec2 arm_i, arm_j;        // m, from the centroids to the face's midpoint
    double rest_turn;         // rad, difference of the bodies' angles at bonding
};

/// Springs of a face, and the weights with which its motion enters the dilations of its two cells.
struct FaceSprings {
    double normal, shear;     // k_n, k_t, N/m
    double length;            // L, m
    double share_i, share_j;  // s_i, s_j
    double skew_i, skew_j;    // m_i, m_j: offset of the midpoint along t from each reference point, divided by h

    /// Whether one of the two bodies is rigid (faces/bond_faces.hpp).
    bool at_rigid() const { return (share_i == 1.0 && share_j == 0.0) || (share_i == 0.0 && share_j == 1.0); }
    /// k_φ, N m/rad.
    double moment() const { return normal * length * length / 12.0; }
};

/// Motion of a face since it was bonded.
struct BondFaceMotion {
    Vec2 normal;                    // n
    double opening, sliding, turn;  // δ_n, δ_t, m; δ_φ, rad
};

/// Pressure of a cell, positive in tension.
struct CellPressure {
    double per_area = 0.0;    // λ/(A + λ Σ L h_b/E_c), Pa/m²
    double pressure = 0.0;    // p, Pa
    double rise = 0.0;        // Pa, change of p in this step, before faces broke
    double lag_weight = 0.0;  // m/√(N/m), sum of the LagWeights of its faces (faces/broken_face.hpp)

    CRACKLE_FIELDS(per_area, pressure, rise, lag_weight);
};

/// Coefficients of the dashpots of a face, or their forces. They resist normal, shear and rotational motion.
struct FaceDashpots {
    double normal = 0.0, shear = 0.0, moment = 0.0;  // N s/m and N m s, or N and N m
};

/// Fractions by which, in one step, a broken face's late pressure approaches p̄ and its slip approaches the limit.
struct FaceLag {
    double pressure = 1.0, slip = 1.0;
};

/// Motion and forces of a broken face in one step, from which the energy losses of the next step are computed.
struct BrokenState {
    double opening = 0.0, sliding = 0.0, turn = 0.0;  // δ_n, δ_t, m; δ_φ, rad
    double half_lap = 0.0;                            // a, m
    double pressure = 0.0;                            // Pa, late pressure for the next step
    double skewing = 0.0;                             // τ, Pa
    double stretch = 0.0;                             // q_n, m
    double shear = 0.0;                               // F_t, N
    double slip = 0.0;                                // increase of u_p in this step, m
    double late_pressure = 0.0;                       // p̄ minus the late pressure, Pa
    double late_force = 0.0, late_moment = 0.0;       // N, N m: F_n and M minus their values at the late pressure
    double end_closure = 0.0;  // N, mean of ½ k w² at the ends of the lap, where w is the overlap
    double held = 0.0;         // 1 - D
    double pull = 0.0;         // J, energy that the tension would have without damage
    double taken = 0.0;        // 1 - q, the share that contact points have taken over
    double whole = 0.0;        // J, Ψ at the late pressure, not multiplied by q

    CRACKLE_FIELDS(opening, sliding, turn, half_lap, pressure, skewing, stretch, shear, slip, late_pressure, late_force,
                   late_moment, end_closure, held, pull, taken, whole);
};

/// State of a broken face that persists from step to step.
struct BrokenFace {
    FaceIndex face = no_face;
    bool in_shear = false;      // how it failed
    bool closed_joint = false;  // whether the linear solution counts the face as intact (Bonding::pressed)
    bool alone = true;          // whether the neighbour list omits the points between its bodies (faces/hand_over.hpp)
    bool retired = false;  // whether contact points have replaced it for good, unless its edges part (hand_over.hpp)
    double slip = 0.0;     // u_p, m
    double slipped = 0.0;  // Σ|Δu_p|, m
    double glued = 0.0;    // b_c, m: smallest closed length since failure in shear; 0 after failure in tension
    double held = 0.0;     // 1 - D, remaining share of an intact face's tension
    double energy = 0.0;   // J, stored in the face
    double taken = 0.0;    // 1 - q, the share that contact points have taken over (faces/hand_over.hpp)
    BrokenState last;      // state in the last force pass

    CRACKLE_FIELDS(face, in_shear, closed_joint, alone, retired, slip, slipped, glued, held, energy, taken, last);
};

/// Pressure, energies and opening where the two edges of a broken face touch, for a given pressure p̄ of its cells.
/// q is the weight of the face, and 1 - q the weight of the contact points that replace it (faces/hand_over.hpp).
struct BrokenContact {
    LapPressure lap;
    double stretch;  // q_n, m
    double energy;   // J, stored energy, without the energy of the shear spring
    double pull;     // J, energy that the tension would have without damage
    double whole;    // J, Ψ not multiplied by q

    CRACKLE_FIELDS(lap, stretch, energy, pull, whole);
};

/// Energy lost in a step, J.
struct FaceLosses {
    double friction = 0.0, fracture = 0.0, lag = 0.0, dashpot = 0.0;

    /// Adds losses of other faces.
    void add(const FaceLosses& other) {
        friction += other.friction;
        fracture += other.fracture;
        lag += other.lag;
        dashpot += other.dashpot;
    }

    CRACKLE_FIELDS(friction, fracture, lag, dashpot);
};

/// The contact points between the two bodies of a face, which gradually replace the face after it has broken.
struct HandOver {
    FaceIndex face;
    PointIndex begin, end;  // range of points

    CRACKLE_FIELDS(face, begin, end);
};

/// All faces of a world.
struct Faces {
    Array<BodyPair> bodies;
    FaceColumns<FacePlace> place;
    FaceColumns<FaceSprings> springs;
    Array<std::uint16_t> law;      // index into `laws`
    Array<double> strength_share;  // random factor on T and C
    Array<FaceIndex> broken_at;    // index into `broken`; no_face while intact
    std::vector<FaceLaw> laws;
    /// Faces of each body. Those of body b begin at index first_face[b] of face_ends, in ascending order. An entry is
    /// twice the index of the face, plus 1 if b is its body j.
    Array<std::uint32_t> first_face, face_ends;
    Array<CellPressure> cells;  // by body
    bool has_pressure = false;  // whether any cell has a pressure
    std::vector<BrokenFace> broken;
    std::vector<HandOver> hand_over;
    // For each point: the stiffness_share that it has once points have replaced the face entirely (q = 0, with q the
    // weight of the face as in faces/hand_over.hpp). Empty if no points replace faces.
    Array<float> whole_share;

    // 1/s² and 1/s: upper bounds on the eigenvalues of M^-½KM^-½ and M^-½CM^-½, computed as if all faces were intact.
    double stiffness_bound = 0.0, damping_bound = 0.0;
    FaceColumns<FaceDashpots> dashpots,
        dashpot_force;  // coefficients, and forces in the last force pass; both empty without damping
    // J, energy lost because late pressures determine q_n, and because breaks are detected at the end of a step.
    double lag_loss = 0.0;

    // The following members are results of the last force pass.
    FaceColumns<BondFaceMotion> motion;
    // Contribution of each face to area times dilation, A e, of its two cells, m²; empty if cells have no pressure.
    Array<double> dilation_i, dilation_j;
    Array<PointForce> force;    // for each face: force on body i, and torques on both bodies
    Array<BrokenContact> late;  // for each broken face: contact at its late pressure
    Array<FaceLosses> losses;   // for each block of faces

    /// Number of faces.
    std::size_t size() const { return bodies.size(); }
    /// Whether faces have dashpots.
    bool damped() const { return dashpots.size() > 0; }
    /// The law of a face.
    const FaceLaw& law_of(FaceIndex k) const { return laws[law[k]]; }
    /// The pressure p̄ = s_i p_i + s_j p_j at a face, Pa.
    double pressure_at(FaceIndex k) const {
        const FaceSprings s = springs[k];
        return s.share_i * cells[bodies[k].body_i].pressure + s.share_j * cells[bodies[k].body_j].pressure;
    }
    /// The shear stress τ = m_i p_i - m_j p_j at a face, Pa.
    double skewing_at(FaceIndex k) const {
        const FaceSprings s = springs[k];
        return s.skew_i * cells[bodies[k].body_i].pressure - s.skew_j * cells[bodies[k].body_j].pressure;
    }

    CRACKLE_FIELDS(bodies, place, springs, law, strength_share, broken_at, laws, first_face, face_ends, cells,
                   has_pressure, broken, hand_over, whole_share, stiffness_bound, damping_bound, dashpots,
                   dashpot_force, lag_loss, motion, dilation_i, dilation_j, force, late, losses);
};

}  // namespace crackle
