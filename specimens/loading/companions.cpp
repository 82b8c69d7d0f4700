// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/loading/companions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <limits>
#include <utility>

#include "solver/base/errors.hpp"
#include "solver/machine/processors_lent.hpp"
#include "solver/machine/threads_to_be_had.hpp"
#include "specimens/loading/load_specimen.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/measures/cycles.hpp"
#include "specimens/results/make_summary.hpp"

namespace crackle {
namespace {

constexpr double student_two = 2.920;      // 95 % point of Student's t for two degrees of freedom
constexpr double convergence_index = 3.0;  // safety factor of the grid convergence index for two grids at first order
constexpr std::chrono::milliseconds between_questions{50};
constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

struct CompanionPlan {
    std::string name;
    ResolvedCase description;
};

std::vector<CompanionPlan> plans_for(const ResolvedCase& asked, int threads) {
    std::vector<CompanionPlan> plans;
    const auto plan = [&](const char* name) -> ResolvedCase& {
        plans.push_back({name, asked});
        plans.back().description.numerics.threads = threads;
        plans.back().description.output.emission = false;  // acoustic events of companions are not used
        return plans.back().description;
    };
    plan("half_time_step").halve_step();
    plan("half_rate").loading.scale_rate(0.5);
    plan("half_damping").damping_scale = 0.5;
    ResolvedCase& doubled = plan("double_damping");
    doubled.damping_scale = 2.0;
    doubled.numerics.time_step.reset();  // more damping requires a smaller time step
    return plans;
}

/// Stress at a strain, interpolated between rows; beyond the last row, the stress of the last row.
double stress_at(const std::vector<CurveRow>& rows, double strain) {
    const auto after =
        std::find_if(rows.begin(), rows.end(), [&](const CurveRow& r) { return r.axial_strain >= strain; });
    if (after == rows.begin()) return rows.front().axial_stress;
    if (after == rows.end()) return rows.back().axial_stress;
    const CurveRow &a = *(after - 1), &b = *after;
    return a.axial_stress +
           (b.axial_stress - a.axial_stress) * (strain - a.axial_strain) / (b.axial_strain - a.axial_strain);
}

double post_peak_difference(const VirtualTest& test, const VirtualTest& other) {
    const double end = std::min(test.state.rows.back().axial_strain, other.state.rows.back().axial_strain);
    double sum = 0.0;
    std::int64_t count = 0;
    for (const CurveRow& row : first_loading(test.state.rows, -1).rows) {
        if (row.axial_strain < test.state.failure.peak_strain || row.axial_strain > end) continue;
        sum += std::abs(stress_at(other.state.rows, row.axial_strain) - row.axial_stress);
        ++count;
    }
    return count > 0 ? sum / static_cast<double>(count) / test.state.failure.peak_stress : 0.0;
}

/// Dashpot of the first contact law: N s/m if given as a dashpot, sqrt(N/m) if given as a damping ratio.
double damping_of(const World& world) {
    if (world.settings.laws.empty()) return undefined;  // the companion became unstable before its world was built
    const ContactLaw& law = world.settings.laws.front();
    return law.normal_damping + law.normal_damping_ratio_term;
}

/// Reads the results from the companion's own world and rows rather than from its plan, so that a setting that was not
/// applied would be noticed.
CompanionFigures what_it_did(const VirtualTest& test, const VirtualTest& other) {
    CompanionFigures c;
    c.ended_by = other.state.ended_by;
    c.steps = other.world.stepping.steps;
    c.time_step = other.world.stepping.time / static_cast<double>(other.world.stepping.steps);
    c.axial_strain_rate = other.state.rows.empty() ? 0.0 : other.state.mean_rate();
    c.damping = damping_of(other.world) / damping_of(test.world);
    return c;
}

/// Runs one companion. @return its results; empty if interrupted
std::optional<CompanionFigures> run_one(const CompanionPlan& plan, const VirtualTest& test, const TestHooks& hooks) {
    TestHooks quiet;
    quiet.interrupted = hooks.interrupted;
    VirtualTest other;
    try {
        other = prepare_test(plan.description, quiet);
        load_specimen(other, quiet);
    } catch (const TestInterrupted&) {
        return std::nullopt;
    } catch (const UnstableRun&) {
        CompanionFigures unstable = what_it_did(test, other);
        unstable.peak_stress = unstable.peak_strain = unstable.post_peak_difference = undefined;
        if (test.setup.apparatus.compression && test.setup.apparatus.uniaxial)
            unstable.crack_initiation_stress = unstable.crack_damage_stress = undefined;
        unstable.ended_by = ended_by_instability;
        return unstable;
    }
    if (other.state.ended_by.empty()) return std::nullopt;
    CompanionFigures done = what_it_did(test, other);
    done.peak_stress = other.state.failure.peak_stress;
    done.peak_strain = other.state.failure.peak_strain;
    done.post_peak_difference = post_peak_difference(test, other);
    if (const auto cracks = crack_thresholds_of(other.description.loading, other.setup.apparatus, other.state)) {
        done.crack_initiation_stress = cracks->initiation();
        done.crack_damage_stress = cracks->damage;
    }
    return done;
}

/// Error of the peak stress due to the spacing of rows. The true peak lies at most one row spacing from the row with
/// the largest stress; the error is taken as the stress increase in that row.
double resolved_stress(const VirtualTest& test) {
    const FailureTracker& f = test.state.failure;
    if (f.peak_row < 1) return 0.0;
    const CurveRow& before = test.state.rows[static_cast<std::size_t>(f.peak_row - 1)];
    return std::abs(f.peak_stress - before.axial_stress) / f.peak_stress;
}
/// Increase of the stress in the row that first reaches `stress`, relative to `stress`; NaN if `stress` is NaN.
double resolved_before_peak(const VirtualTest& test, double stress) {
    if (std::isnan(stress)) return undefined;
    const std::vector<CurveRow>& rows = test.state.rows;
    const auto at = std::ranges::find_if(rows, [&](const CurveRow& row) { return row.axial_stress >= stress; });
    if (at == rows.begin() || at == rows.end()) return 0.0;
    return std::abs(at->axial_stress - (at - 1)->axial_stress) / stress;
}
double resolved_strain(const VirtualTest& test) {
    const FailureTracker& f = test.state.failure;
    if (f.peak_row < 1) return 0.0;
    const CurveRow& before = test.state.rows[static_cast<std::size_t>(f.peak_row - 1)];
    return (f.peak_strain - before.axial_strain) / f.peak_strain;
}

}  // namespace

bool on_one_branch(const ErrorFigures& stress, const ErrorFigures& strain) {
    return stress.time_step.or_nan() <= branch_stress_change && stress.rate.or_nan() <= branch_stress_change &&
           strain.time_step.or_nan() <= branch_strain_change && strain.rate.or_nan() <= branch_strain_change;
}

ErrorFigures error_of(double asked, double resolution, const Table<CompanionFigures>& companions,
                      Number CompanionFigures::*value) {
    double time_step = 0.0, rate = 0.0, damping = 0.0;
    std::vector<double> draws{asked};
    for (const auto& [name, c] : companions) {
        const double found = (c.*value).or_nan(), change = std::abs(found - asked) / std::abs(asked);
        if (name == "half_time_step") time_step = change;
        if (name == "half_rate") rate = change;
        if (name.ends_with("damping"))
            damping = std::isnan(change) ? change : std::max(damping, change);
        else
            draws.push_back(found);
    }
    double mean = 0.0, square = 0.0;
    for (const double x : draws) mean += x / static_cast<double>(draws.size());
    for (const double x : draws) square += (x - mean) * (x - mean) / static_cast<double>(draws.size() - 1);
    const double chance = student_two * std::sqrt(2.0 * square) / std::abs(asked);
    const double stated = norm(Vec2{resolution, std::max(chance, convergence_index * rate)});
    return {time_step, rate, {}, damping, resolution, std::isnan(chance) ? undefined : stated};
}

std::optional<NumericalErrors> run_companions(const VirtualTest& test, const TestHooks& hooks) {
    if (test.state.failure.peak_row < 0) return std::nullopt;
    const std::vector<CompanionPlan> plans = plans_for(test.description, test.world.workers.threads);
    if (hooks.stage) hooks.stage(fmt::format("verifying the test with {} companion runs", plans.size()));
    std::vector<std::optional<CompanionFigures>> done(plans.size());
    const int threads = std::max(1, test.world.workers.threads);
    // The calling thread only waits for companions, so its processor is free for one of them.
    const int had = threads_to_be_had(1 + processors_lent()) - 1;
    const auto at_once = static_cast<std::size_t>(std::max(1, had / threads));
    // Running one at a time needs no additional thread.
    const auto policy = at_once > 1 ? std::launch::async : std::launch::deferred;
    for (std::size_t first = 0; first < plans.size(); first += at_once) {
        std::vector<std::future<std::optional<CompanionFigures>>> running;
        for (std::size_t k = first; k < std::min(plans.size(), first + at_once); ++k)
            running.push_back(std::async(policy, [&, k] { return run_one(plans[k], test, hooks); }));
        for (std::size_t k = 0; k < running.size(); ++k) {
            std::optional<CompanionFigures>& companion = done[first + k];
            // Only this thread may poll for interrupts.
            while (hooks.interrupted && running[k].wait_for(between_questions) == std::future_status::timeout)
                hooks.interrupted();
            companion = running[k].get();
            if (companion && hooks.stage) {
                hooks.stage(fmt::format("  {}: {:.4g} {} at strain {:.4g}, {} steps ({} of {})", plans[first + k].name,
                                        companion->peak_stress.or_nan(), test.description.stress_unit(),
                                        companion->peak_strain.or_nan(), *companion->steps, first + k + 1,
                                        plans.size()));
            }
        }
    }
    NumericalErrors errors;
    ErrorsByFigure& figures = errors.figures;
    Table<CompanionFigures>& companions = figures.companions.begin_table();
    for (std::size_t k = 0; k < plans.size(); ++k) {
        if (!done[k]) return std::nullopt;
        companions.emplace_back(plans[k].name, *done[k]);
    }
    const FailureTracker& f = test.state.failure;
    figures.peak_stress = error_of(f.peak_stress, resolved_stress(test), companions, &CompanionFigures::peak_stress);
    figures.peak_strain = error_of(f.peak_strain, resolved_strain(test), companions, &CompanionFigures::peak_strain);
    if (const std::optional<CrackThresholds> own =
            crack_thresholds_of(test.description.loading, test.setup.apparatus, test.state)) {
        const auto error = [&](double stress, Number CompanionFigures::*value) {
            return error_of(stress, resolved_before_peak(test, stress), companions, value);
        };
        figures.crack_initiation_stress = error(own->initiation(), &CompanionFigures::crack_initiation_stress);
        figures.crack_damage_stress = error(own->damage, &CompanionFigures::crack_damage_stress);
    }
    if (f.failed) errors.peak_converged = on_one_branch(*figures.peak_stress, *figures.peak_strain);
    return errors;
}

}  // namespace crackle
