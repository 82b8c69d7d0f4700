// SPDX-License-Identifier: GPL-3.0-or-later
// Number distributions of circle radii: uniform, lognormal, or a sieve curve (grading curve, by mass).
//
// A sample is stratified: circle k of n takes a random quantile in the k-th of n equal parts of the distribution, and
// the order is then shuffled. Every circle still follows the distribution, but the whole sample follows it far more
// closely than independent draws would. The largest distance between its cumulative curve and the distribution is at
// most 1/n; independent draws give about 0.9/sqrt(n). Packings with different seeds therefore differ in their
// arrangement but not in their grading.
//
// In a sieve curve, size is a diameter [m], and passing_by_mass is the mass fraction [-] of smaller circles. Between
// two points, the fraction is linear in ln(size), as in grading diagrams. In two dimensions, mass ∝ size², so the
// number of circles between two points follows dN ∝ size⁻³ d(size).
// Tested by tests/specimens/packing/packing_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <random>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "solver/base/errors.hpp"

namespace crackle {

/// Radii between two bounds, all equally likely.
struct UniformRadii {
    double radius_min = 0.0;  ///< m, > 0
    double radius_max = 0.0;  ///< m, >= radius_min; if equal, all circles are equal

    bool operator==(const UniformRadii&) const = default;
};

/// Lognormal radii, truncated at both ends and renormalised.
struct LognormalRadii {
    double median = 0.0;         ///< m, > 0, before truncation
    double log_deviation = 0.0;  ///< standard deviation of ln(radius), > 0
    double radius_min = 0.0;     ///< m, >= 0; 0: not truncated
    double radius_max = 0.0;     ///< m; 0: not truncated

    bool operator==(const LognormalRadii&) const = default;
};

/// A point of a sieve curve.
struct SievePoint {
    double size = 0.0;             ///< diameter, m
    double passing_by_mass = 0.0;  ///< mass fraction of smaller circles, 0 to 1
};

/// Sieve curve from fraction 0 to fraction 1. Sizes increase, and fractions do not decrease.
struct SieveCurve {
    std::vector<SievePoint> points;
};

using SizeDistribution = std::variant<UniformRadii, LognormalRadii, SieveCurve>;

/// The part of a packing request to which an error refers.
enum class PackingInput : std::uint8_t {
    box,
    count,
    radius_min,
    radius_max,
    radius_median,
    radius_log_deviation,
    mean_overlap,
    void_ratio,
    whole,  ///< the request as a whole
};

/// A request for a packing that cannot be met. Its message consists of `name` and `text`.
class PackingError : public InputError {
  public:
    /// @param name of the key, with which the message begins
    PackingError(PackingInput wrong, const std::string& name, std::string found_and_expected)
        : InputError(name + found_and_expected), input(wrong), text(std::move(found_and_expected)) {}

    PackingInput input;
    std::string text;  ///< what was found and expected
};

/// @throws PackingError if a value is out of range
void validate(const SizeDistribution& sizes);

/// Radius [m] such that a fraction `probability` (0 to 1, by number) of the circles is smaller.
double radius_at(const SizeDistribution& sizes, double probability);
/// Fraction of the circles (by number) with a radius below `radius` [m].
double share_below(const SizeDistribution& sizes, double radius);

/// Stratified sample of `count` radii [m], in random order.
std::vector<double> sample_radii(const SizeDistribution& sizes, std::size_t count, std::mt19937_64& generator);

/// Largest distance between the cumulative curves of the sample and of the distribution (Kolmogorov-Smirnov statistic).
double kolmogorov_distance(const SizeDistribution& sizes, std::vector<double> radii);

/// Reads a table (solver/files/table_reader.hpp) with the columns size and passing_by_mass. The last value of
/// passing_by_mass is 1, or 100 if all values are percentages.
/// @throws InputError naming file and line
SieveCurve read_sieve_curve(const std::filesystem::path& path);

}  // namespace crackle
