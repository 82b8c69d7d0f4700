// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/statistics/mean.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "specimens/statistics/random_numbers.hpp"

namespace crackle {
namespace {

constexpr std::size_t bootstrap_means = 10'000;
constexpr std::uint64_t resampling_seed = 1;
constexpr std::size_t most_of_bootstrap = 200;
constexpr double outside = 0.05;

/// Mean, deviation and standard error.
MeanFigure moments_of(std::span<const double> values) {
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
    return figure;
}

/// Student's t for the 95 % interval.
double student_of(double freedom) {
    return boost::math::quantile(boost::math::students_t(freedom), 1.0 - 0.5 * outside);
}

double student(std::size_t count) { return student_of(static_cast<double>(count) - 1.0); }

}  // namespace

MeanFigure mean_of(std::span<const double> values) {
    MeanFigure figure = moments_of(values);
    if (values.size() < 2) return figure;
    const auto count = static_cast<double>(values.size());
    const double t = student(values.size());
    figure.low = figure.mean - t * figure.standard_error;
    figure.high = figure.mean + t * figure.standard_error;
    if (values.size() < fewest_of_bootstrap || values.size() > most_of_bootstrap) return figure;

    std::mt19937_64 generator(resampling_seed);
    std::vector<double> means(bootstrap_means);
    for (double& mean : means) {
        double drawn = 0.0;
        for (std::size_t k = 0; k < values.size(); ++k) drawn += values[uniform_below(generator, values.size())];
        mean = drawn / count;
    }
    std::sort(means.begin(), means.end());
    const double tail = expanded_tail(values.size());
    figure.low = percentile(means, tail);
    figure.high = percentile(means, 1.0 - tail);
    return figure;
}

double difference_half_width(const MeanFigure& a, const MeanFigure& b) {
    if (a.count < 2 || b.count < 2) return std::nan("");
    const double of_a = a.standard_error * a.standard_error, of_b = b.standard_error * b.standard_error;
    if (of_a + of_b == 0.0) return 0.0;
    const double freedom =
        (of_a + of_b) * (of_a + of_b) /
        (of_a * of_a / (static_cast<double>(a.count) - 1.0) + of_b * of_b / (static_cast<double>(b.count) - 1.0));
    return student_of(freedom) * std::sqrt(of_a + of_b);
}

bool MeanBias::known() const {
    if (packings < 2) return false;
    const double t = student(packings);
    return std::abs(value) > t * standard_error || std::abs(step) > t * step_error || std::abs(rate) > t * rate_error;
}

MeanBias bias_of(std::span<const double> asked, std::span<const double> half_step, std::span<const double> half_rate) {
    constexpr double first_order = 2.0;
    std::vector<double> by_step, by_rate, by_both;
    for (std::size_t k = 0; k < asked.size(); ++k) {
        by_step.push_back(first_order * (asked[k] - half_step[k]));
        by_rate.push_back(first_order * (asked[k] - half_rate[k]));
        by_both.push_back(by_step.back() + by_rate.back());
    }
    const MeanFigure step = moments_of(by_step), rate = moments_of(by_rate), both = moments_of(by_both);
    return {both.count, step.mean, step.standard_error, rate.mean, rate.standard_error, both.mean, both.standard_error};
}

double expanded_tail(std::size_t count) {
    const auto n = static_cast<double>(count);
    return boost::math::cdf(boost::math::normal(), -std::sqrt(n / (n - 1.0)) * student(count));
}

double percentile(std::span<const double> sorted, double share) {
    const double at = share * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    if (below + 1 >= sorted.size()) return sorted.back();
    return std::lerp(sorted[below], sorted[below + 1], at - static_cast<double>(below));
}

double packings_for(double deviation, double goal) {
    return std::max(2.0, std::ceil(deviation * deviation / (goal * goal)));
}

}  // namespace crackle
