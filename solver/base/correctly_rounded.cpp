// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/base/correctly_rounded.hpp"

#include <mpfr.h>

#include <boost/math/special_functions/erf.hpp>
#include <cmath>

namespace crackle::correctly_rounded {
namespace {

/// Frees MPFR's per-thread cache of constants such as π when the thread ends.
struct CacheOfThread {
    CacheOfThread() = default;
    CacheOfThread(const CacheOfThread&) = delete;
    CacheOfThread& operator=(const CacheOfThread&) = delete;
    ~CacheOfThread() { mpfr_free_cache(); }
    void use() const {}
};
const thread_local CacheOfThread cache_of_thread;

/// An MPFR number, by default with the precision of a double. MPFR functions compute exactly and round to nearest once.
class Number {
  public:
    explicit Number(mpfr_prec_t bits = 53) {
        cache_of_thread.use();  // creates the cache when first used in a thread
        mpfr_init2(value_, bits);
    }
    explicit Number(double x, mpfr_prec_t bits = 53) : Number(bits) { mpfr_set_d(value_, x, MPFR_RNDN); }
    Number(const Number&) = delete;
    Number& operator=(const Number&) = delete;
    ~Number() { mpfr_clear(value_); }

    mpfr_ptr operator*() { return value_; }
    double rounded() const { return mpfr_get_d(value_, MPFR_RNDN); }

  private:
    mpfr_t value_;
};

/// Returns the double nearest to the true value. @param close approximation to within a few units in the last place
/// (relative 2^-63); the glibc manual states errors of at most 5 units for these functions @param exact function that
/// returns the exactly rounded value; called if `close` does not determine which double is nearest
template <class Exact>
double nearest(long double close, Exact exact) {
    const long double margin = 0x1p-59L * std::abs(close);
    const auto low = static_cast<double>(close - margin), high = static_cast<double>(close + margin);
    return low == high ? low : exact();
}

using OfOne = int (*)(mpfr_t, const mpfr_t, mpfr_rnd_t);
double exactly(OfOne f, double x) {
    Number result, argument(x);
    f(*result, *argument, MPFR_RNDN);
    return result.rounded();
}

using OfTwo = int (*)(mpfr_t, const mpfr_t, const mpfr_t, mpfr_rnd_t);
double exactly(OfTwo f, double x, double y) {
    Number result, first(x), second(y);
    f(*result, *first, *second, MPFR_RNDN);
    return result.rounded();
}

/// One Newton step in 200-bit arithmetic. It squares the relative error, so 60 correct bits become 120.
double exact_quantile(long double close, double p) {
    constexpr mpfr_prec_t bits = 200;
    Number z(bits), share(bits), density(bits), scale(bits);
    mpfr_set_ld(*z, close, MPFR_RNDN);
    mpfr_sqrt_ui(*scale, 2, MPFR_RNDN);
    mpfr_div(*share, *z, *scale, MPFR_RNDN);
    mpfr_neg(*share, *share, MPFR_RNDN);
    mpfr_erfc(*share, *share, MPFR_RNDN);
    mpfr_div_2ui(*share, *share, 1, MPFR_RNDN);
    mpfr_sub_d(*share, *share, p, MPFR_RNDN);
    mpfr_sqr(*density, *z, MPFR_RNDN);
    mpfr_div_2ui(*density, *density, 1, MPFR_RNDN);
    mpfr_neg(*density, *density, MPFR_RNDN);
    mpfr_exp(*density, *density, MPFR_RNDN);
    mpfr_const_pi(*scale, MPFR_RNDN);
    mpfr_mul_2ui(*scale, *scale, 1, MPFR_RNDN);
    mpfr_sqrt(*scale, *scale, MPFR_RNDN);
    mpfr_div(*density, *density, *scale, MPFR_RNDN);
    mpfr_div(*share, *share, *density, MPFR_RNDN);
    mpfr_sub(*z, *z, *share, MPFR_RNDN);
    return z.rounded();
}

}  // namespace

double sin(double x) {
    return nearest(std::sin(static_cast<long double>(x)), [x] { return exactly(&mpfr_sin, x); });
}
double cos(double x) {
    return nearest(std::cos(static_cast<long double>(x)), [x] { return exactly(&mpfr_cos, x); });
}
double tan(double x) {
    return nearest(std::tan(static_cast<long double>(x)), [x] { return exactly(&mpfr_tan, x); });
}
double asin(double x) {
    return nearest(std::asin(static_cast<long double>(x)), [x] { return exactly(&mpfr_asin, x); });
}
double acos(double x) {
    return nearest(std::acos(static_cast<long double>(x)), [x] { return exactly(&mpfr_acos, x); });
}
double atan2(double y, double x) {
    return nearest(std::atan2(static_cast<long double>(y), static_cast<long double>(x)),
                   [y, x] { return exactly(&mpfr_atan2, y, x); });
}
double exp(double x) {
    return nearest(std::exp(static_cast<long double>(x)), [x] { return exactly(&mpfr_exp, x); });
}
double expm1(double x) {
    return nearest(std::expm1(static_cast<long double>(x)), [x] { return exactly(&mpfr_expm1, x); });
}
double log(double x) {
    return nearest(std::log(static_cast<long double>(x)), [x] { return exactly(&mpfr_log, x); });
}
double log1p(double x) {
    return nearest(std::log1p(static_cast<long double>(x)), [x] { return exactly(&mpfr_log1p, x); });
}
double pow(double x, double y) {
    return nearest(std::pow(static_cast<long double>(x), static_cast<long double>(y)),
                   [x, y] { return exactly(&mpfr_pow, x, y); });
}
double erfc(double x) {
    return nearest(std::erfc(static_cast<long double>(x)), [x] { return exactly(&mpfr_erfc, x); });
}

// These functions always use MPFR: they are called only a few times per specimen, and the long double lgamma() is
// inaccurate near its zeros.
double tgamma(double x) { return exactly(&mpfr_gamma, x); }
double lgamma(double x) { return exactly(&mpfr_lngamma, x); }

double normal_share_below(double z) { return 0.5 * erfc(-z / std::sqrt(2.0)); }

double normal_quantile(double p) {
    // In long double, 2p and 1 - 2p are exact.
    const long double close = -std::sqrt(2.0L) * boost::math::erfc_inv(2.0L * static_cast<long double>(p));
    return nearest(close, [close, p] { return exact_quantile(close, p); });
}

}  // namespace crackle::correctly_rounded
