// SPDX-License-Identifier: GPL-3.0-or-later
// What a moment tensor says of its source: how large, and whether it opened, slid or closed.
//   M0 = sqrt((m1² + m2²)/2)        m1 >= m2 the principal moments, N m
//   Mw = 2/3 log10 M0 - 6           (Hanks & Kanamori, J. Geophys. Res. 84, 1979)
//   Me = 2/3 log10 E - 3.2          E in J (Choy & Boatwright, J. Geophys. Res. 100, 1995)
//   R  = 100 tr M/(|tr M| + |m1*| + |m2*|)    m* the deviator in two dimensions, m - tr M/2
// R is 100 of an all-round opening, 50 of one along a line, 0 of a shear, and negative of what closes; above 30 a
// source opens, below -30 it closes (Feignier & Young, Geophys. Res. Lett. 19, 1992, where the deviator is that of
// three dimensions). Tested by tests/specimens/emission/source_test.cpp.
#pragma once

#include "solver/base/vec2.hpp"

namespace crackle {

/// Σ f_i r_j, N m: f forces on what surrounds the source, r their arms; positive pushes outwards.
struct MomentTensor {
    double xx = 0.0, xy = 0.0, yx = 0.0, yy = 0.0;

    void add(Vec2 force, Vec2 arm) {
        xx += force.x * arm.x;
        xy += force.x * arm.y;
        yx += force.y * arm.x;
        yy += force.y * arm.y;
    }

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("xx", s.xx);
        visit("xy", s.xy);
        visit("yx", s.yx);
        visit("yy", s.yy);
    }
};

/// Of the symmetric part; what is left over is a torque.
struct PrincipalMoments {
    double largest, smallest;  // N m
    double direction;          // rad, of the largest, in (-π/2, π/2]
};
PrincipalMoments principal_moments(const MomentTensor& moment);

double scalar_moment(const MomentTensor& moment);      ///< M0, N m
double isotropic_percent(const MomentTensor& moment);  ///< R, from -100 to 100; not a number of no moment

enum class SourceType { opening, shear, closing };
SourceType source_type(double isotropic_percent);
const char* name_of(SourceType type);

/// -infinity of none. @param scalar_moment N m
double moment_magnitude(double scalar_moment);
/// -infinity of none. @param energy J
double energy_magnitude(double energy);

}  // namespace crackle
