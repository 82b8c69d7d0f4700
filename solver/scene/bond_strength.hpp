// SPDX-License-Identifier: GPL-3.0-or-later
// Random factor on a bond's strengths, with a mean of 1. It depends only on the seed and the ids of the two bodies, not
// on the order of bonds, the number of threads or interruptions of the run.
// Tested by tests/solver/scene/bond_strength_test.cpp.
#pragma once

#include <cstdint>

#include "solver/base/names.hpp"

namespace crackle {

/// Statistical distribution of bond strengths.
enum class StrengthDistribution : std::uint8_t {
    none,    ///< every bond has the factor 1
    normal,  ///< truncated at 0; mean and coefficient of variation refer to the truncated distribution
    lognormal,
    weibull,
};

constexpr auto list_names(StrengthDistribution) { return in_order("none", "normal", "lognormal", "weibull"); }

/// Largest coefficient of variation of a normal distribution that is truncated at 0 and has a mode >= 0: that of the
/// half-normal distribution, √(π/2 - 1).
inline constexpr double largest_normal_cv = 0.7555;

/// Random strength factors, with a mean of 1.
class StrengthFactors {
  public:
    StrengthFactors() = default;
    /// @param cv the coefficient of variation, > 0 (normal: at most largest_normal_cv) @throws InputError if `cv` is
    /// out of range
    StrengthFactors(StrengthDistribution distribution, double cv, std::int64_t seed);

    /// Factor for the bonds between two bodies. The order of the two ids does not matter.
    double between(int id_a, int id_b) const;

    /// Value x of the distribution with P(X <= x) = probability, for 0 < probability < 1.
    double quantile(double probability) const;
    /// Probability of a value <= x.
    double probability(double x) const;

  private:
    StrengthDistribution distribution_ = StrengthDistribution::none;
    std::int64_t seed_ = 0;
    // Parameters of the distribution. normal: mean and standard deviation before truncation; lognormal: mean and
    // standard deviation of the logarithm; weibull: modulus and scale.
    double first_ = 0.0, second_ = 0.0;
};

/// Modulus m of the Weibull distribution with coefficient of variation cv: Γ(1+2/m)/Γ(1+1/m)² = 1 + cv².
double weibull_modulus(double cv);

}  // namespace crackle
