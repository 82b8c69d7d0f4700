// SPDX-License-Identifier: GPL-3.0-or-later
// Distributions of lengths, for traces, for the gaps between them, and for joint spacings:
//       fixed        l = m
//       uniform      m - d to m + d
//       exponential  exp(-l/m)
//       lognormal    mean m and standard deviation d of l itself: σ² = ln(1 + d²/m²), μ = ln m - σ²/2
//       power law    density ~ l^-a from l0 to l1
// A length is drawn as the value exceeded by a fraction s of all lengths. For the power law, with b = 1 - a and L =
// ln(l1/l0), it is
//       l = l0 [1 + (1 - s)(e^(bL) - 1)]^(1/b),   mean l0 (e^((b+1)L) - 1)/(b + 1) · b/(e^(bL) - 1)
// and its limit for b = 0 or -1 (Bonnet et al., Rev. Geophys. 39, 2001).
// Tested by tests/specimens/joints/length_law_test.cpp.
#pragma once

#include <cstdint>
#include <random>

namespace crackle {

/// Distribution of lengths, m.
class LengthLaw {
  public:
    /// All lengths are equal. @param mean  m
    static LengthLaw fixed(double mean) { return {Kind::fixed, mean, 0.0, 0.0}; }
    /// Uniform distribution. @param mean  m @param deviation  half of the range, m
    static LengthLaw uniform(double mean, double deviation) { return {Kind::uniform, mean, deviation, 0.0}; }
    /// Exponential distribution. @param mean  m
    static LengthLaw exponential(double mean) { return {Kind::exponential, mean, 0.0, 0.0}; }
    /// Lognormal distribution. @param mean  m @param deviation  standard deviation, m
    static LengthLaw lognormal(double mean, double deviation) { return {Kind::lognormal, mean, deviation, 0.0}; }
    /// Density ~ l^-exponent from the shortest to the longest length. @param shortest  m @param longest  m
    static LengthLaw power_law(double shortest, double longest, double exponent) {
        return {Kind::power_law, shortest, longest, exponent};
    }

    /// Whether all lengths lie between two positive bounds, shortest() and longest().
    bool has_power_law() const { return kind_ == Kind::power_law; }
    double shortest() const { return first_; }  ///< shortest length of a power law, m
    double longest() const { return second_; }  ///< longest length of a power law, m

    /// Mean length, m.
    double mean() const;
    /// Fraction of all lengths that are shorter than `length`.
    double share_below(double length) const;
    /// Length exceeded by a given fraction of all lengths, m. @param share  between 0 and 1, both excluded
    double exceeded_by(double share) const;
    /// Draws a length, m.
    double draw(std::mt19937_64& generator) const;

    bool operator==(const LengthLaw&) const = default;

  private:
    enum class Kind : std::uint8_t { fixed, uniform, exponential, lognormal, power_law };
    LengthLaw(Kind kind, double first, double second, double third)
        : kind_(kind), first_(first), second_(second), third_(third) {}
    double log_deviation() const;
    double log_mean() const;

    Kind kind_;
    double first_, second_, third_;
};

/// A uniform random number between 0 and 1, both excluded.
double share_number(std::mt19937_64& generator);

}  // namespace crackle
