// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of direction, of traces in the model's plane: rad from +x, counter-clockwise, of lines that point both ways.
//     fixed      θ = μ
//     uniform    within a deviation of μ either way
//     von Mises  density ~ exp(κ cos 2(θ - μ)), drawn by Best & Fisher, Appl. Stat. 28, 1979
//     Fisher     planes whose normals lie at d from the mean one, density ~ exp(K cos d) sin d:
//                cos d = 1 + ln(1 - u(1 - e^(-2K)))/K, all round it alike; a trace is the line in which a plane meets
//                the section, and a plane meets it as often as |n × n_section| says (Terzaghi 1965)
// Tested by tests/specimens/joints/orientation_law_test.cpp.
#pragma once

#include <cstdint>
#include <random>

namespace crackle {

/// East, north, up.
struct Vec3 {
    double x = 0.0, y = 0.0, z = 0.0;
};

/// The plane of the model in space: unit vectors along its axes.
struct Section {
    Vec3 along_x, along_y;

    /// +x towards the trend, rad from north, clockwise; +y up.
    static Section vertical(double trend);
    /// Seen from above.
    static Section horizontal(double trend);
};

class OrientationLaw {
  public:
    static OrientationLaw fixed(double mean);
    static OrientationLaw uniform(double mean, double deviation);
    static OrientationLaw von_mises(double mean, double kappa);
    /// @param dip, dip_direction  rad, of the mean plane; the direction from north, clockwise
    /// @throws InputError where the mean plane lies in the section: it has no trace
    static OrientationLaw fisher(double dip, double dip_direction, double k, const Section& section);

    /// Of the mean trace, or the trace of the mean plane, rad.
    double mean() const { return mean_; }
    /// Whether all are the same.
    bool single() const { return kind_ == Kind::fixed; }
    /// rad
    double draw(std::mt19937_64& generator) const;
    /// 1/cos of an angle from the mean that at most one line in a thousand exceeds: so many times further off than
    /// lines of the mean direction do lines beside each other still meet a disc. 1 to 1024, for parallel lines 1.
    double stretch() const;

  private:
    enum class Kind : std::uint8_t { fixed, uniform, von_mises, fisher };
    Kind kind_ = Kind::fixed;
    double mean_ = 0.0;
    double spread_ = 0.0;  // deviation, κ or K
    Vec3 normal_, aside_, across_;
    Section section_;

    double share_beyond(double cosine) const;
    double draw_von_mises(std::mt19937_64& generator) const;
    double draw_fisher(std::mt19937_64& generator) const;
};

/// Fewer directions than this say nothing of their scatter.
inline constexpr std::size_t fewest_directions = 5;
/// κ by maximum likelihood of directions whose mean vector at twice the angle has this length: I1(κ)/I0(κ) = R, for up
/// to 15 of them less the bias of so few (Best & Fisher, Comm. Stat. B 10, 1981); infinite of parallel ones, of too few
/// not a number.
double fitted_kappa(double resultant, std::size_t count);

}  // namespace crackle
