// SPDX-License-Identifier: GPL-3.0-or-later
// Mechanical properties of a joint, by which the faces on its traces differ from the surrounding rock.
//
//     1/k_n = 1/k_n,face + 1/(K_n L),   1/k_s = 1/k_s,face + 1/(K_s L)       L length of the face, K stiffness per unit
//     length
//
// so that K -> infinity with full strength gives an intact face. The joint's strengths and friction replace those of
// the rock. Joints require a bond law with BondLawFacts::across_joints, and StiffnessUnits::area. Polygons have edges
// on the traces; circles get flat faces (geometry/flat_faces.hpp), with the stiffness of a face as long as their lap
// (the length that two faces share).
// Source: solver/MODEL.md 5.3, 5.4. Tested by tests/solver/contact/joint_law_test.cpp.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "solver/base/fields.hpp"
#include "solver/base/vec2.hpp"

namespace crackle {

/// Mechanical properties of a joint.
struct Joint {
    bool bonded = true;  ///< whether the joint's faces are bonded; if not, they only push and slide with friction
    /// Factor >= 0 on the rock's tensile strength or cohesion, used if the joint's own value is not given.
    double strength_factor = 1.0;
    std::optional<double> tensile_strength;  ///< Pa, >= 0; with 0, a bond breaks under the slightest tension
    std::optional<double> cohesion;          ///< Pa, >= 0
    std::optional<double> friction_angle;    ///< degrees, 0 <= φ < 90; friction angle of the bonds' failure envelope
    /// Friction angle of unbonded contacts, degrees; if not given, it is friction_angle, or the rock's value if that is
    /// not given either.
    std::optional<double> residual_friction_angle;
    std::optional<double> normal_stiffness;  ///< K_n, Pa/m, > 0
    std::optional<double> shear_stiffness;   ///< K_s, Pa/m, > 0
    /// Dilation angle ψ, degrees, at most the residual friction angle: an unbonded contact opens by tan ψ times its
    /// slip.
    double dilation_angle = 0.0;
    double dilation_slip =
        std::numeric_limits<double>::infinity();  ///< m, > 0; accumulated slip at which dilation ends
    double aperture = 0.0;                    ///< m, >= 0; open joints only: gap that must close before the faces touch
    std::optional<double> residual_cohesion;  ///< Pa, >= 0, cohesion of faces after a failure in shear; if not given,
                                              ///< the rock's value, but at most the joint's cohesion
    std::optional<double> softening_slip;     ///< m, >= 0, slip over which the cohesion falls to residual_cohesion

    friend bool operator==(const Joint&, const Joint&) = default;

    /// Whether the joint has a stiffness of its own.
    bool has_stiffness() const { return normal_stiffness || shear_stiffness; }

    CRACKLE_FIELDS(bonded, strength_factor, tensile_strength, cohesion, friction_angle, residual_friction_angle,
                   normal_stiffness, shear_stiffness, dilation_angle, dilation_slip, aperture, residual_cohesion,
                   softening_slip);
};

/// One side of a trace, encoded as twice the index of the trace, plus one for the right side (as seen along its
/// points). Two sides belong to the same trace if their numbers differ only in the last bit.
using TraceSide = std::int32_t;
inline constexpr TraceSide no_side = -1;
/// The opposite side of a trace.
constexpr TraceSide across(TraceSide side) { return side ^ 1; }
/// Index of the trace to which a side belongs.
constexpr std::int32_t trace_of(TraceSide side) { return side / 2; }

/// A straight part of a trace in an assembly of circles. Consecutive parts of a bent trace share their end points.
struct TracePiece {
    std::int32_t trace = 0;
    Vec2 from, to;  // m
    /// Whether the trace leaves the specimen at this end. If so, circles beside its straight extension also belong to
    /// its sides.
    bool from_outside = false, to_outside = false;
};

}  // namespace crackle
