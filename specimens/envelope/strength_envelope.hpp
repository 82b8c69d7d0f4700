// SPDX-License-Identifier: GPL-3.0-or-later
// The strength of a rock over its confinement, by two laws, from tests of several packings.
//
//   Mohr-Coulomb       σ1 = C + N σ3,  sin φ = (N - 1)/(N + 1),  c = C/(2 sqrt N)
//   Hoek-Brown, intact σ1 = σ3 + sqrt(m C σ3 + C²)      (Hoek & Brown, Int. J. Rock Mech. Min. Sci. 116, 2019; a = ½, s
//   = 1)
//
// Both by least squares in σ1. Packings scatter by a share of their strength, the same at every confinement (the pooled
// coefficient of variation), so a test weighs 1/(mean strength at its confinement)². Hoek-Brown begins at the line of
// (σ1 - σ3)² over σ3, slope m C and intercept C². Intervals: 10,000 fits to as many packings drawn with replacement, a
// packing with all its tests; percentiles at the levels that are as wide as Student's t (statistics/mean.hpp). Of fewer
// than eight packings, whose draws cannot leave their range: Student's t with the standard error of the jackknife, fits
// that leave out a packing each. Two packings say little, and their intervals are as wide as that.
// Stresses in one unit, N/m or Pa, compression positive.
// Tested by tests/specimens/envelope/strength_envelope_test.cpp.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace crackle {

/// Strength of one test.
struct StrengthPoint {
    std::string packing;                       ///< name of the packing; tests of one are drawn together
    double confinement = 0.0, strength = 0.0;  // σ3, σ1
};

struct FittedNumber {
    double value = std::numeric_limits<double>::quiet_NaN();
    double low = std::numeric_limits<double>::quiet_NaN();  ///< of the 95 % interval
    double high = std::numeric_limits<double>::quiet_NaN();
};

struct StrengthAt {
    double confinement = 0.0;
    std::size_t tests = 0;
    double mean = 0.0;
    double deviation = std::numeric_limits<double>::quiet_NaN();  ///< sample standard deviation; not of one test
    double low = std::numeric_limits<double>::quiet_NaN();        ///< of the mean's 95 % interval (mean_of()); likewise
    double high = std::numeric_limits<double>::quiet_NaN();
};

/// Stresses on the plane of failure, compression positive.
struct PlaneStress {
    double normal = 0.0, shear = 0.0;
};

struct StrengthEnvelope {
    std::size_t packings = 0;
    std::vector<StrengthAt> strengths;                       ///< by confinement
    double variation = 0.0;                                  ///< pooled coefficient of variation of the packings
    FittedNumber strength, slope, friction_angle, cohesion;  ///< Mohr-Coulomb: C, N, φ in degrees, c
    double misfit = 0.0;  ///< root of the mean square of what is left, over the mean strengths
    FittedNumber hoek_brown_strength, hoek_brown_m;  ///< C, m
    double hoek_brown_misfit = 0.0;

    double mohr_coulomb(double confinement) const { return strength.value + slope.value * confinement; }
    double hoek_brown(double confinement) const;

    /// Strengths under tension: the confinement, below 0, at which the law has σ1 = 0. Of Hoek-Brown
    /// C (m - sqrt(m² + 4))/2; that of Mohr-Coulomb, -C/N, is not meant to hold.
    double mohr_coulomb_tension() const { return -strength.value / slope.value; }
    double hoek_brown_tension() const;

    /// The envelope of the law's Mohr circles, at the circle whose σ1 - σ3 this is (Balmer, Proc. ASTM 52, 1952):
    ///   σn = σ3 + (σ1 - σ3)/(1 + k),  τ = (σ1 - σ3) sqrt(k)/(1 + k),  k = dσ1/dσ3
    /// with σ3 = ((σ1 - σ3)² - C²)/(m C), k = 1 + m C/(2 (σ1 - σ3)). It begins at σn = -C/m, τ = 0. Mohr-Coulomb, whose
    /// k = N everywhere, is τ = c + σn tan φ. @param deviator σ1 - σ3, >= 0
    PlaneStress hoek_brown_on_plane(double deviator) const;
    double mohr_coulomb_on_plane(double normal) const;
};

/// Both laws of one packing's tests.
struct FittedLaws {
    double strength = 0.0, slope = 0.0, friction_angle = 0.0, cohesion = 0.0;  // as of StrengthEnvelope
    double hoek_brown_strength = 0.0, hoek_brown_m = 0.0;
};
/// Each test weighs 1/strength²; numbers of packings scatter about those of their means. @param tests of one packing
/// @throws InputError of fewer than three confinements
FittedLaws fit_laws(std::span<const StrengthPoint> tests);

inline constexpr std::size_t fewest_confinements = 3, fewest_packings = 2;

/// @throws InputError of fewer than three confinements or two packings, naming what there is
StrengthEnvelope fit_envelope(std::span<const StrengthPoint> tests);

}  // namespace crackle
