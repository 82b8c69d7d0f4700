// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/results/notices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "specimens/measures/parting.hpp"

namespace crackle {

std::vector<std::string> notices_of(const TestCase& test, const TestSetup& setup, const TestState& state,
                                    const World& world, double viscous_share) {
    constexpr std::int64_t rows_that_resolve = 100;
    constexpr double closing_error_to_mention = 2e-3;  // twice the most that the guide's rock leaves by default
    constexpr double share_above_to_mention = 0.25;
    std::vector<std::string> notices = setup.notices;
    const FailureTracker& f = state.failure;
    if (f.failed && f.peak_row < rows_that_resolve) {
        notices.push_back(
            fmt::format("only {} rows of the curve lie before the peak: peak and moduli are coarse; lower "
                        "loading.max_axial_strain = {} towards {:.2g}",
                        f.peak_row, test.loading.max_axial_strain, 10.0 * f.peak_strain));
    }
    if (f.failed && f.larger_after_peak()) {
        notices.push_back(
            fmt::format("the largest stress, {:.4g} {} at strain {:.4g}, comes after the peak of {:.4g} {} at {:.4g}, "
                        "below which the stress had stayed by more than loading.strength_drop = {}: what is broken "
                        "carries again; the strength is the peak",
                        f.largest_stress, test.stress_unit(), f.strain_at_largest, f.peak_stress, test.stress_unit(),
                        f.peak_strain, test.loading.strength_drop));
    }
    if (world.stepping.time_step > setup.stable_time_step) {
        notices.push_back(
            fmt::format("the time step of {:.3g} s lies above the stable bound of {:.3g} s: this shows the limit, its "
                        "numbers are no results",
                        world.stepping.time_step, setup.stable_time_step));
    }
    const CurveRow last = state.rows.empty() ? CurveRow{} : state.rows.back();
    if (std::abs(last.energy_error) > closing_error_to_mention * std::abs(last.platen_work)) {
        notices.push_back(
            fmt::format("the energy balance misses {:.3g} of the platens' work: halve numerics.safety_factor, or load "
                        "more slowly, and compare",
                        last.energy_error / last.platen_work));
    }
    if (world.membrane.open > 0) {
        notices.emplace_back(
            "the specimen parted so far that no membrane could be laid about it: from there on the pressure acted "
            "where it had been");
    }
    const std::optional<Parting> parting = find_parting(setup, state.history);
    if (f.failed && setup.uniaxial && !setup.compression && parting && parting->place != "gauge") {
        notices.push_back(fmt::format(
            "the specimen parted at its {}: {} of the {} bonds of the largest crack are a platen's; the strength is "
            "not the rock's{}",
            parting->place, parting->of_platen, parting->bonds,
            parting->place == "platen" ? "; platens = \"glued\" hold it" : "; a deeper grip, or a longer specimen"));
    }
    const auto deepest = std::ranges::min_element(state.rows, {}, &CurveRow::lateral_strain);
    if (setup.normal_spring > 0.0 && deepest != state.rows.end() &&
        setup.normal_force + setup.normal_spring * deepest->lateral_strain * setup.height < 0.0) {
        notices.push_back(fmt::format(
            "the upper box sank by {:.3g} m, and its spring drew it up: the normal stress was below 0; give "
            "more of it, or less normal_stiffness",
            -deepest->lateral_strain * setup.height));
    }
    if (const TestCase::Loading& loading = test.loading; loading.unloads()) {
        const auto& asked = loading.unload_at_strain ? *loading.unload_at_strain : *loading.unload_at_stress;
        if (state.path.unloaded < std::ssize(asked)) {
            notices.push_back(fmt::format("{} of {} unloadings were reached before the test ended", state.path.unloaded,
                                          asked.size()));
        }
    }
    if (!test.loading.rate_tolerance) return notices;
    const double above = state.share_above_tolerance();
    if (above > share_above_to_mention) {
        notices.push_back(
            fmt::format("the inertia error lay above rate_tolerance = {} over {:.0f} % of the strain: breaks release "
                        "energy faster than loading can slow down; --verify shows what half the rate changes",
                        *test.loading.rate_tolerance, 100.0 * above));
    }
    if (viscous_share > *test.loading.rate_tolerance) {
        notices.push_back(
            fmt::format("the dashpots bear {:.2g} of the largest stress when loading begins, more than rate_tolerance "
                        "= {}: lower it, or the damping",
                        viscous_share, *test.loading.rate_tolerance));
    }
    return notices;
}

std::string notice_of_companions(const FailureTracker& failure, const NumericalErrors& errors) {
    for (const Companion& c : errors.companions) {
        if (c.ended_by == ended_by_instability)
            return fmt::format("the companion {} became unstable: no error is stated where it enters", c.name);
    }
    if (!failure.failed) return "the specimen has not failed: the errors are those of the largest stress so far";
    if (*errors.peak_converged) return "";
    const auto changes = [](const NumberError& e) {
        return fmt::format("{:.2g} % at half the step and {:.2g} % at half the rate", 100.0 * e.time_step,
                           100.0 * e.rate);
    };
    return fmt::format(
        "the peak jumps between branches: it moves by {}, its strain by {}; report the stated error with it, or the "
        "mean of several packings",
        changes(errors.peak_stress), changes(errors.peak_strain));
}

}  // namespace crackle
