// SPDX-License-Identifier: GPL-3.0-or-later
// Distributions of circle radii, by number: uniform, lognormal, or a sieve curve (grading curve, by mass).
//
// A sample is stratified: circle k of n has a random quantile out of the n-th part k of the distribution, and the
// order is then shuffled. Every circle still follows the distribution, but the sample as a whole follows it far closer
// than independent draws would (largest distance of the cumulative curves at most 1/n, against about 0.9/sqrt(n)), so
// that packings of different seeds differ in their arrangement and not in their grading.
//
// Sieve curve: size is a diameter [m], passing_by_mass the share of the mass [-] of circles smaller than that. Between
// two points the share is linear in ln(size), as grading curves are drawn. With mass ∝ size² (2D) the number of circles
// between two points goes as dN ∝ size⁻³ d(size).
// Tested by tests/specimens/packing/packing_test.cpp.
#pragma once

#include <cstddef>
#include <filesystem>
#include <random>
#include <variant>
#include <vector>

namespace crackle {

struct UniformRadii {
    double radius_min = 0.0;  ///< m, > 0
    double radius_max = 0.0;  ///< m, >= radius_min; equal: all circles alike
};

/// ln(radius) is normal, cut off at both ends (and renormalised between them).
struct LognormalRadii {
    double median = 0.0;         ///< m, > 0, before the cut-off
    double log_deviation = 0.0;  ///< standard deviation of ln(radius), > 0
    double radius_min = 0.0;     ///< m, >= 0; 0: not cut off
    double radius_max = 0.0;     ///< m; 0: not cut off
};

struct SievePoint {
    double size = 0.0;             ///< diameter, m
    double passing_by_mass = 0.0;  ///< share of the mass of circles below that size, 0 to 1
};

/// From the size nothing passes (0) to the size everything passes (1); sizes increase, shares do not decrease.
struct SieveCurve {
    std::vector<SievePoint> points;
};

using SizeDistribution = std::variant<UniformRadii, LognormalRadii, SieveCurve>;

/// @throws InputError if a value is out of its range.
void validate(const SizeDistribution& sizes);

/// Radius [m] that a share `probability` (0 to 1, by number) of the circles stay below.
double radius_at(const SizeDistribution& sizes, double probability);
/// Share of the circles (by number) with a radius below `radius` [m].
double share_below(const SizeDistribution& sizes, double radius);

/// Stratified sample of `count` radii [m], in random order.
std::vector<double> sample_radii(const SizeDistribution& sizes, std::size_t count, std::mt19937_64& generator);

/// Largest distance between the cumulative curves of the sample and of the distribution (Kolmogorov-Smirnov statistic).
double kolmogorov_distance(const SizeDistribution& sizes, std::vector<double> radii);

/// Reads a table (solver/files/table_reader.hpp) with the columns size and passing_by_mass. The last row's share may be
/// 1 or 100 (then all shares are percentages). @throws InputError naming file and line.
SieveCurve read_sieve_curve(const std::filesystem::path& path);

}  // namespace crackle
