// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/campaign/statistics.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "specimens/packing/random_numbers.hpp"

namespace crackle {
namespace {

constexpr std::size_t bootstrap_means = 10'000;
constexpr std::uint64_t bootstrap_seed = 1;
constexpr double outside = 0.05;

/// Between sorted values, linear (type 7 of Hyndman and Fan, Am. Stat. 50, 1996).
double percentile(const std::vector<double>& sorted, double share) {
    const double at = share * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    if (below + 1 >= sorted.size()) return sorted.back();
    return sorted[below] + (at - static_cast<double>(below)) * (sorted[below + 1] - sorted[below]);
}

}  // namespace

MeanFigure mean_of(std::span<const double> values) {
    MeanFigure figure;
    figure.count = values.size();
    if (values.empty()) return figure;
    const auto count = static_cast<double>(values.size());
    double sum = 0.0;
    for (const double value : values) sum += value;
    figure.mean = sum / count;
    if (values.size() < 2) return figure;
    double squares = 0.0;
    for (const double value : values) squares += (value - figure.mean) * (value - figure.mean);
    figure.deviation = std::sqrt(squares / (count - 1.0));
    figure.standard_error = figure.deviation / std::sqrt(count);

    std::mt19937_64 generator(bootstrap_seed);
    std::vector<double> means(bootstrap_means);
    for (double& mean : means) {
        double drawn = 0.0;
        for (std::size_t k = 0; k < values.size(); ++k) drawn += values[uniform_below(generator, values.size())];
        mean = drawn / count;
    }
    std::sort(means.begin(), means.end());
    const boost::math::students_t student(count - 1.0);
    const double t = boost::math::quantile(student, 1.0 - 0.5 * outside);
    const double tail = boost::math::cdf(boost::math::normal(), -std::sqrt(count / (count - 1.0)) * t);
    figure.low = percentile(means, tail);
    figure.high = percentile(means, 1.0 - tail);
    return figure;
}

double MeanBias::standard_error() const { return std::sqrt(step_error * step_error + rate_error * rate_error); }

bool MeanBias::known() const { return std::abs(value()) > 2.0 * standard_error(); }

MeanBias bias_of(std::span<const double> step_differences, std::span<const double> rate_differences) {
    constexpr double second_order = 4.0 / 3.0, first_order = 2.0;
    const MeanFigure step = mean_of(step_differences), rate = mean_of(rate_differences);
    MeanBias bias;
    bias.pairs = std::min(step.count, rate.count);
    bias.step = second_order * step.mean;
    bias.step_error = second_order * step.standard_error;
    bias.rate = first_order * rate.mean;
    bias.rate_error = first_order * rate.standard_error;
    return bias;
}

double packings_for(double deviation, double goal) {
    return std::max(2.0, std::ceil(deviation * deviation / (goal * goal)));
}

}  // namespace crackle
