// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/scene/bond_strength.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <numbers>
#include <utility>

#include "solver/base/correctly_rounded.hpp"
#include "solver/base/errors.hpp"

namespace crackle {
namespace {

/// Root of a monotonic function in an interval, to full precision.
template <class F>
double root_between(F f, double low, double high) {
    std::uintmax_t tries = 200;
    const auto [a, b] =
        boost::math::tools::toms748_solve(f, low, high, boost::math::tools::eps_tolerance<double>(50), tries);
    return 0.5 * (a + b);
}

/// Mean and coefficient of variation of a normal distribution truncated at 0. Before truncation, its mean is 1 and its
/// standard deviation is s.
std::pair<double, double> truncated_normal(double s) {
    const double density = correctly_rounded::exp(-0.5 / (s * s)) / std::sqrt(2.0 * std::numbers::pi);
    const double ratio = density / correctly_rounded::normal_share_below(1.0 / s);
    const double mean = 1.0 + s * ratio, variance = s * s * (1.0 - ratio / s - ratio * ratio);
    return {mean, std::sqrt(variance) / mean};
}

/// Mixing function of SplitMix64, with its Weyl sequence (Steele, Lea, Flood 2014).
std::uint64_t mixed(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

}  // namespace

double weibull_modulus(double cv) {
    return root_between(
        [&](double m) {
            return correctly_rounded::exp(correctly_rounded::lgamma(1.0 + 2.0 / m) -
                                          2.0 * correctly_rounded::lgamma(1.0 + 1.0 / m)) -
                   1.0 - cv * cv;
        },
        0.2, 1e5);
}

StrengthFactors::StrengthFactors(StrengthDistribution distribution, double cv, std::int64_t seed)
    : distribution_(distribution), seed_(seed) {
    if (distribution == StrengthDistribution::none) return;
    const double highest = distribution == StrengthDistribution::normal ? largest_normal_cv : 2.0;
    if (!(cv >= 1e-4 && cv <= highest)) {
        throw InputError(fmt::format(
            "coefficient of variation of strengths: found {}, expected 0.0001 to {} for the distribution {}", cv,
            highest, name_of(distribution)));
    }
    if (distribution == StrengthDistribution::normal) {
        // s is the ratio of the standard deviation to the mean before truncation. That mean equals the mode.
        const double s = root_between([&](double x) { return truncated_normal(x).second - cv; }, 0.5e-4, 1e6);
        first_ = 1.0 / truncated_normal(s).first;
        second_ = s * first_;
    } else if (distribution == StrengthDistribution::lognormal) {
        second_ = std::sqrt(correctly_rounded::log1p(cv * cv));
        first_ = -0.5 * second_ * second_;
    } else {
        first_ = weibull_modulus(cv);
        second_ = 1.0 / correctly_rounded::tgamma(1.0 + 1.0 / first_);
    }
}

double StrengthFactors::quantile(double p) const {
    switch (distribution_) {
        case StrengthDistribution::none:
            return 1.0;
        case StrengthDistribution::normal: {
            const double below = correctly_rounded::normal_share_below(-first_ / second_);
            return first_ + second_ * correctly_rounded::normal_quantile(below + p * (1.0 - below));
        }
        case StrengthDistribution::lognormal:
            return correctly_rounded::exp(first_ + second_ * correctly_rounded::normal_quantile(p));
        case StrengthDistribution::weibull:
            break;
    }
    return second_ * correctly_rounded::pow(-correctly_rounded::log1p(-p), 1.0 / first_);
}

double StrengthFactors::probability(double x) const {
    switch (distribution_) {
        case StrengthDistribution::none:
            return x >= 1.0 ? 1.0 : 0.0;
        case StrengthDistribution::normal: {
            const double below = correctly_rounded::normal_share_below(-first_ / second_);
            return std::max(0.0,
                            (correctly_rounded::normal_share_below((x - first_) / second_) - below) / (1.0 - below));
        }
        case StrengthDistribution::lognormal:
            return x <= 0.0 ? 0.0
                            : correctly_rounded::normal_share_below((correctly_rounded::log(x) - first_) / second_);
        case StrengthDistribution::weibull:
            break;
    }
    return x <= 0.0 ? 0.0 : -correctly_rounded::expm1(-correctly_rounded::pow(x / second_, first_));
}

double StrengthFactors::between(int id_a, int id_b) const {
    if (distribution_ == StrengthDistribution::none) return 1.0;
    const auto low = static_cast<std::uint32_t>(std::min(id_a, id_b)),
               high = static_cast<std::uint32_t>(std::max(id_a, id_b));
    const std::uint64_t pair = (static_cast<std::uint64_t>(low) << 32) | high;
    const std::uint64_t bits = mixed(mixed(static_cast<std::uint64_t>(seed_)) ^ pair);
    // Centre of one of 2^53 equal intervals, so that p is never 0 or 1.
    const double p = (static_cast<double>(bits >> 11) + 0.5) * 0x1p-53;
    return quantile(p);
}

}  // namespace crackle
