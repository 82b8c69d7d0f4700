// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/envelope/strength_envelope.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <random>
#include <unsupported/Eigen/NonLinearOptimization>

#include "solver/base/correctly_rounded.hpp"
#include "solver/base/errors.hpp"
#include "specimens/statistics/mean.hpp"
#include "specimens/statistics/random_numbers.hpp"
#include "specimens/statistics/spoken.hpp"

namespace crackle {
namespace {

constexpr std::size_t redrawn = 10'000;
constexpr std::uint64_t bootstrap_seed = 1;
constexpr double degrees_a_radian = 180.0 / std::numbers::pi;

/// Mean strength of the tests at one confinement, with its weight in a least-squares fit.
struct WeightedPoint {
    double confinement, strength;
    double weight;  // square root of the number of tests, divided by their mean strength
};
using WeightedPoints = std::vector<WeightedPoint>;

struct Line {
    double intercept, slope;
};

/// Fits y = a + b x by least squares; each equation is multiplied by its weight.
Line weighted_line(const WeightedPoints& points, auto&& x_of, auto&& y_of, auto&& weight_of) {
    Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    for (const WeightedPoint& p : points) {
        const double w = weight_of(p) * weight_of(p), x = x_of(p), y = y_of(p);
        normal += w * (Eigen::Matrix2d() << 1.0, x, x, x * x).finished();
        right += w * y * Eigen::Vector2d(1.0, x);
    }
    const Eigen::Vector2d found = normal.ldlt().solve(right);
    return {found[0], found[1]};
}

Line fit_mohr_coulomb(const WeightedPoints& points) {
    return weighted_line(
        points, [](const WeightedPoint& p) { return p.confinement; }, [](const WeightedPoint& p) { return p.strength; },
        [](const WeightedPoint& p) { return p.weight; });
}

struct HoekBrown {
    double strength, m;
    double at(double confinement) const {
        return confinement + std::sqrt(std::max(0.0, strength * (m * confinement + strength)));
    }
};

/// Residuals for Eigen's Levenberg-Marquardt solver. The unknowns are the logarithms of C and m, which therefore stay
/// positive.
struct HoekBrownResiduals {
    using Scalar = double;
    using InputType = Eigen::VectorXd;
    using ValueType = Eigen::VectorXd;
    using JacobianType = Eigen::MatrixXd;
    enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

    const WeightedPoints& points;

