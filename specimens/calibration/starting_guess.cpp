// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/calibration/starting_guess.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

#include "specimens/calibration/rock.hpp"

namespace crackle {
namespace {

/// Constants of the formulas in the header.
struct Formulas {
    double intact_share, fall_with_scatter, share_of_bonds_strength;
    double degrees_without_m, degrees_per_m, steepest_friction;
};
constexpr Formulas of_points{0.61, 1.5, 0.7, 0.0, 1.1, 45.0}, of_faces{0.745, 1.85, 0.65, 20.0, 1.3, 50.0};

/// Strengths and pressure in Pa, and Hoek and Brown's m, as known from the targets.
struct Known {
    std::optional<double> tension, compression, m;
    std::optional<double> confined, pressure;
};

bool is_strength(const Target& target) {
    return target.over.empty() &&
           (target.figure.starts_with("peak_stress") || target.figure.starts_with("largest_stress"));
}

Known known_values(const Rock& rock, const std::vector<ResolvedCase>& tests) {
    Known known;
    for (const Target& target : rock.targets) {
        const ResolvedCase& test = tests[target.test];
        const TestKind& kind = test_kind(test.loading.kind);
        if (target.figure == "hoek_brown_m") known.m = target.value;
        if (!is_strength(target)) continue;
        if (kind.pulls()) known.tension = target.value;
        if (kind.presses() && test.pressure() == 0.0) known.compression = target.value;
        if (kind.presses() && test.pressure() > 0.0) {
            known.confined = target.value;
            known.pressure = test.pressure();
        }
    }
    if (!known.m && known.compression && known.confined) {
        const double deviator = *known.confined - *known.pressure;
        const double m =
            (deviator * deviator - *known.compression * *known.compression) / (*known.compression * *known.pressure);
        if (m > 0.0) known.m = m;
    }
    return known;
}

bool is_known_kind(const ResolvedCase& test) {
    return test.mesh && test.mesh->kind == MeshKind::voronoi && test.area_units() &&
           test.bond.facts().strengths_are_given && test.minerals.list.empty();
}

}  // namespace

std::vector<double> starting_values(const Rock& rock) {
    std::vector<double> starts;
    starts.reserve(rock.free.size());
    for (const FreeKey& free : rock.free) starts.push_back(free.start);
    if (std::ranges::all_of(rock.free, &FreeKey::start_given)) return starts;
    std::vector<ResolvedCase> tests;
    tests.reserve(rock.tests.size());
    for (std::size_t test = 0; test < rock.tests.size(); ++test) tests.push_back(rock.case_of(test, starts));
    if (!std::ranges::all_of(tests, is_known_kind)) return starts;
    const Known known = known_values(rock, tests);
    const Formulas& formulas = tests.front().bond.facts().by_faces ? of_faces : of_points;
    const auto index_of = [&](std::string_view key) {
        return static_cast<std::size_t>(std::ranges::find(rock.free, key, &FreeKey::key) - rock.free.begin());
    };
    const auto start_at = [&](std::string_view key, std::optional<double> guess) {
        const std::size_t k = index_of(key);
        if (k == rock.free.size() || rock.free[k].start_given || !guess) return;
        const double base = rock.free[k].of.empty() ? 1.0 : starts[index_of(rock.free[k].of)];
        starts[k] = std::clamp(*guess / base, rock.free[k].from, rock.free[k].to);
    };
    if (known.m)
        start_at("material.friction_angle",
                 std::min(formulas.degrees_without_m + formulas.degrees_per_m * *known.m, formulas.steepest_friction));
    const std::size_t friction = index_of("material.friction_angle");
    const double degrees =
        friction < rock.free.size() ? starts[friction] : tests.front().material.friction_angle.value_or(0.0);
    const double phi = degrees * std::numbers::pi / 180.0;
    const std::optional<parts::RandomStrengths>& random = tests.front().bond.random;
    const double share = formulas.intact_share * std::exp(-formulas.fall_with_scatter * (random ? random->cv : 0.0));
    if (known.tension) start_at("material.tensile_strength", *known.tension / share);
    if (known.compression)
        start_at("material.cohesion",
                 *known.compression * (1.0 - std::sin(phi)) / (2.0 * formulas.share_of_bonds_strength * std::cos(phi)));
    return starts;
}

}  // namespace crackle
