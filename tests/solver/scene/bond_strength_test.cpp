// SPDX-License-Identifier: GPL-3.0-or-later
// Tests random strength factors: moments and distribution over 10,000 pairs, and dependence on seed and pair only.

#include "solver/scene/bond_strength.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "solver/base/errors.hpp"
#include "tests/support/claim.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::within;

class Factors : public ::testing::TestWithParam<StrengthDistribution> {};

TEST_P(Factors, HaveTheirMeanVariationAndDistribution) {
    constexpr int count = 10000;
    constexpr double cv = 0.4;
    const StrengthFactors factors(GetParam(), cv, 11);
    std::vector<double> drawn;
    for (int k = 0; k < count; ++k) drawn.push_back(factors.between(k, k + 1 + k % 7));
    double mean = 0.0, square = 0.0;
    for (const double x : drawn) mean += x / count;
    for (const double x : drawn) square += (x - mean) * (x - mean) / (count - 1);
    // The tolerance is three standard errors: cv/√n for a mean, and at most about 1.5 cv/√(2n) for a coefficient of
    // variation.
    EXPECT_TRUE(within("mean", mean, 1.0, 3.0 * cv / std::sqrt(count)));
    EXPECT_TRUE(agrees("coefficient of variation", std::sqrt(square) / mean, cv, 3.0 * 1.5 / std::sqrt(2.0 * count)));
    std::ranges::sort(drawn);
    double apart = 0.0;
    for (int k = 0; k < count; ++k) {
        const double p = factors.probability(drawn[static_cast<std::size_t>(k)]);
        apart = std::max({apart, std::abs(p - static_cast<double>(k) / count), std::abs(p - (k + 1.0) / count)});
    }
    EXPECT_TRUE(within("Kolmogorov-Smirnov distance, 5 %", apart, 0.0, 1.358 / std::sqrt(count)));
    EXPECT_GT(drawn.front(), 0.0);
    EXPECT_TRUE(agrees("quantile of a probability", factors.quantile(factors.probability(0.8)), 0.8, 1e-9));
}

INSTANTIATE_TEST_SUITE_P(BondStrength, Factors,
                         ::testing::Values(StrengthDistribution::normal, StrengthDistribution::lognormal,
                                           StrengthDistribution::weibull));

TEST(BondStrength, DependsOnSeedAndPairAlone) {
    const StrengthFactors factors(StrengthDistribution::weibull, 0.3, 5), other(StrengthDistribution::weibull, 0.3, 6);
    EXPECT_EQ(factors.between(3, 8), factors.between(8, 3));
    EXPECT_EQ(factors.between(3, 8), StrengthFactors(StrengthDistribution::weibull, 0.3, 5).between(3, 8));
    EXPECT_NE(factors.between(3, 8), factors.between(3, 9));
    EXPECT_NE(factors.between(3, 8), other.between(3, 8));
    EXPECT_EQ(StrengthFactors().between(3, 8), 1.0);
}

TEST(BondStrength, WeibullModulusIsThatOfTheVariation) {
    EXPECT_TRUE(agrees("modulus of an exponential distribution", weibull_modulus(1.0), 1.0, 1e-9));
    EXPECT_TRUE(agrees("modulus of a Rayleigh distribution", weibull_modulus(std::sqrt(4.0 / std::numbers::pi - 1.0)),
                       2.0, 1e-9));
}

TEST(BondStrength, RefusesVariationsThatTheDistributionCannotHave) {
    EXPECT_THROW(StrengthFactors(StrengthDistribution::normal, 0.8, 1), InputError);
    EXPECT_THROW(StrengthFactors(StrengthDistribution::weibull, 0.0, 1), InputError);
    EXPECT_THROW(StrengthFactors(StrengthDistribution::lognormal, -0.1, 1), InputError);
    EXPECT_TRUE(within("half a normal distribution", largest_normal_cv, std::sqrt(0.5 * std::numbers::pi - 1.0), 1e-4));
}

}  // namespace
}  // namespace crackle
