// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of lengths: of traces, of the gaps between them, of the distances between joints.
//     fixed        l = m
//     uniform      m - d to m + d
//     exponential  exp(-l/m)
//     lognormal    mean m and standard deviation d of l itself: σ² = ln(1 + d²/m²), μ = ln m - σ²/2
//     power law    density ~ l^-a from l0 to l1
// each as the length that a share s of all exceeds: that of the power law is, with b = 1 - a and L = ln(l1/l0),
//     l = l0 [1 + (1 - s)(e^(bL) - 1)]^(1/b),   mean l0 (e^((b+1)L) - 1)/(b + 1) · b/(e^(bL) - 1)
// and at b = 0 or -1 the limits of these (Bonnet et al., Rev. Geophys. 39, 2001).
// Tested by tests/specimens/joints/length_law_test.cpp.
#pragma once

#include <cstdint>
#include <random>

namespace crackle {

class LengthLaw {
  public:
    static LengthLaw fixed(double mean) { return {Kind::fixed, mean, 0.0, 0.0}; }
    static LengthLaw uniform(double mean, double deviation) { return {Kind::uniform, mean, deviation, 0.0}; }
    static LengthLaw exponential(double mean) { return {Kind::exponential, mean, 0.0, 0.0}; }
    static LengthLaw lognormal(double mean, double deviation) { return {Kind::lognormal, mean, deviation, 0.0}; }
    static LengthLaw power_law(double shortest, double longest, double exponent) {
        return {Kind::power_law, shortest, longest, exponent};
    }

    double mean() const;
    /// Share of all lengths below this one.
    double share_below(double length) const;
    /// The length that a share of all exceeds. @param share between 0 and 1, both excluded
    double exceeded_by(double share) const;
    double draw(std::mt19937_64& generator) const;

  private:
    enum class Kind : std::uint8_t { fixed, uniform, exponential, lognormal, power_law };
    LengthLaw(Kind kind, double first, double second, double third)
        : kind_(kind), first_(first), second_(second), third_(third) {}
    double log_deviation() const;
    double log_mean() const;

    Kind kind_;
    double first_, second_, third_;
};

/// Between 0 and 1, both excluded.
double share_number(std::mt19937_64& generator);

}  // namespace crackle
