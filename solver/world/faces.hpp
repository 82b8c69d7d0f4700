// SPDX-License-Identifier: GPL-3.0-or-later
// The faces of a world of bonded polygons, as flat arrays: a rigid-body spring network (laws/face_bond.hpp). Each face
// has one set of springs (normal, shear, moment), and each cell one pressure.
//
// Motion of a face between cells i and j, whose images of its midpoint are q_i and q_j:
//     δ_n = (q_j - q_i)·n     δ_t = (q_j - q_i)·t     δ_φ = θ_j - θ_i
// with n from i to j, turned by ½(θ_i + θ_j), and t the normal turned by +90 degrees. Forces act midway between q_i and
// q_j, on i: F_n n + F_t t and +M; on j the opposite. They are thus the gradient of an energy for any rotation.
//
// Dilation and pressure of a cell, s_i, s_j the shares and m_i, m_j the skews of a face (find_faces.hpp,
// bond_faces.cpp):
//     A_i e_i = Σ_intact L (s_i δ_n ± m_i δ_t) + Σ_broken L (s_i q_n ± m_i q_t) + Σ_side L h_b (-p_i)/E_c
//     p_i = λ e_i     p̄ = s_i p_i + s_j p_j     τ = m_i p_i - m_j p_j
//     F_n = k_n δ_n + L p̄     F_t = k_t δ_t + L τ     M = k_φ δ_φ
// The upper sign is that of cell i. The sides' own pressure is implicit, so that A_i + λ Σ L h_b/E_c divides.
//
// A broken face presses by lap_pressure(), with d = δ_n + p̄ L/k_n and the lap L - |δ_t|, and slides:
//     F_n = F(d, δ_φ)     q_n = (F_n - L p̄)/k_n     F_t = k_t (δ_t - u_p) + L τ     q_t = δ_t - u_p
// q_n and q_t take this step's motion, but a late pressure and the slip of the step before. Closed faces have q_n =
// δ_n, and no lag; open ones lose energy to it, which has an account of its own. In each step the late pressure
// approaches p̄ by a share of FaceLag, and u_p its limit by another. The shares are 1 where the lag then decays, as in
// most Voronoi cells, and less elsewhere. Each step is then a descent of the energy at fixed positions.
//
// Only strains are small: displacements and rotations may be large. Source: solver/MODEL.md 5.5.
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

/// Records of doubles, stored column by column, so that lanes load a member of consecutive records at once.
template <class Record>
struct FaceColumns {
    static_assert(std::is_trivially_copyable_v<Record>);
    static constexpr std::size_t width = sizeof(Record) / sizeof(double);
    using Row = std::array<double, width>;

    Array<double> numbers;  // one column after the other
    std::size_t count = 0;  // records

    /// Number of records.
    std::size_t size() const { return count; }
    /// A member of all records. @param c its place in the record
    const double* column(std::size_t c) const { return numbers.data() + c * count; }
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
    /// Makes room for `records` records, all of zeros.
    void assign(std::size_t records) {
        count = records;
        numbers.assign(width * records, 0.0);
    }

    CRACKLE_FIELDS(numbers, count);
};

/// Where a face is on its two bodies, in their frames.
struct FacePlace {
    Vec2 normal_i, normal_j;  // unit vector from i to j when bonded
    Vec2 arm_i, arm_j;        // m, from the centroids to the face's midpoint
    double rest_turn;         // rad, difference of the bodies' angles when bonded
};

/// Springs of a face and its part in the dilation of its two cells.
struct FaceSprings {
    double normal, shear;     // k_n, k_t, N/m
    double length;            // L, m
    double share_i, share_j;  // s_i, s_j
    double skew_i, skew_j;    // m_i, m_j: offsets of the midpoint along t over the distance of the reference points

    /// Whether one of the bodies is rigid (faces/bond_faces.hpp).
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
    double per_area = 0.0;  // λ/(A + λ Σ L h_b/E_c), Pa/m²
    double pressure = 0.0;  // p, Pa
    double rise = 0.0;      // Pa, p less that of the step before, before faces broke in this step

    CRACKLE_FIELDS(per_area, pressure, rise);
};

/// Dashpots of a face along its normal and tangent and against its turn: coefficients, or forces.
struct FaceDashpots {
    double normal = 0.0, shear = 0.0, moment = 0.0;  // N s/m and N m s, or N and N m
};

/// Shares by which a broken face catches up with its cells in one step.
struct FaceLag {
    double pressure = 1.0, slip = 1.0;

    CRACKLE_FIELDS(pressure, slip);
};

