// SPDX-License-Identifier: GPL-3.0-or-later
// Compares functions with MPFR at 300 bits, for arguments that occur in specimens.
#include "solver/base/correctly_rounded.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <mpfr.h>

#include <cmath>
#include <random>
#include <tuple>

namespace crackle {
namespace {

constexpr int trials = 5000;

struct Precise {
    mpfr_t value;
    explicit Precise(double x = 0.0) {
        mpfr_init2(value, 300);
        mpfr_set_d(value, x, MPFR_RNDN);
    }
    Precise(const Precise&) = delete;
    Precise& operator=(const Precise&) = delete;
    ~Precise() { mpfr_clear(value); }
};

using Function = double (*)(double);
using Reference = int (*)(mpfr_t, const mpfr_t, mpfr_rnd_t);

struct Case {
    const char* name;
    Function function;
    Reference reference;
    double low, high;
};

class CorrectlyRounded : public ::testing::TestWithParam<Case> {};

TEST_P(CorrectlyRounded, IsTheNearestDouble) {
    const Case& of = GetParam();
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> argument(of.low, of.high);
    Precise x, y;
    int wrong = 0;
    for (int k = 0; k < trials; ++k) {
        const double at = k == 0 ? of.low : k == 1 ? of.high : argument(random);
        mpfr_set_d(x.value, at, MPFR_RNDN);
        of.reference(y.value, x.value, MPFR_RNDN);
        const double expected = mpfr_get_d(y.value, MPFR_RNDN), got = of.function(at);
        if (got != expected && ++wrong < 4)
            fmt::print("  {}({:a}): expected {:a}, got {:a}\n", of.name, at, expected, got);
    }
    EXPECT_EQ(wrong, 0) << of.name << ", of " << trials;
}

namespace rounded = correctly_rounded;
INSTANTIATE_TEST_SUITE_P(Functions, CorrectlyRounded,
                         ::testing::Values(Case{"sin", &rounded::sin, &mpfr_sin, -20.0, 20.0},
                                           Case{"cos", &rounded::cos, &mpfr_cos, -20.0, 20.0},
                                           Case{"tan", &rounded::tan, &mpfr_tan, -1.5, 1.5},
                                           Case{"asin", &rounded::asin, &mpfr_asin, -1.0, 1.0},
                                           Case{"acos", &rounded::acos, &mpfr_acos, -1.0, 1.0},
                                           Case{"exp", &rounded::exp, &mpfr_exp, -30.0, 30.0},
                                           Case{"expm1", &rounded::expm1, &mpfr_expm1, -1.0, 1.0},
                                           Case{"log", &rounded::log, &mpfr_log, 1e-12, 30.0},
                                           Case{"log1p", &rounded::log1p, &mpfr_log1p, -0.999, 9.0},
                                           Case{"erfc", &rounded::erfc, &mpfr_erfc, -4.0, 9.0},
                                           Case{"tgamma", &rounded::tgamma, &mpfr_gamma, 1.0, 12.0},
                                           Case{"lgamma", &rounded::lgamma, &mpfr_lngamma, 1.0, 12.0}),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(CorrectlyRoundedPow, AndAtan2AreTheNearestDoubles) {
    std::mt19937_64 random(8);
    std::uniform_real_distribution<double> any(-3.0, 3.0);
    Precise x, y, z;
    for (int k = 0; k < trials; ++k) {
        const double a = any(random), b = any(random);
        mpfr_set_d(x.value, a, MPFR_RNDN);
        mpfr_set_d(y.value, b, MPFR_RNDN);
        mpfr_atan2(z.value, x.value, y.value, MPFR_RNDN);
        ASSERT_EQ(correctly_rounded::atan2(a, b), mpfr_get_d(z.value, MPFR_RNDN)) << a << ' ' << b;
        mpfr_abs(x.value, x.value, MPFR_RNDN);
        mpfr_pow(z.value, x.value, y.value, MPFR_RNDN);
        ASSERT_EQ(correctly_rounded::pow(std::abs(a), b), mpfr_get_d(z.value, MPFR_RNDN)) << a << ' ' << b;
    }
}

/// The root lies between the midpoints to both neighbouring doubles: Φ is below p at the lower midpoint and above p at
/// the upper one.
TEST(CorrectlyRoundedNormalQuantile, IsTheNearestDouble) {
    std::mt19937_64 random(9);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    Precise z, next, half(0.5), root_half;
    mpfr_sqrt(root_half.value, half.value, MPFR_RNDN);
    const auto below = [&](double one, double other, double p) {  // whether Φ of their middle is below p
        mpfr_set_d(z.value, one, MPFR_RNDN);
        mpfr_set_d(next.value, other, MPFR_RNDN);
        mpfr_add(z.value, z.value, next.value, MPFR_RNDN);
        mpfr_mul(z.value, z.value, half.value, MPFR_RNDN);
        mpfr_mul(z.value, z.value, root_half.value, MPFR_RNDN);
        mpfr_neg(z.value, z.value, MPFR_RNDN);
        mpfr_erfc(z.value, z.value, MPFR_RNDN);
        mpfr_mul(z.value, z.value, half.value, MPFR_RNDN);
        return mpfr_cmp_d(z.value, p) < 0;
    };
    for (int k = 0; k < trials; ++k) {
        const double u = share(random), p = k % 3 == 0   ? u * u * u * u * u * u * u * u
                                            : k % 3 == 1 ? 1.0 - u * u * u * u
                                                         : u;
        if (p <= 0.0 || p >= 1.0) continue;
        const double got = correctly_rounded::normal_quantile(p);
        EXPECT_TRUE(below(got, std::nextafter(got, -100.0), p)) << p;
        EXPECT_FALSE(below(got, std::nextafter(got, 100.0), p)) << p;
    }
}

TEST(CorrectlyRounded, NumbersThatAreNoneStayNone) {
    EXPECT_TRUE(std::isnan(correctly_rounded::sin(std::nan(""))));
    EXPECT_TRUE(std::isnan(correctly_rounded::acos(1.5)));
    EXPECT_EQ(correctly_rounded::exp(1e4), HUGE_VAL);
    EXPECT_EQ(correctly_rounded::exp(-1e4), 0.0);
    EXPECT_EQ(correctly_rounded::log(0.0), -HUGE_VAL);
    EXPECT_EQ(correctly_rounded::sin(0.0), 0.0);
    EXPECT_EQ(correctly_rounded::atan2(0.0, -1.0), std::acos(-1.0));
}

}  // namespace
}  // namespace crackle
