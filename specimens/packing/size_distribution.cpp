// SPDX-License-Identifier: GPL-3.0-or-later
// Quantiles and cumulative distributions in closed form, so that each circle needs one evaluation.
// size_distribution.hpp describes the distributions.

#include "specimens/packing/size_distribution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "solver/base/correctly_rounded.hpp"
#include "solver/base/errors.hpp"
#include "solver/files/file_kind.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/table_reader.hpp"
#include "specimens/statistics/random_numbers.hpp"

namespace crackle {
namespace {

template <typename... T>
struct overloaded : T... {
    using T::operator()...;
};
template <typename... T>
overloaded(T...) -> overloaded<T...>;

bool positive(double value) { return value > 0.0 && std::isfinite(value); }

[[noreturn]] void refuse(const std::string& name, double found, const std::string& expected) {
    throw InputError(fmt::format("{}: found {}, expected {}", name, found, expected));
}
[[noreturn]] void refuse(PackingInput input, const char* name, double found, const std::string& expected) {
    throw PackingError(input, name, fmt::format(": found {}, expected {}", found, expected));
}

/// Inverse of the standard normal distribution Φ. Probabilities are limited to values that doubles distinguish from 0
/// and 1, so the result is finite.
double normal_quantile(double probability) {
    const double share = std::clamp(probability, std::numeric_limits<double>::min(), 1.0 - 0x1p-53);
    return correctly_rounded::normal_quantile(share);
}

/// Fractions of the untruncated distribution below the two truncation limits.
struct CutOff {
    double below_min, below_max;
};
CutOff cut_off(const LognormalRadii& sizes) {
    const auto share = [&](double radius) {
        return correctly_rounded::normal_share_below(correctly_rounded::log(radius / sizes.median) /
                                                     sizes.log_deviation);
    };
    return {sizes.radius_min > 0.0 ? share(sizes.radius_min) : 0.0,
            sizes.radius_max > 0.0 ? share(sizes.radius_max) : 1.0};
}

/// Number of circles between the lower end a of a sieve interval and `size`, if each circle has the mass size²:
///     N = slope/2·(a⁻² - size⁻²)
/// where slope is the increase of the mass fraction per unit of ln(size).
double number_in_interval(const SievePoint& a, const SievePoint& b, double size) {
    const double slope = (b.passing_by_mass - a.passing_by_mass) / correctly_rounded::log(b.size / a.size);
    return 0.5 * slope * (1.0 / (a.size * a.size) - 1.0 / (size * size));
}

double total_number(const SieveCurve& curve) {
    double total = 0.0;
    for (std::size_t k = 0; k + 1 < curve.points.size(); ++k) {
        total += number_in_interval(curve.points[k], curve.points[k + 1], curve.points[k + 1].size);
    }
    return total;
}

double sieve_radius(const SieveCurve& curve, double probability) {
    double left = probability * total_number(curve);
    for (std::size_t k = 0; k + 1 < curve.points.size(); ++k) {
        const SievePoint &a = curve.points[k], &b = curve.points[k + 1];
        const double here = number_in_interval(a, b, b.size);
        if (here > 0.0 && left <= here) {
            const double slope = (b.passing_by_mass - a.passing_by_mass) / correctly_rounded::log(b.size / a.size);
            return 0.5 * std::clamp(1.0 / std::sqrt(1.0 / (a.size * a.size) - 2.0 * left / slope), a.size, b.size);
        }
        left -= here;
    }
    return 0.5 * curve.points.back().size;
}

double sieve_share_below(const SieveCurve& curve, double radius) {
    const double size = 2.0 * radius;
    double number = 0.0;
    for (std::size_t k = 0; k + 1 < curve.points.size(); ++k) {
        const SievePoint &a = curve.points[k], &b = curve.points[k + 1];
        if (size > a.size) number += number_in_interval(a, b, std::min(size, b.size));
    }
    return number / total_number(curve);
}

// Limits for sieve sizes. Within them, squares are representable and ratios of adjacent sizes have a nonzero logarithm.
constexpr double least_sieve = 1e-30, largest_sieve = 1e30, least_growth = 1e-9;

void validate_sieve(const SieveCurve& curve) {
    if (curve.points.size() < 2)
        throw InputError(
            "sieve curve: found fewer than two points, expected at least the sizes at which the passing fraction is 0 "
            "and 1");
    for (std::size_t k = 0; k < curve.points.size(); ++k) {
        const SievePoint& point = curve.points[k];
        const std::string where = fmt::format("sieve curve: point {}", k + 1);
        if (!(point.size >= least_sieve && point.size <= largest_sieve))
            refuse(where + ": size", point.size, "a diameter > 0 in m");
        if (!(point.passing_by_mass >= 0.0 && point.passing_by_mass <= 1.0)) {
            refuse(where + ": passing_by_mass", point.passing_by_mass, "a fraction from 0 to 1");
        }
        if (k == 0) continue;
        if (!(point.size > (1.0 + least_growth) * curve.points[k - 1].size))
            refuse(where + ": size", point.size, "sizes that increase from row to row");
        if (point.passing_by_mass < curve.points[k - 1].passing_by_mass) {
            refuse(where + ": passing_by_mass", point.passing_by_mass,
                   "fractions that do not decrease from row to row");
        }
    }
    if (curve.points.front().passing_by_mass != 0.0) {
        refuse("sieve curve: first passing_by_mass", curve.points.front().passing_by_mass,
               "0, because the curve begins at the size below which there are no circles");
    }
    if (curve.points.back().passing_by_mass != 1.0) {
        refuse("sieve curve: last passing_by_mass", curve.points.back().passing_by_mass,
               "1, because the curve ends at a sieve size that all circles pass");
    }
}

}  // namespace

void validate(const SizeDistribution& sizes) {
    std::visit(
        overloaded{[](const UniformRadii& uniform) {
                       if (!positive(uniform.radius_min))
                           refuse(PackingInput::radius_min, "radius_min", uniform.radius_min, "a length > 0 in m");
                       if (!positive(uniform.radius_max) || uniform.radius_max < uniform.radius_min) {
                           refuse(PackingInput::radius_max, "radius_max", uniform.radius_max,
                                  fmt::format("a length of at least radius_min = {} m", uniform.radius_min));
                       }
                   },
                   [](const LognormalRadii& lognormal) {
                       if (!positive(lognormal.median))
                           refuse(PackingInput::radius_median, "lognormal median radius", lognormal.median,
                                  "a length > 0 in m");
                       if (!positive(lognormal.log_deviation) || lognormal.log_deviation > 2.0) {
                           refuse(PackingInput::radius_log_deviation, "lognormal standard deviation of ln(radius)",
                                  lognormal.log_deviation,
                                  "a number > 0 and at most 2 (radii from a 2000th to 2000 times the median)");
                       }
                       if (!(lognormal.radius_min >= 0.0))
                           refuse(PackingInput::radius_min, "radius_min", lognormal.radius_min, "a length >= 0 in m");
                       if (lognormal.radius_max != 0.0 && !(lognormal.radius_max > lognormal.radius_min)) {
                           refuse(PackingInput::radius_max, "radius_max", lognormal.radius_max,
                                  fmt::format("a length above radius_min = {} m", lognormal.radius_min));
                       }
                       const CutOff cut = cut_off(lognormal);
                       if (cut.below_max - cut.below_min < 1e-3) {
                           throw PackingError(
                               PackingInput::radius_min, "radius_min",
                               fmt::format(
                                   " to radius_max: found a fraction {} of the lognormal distribution in this range, "
                                   "expected at least 0.001; choose cut-offs that contain more of the distribution",
                                   cut.below_max - cut.below_min));
                       }
                   },
                   [](const SieveCurve& curve) { validate_sieve(curve); }},
        sizes);
}

double radius_at(const SizeDistribution& sizes, double probability) {
    return std::visit(
        overloaded{[&](const UniformRadii& uniform) {
                       return uniform.radius_min + probability * (uniform.radius_max - uniform.radius_min);
                   },
                   [&](const LognormalRadii& lognormal) {
                       const CutOff cut = cut_off(lognormal);
                       const double z = normal_quantile(cut.below_min + probability * (cut.below_max - cut.below_min));
                       return lognormal.median * correctly_rounded::exp(lognormal.log_deviation * z);
                   },
                   [&](const SieveCurve& curve) { return sieve_radius(curve, probability); }},
        sizes);
}

double share_below(const SizeDistribution& sizes, double radius) {
    return std::visit(overloaded{[&](const UniformRadii& uniform) {
                                     if (radius >= uniform.radius_max) return 1.0;
                                     if (radius <= uniform.radius_min) return 0.0;
                                     return (radius - uniform.radius_min) / (uniform.radius_max - uniform.radius_min);
                                 },
                                 [&](const LognormalRadii& lognormal) {
                                     const CutOff cut = cut_off(lognormal);
                                     if (radius <= 0.0) return 0.0;
                                     const double below = correctly_rounded::normal_share_below(
                                         correctly_rounded::log(radius / lognormal.median) / lognormal.log_deviation);
                                     return std::clamp((below - cut.below_min) / (cut.below_max - cut.below_min), 0.0,
                                                       1.0);
                                 },
                                 [&](const SieveCurve& curve) { return sieve_share_below(curve, radius); }},
                      sizes);
}

std::vector<double> sample_radii(const SizeDistribution& sizes, std::size_t count, std::mt19937_64& generator) {
    std::vector<double> radii(count);
    for (std::size_t k = 0; k < count; ++k) {
        const double share = (static_cast<double>(k) + uniform_number(generator)) / static_cast<double>(count);
        radii[k] = radius_at(sizes, share);
    }
    shuffle(radii, generator);
    return radii;
}

double kolmogorov_distance(const SizeDistribution& sizes, std::vector<double> radii) {
    std::sort(radii.begin(), radii.end());
    const double count = static_cast<double>(radii.size());
    double distance = 0.0;
    for (std::size_t k = 0; k < radii.size();) {
        std::size_t end = k;
        while (end < radii.size() && radii[end] == radii[k]) ++end;
        // Both sides of each value are evaluated, because the distribution of a single size has a step there.
        const double below = share_below(sizes, std::nextafter(radii[k], 0.0)), at = share_below(sizes, radii[k]);
        distance = std::max({distance, std::abs(below - static_cast<double>(k) / count),
                             std::abs(at - static_cast<double>(end) / count)});
        k = end;
    }
    return distance;
}

SieveCurve read_sieve_curve(const std::filesystem::path& path) {
    constexpr const char* expected_heading = "the column names size,passing_by_mass";
    const std::string text = read_text(path, most_bytes_of_table);
    refuse_foreign(path.string(), text, fmt::format("a table with {}", expected_heading));
    TableReader reader(path.string(), text, TableReader::Form::table);
    reader.read_heading(expected_heading);
    const auto size = reader.column("size"), passing = reader.column("passing_by_mass");
    if (!size || !passing) reader.refuse(fmt::format("'{:.40}'", reader.whole_line()), expected_heading);
    SieveCurve curve;
    while (reader.next())
        curve.points.push_back({reader.number(*size, "size"), reader.number(*passing, "passing_by_mass")});
    if (!curve.points.empty() && curve.points.back().passing_by_mass == 100.0) {
        for (SievePoint& point : curve.points) point.passing_by_mass /= 100.0;
    }
    try {
        validate_sieve(curve);
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", path.string(), error.what()));
    }
    return curve;
}

}  // namespace crackle
