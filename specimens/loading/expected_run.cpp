// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/loading/expected_run.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "solver/base/errors.hpp"
#include "specimens/loading/own_loading.hpp"
#include "specimens/setup/unloading.hpp"

namespace crackle {
namespace {

// Particle-steps per second and thread, from tests/benchmarks/results/throughput.md.
constexpr double rate_of_circles = 2e7, rate_of_polygons = 4e6;

// Thresholds for naming the cause of a long run: time step relative to the stable one, and RateRule::first_strain.
constexpr double small_step_share = 0.01, small_first_strain = 1e-6;

/// The most likely cause of a long run: a key and its value.
std::string likely_cause(const VirtualTest& test) {
    const ResolvedCase& asked = test.description;
    if (asked.numerics.time_step && *asked.numerics.time_step < small_step_share * test.setup.stable_time_step) {
        return fmt::format("{} = {:.3g} s, although {:.3g} s would be stable", asked.at(CaseKey::numerics_time_step),
                           *asked.numerics.time_step, test.setup.stable_time_step);
    }
    if (const double* rate = asked.loading.axial_strain_rate())
        return fmt::format("{} = {:.3g} 1/s", asked.at(CaseKey::loading_axial_strain_rate), *rate);
    if (test.setup.rate_rule.first_strain < small_first_strain) {
        return fmt::format(
            "{} = {:g}: the first bonds slide or break at a strain of {:.2g}, which requires very slow "
            "loading; check friction angles and strengths, or set axial_strain_rate",
            asked.at(CaseKey::loading_rate_tolerance), *asked.loading.rate_tolerance(),
            test.setup.rate_rule.first_strain);
    }
    return fmt::format("{} = {:g}", asked.at(CaseKey::loading_rate_tolerance), *asked.loading.rate_tolerance());
}

/// Describes a particle that is so small that it determines the time step and makes the run long; empty if there is
/// none.
std::string small_particle(const VirtualTest& test) {
    constexpr double noticed_steps = 10.0;
    const World& world = test.world;
    BodyIndex smallest = 0;
    double least = std::numeric_limits<double>::infinity(), sum = 0.0;
    for (BodyIndex b = 0; b < world.bodies.size(); ++b) {
        if (test.setup.apparatus.is_platen(b)) continue;
        const double mass = world.bodies.inertia[b].mass;
        sum += mass;
        if (mass >= least) continue;
        least = mass;
        smallest = b;
    }
    const double times = std::sqrt(sum / static_cast<double>(test.setup.specimen.particles) / least);
    if (!(times > noticed_steps)) return "";
    const BodyState& body = world.bodies.state[smallest];
    return fmt::format(
        "; particle {} at ({:.4g}, {:.4g}) m has only {:.2g} of the mean particle mass, which makes the time step "
        "about {:.2g} times shorter",
        world.bodies.info(smallest).id, body.x, body.y, 1.0 / (times * times), times);
}

}  // namespace

RunEstimate expected_run(const VirtualTest& test, double strain, double steps_per_second) {
    const parts::Loading& loading = test.description.loading;
    const double rate = loading.axial_strain_rate() != nullptr ? *loading.axial_strain_rate() : test.state.rate.rate;
    const UnloadRule unloading = unload_rule_of(loading.unloading, test.setup.rate_rule, test.state.youngs_modulus);
    const double steps = (strain + unloading.added_travel(strain)) / rate / test.world.stepping.time_step;
    return {strain, steps, steps / steps_per_second};
}

double roughly_steps_per_second(const VirtualTest& test) {
    const double rate = test.setup.specimen.polygons ? rate_of_polygons : rate_of_circles;
    return rate * test.world.workers.threads / static_cast<double>(test.world.bodies.size());
}

void refuse_endless(const VirtualTest& test, const RunEstimate& run) {
    if (run.steps <= most_steps && run.seconds <= most_seconds) return;
    constexpr double seconds_a_day = 86400.0;
    throw InputError(
        fmt::format("{} = {:g} would take {:.2g} steps, about {:.2g} days, expected at most {:g} steps and a day "
                    "without --long. The cause is {}{}",
                    test.description.at(CaseKey::loading_max_axial_strain), run.strain, run.steps,
                    run.seconds / seconds_a_day, most_steps, likely_cause(test), small_particle(test)));
}

void refuse_resting(const VirtualTest& test) {
    if (test.state.path.by_caller()) return;
    const BodyState& driver = test.world.bodies.state[test.setup.apparatus.top];
    const double place = test.setup.apparatus.axis == 0 ? driver.x : driver.y, speed = platen_speed(test);
    const double way = speed * test.world.stepping.time_step;
    if (speed > 0.0 && place + way != place) return;
    const ResolvedCase& asked = test.description;
    throw InputError(
        fmt::format("{}: found a displacement of {:.2g} m per step of the driving part, expected one that changes its "
                    "position of {:.3g} m despite round-off; the strain would stay 0. Use a higher rate",
                    asked.at(asked.loading.axial_strain_rate() != nullptr ? CaseKey::loading_axial_strain_rate
                                                                          : CaseKey::loading_rate_tolerance),
                    way, place));
}

}  // namespace crackle
