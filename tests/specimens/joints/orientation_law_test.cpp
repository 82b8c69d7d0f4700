// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the laws of direction: samplers against their own distributions and moments, planes cut by sections against the
// formula of apparent dip, and recovery of κ.

#include "specimens/joints/orientation_law.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/special_functions/bessel.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "specimens/statistics/directions.hpp"
#include "specimens/statistics/random_numbers.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/refusal.hpp"

namespace crackle::orientation_law_test {
namespace {

using testing::agrees;
using testing::refusal;
using testing::within;

constexpr double degree = std::numbers::pi / 180.0;
constexpr std::size_t draws = 20'000;

/// The angle from the mean direction, reduced to [-90, 90) degrees, in rad.
double from_mean(double angle, double mean) {
    const double off = angle - mean;
    return off - std::numbers::pi * std::floor(off / std::numbers::pi + 0.5);
}

std::vector<double> drawn(const OrientationLaw& law, std::uint64_t seed, std::size_t count = draws) {
    std::mt19937_64 generator(seed);
    std::vector<double> angles(count);
    for (double& angle : angles) angle = law.draw(generator);
    return angles;
}

/// √n D of angles relative to the mean, for a density over [-π/2, π/2] that need not be normalised.
double kolmogorov(std::vector<double> off, const std::function<double(double)>& density) {
    std::sort(off.begin(), off.end());
    using boost::math::quadrature::gauss_kronrod;
    const double whole =
        gauss_kronrod<double, 61>::integrate(density, -std::numbers::pi / 2, std::numbers::pi / 2, 15, 1e-10);
    double below = 0.0, at = -std::numbers::pi / 2, furthest = 0.0;
    const double n = static_cast<double>(off.size());
    for (std::size_t k = 0; k < off.size(); ++k) {
        below += gauss_kronrod<double, 15>::integrate(density, at, off[k], 0) / whole;
        at = off[k];
        furthest = std::max({furthest, below - static_cast<double>(k) / n, static_cast<double>(k + 1) / n - below});
    }
    return std::sqrt(n) * furthest;
}

TEST(OrientationLaw, VonMisesSamplesFollowTheirDensity) {
    for (const double kappa : {0.001, 0.5, 4.0, 60.0}) {
        std::vector<double> off = drawn(OrientationLaw::von_mises(0.7, kappa), 21);
        for (double& angle : off) angle = from_mean(angle, 0.7);
        const auto density = [&](double d) { return std::exp(kappa * (std::cos(2.0 * d) - 1.0)); };
        EXPECT_TRUE(
            within(fmt::format("Kolmogorov's sqrt(n) D, kappa {}", kappa), kolmogorov(off, density), 0.0, 1.95));
    }
}

TEST(OrientationLaw, UniformSamplesFillTheirRange) {
    std::vector<double> off = drawn(OrientationLaw::uniform(1.0, 0.4), 22);
    for (double& angle : off) angle = from_mean(angle, 1.0);
    const auto density = [](double d) { return std::abs(d) <= 0.4 ? 1.0 : 0.0; };
    double furthest = 0.0;
    std::sort(off.begin(), off.end());
    for (std::size_t k = 0; k < off.size(); ++k) {
        EXPECT_EQ(density(off[k]), 1.0);
        furthest = std::max(furthest, std::abs((off[k] + 0.4) / 0.8 - (static_cast<double>(k) + 0.5) / draws));
    }
    EXPECT_TRUE(within("Kolmogorov's sqrt(n) D", std::sqrt(draws) * furthest, 0.0, 1.95));
}

TEST(OrientationLaw, KappaIsRecovered) {
    for (const double kappa : {0.5, 3.0, 40.0, 1000.0}) {
        Rose rose;
        for (const double angle : drawn(OrientationLaw::von_mises(0.3, kappa), 23)) rose.add(angle, 1.0);
        const double fitted = fitted_kappa(rose.resultant(), rose.count);
        // The standard error of the estimate is 1/sqrt(n A'(κ)), A' = 1 - A/κ - A²; for large κ it is κ sqrt(2/n).
        const double a =
            boost::math::cyl_bessel_i(1, std::min(kappa, 600.0)) / boost::math::cyl_bessel_i(0, std::min(kappa, 600.0));
        const double slope = kappa < 600.0 ? 1.0 - a / kappa - a * a : 0.5 / (kappa * kappa);
        EXPECT_TRUE(within(fmt::format("kappa {}", kappa), fitted, kappa, 4.0 / std::sqrt(draws * slope)));
    }
}

TEST(OrientationLaw, FewLinesLieBeyondTheStretch) {
    const Section section = Section::vertical(80.0 * degree);
    std::vector<OrientationLaw> laws{OrientationLaw::uniform(0.3, 0.5 * std::numbers::pi)};
    for (const double kappa : {1e-3, 0.5, 2.0, 10.0, 1e6}) laws.push_back(OrientationLaw::von_mises(0.3, kappa));
    for (const double k : {1e-3, 3.0, 20.0, 1e6}) {
        laws.push_back(OrientationLaw::fisher(50.0 * degree, 45.0 * degree, k, section));
        laws.push_back(OrientationLaw::fisher(85.0 * degree, 165.0 * degree, k, section));  // 15 degrees off
    }
    for (const OrientationLaw& law : laws) {
        double beyond = 0.0;
        for (const double angle : drawn(law, 27))
            beyond += std::abs(std::cos(from_mean(angle, law.mean()))) < 1.0 / law.stretch() ? 1.0 : 0.0;
        EXPECT_LE(beyond / draws, 1e-3 + 4.0 * std::sqrt(1e-3 / draws)) << law.stretch();
    }
    EXPECT_EQ(OrientationLaw::fixed(0.3).stretch(), 1.0);
    EXPECT_TRUE(agrees("all lines within", OrientationLaw::uniform(0.3, 60.0 * degree).stretch(), 2.0, 1e-12));
    EXPECT_LE(OrientationLaw::von_mises(0.3, 10.0).stretch(), 4.0) << "the bound may not be larger than necessary";
}

TEST(OrientationLaw, FittedKappaSolvesTheLikelihoodEquation) {
    for (const double kappa : {0.01, 1.0, 10.0, 500.0}) {
        const double resultant = boost::math::cyl_bessel_i(1, kappa) / boost::math::cyl_bessel_i(0, kappa);
        EXPECT_TRUE(agrees("kappa", fitted_kappa(resultant, 1000), kappa, 1e-9));
    }
    EXPECT_TRUE(std::isinf(fitted_kappa(1.0, 1000)));
    EXPECT_TRUE(std::isnan(fitted_kappa(0.5, 0)));
    EXPECT_TRUE(std::isnan(fitted_kappa(0.5, 4)));
    EXPECT_TRUE(std::isnan(fitted_kappa(1.0, 1)));
    // Best and Fisher's correction: (n - 1)^3 κ/(n^3 + n).
    EXPECT_TRUE(agrees("of ten", fitted_kappa(0.9, 10) / fitted_kappa(0.9, 1000), 729.0 / 1010.0, 1e-12));
}

TEST(OrientationLaw, FisherPlanesCutSquareAreVonMisesLike) {
    // If the mean plane is perpendicular to the section, the trace's angle has the projected density of n. For large K
    // and small deviations it is a normal distribution with variance 1/K, with weights near 1.
    const double k = 2000.0;
    const Section section = Section::vertical(90.0 * degree);
    const OrientationLaw law = OrientationLaw::fisher(30.0 * degree, 90.0 * degree, k, section);
    EXPECT_TRUE(within("mean trace", from_mean(law.mean(), -30.0 * degree), 0.0, 1e-12));
    double squares = 0.0, sum = 0.0;
    for (const double angle : drawn(law, 24)) {
        const double off = from_mean(angle, law.mean());
        squares += off * off;
        sum += off;
    }
    EXPECT_TRUE(agrees("variance times K", k * squares / draws, 1.0, 4.0 * std::sqrt(2.0 / draws) + 3.0 / k));
    EXPECT_TRUE(within("mean", sum / draws, 0.0, 4.0 / std::sqrt(k * draws)));
}

TEST(OrientationLaw, FisherWithoutConcentrationIsUniformInTheSection) {
    // With uniformly distributed planes, weighted by how often they meet the section, traces have no preferred
    // direction.
    std::vector<double> off =
        drawn(OrientationLaw::fisher(50.0 * degree, 200.0 * degree, 1e-3, Section::vertical(10.0 * degree)), 25);
    for (double& angle : off) angle = from_mean(angle, 0.0);
    EXPECT_TRUE(within("Kolmogorov's sqrt(n) D", kolmogorov(off, [](double) { return 1.0; }), 0.0, 1.95));
}

TEST(OrientationLaw, FisherWeighsPlanesByTheirChanceToMeetTheSection) {
    // Compared with a direct sum over planes in all directions, each weighted: the mean of cos 2θ.
    const double k = 5.0, dip = 40.0 * degree, direction = 75.0 * degree;
    const Section section = Section::vertical(30.0 * degree);
    const OrientationLaw law = OrientationLaw::fisher(dip, direction, k, section);
    double cosine = 0.0, sine = 0.0;
    for (const double angle : drawn(law, 26, 100'000)) cosine += std::cos(2.0 * angle), sine += std::sin(2.0 * angle);
    double weighted_cosine = 0.0, weighted_sine = 0.0, weights = 0.0;
    const double t = 30.0 * degree;
    const double mean[3] = {std::sin(dip) * std::sin(direction), std::sin(dip) * std::cos(direction), std::cos(dip)};
    // Normals on a fine grid over the sphere, with Fisher's density.
    constexpr int rings = 800, round = 800;
    for (int i = 0; i < rings; ++i) {
        const double z = -1.0 + 2.0 * (i + 0.5) / rings, r = std::sqrt(1.0 - z * z);
        for (int j = 0; j < round; ++j) {
            const double a = 2.0 * std::numbers::pi * (j + 0.5) / round;
            const double n[3] = {r * std::cos(a), r * std::sin(a), z};
            const double density = std::exp(k * (n[0] * mean[0] + n[1] * mean[1] + n[2] * mean[2] - 1.0));
            // Section: ex = (sin t, cos t, 0), ey = up; normal n_s = ex x ey = (cos t, -sin t, 0).
            const double s[3] = {std::cos(t), -std::sin(t), 0.0};
            const double line[3] = {n[1] * s[2] - n[2] * s[1], n[2] * s[0] - n[0] * s[2], n[0] * s[1] - n[1] * s[0]};
            const double x = line[0] * std::sin(t) + line[1] * std::cos(t), y = line[2];
            const double chance = std::sqrt(x * x + y * y), angle = std::atan2(y, x);
            weighted_cosine += density * chance * std::cos(2.0 * angle);
            weighted_sine += density * chance * std::sin(2.0 * angle);
            weights += density * chance;
        }
    }
    const double n = 100'000;
    EXPECT_TRUE(within("mean cos 2 theta", cosine / n, weighted_cosine / weights, 4.0 / std::sqrt(2.0 * n) + 1e-4));
    EXPECT_TRUE(within("mean sin 2 theta", sine / n, weighted_sine / weights, 4.0 / std::sqrt(2.0 * n) + 1e-4));
}

TEST(OrientationLaw, TheMeanTraceHasTheApparentDip) {
    for (const double trend : {0.0, 40.0, 155.0, 290.0}) {
        for (const double dip : {10.0, 45.0, 80.0}) {
            for (const double direction : {20.0, 130.0, 300.0}) {
                const OrientationLaw law =
                    OrientationLaw::fisher(dip * degree, direction * degree, 100.0, Section::vertical(trend * degree));
                // The trace goes down towards +x if the plane dips that way.
                const double apparent = -std::atan(std::tan(dip * degree) * std::cos((direction - trend) * degree));
                EXPECT_NEAR(from_mean(law.mean(), apparent), 0.0, 1e-9) << trend << ' ' << dip << ' ' << direction;
                // On a map, the trace is the strike.
                const OrientationLaw map = OrientationLaw::fisher(dip * degree, direction * degree, 100.0,
                                                                  Section::horizontal(trend * degree));
                EXPECT_NEAR(from_mean(map.mean(), (trend - (direction - 90.0)) * degree), 0.0, 1e-9);
            }
        }
    }
}

TEST(OrientationLaw, APlaneThatLiesInTheSectionIsRefused) {
    EXPECT_NE(refusal([] {
                  OrientationLaw::fisher(90.0 * degree, 90.0 * degree, 10.0, Section::vertical(0.0));
              }).find("lies in the section"),
              std::string::npos);
}

}  // namespace
}  // namespace crackle::orientation_law_test
