// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/statistics/rosin_rammler.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <numeric>
#include <vector>

#include "solver/base/correctly_rounded.hpp"

namespace crackle {
namespace {

// Range of exponents n that is searched: from sizes spread over decades to sizes equal to within one percent.
constexpr double least_exponent = 0.02, largest_exponent = 100.0;
constexpr int half_digits = 26;  // rounding limits the position of a minimum to half the digits of a double

}  // namespace

RosinRammler fit_rosin_rammler(std::span<const double> sizes, std::span<const double> areas, double least) {
    std::vector<double> ratio, weight;  // ratio of each size to `least`
    double all = 0.0;
    for (std::size_t k = 0; k < sizes.size(); ++k) {
        if (sizes[k] < least) continue;
        ratio.push_back(sizes[k] / least);
        weight.push_back(areas[k]);
        all += areas[k];
    }
    RosinRammler fit;
    fit.pieces = ratio.size();
    if (ratio.size() < fewest_pieces) return fit;
    const auto [smallest, largest] = std::ranges::minmax(ratio);
    if (!(largest > smallest)) return fit;
    double mean_log = 0.0;
    for (std::size_t k = 0; k < ratio.size(); ++k) mean_log += weight[k] / all * correctly_rounded::log(ratio[k]);
    // For given n, the best (x0/least)^n is the weighted mean of (x/least)^n - 1.
    const auto scale_of = [&](double n) {
        double mean = 0.0;
        for (std::size_t k = 0; k < ratio.size(); ++k)
            mean += weight[k] / all * correctly_rounded::expm1(n * correctly_rounded::log(ratio[k]));
        return mean;
    };
    const auto minus_likelihood = [&](double log_n) {
        const double n = correctly_rounded::exp(log_n);
        return -(log_n - correctly_rounded::log(scale_of(n)) + (n - 1.0) * mean_log - 1.0);
    };
    const double log_n = boost::math::tools::brent_find_minima(minus_likelihood, correctly_rounded::log(least_exponent),
                                                               correctly_rounded::log(largest_exponent), half_digits)
                             .first;
    const double exponent = correctly_rounded::exp(log_n);
    // The likelihood still grows towards n = 0, so the law does not apply.
    if (exponent < 2.0 * least_exponent) return fit;
    fit.exponent = exponent;
    fit.size = least * correctly_rounded::pow(scale_of(fit.exponent), 1.0 / fit.exponent);
    return fit;
}

double median_size(std::span<const double> sizes, std::span<const double> areas) {
    std::vector<std::size_t> order(sizes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t k) { return sizes[k]; });
    const double half = 0.5 * std::accumulate(areas.begin(), areas.end(), 0.0);
    double passed = 0.0, size_before = 0.0;
    for (const std::size_t k : order) {
        if (passed + areas[k] >= half) {
            const double share = (half - passed) / areas[k];
            return size_before == 0.0 ? sizes[k] : std::lerp(size_before, sizes[k], share);
        }
        passed += areas[k];
        size_before = sizes[k];
    }
    return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace crackle
