// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/joints/orientation_law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "solver/base/correctly_rounded.hpp"
#include "solver/base/errors.hpp"
#include "specimens/joints/length_law.hpp"
#include "specimens/statistics/random_numbers.hpp"

namespace crackle {
namespace {

namespace cr = correctly_rounded;
constexpr double pi = std::numbers::pi;

Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
double norm(Vec3 a) { return std::sqrt(dot(a, a)); }
Vec3 sum(double s, Vec3 a, double t, Vec3 b, double u = 0.0, Vec3 c = {}) {
    return {s * a.x + t * b.x + u * c.x, s * a.y + t * b.y + u * c.y, s * a.z + t * b.z + u * c.z};
}

/// Angle of the line in which a plane intersects the section, rad.
double trace_angle(Vec3 normal, const Section& section) {
    const Vec3 line = cross(normal, cross(section.along_x, section.along_y));
    return cr::atan2(dot(line, section.along_y), dot(line, section.along_x));
}

/// I1(κ)/I0(κ) from the continued fraction 1/(2/κ + 1/(4/κ + ...)), which needs only basic arithmetic.
double mean_resultant(double kappa) {
    // Each term k below κ reduces the error by a factor of 1 - 2k/κ.
    const int terms = 40 + static_cast<int>(8.0 * std::sqrt(kappa));
    double tail = 0.0;
    for (int k = terms; k >= 1; --k) tail = 1.0 / (2.0 * k / kappa + tail);
    return tail;
}

}  // namespace

Section Section::vertical(double trend) { return {{cr::sin(trend), cr::cos(trend), 0.0}, {0.0, 0.0, 1.0}}; }
Section Section::horizontal(double trend) {
    return {{cr::sin(trend), cr::cos(trend), 0.0}, {-cr::cos(trend), cr::sin(trend), 0.0}};
}

OrientationLaw OrientationLaw::fixed(double mean) {
    OrientationLaw law;
    law.mean_ = mean;
    return law;
}
OrientationLaw OrientationLaw::uniform(double mean, double deviation) {
    OrientationLaw law = fixed(mean);
    law.kind_ = Kind::uniform;
    law.spread_ = deviation;
    return law;
}
OrientationLaw OrientationLaw::von_mises(double mean, double kappa) {
    OrientationLaw law = fixed(mean);
    law.kind_ = Kind::von_mises;
    law.spread_ = kappa;
    return law;
}
OrientationLaw OrientationLaw::fisher(double dip, double dip_direction, double k, const Section& section) {
    OrientationLaw law;
    law.kind_ = Kind::fisher;
    law.spread_ = k;
    law.section_ = section;
    // Upward normal, inclined towards the dip direction.
    law.normal_ = {cr::sin(dip) * cr::sin(dip_direction), cr::sin(dip) * cr::cos(dip_direction), cr::cos(dip)};
    law.aside_ = {cr::cos(dip_direction), -cr::sin(dip_direction), 0.0};  // along the strike
    law.across_ = cross(law.normal_, law.aside_);
    constexpr double parallel = 1e-6;  // sine of an angle below which a plane and the section count as parallel
    if (norm(cross(law.normal_, cross(section.along_x, section.along_y))) < parallel)
        throw InputError("found a mean plane that lies in the section, expected one that cuts it");
    law.mean_ = trace_angle(law.normal_, section);
    return law;
}

double OrientationLaw::draw_von_mises(std::mt19937_64& generator) const {
    const double tau = 1.0 + std::sqrt(1.0 + 4.0 * spread_ * spread_);
    const double rho = (tau - std::sqrt(2.0 * tau)) / (2.0 * spread_);
    const double r = (1.0 + rho * rho) / (2.0 * rho);
    while (true) {
        const double z = cr::cos(pi * uniform_number(generator));
        const double f = (1.0 + r * z) / (r + z), c = spread_ * (r - f);
        const double u = share_number(generator);
        if (c * (2.0 - c) <= u && cr::log(c / u) + 1.0 - c < 0.0) continue;
        const double twice = cr::acos(std::clamp(f, -1.0, 1.0));
        return mean_ + (uniform_number(generator) < 0.5 ? -0.5 : 0.5) * twice;
    }
}

double OrientationLaw::draw_fisher(std::mt19937_64& generator) const {
    const Vec3 normal_of_section = cross(section_.along_x, section_.along_y);
    while (true) {
        const double u = uniform_number(generator);
        // 1 - cos d, without cancellation for small d.
        const double lack = std::min(-cr::log1p(u * cr::expm1(-2.0 * spread_)) / spread_, 2.0);
        const double sine = std::sqrt(lack * (2.0 - lack)), round = 2.0 * pi * uniform_number(generator);
        const Vec3 n = sum(1.0 - lack, normal_, sine * cr::cos(round), aside_, sine * cr::sin(round), across_);
        if (uniform_number(generator) < norm(cross(n, normal_of_section))) return trace_angle(n, section_);
    }
}

double OrientationLaw::draw(std::mt19937_64& generator) const {
    switch (kind_) {
        case Kind::uniform:
            return mean_ + spread_ * (2.0 * uniform_number(generator) - 1.0);
        case Kind::von_mises:
            return draw_von_mises(generator);
        case Kind::fisher:
            return draw_fisher(generator);
        case Kind::fixed:
            break;
    }
    return mean_;
}

/// Upper bound on the fraction of lines that deviate from the mean by an angle d whose cosine is less than c:
///       von Mises  2 asin(c) e^(-2κ(1 - c²))/I, where I = ∫ e^(-κ(1 - cos ψ)) dψ from 0 to π, ψ = 2d. I is at least
///                  e^(-1/2) min(π, 1/√κ)
///       Fisher     e^(-K(1 - cos δ))/w for normals at more than δ from the mean normal, sin δ = sin γ sin d. Here γ is
///                  the angle between the mean normal and the section's; the mean weight w is at least sin γ K/(3 + K)
double OrientationLaw::share_beyond(double cosine) const {
    if (kind_ == Kind::von_mises) {
        const double least = std::min(pi, 1.0 / std::sqrt(spread_)) * cr::exp(-0.5);
        return 2.0 * cr::asin(cosine) * cr::exp(-2.0 * spread_ * (1.0 - cosine * cosine)) / least;
    }
    const double sine_of_mean = norm(cross(normal_, cross(section_.along_x, section_.along_y)));
    const double sine = sine_of_mean * std::sqrt(1.0 - cosine * cosine);
    const double lack = sine * sine / (1.0 + std::sqrt(1.0 - std::min(sine * sine, 1.0)));
    return cr::exp(-spread_ * lack) * (3.0 + spread_) / (spread_ * sine_of_mean);
}

double OrientationLaw::stretch() const {
    constexpr double beyond_it = 1e-3, largest = 1024.0;
    if (kind_ == Kind::fixed) return 1.0;
    if (kind_ == Kind::uniform) return spread_ < 0.5 * pi ? std::min(1.0 / cr::cos(spread_), largest) : largest;
    // The density decreases from the mean direction to 90 degrees from it. Therefore, an interval of angles that ends
    // at 90 degrees has a smaller fraction of the remaining lines than of the remaining angles. At 1024,
    // asin(1/1024)/90 degrees is less than 0.001.
    double stretch = 1.0;
    for (double share = 1.0; share > beyond_it && stretch < largest; stretch *= 2.0) {
        const double narrower = cr::asin(0.5 / stretch) / cr::asin(1.0 / stretch);
        share = std::min(share * narrower, share_beyond(0.5 / stretch));
    }
    return stretch;
}

double fitted_kappa(double resultant, std::size_t count) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    if (count < 2 || std::isnan(resultant)) return none;
    constexpr double largest = 1e6;  // at this concentration, directions within 0.05 degrees count as parallel
    if (!(resultant < mean_resultant(largest))) return std::numeric_limits<double>::infinity();
    if (count < fewest_directions) return none;
    double low = 0.0, high = largest;
    for (int halving = 0; halving < 60; ++halving) {
        const double middle = 0.5 * (low + high);
        (mean_resultant(middle) < resultant ? low : high) = middle;
    }
    const double kappa = low, n = static_cast<double>(count);
    if (count > 15) return kappa;
    if (kappa < 2.0) return std::max(kappa - 2.0 / (n * kappa), 0.0);
    return (n - 1.0) * (n - 1.0) * (n - 1.0) * kappa / (n * (n * n + 1.0));
}

}  // namespace crackle
