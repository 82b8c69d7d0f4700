// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/results/notices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "specimens/measures/parting.hpp"

namespace crackle {

namespace {

constexpr std::int64_t rows_that_resolve = 100;
// Relative imbalance of the energy account that causes a notice: twice the largest value found for the DEMseg guide's
// example rock with default values.
constexpr double closing_error_to_mention = 2e-3;
constexpr double share_above_to_mention = 0.25;
constexpr double excess_to_mention = 0.1;

using Notices = std::vector<std::string>;

/// Notices on the peak, and on a curve that extends beyond the requested strain.
void note_curve(Notices& notices, const parts::Loading& loading, const char* stress_unit, const TestSetup& setup,
                const TestState& state, const World& world) {
    const FailureTracker& f = state.failure;
    if (f.failed && f.peak_row < rows_that_resolve) {
        notices.push_back(fmt::format(
            "only {} rows of the curve lie before the peak, so the peak and the moduli are poorly resolved; "
            "lower loading.max_axial_strain = {} to about {:.2g}",
            f.peak_row, loading.max_axial_strain, 10.0 * f.peak_strain));
    }
    if (f.failed && f.larger_after_peak()) {
        notices.push_back(fmt::format(
            "the largest stress, {:.4g} {} at a strain of {:.4g}, occurs after the peak of {:.4g} {} at a strain of "
            "{:.4g}. Between them, the stress fell and stayed below the peak by more than the fraction "
            "loading.strength_drop = {}. The broken specimen carries load again; its strength is the peak",
            f.largest_stress, stress_unit, f.strain_at_largest, f.peak_stress, stress_unit, f.peak_strain,
            loading.strength_drop));
    }
    if (const double most = loading.max_axial_strain;
        state.ended_by == ended_by_strain && setup.apparatus.axial_strain(world) > (1.0 + excess_to_mention) * most) {
        notices.push_back(fmt::format(
            "the test ended at a strain of {:.3g}, beyond loading.max_axial_strain = {:g}, because {} strained "
            "the specimen too far; increase loading.max_axial_strain, or lower the loading rate",
            setup.apparatus.axial_strain(world), most,
            world.stepping.steps == 1 ? "the first step" : "the last steps"));
    }
}

/// Notices on an unstable time step and on an energy account that does not close.
void note_numerics(Notices& notices, const TestSetup& setup, const TestState& state, const World& world) {
    if (world.stepping.time_step > setup.stable_time_step) {
        notices.push_back(
            fmt::format("the time step of {:.3g} s exceeds the stability limit of {:.3g} s; this run can only "
                        "demonstrate the limit, and its values are not valid results",
                        world.stepping.time_step, setup.stable_time_step));
    }
    const CurveRow last = state.rows.empty() ? CurveRow{} : state.rows.back();
    if (std::abs(last.energy_error) > closing_error_to_mention * std::abs(last.platen_work)) {
        notices.push_back(
            fmt::format("the energy account does not close: its imbalance divided by the platens' work is {:.3g}; "
                        "halve numerics.safety_factor or lower the loading rate, and compare the results",
                        last.energy_error / last.platen_work));
    }
}

/// Notices on the membrane, the platens and the upper half of a shear box.
void note_holding(Notices& notices, const TestSetup& setup, const TestState& state, const World& world) {
    if (world.membrane.open > 0) {
        notices.emplace_back(
            "the specimen separated so far that the membrane could not be wrapped around it again; the pressure then "
            "acted along the membrane as it was last wrapped");
    }
    const std::optional<Parting> parting = find_parting(setup, state.history);
    if (state.failure.failed && setup.apparatus.uniaxial && !setup.apparatus.compression && parting &&
        parting->place != PartingPlace::gauge) {
        notices.push_back(
            fmt::format("the specimen broke at a {}, so the strength is not that of the rock: {} of the {} broken "
                        "bonds in the largest crack joined particles to a platen; {}",
                        name_of(parting->place), parting->of_platen, parting->bonds,
                        parting->place == PartingPlace::platen ? "use loading.platens = \"glued\""
                                                               : "increase loading.grip, or use a longer specimen"));
    }
    const auto deepest = std::ranges::min_element(state.rows, {}, &CurveRow::lateral_strain);
    if (setup.apparatus.normal_spring > 0.0 && deepest != state.rows.end() &&
        setup.apparatus.normal_force + setup.apparatus.normal_spring * deepest->lateral_strain * setup.specimen.height <
            0.0) {
        notices.push_back(
            fmt::format("the upper half box sank by {:.3g} m, and loading.normal_stiffness made the normal stress "
                        "negative; increase loading.normal_stress, or reduce loading.normal_stiffness",
                        -deepest->lateral_strain * setup.specimen.height));
    }
}

/// Notices on unloadings that were not reached, and on inertia and dashpot forces due to the loading rate.
void note_loading(Notices& notices, const parts::Loading& loading, const TestState& state, double viscous_share) {
    if (const std::size_t asked = loading.unloading.at.size(); state.path.unloaded < static_cast<std::int64_t>(asked))
        notices.push_back(fmt::format("the test ended after {} of {} unloadings", state.path.unloaded, asked));
    const double* tolerance = loading.rate_tolerance();
    if (tolerance == nullptr) return;
    const double above = state.share_above_tolerance();
    if (above > share_above_to_mention) {
        notices.push_back(
            fmt::format("the inertia error exceeded loading.rate_tolerance = {} over {:.0f} % of the strain, because "
                        "breaks release energy faster than loading can slow down; run `crackle test --verify` to see "
                        "how results change at half the rate",
                        *tolerance, 100.0 * above));
    }
    if (viscous_share > *tolerance) {
        notices.push_back(
            fmt::format("when loading begins, dashpots carry {:.2g} of the largest stress, more than "
                        "loading.rate_tolerance = {}; lower the tolerance or the damping",
                        viscous_share, *tolerance));
    }
}

}  // namespace

std::vector<std::string> notices_of(const parts::Loading& loading, const char* stress_unit, const TestSetup& setup,
                                    const TestState& state, const World& world, double viscous_share) {
    Notices notices = setup.origin.notices;
    note_curve(notices, loading, stress_unit, setup, state, world);
    note_numerics(notices, setup, state, world);
    note_holding(notices, setup, state, world);
    note_loading(notices, loading, state, viscous_share);
    return notices;
}

std::string notice_of_companions(const FailureTracker& failure, const NumericalErrors& errors) {
    for (const auto& [name, c] : *errors.figures.companions) {
        if (c.ended_by == ended_by_instability)
            return fmt::format("the companion run {} became unstable, so errors that depend on it are not stated",
                               name);
    }
    if (!failure.failed)
        return "the specimen has not failed; the numerical errors refer to its largest stress instead of a peak";
    if (*errors.peak_converged) return "";
    const auto changes = [](const ErrorFigures& e) {
        return fmt::format("{:.2g} % at half the step and {:.2g} % at half the rate", 100.0 * e.time_step.or_nan(),
                           100.0 * e.rate.or_nan());
    };
    return fmt::format(
        "a run with another time step or rate fails in a different way (on another branch): the peak stress changes by "
        "{}, the peak strain by {}; report the peak with its stated error, or the mean of several packings",
        changes(*errors.figures.peak_stress), changes(*errors.figures.peak_strain));
}

}  // namespace crackle
