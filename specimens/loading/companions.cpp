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
#include "solver/base/processors_lent.hpp"
#include "solver/base/threads_to_be_had.hpp"
#include "specimens/loading/load_specimen.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/measures/cycles.hpp"
#include "specimens/results/summary.hpp"

namespace crackle {
namespace {

constexpr double student_two = 2.920;      // 95 % point, two degrees of freedom
constexpr double convergence_index = 3.0;  // two grids, first order
constexpr std::chrono::milliseconds between_questions{50};
constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

struct CompanionPlan {
    std::string name;
    TestCase description;
};

std::vector<CompanionPlan> plans_for(const TestCase& asked, int threads) {
    std::vector<CompanionPlan> plans;
    const auto plan = [&](const char* name) -> TestCase& {
        plans.push_back({name, asked});
        plans.back().description.numerics.threads = threads;
        plans.back().description.output.emission = false;  // nobody reads what they hear
        return plans.back().description;
    };
    plan("half_time_step").halve_step();
    plan("half_rate").loading.scale_rate(0.5);
    plan("half_damping").damping_scale = 0.5;
    TestCase& doubled = plan("double_damping");
    doubled.damping_scale = 2.0;
    doubled.numerics.time_step.reset();  // more damping needs a smaller step
    return plans;
}

/// Stress at a strain, between rows; the last row's beyond them.
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

/// Dashpots of the first law, N s/m where given as such, sqrt(N/m) where by ratio.
double damping_of(const World& world) {
    if (world.settings.laws.empty()) return undefined;  // it became unstable before there was a world
    const ContactLaw& law = world.settings.laws.front();
    return law.normal_damping + law.normal_damping_ratio_term;
}

/// Read off its own world and rows, not off the plan: what was planned and not done would show.
Companion what_it_did(const CompanionPlan& plan, const VirtualTest& test, const VirtualTest& other) {
    Companion c;
    c.name = plan.name;
    c.ended_by = other.state.ended_by;
    c.steps = other.world.stepping.steps;
    c.time_step = other.world.stepping.time / static_cast<double>(c.steps);
    if (!other.state.rows.empty()) c.axial_strain_rate = other.state.mean_rate();
    c.damping = damping_of(other.world) / damping_of(test.world);
    return c;
}

/// @return nothing if interrupted
std::optional<Companion> run_one(const CompanionPlan& plan, const VirtualTest& test, const TestHooks& hooks) {
    TestHooks quiet;
    quiet.interrupted = hooks.interrupted;
    VirtualTest other;
    try {
        other = prepare_test(plan.description, quiet);
        load_specimen(other, quiet);
    } catch (const TestInterrupted&) {
        return std::nullopt;
    } catch (const UnstableRun&) {
        Companion unstable = what_it_did(plan, test, other);
        unstable.peak_stress = unstable.peak_strain = unstable.post_peak_difference = undefined;
        unstable.crack_initiation_stress = unstable.crack_damage_stress = undefined;
        unstable.ended_by = ended_by_instability;
        return unstable;
    }
    if (other.state.ended_by.empty()) return std::nullopt;
    Companion done = what_it_did(plan, test, other);
    done.peak_stress = other.state.failure.peak_stress;
    done.peak_strain = other.state.failure.peak_strain;
    done.post_peak_difference = post_peak_difference(test, other);
    const CrackThresholds cracks =
        crack_thresholds_of(other.description, other.setup, other.state).value_or(CrackThresholds{});
    done.crack_initiation_stress = cracks.count_break;
    done.crack_damage_stress = cracks.damage;
    return done;
}

/// How far the largest of the rows may lie from the peak between them: a spacing in strain, and in stress what the last
/// row before it rose by.
double resolved_stress(const VirtualTest& test) {
    const FailureTracker& f = test.state.failure;
    if (f.peak_row < 1) return 0.0;
    const CurveRow& before = test.state.rows[static_cast<std::size_t>(f.peak_row - 1)];
    return std::abs(f.peak_stress - before.axial_stress) / f.peak_stress;
}
/// What the row that first comes to a stress rose by, over it; undefined as the stress is.
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

bool on_one_branch(const NumberError& stress, const NumberError& strain) {
    return stress.time_step <= branch_stress_change && stress.rate <= branch_stress_change &&
           strain.time_step <= branch_strain_change && strain.rate <= branch_strain_change;
}

NumberError error_of(double asked, double resolution, const std::vector<Companion>& companions,
                     double Companion::*value) {
    NumberError error;
    error.resolution = resolution;
    std::vector<double> draws{asked};
    for (const Companion& c : companions) {
        const double change = std::abs(c.*value - asked) / std::abs(asked);
        if (c.name == "half_time_step") error.time_step = change;
        if (c.name == "half_rate") error.rate = change;
        if (c.name.ends_with("damping"))
            error.damping = std::isnan(change) ? change : std::max(error.damping, change);
        else
            draws.push_back(c.*value);
    }
    double mean = 0.0, square = 0.0;
    for (const double x : draws) mean += x / static_cast<double>(draws.size());
    for (const double x : draws) square += (x - mean) * (x - mean) / static_cast<double>(draws.size() - 1);
    const double chance = student_two * std::sqrt(2.0 * square) / std::abs(asked);
    error.stated = norm(Vec2{resolution, std::max(chance, convergence_index * error.rate)});
    if (std::isnan(chance)) error.stated = undefined;
    return error;
}

std::optional<NumericalErrors> run_companions(const VirtualTest& test, const TestHooks& hooks) {
    if (test.state.failure.peak_row < 0) return std::nullopt;
    const std::vector<CompanionPlan> plans = plans_for(test.description, test.world.workers.threads);
    if (hooks.stage) hooks.stage(fmt::format("verifying: {} companions of the test", plans.size()));
    std::vector<std::optional<Companion>> done(plans.size());
    const int threads = std::max(1, test.world.workers.threads);
    // This thread only waits for those that are begun.
    const int had = threads_to_be_had(1 + processors_lent()) - 1;
    const auto at_once = static_cast<std::size_t>(std::max(1, had / threads));
    // One at a time needs no thread of its own.
    const auto policy = at_once > 1 ? std::launch::async : std::launch::deferred;
    for (std::size_t first = 0; first < plans.size(); first += at_once) {
        std::vector<std::future<std::optional<Companion>>> running;
        for (std::size_t k = first; k < std::min(plans.size(), first + at_once); ++k)
            running.push_back(std::async(policy, [&, k] { return run_one(plans[k], test, hooks); }));
        for (std::size_t k = 0; k < running.size(); ++k) {
            std::optional<Companion>& companion = done[first + k];
            // This thread alone may be the one that hears of an interrupt.
            while (hooks.interrupted && running[k].wait_for(between_questions) == std::future_status::timeout)
                hooks.interrupted();
            companion = running[k].get();
            if (companion && hooks.stage) {
                hooks.stage(fmt::format("  {}: {:.4g} {} at strain {:.4g}, {} steps ({} of {})", companion->name,
                                        companion->peak_stress, test.description.stress_unit(), companion->peak_strain,
                                        companion->steps, first + k + 1, plans.size()));
            }
        }
    }
    NumericalErrors errors;
    for (const auto& companion : done) {
        if (!companion) return std::nullopt;
        errors.companions.push_back(*companion);
    }
    const FailureTracker& f = test.state.failure;
    errors.peak_stress = error_of(f.peak_stress, resolved_stress(test), errors.companions, &Companion::peak_stress);
    errors.peak_strain = error_of(f.peak_strain, resolved_strain(test), errors.companions, &Companion::peak_strain);
    if (const std::optional<CrackThresholds> own = crack_thresholds_of(test.description, test.setup, test.state)) {
        const auto error = [&](double stress, double Companion::*value) {
            return error_of(stress, resolved_before_peak(test, stress), errors.companions, value);
        };
        errors.crack_initiation_stress = error(own->count_break, &Companion::crack_initiation_stress);
        errors.crack_damage_stress = error(own->damage, &Companion::crack_damage_stress);
    }
    if (f.failed) errors.peak_converged = on_one_branch(errors.peak_stress, errors.peak_strain);
    return errors;
}

}  // namespace crackle
