// SPDX-License-Identifier: GPL-3.0-or-later
// Distributions of the directions of traces in the model's plane, as angles of undirected lines from +x, rad,
// counter-clockwise:
//       fixed      θ = μ
//       uniform    from μ - deviation to μ + deviation
//       von Mises  density ~ exp(κ cos 2(θ - μ)), drawn by Best & Fisher, Appl. Stat. 28, 1979
//       Fisher     planes whose normals are at the angle d from the mean normal, density ~ exp(K cos d) sin d:
//                  cos d = 1 + ln(1 - u(1 - e^(-2K)))/K, uniform around it. A trace is the intersection of a plane with
//                  the section; a plane meets the section with a frequency ~ |n × n_section| (Terzaghi 1965)
// Tested by tests/specimens/joints/orientation_law_test.cpp.
#pragma once

#include <cstdint>
#include <limits>
#include <random>

namespace crackle {

/// Vector in space: east, north, up.
struct Vec3 {
    double x = 0.0, y = 0.0, z = 0.0;

    bool operator==(const Vec3&) const = default;
};

/// The plane of the model in space, given by unit vectors along its axes.
struct Section {
    Vec3 along_x, along_y;

    /// Vertical section with +y up. @param trend  direction of +x, rad from north, clockwise
    static Section vertical(double trend);
    /// Horizontal section, seen from above. @param trend  direction of +x, rad from north, clockwise
    static Section horizontal(double trend);

    bool operator==(const Section&) const = default;
};

/// Distribution of the directions of traces.
class OrientationLaw {
  public:
    /// All directions are equal. @param mean  rad
    static OrientationLaw fixed(double mean);
    /// Uniform distribution. @param mean  rad @param deviation  half of the range, rad
    static OrientationLaw uniform(double mean, double deviation);
    /// Axial von Mises distribution. @param mean  rad @param kappa  concentration, >= 0
    static OrientationLaw von_mises(double mean, double kappa);
    /// Traces of planes whose normals have a Fisher distribution.
    /// @param dip, dip_direction  orientation of the mean plane, rad; dip_direction from north, clockwise
    /// @throws InputError if the mean plane lies in the section and therefore has no trace
    static OrientationLaw fisher(double dip, double dip_direction, double k, const Section& section);

    /// Mean direction, or direction of the trace of the mean plane, rad.
    double mean() const { return mean_; }
    /// κ of an axial von Mises distribution; NaN for the others.
    double kappa() const { return kind_ == Kind::von_mises ? spread_ : std::numeric_limits<double>::quiet_NaN(); }
    /// Whether all directions are the same.
    bool single() const { return kind_ == Kind::fixed; }
    /// Draws a direction, rad.
    double draw(std::mt19937_64& generator) const;
    /// Factor by which lines must be drawn from farther away, so that nearly all lines that cross a disc are included.
    /// It is 1/cos of the deviation from the mean that at most one line in a thousand exceeds, at most 1024.
    double stretch() const;

    bool operator==(const OrientationLaw&) const = default;

  private:
    enum class Kind : std::uint8_t { fixed, uniform, von_mises, fisher };
    Kind kind_ = Kind::fixed;
    double mean_ = 0.0;
    double spread_ = 0.0;  // deviation (rad), κ or K, depending on the kind
    Vec3 normal_, aside_, across_;
    Section section_;

    double share_beyond(double cosine) const;
    double draw_von_mises(std::mt19937_64& generator) const;
    double draw_fisher(std::mt19937_64& generator) const;
};

/// Smallest number of directions to which κ is fitted.
inline constexpr std::size_t fewest_directions = 5;
/// Maximum-likelihood estimate of κ: I1(κ)/I0(κ) = R, where R is the length of the mean vector of the doubled angles.
/// For up to 15 directions the bias is removed (Best & Fisher, Comm. Stat. B 10, 1981). Infinite for parallel
/// directions, NaN for too few.
double fitted_kappa(double resultant, std::size_t count);

}  // namespace crackle
