// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the laws of trace length: samplers against their own distribution (Kolmogorov-Smirnov) and moments, and
// formulas of the laws against closed forms.

#include "specimens/joints/length_law.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/claim.hpp"

namespace crackle::length_law_test {
namespace {

using testing::agrees;
using testing::within;

struct Named {
    const char* name;
    LengthLaw law;
    double mean, deviation;  // m, values of closed forms
};

/// Moments of a power law with density l^-a: ∫ l^(k-a) / ∫ l^-a.
double power_moment(double l0, double l1, double a, int k) {
    const auto integral = [&](double p) {
        return p == -1.0 ? std::log(l1 / l0) : (std::pow(l1, p + 1.0) - std::pow(l0, p + 1.0)) / (p + 1.0);
    };
    return integral(k - a) / integral(-a);
}

std::vector<Named> laws() {
    std::vector<Named> all{{"fixed", LengthLaw::fixed(0.3), 0.3, 0.0},
                           {"uniform", LengthLaw::uniform(0.3, 0.1), 0.3, 0.1 / std::sqrt(3.0)},
                           {"exponential", LengthLaw::exponential(0.3), 0.3, 0.3},
                           {"lognormal", LengthLaw::lognormal(0.3, 0.15), 0.3, 0.15},
                           {"wide lognormal", LengthLaw::lognormal(2.0, 2.0), 2.0, 2.0}};
    for (const double a : {0.5, 1.0, 1.5, 2.0, 3.0}) {
        const double mean = power_moment(0.1, 5.0, a, 1), square = power_moment(0.1, 5.0, a, 2);
        all.push_back({"power law", LengthLaw::power_law(0.1, 5.0, a), mean, std::sqrt(square - mean * mean)});
    }
    return all;
}

constexpr std::size_t draws = 20'000;

std::vector<double> drawn(const LengthLaw& law, std::uint64_t seed) {
    std::mt19937_64 generator(seed);
    std::vector<double> lengths(draws);
    for (double& length : lengths) length = law.draw(generator);
    std::sort(lengths.begin(), lengths.end());
    return lengths;
}

TEST(LengthLaw, SamplesFollowTheirDistribution) {
    for (const auto& [name, law, mean, deviation] : laws()) {
        if (deviation == 0.0) continue;
        const std::vector<double> lengths = drawn(law, 11);
        double furthest = 0.0;
        for (std::size_t k = 0; k < draws; ++k) {
            const double share = law.share_below(lengths[k]), n = static_cast<double>(draws);
            furthest = std::max({furthest, share - static_cast<double>(k) / n, static_cast<double>(k + 1) / n - share});
        }
        // By Kolmogorov's distribution, √n D exceeds 1.95 in one of a thousand cases.
        EXPECT_TRUE(within(std::string("Kolmogorov's sqrt(n) D, ") + name, std::sqrt(draws) * furthest, 0.0, 1.95));
    }
}

TEST(LengthLaw, SamplesHaveItsMeanAndDeviation) {
    for (const auto& [name, law, mean, deviation] : laws()) {
        EXPECT_TRUE(agrees(std::string("mean by formula, ") + name, law.mean(), mean, 1e-12));
        double sum = 0.0, squares = 0.0;
        for (const double length : drawn(law, 12)) sum += length, squares += (length - mean) * (length - mean);
        const double n = static_cast<double>(draws), error = deviation / std::sqrt(n);
        EXPECT_TRUE(within(std::string("mean of samples, ") + name, sum / n, mean, 4.0 * error + 1e-12));
        // The error of the variance increases with the weight of the tail, so it is not checked for the widest law.
        if (deviation > 0.0 && std::string(name) != "wide lognormal") {
            EXPECT_TRUE(agrees(std::string("deviation of samples, ") + name, std::sqrt(squares / n), deviation, 0.05));
        }
    }
}

TEST(LengthLaw, PowerLawIsThePaperFormula) {
    // l = [l0^(1-a) + u (l1^(1-a) - l0^(1-a))]^(1/(1-a)), mean (1-a)/(2-a) (l1^(2-a) - l0^(2-a))/(l1^(1-a) - l0^(1-a)).
    const double l0 = 0.2, l1 = 7.0;
    for (const double a : {0.3, 1.7, 2.6}) {
        const LengthLaw law = LengthLaw::power_law(l0, l1, a);
        for (const double u : {0.1, 0.5, 0.99}) {
            const double b = 1.0 - a;
            const double formula = std::pow(std::pow(l0, b) + u * (std::pow(l1, b) - std::pow(l0, b)), 1.0 / b);
            EXPECT_TRUE(agrees("length", law.exceeded_by(1.0 - u), formula, 1e-12));
            EXPECT_TRUE(agrees("share below", law.share_below(formula), u, 1e-12));
        }
        EXPECT_TRUE(agrees("mean", law.mean(),
                           (1.0 - a) / (2.0 - a) * (std::pow(l1, 2.0 - a) - std::pow(l0, 2.0 - a)) /
                               (std::pow(l1, 1.0 - a) - std::pow(l0, 1.0 - a)),
                           1e-12));
    }
}

TEST(LengthLaw, PowerLawGoesOverIntoItsLimits) {
    for (const double a : {1.0, 2.0}) {
        const LengthLaw at = LengthLaw::power_law(0.1, 4.0, a), beside = LengthLaw::power_law(0.1, 4.0, a + 1e-9);
        EXPECT_TRUE(agrees("mean", at.mean(), beside.mean(), 1e-7));
        EXPECT_TRUE(agrees("median", at.exceeded_by(0.5), beside.exceeded_by(0.5), 1e-7));
    }
    EXPECT_TRUE(agrees("median at a = 1", LengthLaw::power_law(0.1, 4.0, 1.0).exceeded_by(0.5), std::sqrt(0.4), 1e-14));
}

}  // namespace
}  // namespace crackle::length_law_test
