// SPDX-License-Identifier: GPL-3.0-or-later
// Daniels' bundle: discs in a row, each held by one platen, and pulled by another platen through a bond of random
// strength. The load is divided equally among the remaining bonds, so the largest load follows from order statistics.
// For sorted strengths x_(i) of N bonds it is max x_(i) (N - i + 1). With Weibull strengths of modulus m and scale F0
//
//     peak/(N F0) -> (m e)^(-1/m) at an opening of x = (1/m)^(1/m) times that for F0,  standard deviation x √(P(1 -
//     P)/N)
//
// with P = exp(-1/m). The mean is 0.996 [f² x⁴/(2f + x f')]^(1/3) N^(-2/3) higher, where f is the density at x (H. E.
// Daniels, 1945 and 1989; checked by simulation). This is a closed form of a strength that involves more than one
// break.
// Tested by tests/verification/claims_test.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "solver/measure/point_view.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/controls.hpp"
#include "solver/stepping/step.hpp"
#include "solver/world/world.hpp"
#include "specimens/statistics/random_numbers.hpp"
#include "tests/bench/verify/groups.hpp"
#include "tests/bench/verify/rows.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"

namespace crackle::verification {
namespace bundle_scenes {
namespace {

constexpr double radius = 0.02, pitch = 0.05, thick = 1e-3, overlap = 1e-4;  // m
constexpr double kn = 1e7, mean_strength = 10.0;                             // N/m, N
constexpr int low_id = 100001, high_id = 100002;

double scale_of(double modulus) { return mean_strength / std::tgamma(1.0 + 1.0 / modulus); }
double limit_of(double modulus) { return std::pow(modulus * std::numbers::e, -1.0 / modulus); }

/// √N times the standard deviation of the peak, relative to F0.
double spread_of(double modulus) {
    const double x = std::pow(1.0 / modulus, 1.0 / modulus), p = std::exp(-1.0 / modulus);
    return x * std::sqrt(p * (1.0 - p));
}

/// Difference of the mean peak between a finite and an infinite bundle, relative to F0.
double excess_of(double modulus, double count) {
    const double x = std::pow(1.0 / modulus, 1.0 / modulus), p = std::exp(-1.0 / modulus);
    const double f = modulus * std::pow(x, modulus - 1.0) * p;
    const double slope = f * ((modulus - 1.0) / x - modulus * std::pow(x, modulus - 1.0));
    return 0.996 * std::cbrt(f * f * std::pow(x, 4) / (2.0 * f + x * slope)) * std::pow(count, -2.0 / 3.0);
}

struct Sample {
    double mean = 0.0, deviation = 0.0;
};
Sample sample_of(const std::vector<double>& values) {
    const auto n = static_cast<double>(values.size());
    Sample sample;
    for (const double v : values) sample.mean += v / n;
    for (const double v : values) sample.deviation += (v - sample.mean) * (v - sample.mean) / (n - 1.0);
    sample.deviation = std::sqrt(sample.deviation);
    return sample;
}

/// Peaks relative to N F0, computed from sorted random numbers.
Sample order_statistics(double modulus, int count, int bundles) {
    std::mt19937_64 generator(2026);
    std::vector<double> peaks, strengths(static_cast<std::size_t>(count));
    for (int b = 0; b < bundles; ++b) {
        for (double& x : strengths) x = std::pow(-std::log1p(-uniform_number(generator)), 1.0 / modulus);
        std::sort(strengths.begin(), strengths.end());
        double peak = 0.0;
        for (std::size_t i = 0; i < strengths.size(); ++i)
            peak = std::max(peak, strengths[i] * static_cast<double>(strengths.size() - i));
        peaks.push_back(peak / count);
    }
    return sample_of(peaks);
}

World unbonded_bundle(int count) {
    Scene scene;
    scene.materials = {rock(0.0)};
    scene.materials[0].tensile_strength = mean_strength;
    scene.materials[0].cohesion = 10.0 * mean_strength;
    scene.bond_law = BondLaw::coulomb;
    scene.thick = thick;
    scene.domain.wall_present = {false, false, false, false};
    for (int k = 0; k < count; ++k) scene.add_circle_body(k + 1, 0, {{k * pitch, 0.0}, radius, 0.0});
    const double reach = radius + thick - overlap, end = count * pitch;
    scene.add_chain_body(low_id, 0, {{-pitch, -reach}, {end, -reach}}, false);
    scene.add_chain_body(high_id, 0, {{-pitch, reach}, {end, reach}}, false);
    const DofControl still{Drive::velocity, 0.0};
    scene.controls = {{count, still, still, still, 0}, {count + 1, still, still, still, 0}};
    return build_world(std::move(scene));
}

struct Pulled {
    double peak = 0.0;     // N
    double opening = 0.0;  // m, opening of a bond at the peak
};

/// Pulls one bundle beyond its peak. The discs move at half the platen's speed, so that only freed discs oscillate and
/// the platen carries the load of the remaining bonds.
/// @param start opening of a bond at which slow loading begins, m @param each further opening per step, m
/// @param enough fraction of the largest load at which the run ends
Pulled pull(World world, const StrengthFactors& factors, double start, double each, double enough) {
    const BodyIndex low = body_of_id(world, low_id), high = body_of_id(world, high_id);
    Bonding bonding;
    bonding.thick = thick;
    bonding.factors = factors;
    bonding.holds = [&](Vec2, BodyIndex i, BodyIndex j) { return i == low || j == low; };
    bond_all(world, bonding);
    const auto move = [&](double by) {
        const double speed = by / world.stepping.time_step;
        for (std::size_t b = 0; b < world.bodies.size(); ++b)
            if (b != low) world.bodies.state[b].vy = b == high ? 2.0 * speed : speed;
        const DofControl still{Drive::velocity, 0.0};
        set_control(world, high, {still, {Drive::velocity, 2.0 * speed}, still}, 0);
    };
    constexpr int approach = 100;  // number of fast steps; their breaks are found late, but before the peak
    move(start / approach);
    for (int n = 0; n < approach; ++n) step(world);
    move(each);
    Pulled result;
    for (double load = 1.0; load > enough * result.peak;) {
        compute_forces(world);
        load = -world.bodies.force[high].fy;
        if (load > result.peak) {
            result.peak = load;
            result.opening = load / kn / static_cast<double>(world.bodies.size() - 2 - world.bonds.events.size());
        }
        advance(world);
    }
    return result;
}

std::vector<ClaimRow> bundles(const std::vector<int>& counts, int number) {
    Rows rows;
    constexpr int simulated = 4000;
    for (const double modulus : {2.0, 3.0, 5.0, 10.0}) {
        const double scale = scale_of(modulus), at = std::pow(1.0 / modulus, 1.0 / modulus) * scale / kn;
        const double cv =
            std::sqrt(std::tgamma(1.0 + 2.0 / modulus) / std::pow(std::tgamma(1.0 + 1.0 / modulus), 2) - 1.0);
        for (const int count : counts) {
            const World world = unbonded_bundle(count);
            const Sample expected = order_statistics(modulus, count, simulated);
            const double error = expected.deviation * std::sqrt(1.0 / number + 1.0 / simulated);
            // The largest load found is below the true peak by at most the load increment of one step.
            const double each = 0.3 * error / expected.mean * at;
            // Strains at the peak scatter by N^(-1/3), and loads near it by N^(-2/3).
            const double start = (1.0 - 2.0 / std::cbrt(count)) * at, enough = 1.0 - 5.0 * std::pow(count, -2.0 / 3.0);
            std::vector<double> peaks, openings;
            for (int seed = 1; seed <= number; ++seed) {
                const Pulled pulled = pull(world, {StrengthDistribution::weibull, cv, seed}, start, each, enough);
                peaks.push_back(pulled.peak / (count * scale));
                openings.push_back(pulled.opening / (scale / kn));
            }
            const Sample got = sample_of(peaks);
            const std::string name = fmt::format("m = {}, N = {}: ", modulus, count);
            rows.absolute(name + "mean of peak/(N F₀)", got.mean, expected.mean, 3.5 * error, "3.5 standard errors");
            rows.shown(name + "closed form, N → ∞", limit_of(modulus));
            rows.shown(name + "with its term of finite N", limit_of(modulus) + excess_of(modulus, count));
            rows.shown(name + "standard deviation × √N", got.deviation * std::sqrt(count));
            rows.shown(name + "its closed form", spread_of(modulus));
            rows.shown(name + "opening at the peak over F₀/k_n", sample_of(openings).mean);
            rows.shown(name + "its closed form, N → ∞", at / (scale / kn));
        }
    }
    return rows.take();
}

std::vector<ClaimRow> small_bundles_have_the_strength_of_daniels() { return bundles({100}, 20); }
std::vector<ClaimRow> bundles_have_the_strength_of_daniels() { return bundles({100, 400, 1600}, 200); }

}  // namespace
}  // namespace bundle_scenes

std::vector<Claim> bundle_claims() {
    using namespace bundle_scenes;
    constexpr const char* group = "Bonds with given strengths";
    constexpr const char* statement =
        "N discs between two platens have bonds with Weibull strengths to one of them: the mean largest load follows "
        "from order statistics, as the largest x_(i) (N - i + 1) of N sorted strengths";
    return {
        {.name = "small_bundles_have_the_strength_of_daniels",
         .group = group,
         .statement = statement,
         .check = small_bundles_have_the_strength_of_daniels,
         .note = "20 bundles each are compared with 4,000 sets of sorted numbers."},
        {.name = "bundles_have_the_strength_of_daniels",
         .group = group,
         .statement = statement,
         .check = bundles_have_the_strength_of_daniels,
         .slow = true,
         .note = "200 bundles each are compared with 4,000 sets of sorted numbers. The limit (m e)^(-1/m) for N → ∞ "
                 "and Daniels' term for finite N are reported too; at N = 100, the latter differs by up to two "
                 "standard errors."},
    };
}

}  // namespace crackle::verification
