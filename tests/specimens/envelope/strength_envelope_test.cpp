// SPDX-License-Identifier: GPL-3.0-or-later
// Tests envelopes of strengths that follow a known law with the scatter of packings.

#include "specimens/envelope/strength_envelope.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "solver/base/correctly_rounded.hpp"
#include "solver/base/errors.hpp"
#include "specimens/statistics/random_numbers.hpp"
#include "tests/support/claim.hpp"

namespace crackle::strength_envelope_test {
namespace {

using testing::agrees;
using testing::within;

#ifdef __SANITIZE_ADDRESS__
constexpr int tries_of_coverage = 10;  // with sanitizers, each takes a second
#else
constexpr int tries_of_coverage = 100;
#endif
constexpr double unconfined = 150e6, slope = 5.0, m = 18.0;

double line(double s3) { return unconfined + slope * s3; }
double hoek_brown(double s3) { return s3 + std::sqrt(m * unconfined * s3 + unconfined * unconfined); }

/// Ten packings at six confinements. Strengths scatter by packing and by test, in proportion to the strength.
template <class Law>
std::vector<StrengthPoint> tests_of(Law&& law, double of_packing, double of_test, std::mt19937_64* generator,
                                    int packings = 10) {
    const auto normal = [&] {
        return generator == nullptr
                   ? 0.0
                   : correctly_rounded::normal_quantile(1e-12 + (1.0 - 2e-12) * uniform_number(*generator));
    };
    std::vector<StrengthPoint> tests;
    for (int packing = 0; packing < packings; ++packing) {
        const double whole = 1.0 + of_packing * normal();
        for (const double share : {0.0, 0.05, 0.1, 0.2, 0.35, 0.5}) {
            const double s3 = share * unconfined;
            tests.push_back({fmt::format("{}", packing), s3, law(s3) * (whole + of_test * normal())});
        }
    }
    return tests;
}

TEST(StrengthEnvelope, OfExactStrengthsIsTheirLaw) {
    const StrengthEnvelope straight = fit_envelope(tests_of(line, 0.0, 0.0, nullptr));
    EXPECT_TRUE(agrees("C of the line, Pa", straight.strength.value, unconfined, 1e-12));
    EXPECT_TRUE(agrees("N", straight.slope.value, slope, 1e-12));
    EXPECT_TRUE(agrees("friction angle, asin 4/6", straight.friction_angle.value, 41.810314895778596, 1e-12));
    EXPECT_TRUE(agrees("cohesion, C/(2 sqrt 5)", straight.cohesion.value, 33541019.66249685, 1e-12));
    EXPECT_TRUE(within("misfit", straight.misfit, 0.0, 1e-12));
    EXPECT_GT(straight.hoek_brown_misfit, 1e-3) << "a line is not curved";
    const StrengthEnvelope curved = fit_envelope(tests_of(hoek_brown, 0.0, 0.0, nullptr));
    EXPECT_TRUE(agrees("C of Hoek and Brown, Pa", curved.hoek_brown_strength.value, unconfined, 1e-9));
    EXPECT_TRUE(agrees("m", curved.hoek_brown_m.value, m, 1e-9));
    EXPECT_TRUE(within("misfit", curved.hoek_brown_misfit, 0.0, 1e-9));
    EXPECT_GT(curved.misfit, 1e-3);
    EXPECT_TRUE(agrees("at a confinement, Pa", curved.hoek_brown(30e6), hoek_brown(30e6), 1e-9));
}

TEST(StrengthEnvelope, OfScatteredStrengthsLiesInItsIntervalsAsOftenAsStated) {
    constexpr int tries = tries_of_coverage;
    std::mt19937_64 generator(12);
    int of_strength = 0, of_angle = 0, of_m = 0, of_curved_strength = 0;
    for (int k = 0; k < tries; ++k) {
        const StrengthEnvelope straight = fit_envelope(tests_of(line, 0.08, 0.05, &generator));
        const StrengthEnvelope curved = fit_envelope(tests_of(hoek_brown, 0.08, 0.05, &generator));
        const auto covers = [](const FittedNumber& number, double truth) {
            return number.low <= truth && truth <= number.high;
        };
        of_strength += covers(straight.strength, unconfined);
        of_angle += covers(straight.friction_angle, 41.810314895778596);
        of_curved_strength += covers(curved.hoek_brown_strength, unconfined);
        of_m += covers(curved.hoek_brown_m, m);
    }
    // Three standard deviations of a binomial count.
    const double expected = 0.95 * tries, spread = 3.0 * std::sqrt(0.95 * 0.05 * tries);
    EXPECT_TRUE(within("of all lines C in its interval", of_strength, expected, spread));
    EXPECT_TRUE(within("of all lines the angle in its interval", of_angle, expected, spread));
    EXPECT_TRUE(within("of all curves C in its interval", of_curved_strength, expected, spread));
    EXPECT_TRUE(within("of all curves m in its interval", of_m, expected, spread));
}

/// Two packings are included: the interval then extends 12.7 standard errors to either side. A bootstrap would never
/// leave the range of the two.
TEST(StrengthEnvelope, OfFewPackingsLiesInItsIntervalsAsOftenAsStated) {
    for (const int packings : {2, 3, 6}) {
        std::mt19937_64 generator(40 + static_cast<unsigned>(packings));
        constexpr int tries = 40 * tries_of_coverage;  // fast, since there is no bootstrap
        int of_strength = 0, of_angle = 0, of_m = 0;
        for (int k = 0; k < tries; ++k) {
            const auto covers = [](const FittedNumber& number, double truth) {
                return number.low <= truth && truth <= number.high;
            };
            const StrengthEnvelope straight = fit_envelope(tests_of(line, 0.08, 0.05, &generator, packings));
            const StrengthEnvelope curved = fit_envelope(tests_of(hoek_brown, 0.08, 0.05, &generator, packings));
            of_strength += covers(straight.strength, unconfined);
            of_angle += covers(straight.friction_angle, 41.810314895778596);
            of_m += covers(curved.hoek_brown_m, m);
        }
        const double expected = 0.95 * tries, spread = 3.0 * std::sqrt(0.95 * 0.05 * tries);
        EXPECT_TRUE(within(fmt::format("C in its interval, {} packings", packings), of_strength, expected, spread));
        EXPECT_TRUE(within(fmt::format("the angle, {} packings", packings), of_angle, expected, spread));
        EXPECT_TRUE(within(fmt::format("m, {} packings", packings), of_m, expected, spread));
    }
}

TEST(StrengthEnvelope, OfTwoPackingsHasTheIntervalOfStudentsT) {
    std::vector<StrengthPoint> tests;
    for (const double s3 : {0.0, 10e6, 20e6}) {
        tests.push_back({"1", s3, 100e6 + 4.0 * s3});
        tests.push_back({"2", s3, 110e6 + 4.4 * s3});
    }
    const StrengthEnvelope envelope = fit_envelope(tests);
    // Each packing alone lies on a line; half the difference of their logarithms is the standard error, t = 12.7062.
    const double half = 12.7062 * 0.5 * std::log(1.1);
    EXPECT_TRUE(agrees("slope", envelope.slope.value, 4.2, 1e-12));
    EXPECT_TRUE(agrees("its lower end", envelope.slope.low, 4.2 * std::exp(-half), 1e-5));
    EXPECT_TRUE(agrees("its upper end", envelope.slope.high, 4.2 * std::exp(half), 1e-5));
    const double upper = 4.2 * std::exp(half);
    EXPECT_TRUE(agrees("upper end of the angle", envelope.friction_angle.high,
                       std::asin((upper - 1.0) / (upper + 1.0)) * 180.0 / 3.14159265358979323846, 1e-5));
}

/// Each circle of the law touches the curve from inside: no point of the curve is closer to the centre than the radius.
TEST(StrengthEnvelope, OnThePlaneOfFailureTouchesEachCircleOfTheLaw) {
    const StrengthEnvelope envelope = fit_envelope(tests_of(hoek_brown, 0.0, 0.0, nullptr));
    const double c = unconfined;
    EXPECT_TRUE(agrees("apex -C/m", envelope.hoek_brown_on_plane(0.0).normal, -c / m, 1e-9));
    EXPECT_EQ(envelope.hoek_brown_on_plane(0.0).shear, 0.0);
    EXPECT_TRUE(agrees("and near it", envelope.hoek_brown_on_plane(1e-6 * c).normal, -c / m, 1e-5));
    for (const double s3 : {envelope.hoek_brown_tension(), 0.0, 0.1 * c, 0.5 * c}) {
        const double s1 = envelope.hoek_brown(s3), centre = 0.5 * (s1 + s3), radius = 0.5 * (s1 - s3);
        double nearest = 2.0 * radius;
        // Steps of deviatoric stress; near a minimum, the error is of the order of a step squared.
        constexpr int steps = 20'000;
        for (int k = 0; k <= steps; ++k) {
            const PlaneStress on = envelope.hoek_brown_on_plane(3.0 * (s1 - s3) * k / steps);
            nearest = std::min(nearest, std::hypot(on.normal - centre, on.shear));
        }
        EXPECT_TRUE(
            agrees(fmt::format("nearest point of the curve to the circle at {:.3g} Pa", s3), nearest, radius, 1e-7));
        const PlaneStress on = envelope.hoek_brown_on_plane(s1 - s3);
        EXPECT_TRUE(agrees("which is its own", std::hypot(on.normal - centre, on.shear), radius, 1e-12));
    }
    EXPECT_TRUE(within("s1 at the tensile strength, over C", envelope.hoek_brown(envelope.hoek_brown_tension()) / c,
                       0.0, 1e-9));
    const StrengthEnvelope straight = fit_envelope(tests_of(line, 0.0, 0.0, nullptr));
    EXPECT_TRUE(agrees("cohesion", straight.mohr_coulomb_on_plane(0.0), 33541019.66249685, 1e-12));
    EXPECT_TRUE(agrees("and tan 41.81 more at 1 Pa",
                       straight.mohr_coulomb_on_plane(1e8) - straight.mohr_coulomb_on_plane(0.0), 0.8944271909999159e8,
                       1e-12));
    EXPECT_TRUE(agrees("s1 = 0 at -C/N", straight.mohr_coulomb_tension(), -unconfined / slope, 1e-12));
}

TEST(FittedLaws, OfOnePackingsExactStrengthsAreTheirLaws) {
    const std::vector<StrengthPoint> straight = tests_of(line, 0.0, 0.0, nullptr),
                                     curved = tests_of(hoek_brown, 0.0, 0.0, nullptr);
    const FittedLaws of_line = fit_laws(std::span(straight).first(3)), of_curve = fit_laws(std::span(curved).first(6));
    EXPECT_TRUE(agrees("C", of_line.strength, unconfined, 1e-12));
    EXPECT_TRUE(agrees("friction angle", of_line.friction_angle, 41.810314895778596, 1e-12));
    EXPECT_TRUE(agrees("cohesion", of_line.cohesion, 33541019.66249685, 1e-12));
    EXPECT_TRUE(agrees("C of Hoek and Brown", of_curve.hoek_brown_strength, unconfined, 1e-9));
    EXPECT_TRUE(agrees("m", of_curve.hoek_brown_m, m, 1e-9));
    EXPECT_THROW(fit_laws(std::span(straight).first(2)), InputError);
}

TEST(StrengthEnvelope, OfTooLittleIsRefusedWithWhatThereIs) {
    std::vector<StrengthPoint> tests = tests_of(line, 0.0, 0.0, nullptr);
    std::vector<StrengthPoint> one_packing(tests.begin(), tests.begin() + 6);
    std::vector<StrengthPoint> two_confinements;
    for (const StrengthPoint& test : tests)
        if (test.confinement < 0.07 * unconfined) two_confinements.push_back(test);
    for (const auto& [few, found] : {std::pair(one_packing, "6 confinements and 1 packing,"),
                                     std::pair(two_confinements, "2 confinements and 10 packings")}) {
        try {
            fit_envelope(few);
            ADD_FAILURE() << "fitted";
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(found), std::string::npos) << error.what();
        }
    }
}

/// For two, three and one tests, results by hand: means 100, 200, 320; squared relative deviations 0.02 with one degree
/// of freedom and 0.0025 with two.
TEST(StrengthEnvelope, OfUnequalNumbersWeighsByThem) {
    const std::vector<StrengthPoint> tests{{"1", 0.0, 90.0},   {"2", 0.0, 110.0},  {"1", 10.0, 190.0},
                                           {"2", 10.0, 200.0}, {"3", 10.0, 210.0}, {"3", 20.0, 320.0}};
    const StrengthEnvelope envelope = fit_envelope(tests);
    EXPECT_TRUE(agrees("pooled scatter", envelope.variation, std::sqrt((0.02 + 2.0 * 0.0025) / 3.0), 1e-12));
    // t is 12.7062 for one degree of freedom and 4.302653 for two; deviations are sqrt(200) and 10.
    EXPECT_TRUE(agrees("upper end of the first mean", envelope.strengths[0].high, 100.0 + 12.7062 * 10.0, 1e-5));
    EXPECT_TRUE(
        agrees("lower end of the second", envelope.strengths[1].low, 200.0 - 4.302653 * 10.0 / std::sqrt(3.0), 1e-6));
    EXPECT_TRUE(std::isnan(envelope.strengths[2].high)) << "of one test";
    // With weights n/mean², the line passes through the weighted centre.
    const double x[] = {0.0, 10.0, 20.0}, y[] = {100.0, 200.0, 320.0}, n[] = {2.0, 3.0, 1.0};
    double w = 0.0, mx = 0.0, my = 0.0, xx = 0.0, xy = 0.0;
    for (int k = 0; k < 3; ++k) {
        const double weight = n[k] / y[k] / y[k];
        w += weight, mx += weight * x[k], my += weight * y[k];
    }
    mx /= w, my /= w;
    for (int k = 0; k < 3; ++k) {
        const double weight = n[k] / y[k] / y[k];
        xx += weight * (x[k] - mx) * (x[k] - mx), xy += weight * (x[k] - mx) * (y[k] - my);
    }
    const double rise = xy / xx, begin = my - rise * mx;
    EXPECT_TRUE(agrees("N", envelope.slope.value, rise, 1e-10));
    EXPECT_TRUE(agrees("C", envelope.strength.value, begin, 1e-10));
    double squares = 0.0;
    for (int k = 0; k < 3; ++k) squares += std::pow((begin + rise * x[k]) / y[k] - 1.0, 2.0);
    EXPECT_TRUE(agrees("root mean square of what it misses", envelope.misfit, std::sqrt(squares / 3.0), 1e-9));
}

TEST(StrengthEnvelope, StatesMeansAndScatterOfEachConfinement) {
    std::mt19937_64 generator(5);
    const std::vector<StrengthPoint> tests = tests_of(line, 0.1, 0.0, &generator);
    const StrengthEnvelope envelope = fit_envelope(tests);
    ASSERT_EQ(envelope.strengths.size(), 6U);
    EXPECT_EQ(envelope.packings, 10U);
    EXPECT_EQ(envelope.strengths[2].tests, 10U);
    EXPECT_TRUE(agrees("a whole packing's scatter is the same share everywhere", envelope.variation,
                       envelope.strengths[0].deviation / envelope.strengths[0].mean, 1e-9));
}

}  // namespace
}  // namespace crackle::strength_envelope_test
