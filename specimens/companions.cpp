// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/companions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <thread>
#include <utility>

namespace crackle {
namespace {

constexpr double student_two = 4.303;  // 97.5 % point, two degrees of freedom

struct Plan {
    std::string name;
    TestCase description;
};

void scale_damping(TestCase& test, double by) {
    TestCase::MaterialKeys& m = test.material;
    if (m.normal_damping) {
        *m.normal_damping *= by;
        *m.shear_damping *= by;
    } else {
        m.damping_ratio = by * m.damping_ratio.value_or(default_damping_ratio);
    }
}

std::vector<Plan> plans_for(const TestCase& asked) {
    std::vector<Plan> plans;
    const auto plan = [&](const char* name) -> TestCase& {
        plans.push_back({name, asked});
        return plans.back().description;
    };
    TestCase& step = plan("half_time_step");
    if (step.numerics.time_step) *step.numerics.time_step *= 0.5;
    step.numerics.safety_factor *= 0.5;
    TestCase& rate = plan("half_rate");
    rate.loading.scale_rate(0.5);
    // A particle file's own damping is not ours to scale.
    if (asked.has_table("packing") || asked.material.damping_ratio || asked.material.normal_damping) {
        scale_damping(plan("half_damping"), 0.5);
        TestCase& doubled = plan("double_damping");
        scale_damping(doubled, 2.0);
        doubled.numerics.time_step.reset();  // more damping needs a smaller step
    }
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
    for (const CurveRow& row : test.state.rows) {
        if (row.axial_strain < test.state.failure.peak_strain || row.axial_strain > end) continue;
        sum += std::abs(stress_at(other.state.rows, row.axial_strain) - row.axial_stress);
        ++count;
    }
    return count > 0 ? sum / static_cast<double>(count) / test.state.failure.peak_stress : 0.0;
}

/// @return nothing if interrupted or without a peak
std::optional<Companion> run_one(const Plan& plan, const VirtualTest& test, const TestHooks& hooks) {
    TestHooks quiet;
    quiet.interrupted = hooks.interrupted;
    VirtualTest other = prepare_test(plan.description, quiet);
    load_specimen(other, quiet);
    if (other.state.ended_by.empty() || other.state.failure.peak_row < 0) return std::nullopt;
    const FailureTracker& f = other.state.failure;
    return Companion{plan.name, f.peak_stress,    f.peak_strain,
                     f.failed,  other.world.step, post_peak_difference(test, other)};
}

NumberError error_of(double asked, const std::vector<Companion>& companions, double Companion::*value) {
    NumberError error;
    std::vector<double> draws{asked};
    for (const Companion& c : companions) {
        const double change = std::abs(c.*value - asked) / std::abs(asked);
        if (c.name == "half_time_step") error.time_step = change;
        if (c.name == "half_rate") error.rate = change;
        if (c.name.ends_with("damping"))
            error.damping = std::max(error.damping, change);
        else
            draws.push_back(c.*value);
    }
    double mean = 0.0, square = 0.0;
    for (const double x : draws) mean += x / static_cast<double>(draws.size());
    for (const double x : draws) square += (x - mean) * (x - mean) / static_cast<double>(draws.size() - 1);
    error.stated = student_two * std::sqrt(2.0 * square) / std::abs(asked);
    return error;
}

}  // namespace

std::optional<NumericalErrors> run_companions(const VirtualTest& test, const TestHooks& hooks) {
    if (test.state.failure.peak_row < 0) return std::nullopt;
    const std::vector<Plan> plans = plans_for(test.description);
    if (hooks.stage) hooks.stage(fmt::format("verifying: {} companions of the test", plans.size()));
    std::vector<std::optional<Companion>> done(plans.size());
    const std::size_t at_once = std::max(1U, std::thread::hardware_concurrency());
    for (std::size_t first = 0; first < plans.size(); first += at_once) {
        std::vector<std::future<std::optional<Companion>>> running;
        for (std::size_t k = first; k < std::min(plans.size(), first + at_once); ++k)
            running.push_back(std::async(std::launch::async, [&, k] { return run_one(plans[k], test, hooks); }));
        for (std::size_t k = 0; k < running.size(); ++k) done[first + k] = running[k].get();
    }
    NumericalErrors errors;
    for (const auto& companion : done) {
        if (!companion) return std::nullopt;
        errors.companions.push_back(*companion);
    }
    const FailureTracker& f = test.state.failure;
    errors.peak_stress = error_of(f.peak_stress, errors.companions, &Companion::peak_stress);
    errors.peak_strain = error_of(f.peak_strain, errors.companions, &Companion::peak_strain);
    errors.peak_converged = f.failed &&
                            std::max(errors.peak_stress.time_step, errors.peak_stress.rate) <= branch_stress_change &&
                            std::max(errors.peak_strain.time_step, errors.peak_strain.rate) <= branch_strain_change;
    return errors;
}

}  // namespace crackle
