// SPDX-License-Identifier: GPL-3.0-or-later
// Distribution of the random strength factors of a lattice's bonds.
// Tested by tests/verification/claims_test.cpp.

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/world/world.hpp"
#include "specimens/making/lattices.hpp"
#include "tests/bench/verify/groups.hpp"
#include "tests/bench/verify/rows.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"

namespace crackle::verification {
namespace {

std::vector<ClaimRow> random_factors_of_strength_have_their_distribution() {
    Rows rows;
    constexpr std::size_t wanted = 10000;
    constexpr double cv = 0.4, tensile = 300.0;
    constexpr auto n = static_cast<double>(wanted);
    Scene scene = triangular_lattice(60, 60, 0.02, 8e-5, rock());
    scene.bond_law = BondLaw::coulomb;
    scene.materials[0].tensile_strength = tensile;
    scene.materials[0].cohesion = tensile;
    const World unbonded = build_world(std::move(scene));
    for (const StrengthDistribution kind :
         {StrengthDistribution::normal, StrengthDistribution::lognormal, StrengthDistribution::weibull}) {
        Bonding bonding;
        bonding.factors = {kind, cv, 11};
        World world = unbonded;
        bond_all(world, bonding);
        std::vector<double> drawn;
        double apart = 0.0;
        for (PointIndex k = 0; k < world.points.size() && drawn.size() < wanted; ++k) {
            if ((world.points.state[k].flags & point_bonded) == 0) continue;
            const ContactLaw law = law_of(world, k);
            drawn.push_back(law.tensile_strength / tensile);
            apart = std::max(apart, std::abs(law.cohesion - law.tensile_strength) / tensile);
        }
        const std::string name = name_of(kind);
        rows.exactly(name + ": bonds", static_cast<double>(drawn.size()), n);
        rows.exactly(name + ": tensile strength and cohesion with different factors", apart, 0.0);
        double mean = 0.0, variance = 0.0, fourth = 0.0;
        for (const double x : drawn) mean += x / n;
        for (const double x : drawn) variance += (x - mean) * (x - mean) / (n - 1.0);
        for (const double x : drawn) fourth += std::pow(x - mean, 4) / n;
        rows.absolute(name + ": mean", mean, 1.0, 3.5 * cv / std::sqrt(n), "3.5 standard errors");
        // Standard error of a standard deviation, from the fourth moment.
        const double error = std::sqrt((fourth - variance * variance) / n) / (2.0 * std::sqrt(variance));
        rows.absolute(name + ": coefficient of variation", std::sqrt(variance) / mean, cv, 3.5 * error,
                      "3.5 standard errors");
        std::sort(drawn.begin(), drawn.end());
        double distance = 0.0;
        for (std::size_t k = 0; k < drawn.size(); ++k) {
            const double p = bonding.factors.probability(drawn[k]), below = static_cast<double>(k) / n;
            distance = std::max({distance, p - below, below + 1.0 / n - p});
        }
        rows.at_most(name + ": Kolmogorov-Smirnov distance", distance, 1.358 / std::sqrt(n), "at 5 %");
    }
    return rows.take();
}

}  // namespace

std::vector<Claim> strength_factor_claims() {
    return {
        {.name = "random_factors_of_strength_have_their_distribution",
         .group = "Bonds with given strengths",
         .statement = "the strengths of 10,000 bonds have the given mean, coefficient of variation and distribution",
         .check = random_factors_of_strength_have_their_distribution}};
}

}  // namespace crackle::verification