    int inputs() const { return 2; }
    int values() const { return static_cast<int>(points.size()); }
    static HoekBrown law_of(const Eigen::VectorXd& x) {
        return {correctly_rounded::exp(x[0]), correctly_rounded::exp(x[1])};
    }
    int operator()(const Eigen::VectorXd& x, Eigen::VectorXd& left) const {
        const HoekBrown law = law_of(x);
        for (std::size_t k = 0; k < points.size(); ++k)
            left[static_cast<Eigen::Index>(k)] =
                points[k].weight * (law.at(points[k].confinement) - points[k].strength);
        return 0;
    }
    int df(const Eigen::VectorXd& x, Eigen::MatrixXd& slopes) const {
        const HoekBrown law = law_of(x);
        for (std::size_t k = 0; k < points.size(); ++k) {
            const double s3 = points[k].confinement, root = law.at(s3) - s3, w = points[k].weight;
            const auto row = static_cast<Eigen::Index>(k);
            slopes(row, 0) = w * law.strength * (law.m * s3 + 2.0 * law.strength) / (2.0 * root);
            slopes(row, 1) = w * law.m * law.strength * s3 / (2.0 * root);
        }
        return 0;
    }
};

HoekBrown fit_hoek_brown(const WeightedPoints& points) {
    // The error of (σ1 - σ3)² is 2 (σ1 - σ3) times that of σ1.
    const auto difference = [](const WeightedPoint& p) { return p.strength - p.confinement; };
    const Line start = weighted_line(
        points, [](const WeightedPoint& p) { return p.confinement; },
        [&](const WeightedPoint& p) { return difference(p) * difference(p); },
        [&](const WeightedPoint& p) { return p.weight / std::max(difference(p), 1e-3 * p.strength); });
    const double c = std::sqrt(std::max(start.intercept, 1e-12 * points.front().strength * points.front().strength));
    Eigen::VectorXd x(2);
    x << correctly_rounded::log(c), correctly_rounded::log(std::max(start.slope / c, 1e-3));
    HoekBrownResiduals residuals{points};
    Eigen::LevenbergMarquardt<HoekBrownResiduals> search(residuals);
    search.minimize(x);
    return HoekBrownResiduals::law_of(x);
}

/// Tests grouped by packing, in the order of the packings' names.
using PackingStrengths = std::map<std::string, std::vector<StrengthPoint>>;

PackingStrengths by_packing(std::span<const StrengthPoint> tests) {
    PackingStrengths packings;
    for (const StrengthPoint& test : tests) packings[test.packing].push_back(test);
    return packings;
}

std::vector<StrengthAt> by_confinement(std::span<const StrengthPoint> tests) {
    std::map<double, std::vector<double>> strengths;
    for (const StrengthPoint& test : tests) strengths[test.confinement].push_back(test.strength);
    std::vector<StrengthAt> all;
    for (const auto& [confinement, values] : strengths) {
        const MeanFigure mean = mean_of(values);
        all.push_back({confinement, values.size(), mean.mean, mean.deviation, mean.low, mean.high});
    }
    return all;
}

double pooled_variation(const std::vector<StrengthAt>& strengths) {
    double squares = 0.0, freedom = 0.0;
    for (const StrengthAt& at : strengths) {
        if (at.tests < 2) continue;
        const double n = static_cast<double>(at.tests) - 1.0;
        squares += n * (at.deviation / at.mean) * (at.deviation / at.mean);
        freedom += n;
    }
    return freedom > 0.0 ? std::sqrt(squares / freedom) : std::numeric_limits<double>::quiet_NaN();
}

double friction_angle(double slope) {
    return degrees_a_radian * correctly_rounded::asin(std::clamp((slope - 1.0) / (slope + 1.0), -1.0, 1.0));
}

double cohesion(const Line& line) { return line.intercept / (2.0 * std::sqrt(line.slope)); }

/// The six fitted numbers, in the order of the envelope's members.
using Numbers = std::array<double, 6>;
using FittedNumbers = std::array<FittedNumber*, 6>;
constexpr std::size_t slope_number = 1, angle_number = 2;

Numbers numbers_of(const WeightedPoints& points) {
    const Line line = fit_mohr_coulomb(points);
    const HoekBrown law = fit_hoek_brown(points);
    return {line.intercept, line.slope, friction_angle(line.slope), cohesion(line), law.strength, law.m};
}

/// Computes intervals by bootstrap: fits samples of packings of the original size, drawn with replacement.
/// @param numbers_with  fits the packings whose indices are given
void state_by_drawing(const FittedNumbers& fitted, std::size_t packings, auto&& numbers_with) {
    std::mt19937_64 generator(bootstrap_seed);
    std::array<std::vector<double>, 6> drawn;
    std::vector<std::size_t> named(packings);
    for (std::size_t n = 0; n < redrawn; ++n) {
        for (std::size_t& one : named) one = uniform_below(generator, packings);
        const std::optional<Numbers> numbers = numbers_with(named);
        if (!numbers) continue;
        for (std::size_t k = 0; k < numbers->size(); ++k)
            if (std::isfinite((*numbers)[k])) drawn[k].push_back((*numbers)[k]);
    }
    const double tail = expanded_tail(packings);
    for (std::size_t k = 0; k < fitted.size(); ++k) {
        if (drawn[k].empty()) continue;
        std::ranges::sort(drawn[k]);
        fitted[k]->low = percentile(drawn[k], tail);
        fitted[k]->high = percentile(drawn[k], 1.0 - tail);
    }
}

/// Computes intervals for few packings from Student's t about the fit, since bootstrap draws cannot leave the range of
/// the packings. The standard error comes from fits that each leave out one packing (jackknife: sqrt((n - 1)/n) times
/// the root of the sum of squares about their mean). All figures except the angle are positive, so intervals are
/// computed for their logarithms. The interval of the angle follows from that of the slope.
void state_by_leaving_out(const FittedNumbers& fitted, std::size_t packings, auto&& numbers_with) {
    std::array<std::vector<double>, 6> logarithms;
    for (std::size_t out = 0; out < packings; ++out) {
        std::vector<std::size_t> named;
        for (std::size_t k = 0; k < packings; ++k)
            if (k != out) named.push_back(k);
        const std::optional<Numbers> numbers = numbers_with(named);
        if (!numbers) return;  // some packings lack confinements, so the effect of leaving out one packing is unknown
        for (std::size_t k = 0; k < numbers->size(); ++k) logarithms[k].push_back(std::log((*numbers)[k]));
    }
    const auto n = static_cast<double>(packings);
    for (std::size_t k = 0; k < fitted.size(); ++k) {
        if (k == angle_number) continue;
        // With S the sum of squared deviations, mean_of() gives the half-width t sqrt(S/(n (n - 1))). The jackknife
        // half-width is n - 1 times this.
        const MeanFigure mean = mean_of(logarithms[k]);
        const double half = 0.5 * (mean.high - mean.low) * (n - 1.0);
        fitted[k]->low = fitted[k]->value * std::exp(-half);
        fitted[k]->high = fitted[k]->value * std::exp(half);
    }
    const FittedNumber& slope = *fitted[slope_number];
    if (!std::isfinite(slope.low)) return;
    fitted[angle_number]->low = friction_angle(slope.low);
    fitted[angle_number]->high = friction_angle(slope.high);
}

}  // namespace

FittedLaws fit_laws(std::span<const StrengthPoint> tests) {
    WeightedPoints points;
    for (const StrengthAt& at : by_confinement(tests))
        points.push_back({at.confinement, at.mean, std::sqrt(static_cast<double>(at.tests)) / at.mean});
    if (points.size() < fewest_confinements) {
        throw InputError(fmt::format("envelope: found {}, expected at least {}", counted(points.size(), "confinement"),
                                     fewest_confinements));
    }
    const std::array<double, 6> found = numbers_of(points);
    return {found[0], found[1], found[2], found[3], found[4], found[5]};
}

double StrengthEnvelope::hoek_brown(double confinement) const {
    return HoekBrown{hoek_brown_strength.value, hoek_brown_m.value}.at(confinement);
}

double StrengthEnvelope::hoek_brown_tension() const {
    const double m = hoek_brown_m.value;
    // m - sqrt(m² + 4), without cancellation for large m.
    return -2.0 * hoek_brown_strength.value / (m + std::sqrt(m * m + 4.0));
}

PlaneStress StrengthEnvelope::hoek_brown_on_plane(double deviator) const {
    const double c = hoek_brown_strength.value, m = hoek_brown_m.value;
    const double confinement = (deviator * deviator - c * c) / (m * c);
    if (deviator == 0.0) return {confinement, 0.0};
    const double k = 1.0 + m * c / (2.0 * deviator);
    return {confinement + deviator / (1.0 + k), deviator * std::sqrt(k) / (1.0 + k)};
}

double StrengthEnvelope::mohr_coulomb_on_plane(double normal) const {
    return cohesion.value + normal * (slope.value - 1.0) / (2.0 * std::sqrt(slope.value));  // tan φ
}

namespace {

/// Strengths by packing, so that both laws can be fitted to any selection of packings.
class DrawnPackings {
  public:
    /// @param points  mean strength of all packings at each confinement @param means  statistics of the same strengths
    DrawnPackings(const PackingStrengths& packings, const WeightedPoints& points, std::span<const StrengthAt> means)
        : points_(points), means_(means) {
        for (const auto& [name, own] : packings) {
            std::vector<Sums>& sums = packings_.emplace_back(points.size());
            for (const StrengthPoint& test : own) {
                const auto at = std::ranges::lower_bound(points, test.confinement, {}, &WeightedPoint::confinement);
                Sums& sum = sums[static_cast<std::size_t>(at - points.begin())];
                sum.strength += test.strength;
                sum.tests += 1.0;
            }
        }
    }