/// Motion and forces of a broken face, as its energy account needs them from one step to the next.
struct BrokenState {
    double opening = 0.0, sliding = 0.0, turn = 0.0;  // δ_n, δ_t, m; δ_φ, rad
    double half_lap = 0.0;                            // a, m
    double pressure = 0.0;                            // Pa, late pressure of the next step
    double skewing = 0.0;                             // τ, Pa
    double stretch = 0.0;                             // q_n, m
    double shear = 0.0;                               // F_t, N
    double slip = 0.0;                                // u_p of this step less that of the step before, m
    double late_pressure = 0.0;                       // p̄ less the late pressure, Pa
    double late_force = 0.0, late_moment = 0.0;       // F_n and M, less those at the late pressure
    double end_closure = 0.0;                         // N, ½ k w² at the ends of the lap, w the overlap there
    double held = 0.0;                                // 1 - D
    double pull = 0.0;                                // J, energy of an undamaged tension
    double taken = 0.0;                               // 1 - q, which contact points have
    double whole = 0.0;                               // J, Ψ at the late pressure as if q were 1

    CRACKLE_FIELDS(opening, sliding, turn, half_lap, pressure, skewing, stretch, shear, slip, late_pressure, late_force,
                   late_moment, end_closure, held, pull, taken, whole);
};

/// What a broken face remembers.
struct BrokenFace {
    FaceIndex face = no_face;
    bool in_shear = false;  // how it failed
    bool alone = true;      // whether the neighbour list leaves out the points between its bodies (faces/hand_over.hpp)
    double slip = 0.0;      // u_p, m
    double slipped = 0.0;   // Σ|Δu_p|, m
    double glued = 0.0;     // b_c, m: least closed length since a failure in shear
    double held = 0.0;      // 1 - D, share of an intact face's tension that it can carry
    double energy = 0.0;    // J, stored in the face
    double taken = 0.0;     // share that the contact points between its bodies have taken over (faces/hand_over.hpp)
    BrokenState last;       // of the last force pass

    CRACKLE_FIELDS(face, in_shear, alone, slip, slipped, glued, held, energy, taken, last);
};

/// Pressure of a broken face's edges at a given pressure of its cells.
struct BrokenContact {
    LapPressure lap;
    double stretch;  // q_n, m
    double energy;   // J, without shear
    double pull;     // J, that of an undamaged tension
    double whole;    // J, Ψ as if no contact points had taken over

    CRACKLE_FIELDS(lap, stretch, energy, pull, whole);
};

/// Energy lost in a step, J.
struct FaceLosses {
    double friction = 0.0, fracture = 0.0, lag = 0.0, dashpot = 0.0;

    void add(const FaceLosses& other) {
        friction += other.friction;
        fracture += other.fracture;
        lag += other.lag;
        dashpot += other.dashpot;
    }

    CRACKLE_FIELDS(friction, fracture, lag, dashpot);
};

/// The contact points between the two bodies of a face, which take over from it when it is broken.
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
    Array<FaceLag> lag;
    Array<FaceIndex> broken_at;  // index into `broken`; no_face while intact
    std::vector<FaceLaw> laws;
    /// Faces of each body: from first_face[b] on, in ascending order, each as twice its index, plus 1 if the body is j.
    Array<std::uint32_t> first_face, face_ends;
    Array<CellPressure> cells;  // by body
    bool has_pressure = false;  // whether any cell has a pressure
    std::vector<BrokenFace> broken;
    std::vector<HandOver> hand_over;
    Array<float> whole_share;  // by point, its stiffness_share if it had all; empty if no face hands over
    double stiffness_bound = 0.0, damping_bound = 0.0;  // 1/s² and 1/s, at least the largest eigenvalues of M^-½KM^-½
                                                        // and M^-½CM^-½, of all faces as if none were broken
    FaceColumns<FaceDashpots> dashpots,
        dashpot_force;      // coefficients, and forces of the last pass; empty without damping
    double lag_loss = 0.0;  // J, lost because q_n takes the pressures of the step before, and breaks are found late

    // The rest is what the last force pass found.
    FaceColumns<BondFaceMotion> motion;
    Array<double> dilation_i, dilation_j;  // m², of both cells by each face; empty without a pressure
    Array<PointForce> force;               // on body i, and torques on both
    Array<BrokenContact> late;             // for each broken face, at its late pressure
    Array<FaceLosses> losses;              // of each block of faces

    /// Number of faces.
    std::size_t size() const { return bodies.size(); }
    /// Whether faces have dashpots.
    bool damped() const { return dashpots.size() > 0; }
    /// The law of a face.
    const FaceLaw& law_of(FaceIndex k) const { return laws[law[k]]; }
    /// p̄ of a face, Pa.
    double pressure_at(FaceIndex k) const {
        const FaceSprings s = springs[k];
        return s.share_i * cells[bodies[k].body_i].pressure + s.share_j * cells[bodies[k].body_j].pressure;
    }
    /// τ of a face, Pa.
    double skewing_at(FaceIndex k) const {
        const FaceSprings s = springs[k];
        return s.skew_i * cells[bodies[k].body_i].pressure - s.skew_j * cells[bodies[k].body_j].pressure;
    }

    CRACKLE_FIELDS(bodies, place, springs, law, strength_share, lag, broken_at, laws, first_face, face_ends, cells,
                   has_pressure, broken, hand_over, whole_share, stiffness_bound, damping_bound, dashpots,
                   dashpot_force, lag_loss, motion, dilation_i, dilation_j, force, late, losses);
};

}  // namespace crackle
