// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/joints/length_law.hpp"

#include <algorithm>
#include <cmath>

#include "solver/base/correctly_rounded.hpp"
#include "specimens/statistics/random_numbers.hpp"

namespace crackle {
namespace {

namespace cr = correctly_rounded;

/// (e^(bL) - 1)/b with L = log_ratio, or its limit L for b = 0.
double grown(double b, double log_ratio) { return b == 0.0 ? log_ratio : cr::expm1(b * log_ratio) / b; }

}  // namespace

double LengthLaw::log_deviation() const {
    const double variation = second_ / first_;
    return std::sqrt(cr::log1p(variation * variation));
}
double LengthLaw::log_mean() const {
    const double deviation = log_deviation();
    return cr::log(first_) - 0.5 * deviation * deviation;
}

double LengthLaw::mean() const {
    if (kind_ != Kind::power_law) return first_;
    const double log_ratio = cr::log(second_ / first_), b = 1.0 - third_;
    return first_ * grown(b + 1.0, log_ratio) / grown(b, log_ratio);
}

double LengthLaw::share_below(double length) const {
    switch (kind_) {
        case Kind::fixed:
            return length > first_ ? 1.0 : 0.0;
        case Kind::uniform:
            return std::clamp(0.5 + 0.5 * (length - first_) / second_, 0.0, 1.0);
        case Kind::exponential:
            return length > 0.0 ? -cr::expm1(-length / first_) : 0.0;
        case Kind::lognormal:
            return length > 0.0 ? cr::normal_share_below((cr::log(length) - log_mean()) / log_deviation()) : 0.0;
        case Kind::power_law:
            break;
    }
    if (length <= first_) return 0.0;
    if (length >= second_) return 1.0;
    const double b = 1.0 - third_;
    return grown(b, cr::log(length / first_)) / grown(b, cr::log(second_ / first_));
}

double LengthLaw::exceeded_by(double share) const {
    switch (kind_) {
        case Kind::fixed:
            return first_;
        case Kind::uniform:
            return first_ + second_ * (1.0 - 2.0 * share);
        case Kind::exponential:
            return -first_ * cr::log(share);
        case Kind::lognormal:
            return cr::exp(log_mean() - log_deviation() * cr::normal_quantile(share));
        case Kind::power_law:
            break;
    }
    const double log_ratio = cr::log(second_ / first_), b = 1.0 - third_;
    const double exponent =
        b == 0.0 ? (1.0 - share) * log_ratio : cr::log1p((1.0 - share) * cr::expm1(b * log_ratio)) / b;
    return std::clamp(first_ * cr::exp(exponent), first_, second_);
}

double LengthLaw::draw(std::mt19937_64& generator) const { return exceeded_by(share_number(generator)); }

double share_number(std::mt19937_64& generator) {
    double share = 0.0;
    while (share == 0.0) share = uniform_number(generator);
    return share;
}

}  // namespace crackle
