// SPDX-License-Identifier: GPL-3.0-or-later
// How often events of each magnitude come: log10 N(>= M) = a - b M above a magnitude of completeness Mc, below which
// they are missed or, in a specimen of particles, cannot be.
//
// Maximum likelihood (Aki, Bull. Earthq. Res. Inst. 43, 1965): b = log10(e)/(mean M - Mc) of the N events above Mc,
// here times (N - 1)/N, for it is too large by N/(N - 1) in the mean. Magnitudes are exact, so nothing is corrected for
// bins. Standard error: 2.30 b² sqrt(Σ(M - mean)²/(N (N - 1))) (Shi & Bolt, Bull. Seism. Soc. Am. 72, 1982), which does
// not take the law for granted; the 95 % interval is that of the law, for then 2 N times the ratio of the true b to
// Aki's has the χ² distribution with 2 N degrees of freedom. How well Mc is known is in neither.
// Tested by tests/specimens/emission/b_value_test.cpp.
#pragma once

#include <cstddef>
#include <limits>
#include <span>

namespace crackle {

/// Fewer events above Mc give no b; fewer than `few_magnitudes` one that is marked.
inline constexpr std::size_t fewest_magnitudes = 50, few_magnitudes = 200;

/// Not a number where there are too few.
struct BValue {
    std::size_t events = 0;                                          ///< above Mc: the number behind all else
    double completeness = std::numeric_limits<double>::quiet_NaN();  ///< Mc
    double b = std::numeric_limits<double>::quiet_NaN();
    double standard_error = std::numeric_limits<double>::quiet_NaN();
    double low = std::numeric_limits<double>::quiet_NaN(), high = std::numeric_limits<double>::quiet_NaN();  ///< 95 %
    double a = std::numeric_limits<double>::quiet_NaN();  ///< log10 of the events above magnitude 0, by the line
    /// Largest distance of the shares above each magnitude from the line's (Kolmogorov-Smirnov), and whether it is one
    /// that such a law passes in 19 of 20 cases (Stephens, J. Am. Stat. Assoc. 69, 1974; slope from the same events).
    double distance = std::numeric_limits<double>::quiet_NaN();
    bool straight = false;

    bool known() const { return events >= fewest_magnitudes; }
    bool of_few() const { return events < few_magnitudes; }
};

/// Of events above a magnitude that is known. @param magnitudes in any order; no NaN
BValue b_value_above(std::span<const double> magnitudes, double completeness);

enum class Completeness {
    maximum_curvature,  ///< middle of the fullest bin of 0.1, and 0.2 more (Wiemer & Wyss 2000; Woessner & Wiemer 2005)
    least_distance      ///< the observed magnitude above which `distance` is least (Clauset et al., SIAM Rev. 51, 2009)
};
/// Mc; not a number of fewer than 50 magnitudes. `least_distance` leaves 50 above it.
double completeness_of(std::span<const double> magnitudes, Completeness rule);

/// b above the Mc of a rule. Of `least_distance` without errors, interval and `straight`: the same events have chosen
/// it, and the errors would be too small by a quarter.
BValue fit_b_value(std::span<const double> magnitudes, Completeness rule);

}  // namespace crackle
