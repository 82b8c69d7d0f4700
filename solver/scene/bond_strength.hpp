// SPDX-License-Identifier: GPL-3.0-or-later
// Random factor of a bond's strengths: mean 1, a pure function of the seed and the two bodies' ids, so that it depends
// on neither order, threads nor an interruption.
// Tested by tests/solver/scene/bond_strength_test.cpp.
#pragma once

#include <cstdint>
#include <string>

namespace crackle {

enum class StrengthDistribution : std::uint8_t {
    none,    ///< every bond has factor 1
    normal,  ///< truncated at 0; mean and coefficient of variation are those of the truncated one
    lognormal,
    weibull,
};

/// "none", "normal", "lognormal" or "weibull". @throws InputError on another word, naming `where`.
StrengthDistribution strength_distribution_named(const std::string& where, const std::string& word);
const char* name_of(StrengthDistribution distribution);

/// Largest coefficient of variation of a normal distribution truncated at 0 whose mode is not negative: that of half a
/// normal distribution, √(π/2 - 1).
inline constexpr double largest_normal_cv = 0.7555;

class StrengthFactors {
  public:
    StrengthFactors() = default;
    /// @param cv coefficient of variation, > 0 (normal: at most largest_normal_cv)  @throws InputError outside
    StrengthFactors(StrengthDistribution distribution, double cv, std::int64_t seed);

    /// Factor of the bonds between two bodies, in either order.
    double between(int id_a, int id_b) const;

    /// Value of the distribution at a probability, 0 < p < 1.
    double quantile(double probability) const;
    /// Probability of at most x.
    double probability(double x) const;

  private:
    StrengthDistribution distribution_ = StrengthDistribution::none;
    std::int64_t seed_ = 0;
    // normal: mean and deviation before truncation; lognormal: of the logarithm; weibull: modulus and scale.
    double first_ = 0.0, second_ = 0.0;
};

/// Modulus m of the Weibull distribution of a coefficient of variation: Γ(1+2/m)/Γ(1+1/m)² = 1 + cv².
double weibull_modulus(double cv);

}  // namespace crackle