    /// Fits the six numbers to the given packings, each counted as often as it is listed; empty if no line can be
    /// fitted.
    std::optional<Numbers> operator()(const std::vector<std::size_t>& named) const {
        std::vector<Sums> sums(points_.size());
        for (const std::size_t packing : named) {
            const std::vector<Sums>& own = packings_[packing];
            for (std::size_t at = 0; at < sums.size(); ++at) {
                sums[at].strength += own[at].strength;
                sums[at].tests += own[at].tests;
            }
        }
        WeightedPoints again;
        for (std::size_t at = 0; at < sums.size(); ++at) {
            if (sums[at].tests == 0.0) continue;
            again.push_back({points_[at].confinement, sums[at].strength / sums[at].tests,
                             std::sqrt(sums[at].tests) / means_[at].mean});
        }
        if (again.size() < 2) return std::nullopt;
        return numbers_of(again);
    }

  private:
    /// Sum and number of a packing's strengths at one confinement.
    struct Sums {
        double strength = 0.0, tests = 0.0;
    };

    const WeightedPoints& points_;
    std::span<const StrengthAt> means_;
    std::vector<std::vector<Sums>> packings_;
};

/// States how far both fitted laws are from the mean strengths.
void state_misfits(StrengthEnvelope& envelope) {
    double line_squares = 0.0, law_squares = 0.0;
    for (const StrengthAt& at : envelope.strengths) {
        const double by_line = envelope.mohr_coulomb(at.confinement) / at.mean - 1.0,
                     by_law = envelope.hoek_brown(at.confinement) / at.mean - 1.0;
        line_squares += by_line * by_line;
        law_squares += by_law * by_law;
    }
    const auto confinements = static_cast<double>(envelope.strengths.size());
    envelope.misfit = std::sqrt(line_squares / confinements);
    envelope.hoek_brown_misfit = std::sqrt(law_squares / confinements);
}

}  // namespace

StrengthEnvelope fit_envelope(std::span<const StrengthPoint> tests) {
    StrengthEnvelope envelope;
    envelope.strengths = by_confinement(tests);
    const PackingStrengths packings = by_packing(tests);
    envelope.packings = packings.size();
    if (envelope.strengths.size() < fewest_confinements || packings.size() < fewest_packings) {
        throw InputError(
            fmt::format("envelope: found {} and {}, expected at least {} confinements (from 0 to half of the "
                        "unconfined strength) and at least {} packings, since strengths scatter between packings",
                        counted(envelope.strengths.size(), "confinement"), counted(packings.size(), "packing"),
                        fewest_confinements, fewest_packings));
    }
    envelope.variation = pooled_variation(envelope.strengths);
    WeightedPoints points;
    for (const StrengthAt& at : envelope.strengths)
        points.push_back({at.confinement, at.mean, std::sqrt(static_cast<double>(at.tests)) / at.mean});
    const FittedNumbers fitted{&envelope.strength,
                               &envelope.slope,
                               &envelope.friction_angle,
                               &envelope.cohesion,
                               &envelope.hoek_brown_strength,
                               &envelope.hoek_brown_m};
    const Numbers best = numbers_of(points);
    for (std::size_t k = 0; k < fitted.size(); ++k) fitted[k]->value = best[k];

    const DrawnPackings numbers_with(packings, points, envelope.strengths);
    if (packings.size() < fewest_of_bootstrap)
        state_by_leaving_out(fitted, packings.size(), numbers_with);
    else
        state_by_drawing(fitted, packings.size(), numbers_with);
    state_misfits(envelope);
    return envelope;
}

}  // namespace crackle
