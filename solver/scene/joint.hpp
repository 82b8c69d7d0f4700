// SPDX-License-Identifier: GPL-3.0-or-later
// A joint's mechanics: what the faces on its traces do where they are not as the rock around them.
//
//     1/k_n = 1/k_n,face + 1/(K_n L),   1/k_s = 1/k_s,face + 1/(K_s L)       L length of the face, K stiffness a length
//
// so that K -> infinity with full strength is the intact face. Strengths and friction stand in place of the rock's.
// Under BondLaw::coulomb in StiffnessUnits::area. Polygons have faces on traces; circles get flat ones
// (geometry/flat_faces.hpp), whose stiffness is that of a face as long as they lap. Source: solver/MODEL.md 5.3, 5.4.
// Tested by tests/solver/contact/joint_law_test.cpp.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "solver/base/vec2.hpp"

namespace crackle {

struct Joint {
    bool bonded = true;            ///< else open: its faces push, rub and slide from the start
    double strength_factor = 1.0;  ///< >= 0, of the rock's tensile strength and cohesion, where these are not given:
    std::optional<double> tensile_strength;         ///< Pa, >= 0; at 0 a bond breaks as soon as it is pulled
    std::optional<double> cohesion;                 ///< Pa, >= 0
    std::optional<double> friction_angle;           ///< degrees, 0 <= φ < 90, of the bonds' envelope
    std::optional<double> residual_friction_angle;  ///< degrees, without a bond; φ where that is given
    std::optional<double> normal_stiffness;         ///< K_n, Pa/m, > 0
    std::optional<double> shear_stiffness;          ///< K_s, Pa/m, > 0
    /// Degrees ψ, at most the residual friction angle: a contact without a bond that slides opens by tan ψ of its slip,
    double dilation_angle = 0.0;
    double dilation_slip = std::numeric_limits<double>::infinity();  ///< m, > 0: until it has slid so far in all
    double aperture = 0.0;  ///< m, >= 0, of an open one: gap before its faces touch

    friend bool operator==(const Joint&, const Joint&) = default;

    bool has_stiffness() const { return normal_stiffness || shear_stiffness; }

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("bonded", s.bonded);
        visit("strength_factor", s.strength_factor);
        visit("tensile_strength", s.tensile_strength);
        visit("cohesion", s.cohesion);
        visit("friction_angle", s.friction_angle);
        visit("residual_friction_angle", s.residual_friction_angle);
        visit("normal_stiffness", s.normal_stiffness);
        visit("shear_stiffness", s.shear_stiffness);
        visit("dilation_angle", s.dilation_angle);
        visit("dilation_slip", s.dilation_slip);
        visit("aperture", s.aperture);
    }
};

/// Number of a side of a trace: twice the trace's, one more for what lies to the right of it (seen along its points).
/// Faces that have each other's number but for that are the two sides of one trace.
using TraceSide = std::int32_t;
inline constexpr TraceSide no_side = -1;
constexpr TraceSide across(TraceSide side) { return side ^ 1; }
constexpr std::int32_t trace_of(TraceSide side) { return side / 2; }

/// A straight part of a trace among circles. Parts of a bent one follow each other, each from where the last one ends.
struct TracePiece {
    std::int32_t trace = 0;
    Vec2 from, to;  // m
    /// Whether the trace leaves the specimen there: circles in front of what would follow lie on its sides, too.
    bool from_outside = false, to_outside = false;
};

}  // namespace crackle
