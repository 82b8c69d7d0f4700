// SPDX-License-Identifier: GPL-3.0-or-later
// Frequency-magnitude law of events: log10 N(>= M) = a - b M above a magnitude of completeness Mc. Smaller events are
// missed or, in a specimen of particles, cannot occur.
//
// Maximum likelihood (Aki, Bull. Earthq. Res. Inst. 43, 1965): b = log10(e)/(mean M - Mc), where the mean is over the N
// events above Mc. This estimate is too large by a factor of N/(N - 1) on average and is corrected for it. Magnitudes
// are exact and need no correction for bins. Standard error: 2.30 b² sqrt(Σ(M - mean)²/(N (N - 1))) (Shi & Bolt, Bull.
// Seism. Soc. Am. 72, 1982), which does not assume that the law holds. The 95 % interval does assume it: 2 N times the
// ratio of the true b to Aki's estimate then has a χ² distribution with 2 N degrees of freedom. Neither error includes
// the uncertainty of Mc.
// Tested by tests/specimens/emission/b_value_test.cpp.
#pragma once

#include <cstddef>
#include <limits>
#include <span>

namespace crackle {

/// No b is computed from fewer than `fewest_magnitudes` events above Mc; with fewer than `few_magnitudes`, b is marked
/// as uncertain.
inline constexpr std::size_t fewest_magnitudes = 50, few_magnitudes = 200;

/// The frequency-magnitude law fitted to events; values are NaN if there are too few events.
struct BValue {
    std::size_t events = 0;  ///< number of events above Mc, on which all other values are based
    double completeness = std::numeric_limits<double>::quiet_NaN();  ///< Mc
    double b = std::numeric_limits<double>::quiet_NaN();
    double standard_error = std::numeric_limits<double>::quiet_NaN();
    /// Ends of the 95 % interval of b.
    double low = std::numeric_limits<double>::quiet_NaN(), high = std::numeric_limits<double>::quiet_NaN();
    /// log10 of the number of events above magnitude 0 according to the fitted line.
    double a = std::numeric_limits<double>::quiet_NaN();
    /// Largest difference between the observed fraction of events above a magnitude and the fitted one
    /// (Kolmogorov-Smirnov). `straight`: whether samples from such a law would exceed this distance with a probability
    /// of at least 5 % (Stephens, J. Am. Stat. Assoc. 69, 1974; slope estimated from the same events).
    double distance = std::numeric_limits<double>::quiet_NaN();
    bool straight = false;

    /// Whether there are enough events to estimate the b-value.
    bool known() const { return events >= fewest_magnitudes; }
    /// Whether the b-value is estimated from few events.
    bool of_few() const { return events < few_magnitudes; }
};

/// b of the events above a known magnitude of completeness. @param magnitudes  magnitudes in any order; not NaN
BValue b_value_above(std::span<const double> magnitudes, double completeness);

/// Method of finding the magnitude of completeness, above which all events are assumed to be observed.
enum class Completeness {
    maximum_curvature,  ///< middle of the fullest bin of 0.1, plus 0.2 (Wiemer & Wyss 2000; Woessner & Wiemer 2005)
    /// The observed magnitude above which `BValue::distance` is least (Clauset et al., SIAM Rev. 51, 2009).
    least_distance
};
/// Magnitude of completeness Mc; NaN for fewer than 50 magnitudes. With `least_distance`, at least 50 magnitudes lie
/// above Mc, unless fewer than 50 exceed the smallest one; Mc is then the smallest magnitude.
double completeness_of(std::span<const double> magnitudes, Completeness rule);

/// b of the events above Mc, which is found by the given rule. With `least_distance`, errors, interval and `straight`
/// are left out: the same events determine Mc, so the errors would be too small by a quarter.
BValue fit_b_value(std::span<const double> magnitudes, Completeness rule);

}  // namespace crackle
