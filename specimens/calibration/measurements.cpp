// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/calibration/measurements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/base/errors.hpp"
#include "solver/base/system_failure.hpp"
#include "specimens/campaign/point_table.hpp"
#include "specimens/envelope/strength_envelope.hpp"
#include "specimens/making/hooks.hpp"
#include "specimens/statistics/spoken.hpp"

namespace crackle {
namespace {

constexpr std::size_t no_column = std::numeric_limits<std::size_t>::max();

double number_in(const std::vector<LedgerCell>& row, std::size_t column) {
    const auto* number = column < row.size() ? std::get_if<double>(&row[column]) : nullptr;
    return number != nullptr ? *number : std::nan("");
}

/// Indices of the columns of a results table that hold the values for the targets.
struct TargetColumns {
    std::size_t failed, state, pressure;
    std::vector<std::size_t> figures, divisors;  // one per target; divisor: the denominator of a ratio
};

TargetColumns columns_of(const LedgerTable& results, const std::vector<Target>& targets) {
    const auto column = [&](const std::string& name) {
        return static_cast<std::size_t>(std::ranges::find(results.columns, name) - results.columns.begin());
    };
    TargetColumns all{column("failed"), column("state"), column("confining_pressure"), {}, {}};
    for (const Target& target : targets) {
        all.figures.push_back(column(target.of_law() ? "peak_stress" : target.figure));
        all.divisors.push_back(target.over.empty() ? no_column : column(target.over));
    }
    return all;
}

/// Whether a target has no value if the test has no peak. @param value  value recorded for the test; may be NaN
bool needs_peak(const Target& target, double value) {
    if (refers_to_peak(target.figure) || refers_to_peak(target.over)) return true;
    return !std::isfinite(value) && (target.figure.starts_with("peak_") || target.over.starts_with("peak_"));
}

/// Error for a target that has no value in any test. @param done  whether any of its tests finished
InputError no_figure(const Target& target, const std::vector<PlannedTest>& tests, bool done,
                     const std::filesystem::path& folder) {
    return InputError(fmt::format(
        "{}: found no {} in any test of {}{}, expected a number; see `crackle campaign show {} --wrong`", target.where,
        target.quantity(), target.source(tests),
        done ? " (did any specimen fail before it reached loading.max_axial_strain?)" : ", none of which finished",
        folder.string()));
}

}  // namespace

Measurements::Measurements(const Rock& rock, Keep keep, CampaignOptions options, CampaignHooks hooks)
    : rock_(rock), keep_(keep), options_(std::move(options)), hooks_(std::move(hooks)) {}

void Measurements::measure(const std::vector<std::vector<double>>& points, PackingRange packings) {
    bool all_known = true;
    for (const std::vector<double>& point : points) {
        auto at = std::find(points_.begin(), points_.end(), point);
        if (at == points_.end()) at = points_.insert(points_.end(), point);
        const auto place = static_cast<std::size_t>(at - points_.begin());
        for (std::int64_t k = packings.first; k < packings.first + packings.count; ++k)
            all_known = !known_.emplace(std::pair(place, k), std::vector<double>()).second && all_known;
    }
    if (all_known) return;
    // The plan holds all requested points; finished tests are not run again.
    Plan plan;
    plan.file = rock_.file;
    plan.text = rock_.text;
    plan.title = rock_.title;
    plan.tests = rock_.tests;
    plan.own_seeds = false;
    plan.keep = keep_;
    plan.time_limit = rock_.time_limit;
    std::vector<std::size_t> axes;
    for (const FreeKey& free : rock_.free) {
        axes.push_back(axes.size());
        Axis axis;
        axis.key = free.key;
        axis.where = free.where;
        plan.axes.push_back(axis);
    }
    for (const std::vector<double>& point : points_)
        for (std::size_t test = 0; test < rock_.tests.size(); ++test)
            plan.points.push_back({test, rock_.settings(point), axes, {}, 1});
    judge_points(plan);
    for (const auto& [place, ignored] : known_)
        for (std::size_t test = 0; test < rock_.tests.size(); ++test)
            plan.rows.push_back(
                {place.first * rock_.tests.size() + test, rock_.first_seed + place.second, Variant::as_asked});
    std::stable_sort(plan.rows.begin(), plan.rows.end(), [](const auto& a, const auto& b) { return a.seed < b.seed; });
    std::int64_t last = rock_.first_seed;
    for (const PlanRow& row : plan.rows) last = std::max(last, row.seed);
    plan.packings = last - rock_.first_seed + 1;
    plan.first_seed = rock_.first_seed;
    const CampaignOutcome outcome = run_campaign(plan, options_, hooks_);
    if (outcome.interrupted) throw TestInterrupted();
    if (outcome.progress.failures > 0)
        throw SystemFailure(
            fmt::format("{}: {} failed because of the system ({}), expected figures of all packings; the same command "
                        "runs what is missing",
                        options_.folder.string(), counted(outcome.progress.failures, "test"), outcome.failure));
    read(plan);
}

void Measurements::read(const Plan& plan) {
    const CampaignLedger ledger = CampaignLedger::read(ledger_file(options_.folder));
    const LedgerTable results = ledger.results();
    const auto [failed, state, pressure, columns, divisors] = columns_of(results, rock_.targets);
    // Strengths to which the law of a target is fitted: by point and packing, then by target.
    std::map<std::pair<std::size_t, std::int64_t>, std::map<std::size_t, std::vector<StrengthPoint>>> strengths;
    for (auto& [place, figures] : known_) figures.assign(rock_.targets.size(), std::nan(""));
    peakless_.clear();
    std::vector<bool> any(rock_.targets.size(), false), done(rock_.tests.size(), false);
    for (std::size_t r = 0; r < results.rows.size(); ++r) {
        const auto& row = results.rows[r];
        const auto* word = std::get_if<std::string>(&row[state]);
        if (word == nullptr || *word != row_done) continue;
        const PlanRow& asked = plan.rows[r];
        const std::size_t test = plan.points[asked.point].test;
        done[test] = true;
        const std::pair place(asked.point / rock_.tests.size(), asked.seed - rock_.first_seed);
        std::vector<double>& figures = known_.at(place);
        for (std::size_t t = 0; t < rock_.targets.size(); ++t) {
            const Target& target = rock_.targets[t];
            double value = number_in(row, columns[t]);
            const bool peakless = number_in(row, failed) == 0.0;
            if (target.of_law()) {
                if (std::ranges::find(target.tests, test) == target.tests.end()) continue;
                if (!std::isfinite(value)) {
                    if (peakless) peakless_[place].insert(t);
                    continue;
                }
                const double confined = number_in(row, pressure);
                strengths[place][t].push_back({"", std::isfinite(confined) ? confined : 0.0, value});
                continue;
            }
            if (target.test != test) continue;
            if (divisors[t] != no_column) value /= number_in(row, divisors[t]);
            any[t] = any[t] || std::isfinite(value);
            if (peakless && needs_peak(target, value))
                peakless_[place].insert(t);
            else
                figures[t] = value;
        }
    }
    // A law is fitted only to packings with all strengths; others would not be comparable.
    for (const auto& [place, of_targets] : strengths) {
        for (const auto& [t, points] : of_targets) {
            const Target& target = rock_.targets[t];
            if (points.size() < target.tests.size()) continue;
            const FittedLaws laws = fit_laws(points);
            known_.at(place)[t] = target.figure == "friction_angle" ? laws.friction_angle : laws.hoek_brown_m;
            any[t] = true;
        }
    }
    for (std::size_t t = 0; t < rock_.targets.size(); ++t)
        if (!any[t]) throw no_figure(rock_.targets[t], rock_.tests, done[rock_.targets[t].test], options_.folder);
    const LedgerCounts counts = ledger.counts();
    tests_ = counts.tests;
    processor_seconds_ = counts.processor_seconds;
}

Eigen::MatrixXd Measurements::figures(const std::vector<double>& point, PackingRange packings) const {
    const auto at = std::find(points_.begin(), points_.end(), point);
    const auto place = static_cast<std::size_t>(at - points_.begin());
    Eigen::MatrixXd all(packings.count, static_cast<Eigen::Index>(rock_.targets.size()));
    for (std::int64_t k = 0; k < packings.count; ++k) {
        const std::vector<double>& row = known_.at({place, packings.first + k});
        for (std::size_t t = 0; t < row.size(); ++t) all(k, static_cast<Eigen::Index>(t)) = row[t];
    }
    return all;
}

std::int64_t Measurements::without_peak(const std::vector<double>& point, PackingRange packings,
                                        std::size_t target) const {
    const auto place = static_cast<std::size_t>(std::find(points_.begin(), points_.end(), point) - points_.begin());
    std::int64_t count = 0;
    for (std::int64_t k = packings.first; k < packings.first + packings.count; ++k) {
        const auto at = peakless_.find({place, k});
        if (at != peakless_.end() && at->second.contains(target)) ++count;
    }
    return count;
}

}  // namespace crackle
