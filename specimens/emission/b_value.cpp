// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/emission/b_value.hpp"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "solver/base/correctly_rounded.hpp"

namespace crackle {
namespace {

constexpr double bin_width = 0.1, above_curvature = 0.2;
constexpr double outside = 0.05;  // probability outside the 95 % interval

std::vector<double> sorted_above(std::span<const double> magnitudes, double completeness) {
    std::vector<double> above;
    for (const double m : magnitudes)
        if (m > completeness) above.push_back(m - completeness);
    std::ranges::sort(above);
    return above;
}

double mean_excess(std::span<const double> above) {
    double sum = 0.0;
    for (const double excess : above) sum += excess;
    return sum / static_cast<double>(above.size());
}

/// Kolmogorov-Smirnov distance between the distribution of sorted excesses and the exponential law with this mean.
double distance_from_law(std::span<const double> above, double mean) {
    const auto count = static_cast<double>(above.size());
    double largest = 0.0;
    for (std::size_t k = 0; k < above.size(); ++k) {
        const double below = -correctly_rounded::expm1(-above[k] / mean);
        largest =
            std::max({largest, (static_cast<double>(k) + 1.0) / count - below, below - static_cast<double>(k) / count});
    }
    return largest;
}

/// Whether a distance is below Stephens' critical value at 5 %, for an exponential law with the mean of the sample.
bool passes(double distance, double count) {
    constexpr double five_percent = 1.094;
    const double root = std::sqrt(count);
    return (distance - 0.2 / count) * (root + 0.26 + 0.5 / root) < five_percent;
}

double by_curvature(std::span<const double> magnitudes) {
    std::vector<std::int64_t> bins;
    for (const double m : magnitudes) bins.push_back(static_cast<std::int64_t>(std::floor(m / bin_width)));
    std::ranges::sort(bins);
    std::int64_t fullest = bins.front();
    std::size_t most = 0;
    for (std::size_t k = 0; k < bins.size();) {
        std::size_t end = k;
        while (end < bins.size() && bins[end] == bins[k]) ++end;
        if (end - k > most) most = end - k, fullest = bins[k];
        k = end;
    }
    return (static_cast<double>(fullest) + 0.5) * bin_width + above_curvature;
}

/// Largest number of observed magnitudes that are tried as Mc, evenly spaced by rank.
constexpr std::size_t most_tries = 64;

double by_distance(std::span<const double> magnitudes) {
    std::vector<double> sorted(magnitudes.begin(), magnitudes.end());
    std::ranges::sort(sorted);
    double best = sorted.front(), least = std::numeric_limits<double>::infinity();
    const std::size_t tried = sorted.size() - fewest_magnitudes, stride = tried / most_tries + 1;
    for (std::size_t k = 0; k < tried; k += stride) {
        const std::vector<double> above = sorted_above(std::span(sorted).subspan(k), sorted[k]);
        if (above.size() < fewest_magnitudes) break;
        const double distance = distance_from_law(above, mean_excess(above));
        if (distance < least) least = distance, best = sorted[k];
    }
    return best;
}

}  // namespace

BValue b_value_above(std::span<const double> magnitudes, double completeness) {
    BValue value;
    value.completeness = completeness;
    const std::vector<double> above = sorted_above(magnitudes, completeness);
    value.events = above.size();
    if (!value.known()) return value;
    const auto count = static_cast<double>(above.size());
    const double mean = mean_excess(above), aki = std::numbers::log10e / mean;
    value.b = aki * (count - 1.0) / count;
    double squares = 0.0;
    for (const double excess : above) squares += (excess - mean) * (excess - mean);
    value.standard_error = std::numbers::ln10 * value.b * value.b * std::sqrt(squares / (count * (count - 1.0)));
    const boost::math::chi_squared law(2.0 * count);
    value.low = aki * boost::math::quantile(law, 0.5 * outside) / (2.0 * count);
    value.high = aki * boost::math::quantile(law, 1.0 - 0.5 * outside) / (2.0 * count);
    value.a = correctly_rounded::log(count) * std::numbers::log10e + value.b * completeness;
    value.distance = distance_from_law(above, mean);
    value.straight = passes(value.distance, count);
    return value;
}

double completeness_of(std::span<const double> magnitudes, Completeness rule) {
    if (magnitudes.size() < fewest_magnitudes) return std::numeric_limits<double>::quiet_NaN();
    return rule == Completeness::maximum_curvature ? by_curvature(magnitudes) : by_distance(magnitudes);
}

BValue fit_b_value(std::span<const double> magnitudes, Completeness rule) {
    const double completeness = completeness_of(magnitudes, rule);
    if (!(completeness < std::numeric_limits<double>::infinity())) {
        BValue none;
        none.events = magnitudes.size();
        return none;
    }
    BValue value = b_value_above(magnitudes, completeness);
    if (rule == Completeness::least_distance) {
        value.standard_error = value.low = value.high = std::numeric_limits<double>::quiet_NaN();
        value.straight = false;
    }
    return value;
}

}  // namespace crackle
