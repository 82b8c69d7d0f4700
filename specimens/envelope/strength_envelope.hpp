// SPDX-License-Identifier: GPL-3.0-or-later
// The strength of a rock as a function of confinement, by two laws fitted to tests of several packings.
//
//   Mohr-Coulomb       σ1 = C + N σ3,  sin φ = (N - 1)/(N + 1),  c = C/(2 sqrt N)
//   Hoek-Brown, intact σ1 = σ3 + sqrt(m C σ3 + C²)      (a = ½, s = 1)
// Hoek & Brown, Int. J. Rock Mech. Min. Sci. 116, 2019.
//
// Both are fitted by least squares in σ1. The scatter between packings is assumed to be proportional to the strength,
// with the same coefficient of variation at every confinement (pooled). The weight of a test is therefore 1/(mean
// strength at its confinement)². The Hoek-Brown fit starts from the straight line of (σ1 - σ3)² against σ3, with slope
// m C and intercept C². Intervals come from 10,000 bootstrap fits. Each uses a sample of packings of the original size,
// drawn with replacement and with all their tests. The percentiles are chosen so that the interval is as wide as one
// from Student's t (statistics/mean.hpp). Bootstrap samples cannot leave the range of the packings. For fewer than
// eight packings, intervals therefore come from Student's t and the jackknife (fits that each leave out one packing).
// With only two packings, they are wide.
// All stresses have one unit, N/m or Pa, compression positive.
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
    std::string packing;                       ///< name of the packing; tests of one packing are resampled together
    double confinement = 0.0, strength = 0.0;  // σ3, σ1
};

/// A fitted number with its 95 % interval. Strengths are in the unit of the tests' stresses.
struct FittedNumber {
    double value = std::numeric_limits<double>::quiet_NaN();
    double low = std::numeric_limits<double>::quiet_NaN();  ///< lower end of the interval
    double high = std::numeric_limits<double>::quiet_NaN();
};

/// Mean and scatter of the strengths at one confinement, in the unit of the tests' stresses.
struct StrengthAt {
    double confinement = 0.0;
    std::size_t tests = 0;
    double mean = 0.0;
    double deviation = std::numeric_limits<double>::quiet_NaN();  ///< sample standard deviation; NaN for a single test
    /// Ends of the mean's 95 % interval (mean_of()); NaN for a single test.
    double low = std::numeric_limits<double>::quiet_NaN();
    double high = std::numeric_limits<double>::quiet_NaN();
};

/// Stresses on the plane of failure, compression positive.
struct PlaneStress {
    double normal = 0.0, shear = 0.0;
};

/// Both laws, fitted to the strengths of a rock, in the unit of the tests' stresses.
struct StrengthEnvelope {
    std::size_t packings = 0;
    std::vector<StrengthAt> strengths;                       ///< ordered by confinement
    double variation = 0.0;                                  ///< pooled coefficient of variation between packings
    FittedNumber strength, slope, friction_angle, cohesion;  ///< Mohr-Coulomb: C, N, φ in degrees, c
    double misfit = 0.0;                             ///< root mean square residual, relative to the mean strengths
    FittedNumber hoek_brown_strength, hoek_brown_m;  ///< C, m
    double hoek_brown_misfit = 0.0;

    /// σ1 at failure by Mohr-Coulomb: C + N σ3. @param confinement  σ3
    double mohr_coulomb(double confinement) const { return strength.value + slope.value * confinement; }
    /// σ1 at failure by Hoek-Brown: σ3 + sqrt(m C σ3 + C²). @param confinement  σ3
    double hoek_brown(double confinement) const;

    /// Tensile strength by Mohr-Coulomb, as a negative confinement at which σ1 = 0: -C/N. The law does not hold there.
    double mohr_coulomb_tension() const { return -strength.value / slope.value; }
    /// Tensile strength by Hoek-Brown, as a negative confinement at which σ1 = 0: C (m - sqrt(m² + 4))/2.
    double hoek_brown_tension() const;

    /// Stresses where the circle of diameter σ1 - σ3 touches the envelope of the Hoek-Brown Mohr circles (Balmer, Proc.
    /// ASTM 52, 1952):
    ///     σn = σ3 + (σ1 - σ3)/(1 + k),  τ = (σ1 - σ3) sqrt(k)/(1 + k),  k = dσ1/dσ3
    /// with σ3 = ((σ1 - σ3)² - C²)/(m C), k = 1 + m C/(2 (σ1 - σ3)). The envelope begins at σn = -C/m, τ = 0.
    /// @param deviator  σ1 - σ3, >= 0
    PlaneStress hoek_brown_on_plane(double deviator) const;
    /// Shear stress of Mohr-Coulomb on the plane of failure: c + σn tan φ. @param normal  σn
    double mohr_coulomb_on_plane(double normal) const;
};

/// Both laws, fitted to one packing's tests.
struct FittedLaws {
    double strength = 0.0, slope = 0.0, friction_angle = 0.0, cohesion = 0.0;  // see StrengthEnvelope
    double hoek_brown_strength = 0.0, hoek_brown_m = 0.0;
};
/// Fits both laws with weights 1/strength². Results of single packings scatter about those fitted to the means.
/// @param tests  tests of one packing
/// @throws InputError for fewer than three confinements
FittedLaws fit_laws(std::span<const StrengthPoint> tests);

inline constexpr std::size_t fewest_confinements = 3, fewest_packings = 2;

/// Fits both laws to tests of several packings.
/// @throws InputError for fewer than three confinements or two packings; the message states how many were found
StrengthEnvelope fit_envelope(std::span<const StrengthPoint> tests);

}  // namespace crackle
