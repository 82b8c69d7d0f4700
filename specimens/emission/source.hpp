// SPDX-License-Identifier: GPL-3.0-or-later
// Size of a seismic source, and its type (opening, shear or closing), from the moment tensor:
//     M0 = sqrt((m1² + m2²)/2)        m1 >= m2 the principal moments, N m
//     Mw = 2/3 log10 M0 - 6           (Hanks & Kanamori, J. Geophys. Res. 84, 1979)
//     Me = 2/3 log10 E - 3.2          E in J (Choy & Boatwright, J. Geophys. Res. 100, 1995)
//     R  = 100 tr M/(|tr M| + |m1*| + |m2*|)    m* the deviator in two dimensions, m - tr M/2
// R is 100 for uniform opening, 50 for opening in one direction, 0 for shear, and negative for closing. A source with R
// above 30 opens, below -30 it closes (Feignier & Young, Geophys. Res. Lett. 19, 1992, with the deviator in three
// dimensions).
// Tested by tests/specimens/emission/source_test.cpp.
#pragma once

#include "solver/base/fields.hpp"
#include "solver/base/names.hpp"
#include "solver/base/vec2.hpp"

namespace crackle {

/// Moment tensor Σ f_i r_j, N m. Here f is a force on the surroundings of the source, and r is its position relative to
/// the centre. Outward forces give positive moments.
struct MomentTensor {
    double xx = 0.0, xy = 0.0, yx = 0.0, yy = 0.0;

    /// Adds the moment of a force. @param force  N  @param arm  m
    void add(Vec2 force, Vec2 arm) {
        xx += force.x * arm.x;
        xy += force.x * arm.y;
        yx += force.y * arm.x;
        yy += force.y * arm.y;
    }

    CRACKLE_FIELDS(xx, xy, yx, yy);
};

/// Principal moments of the symmetric part; the antisymmetric part is a torque.
struct PrincipalMoments {
    double largest, smallest;  // N m
    double direction;          // direction of the axis of the largest moment, rad, in (-π/2, π/2]
};
/// Principal moments of a moment tensor.
PrincipalMoments principal_moments(const MomentTensor& moment);

double scalar_moment(const MomentTensor& moment);      ///< M0, N m
double isotropic_percent(const MomentTensor& moment);  ///< R, from -100 to 100; NaN for a zero moment

/// Type of a source.
enum class SourceType { opening, shear, closing };
constexpr auto list_names(SourceType) { return in_order("opening", "shear", "closing"); }
/// Type of a source from its isotropic part. @param isotropic_percent  R, from -100 to 100
SourceType source_type(double isotropic_percent);

/// Moment magnitude; -infinity for a zero moment. @param scalar_moment  M0, N m
double moment_magnitude(double scalar_moment);
/// Energy magnitude; -infinity for zero energy. @param energy  J
double energy_magnitude(double energy);

}  // namespace crackle
