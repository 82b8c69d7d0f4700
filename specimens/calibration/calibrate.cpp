// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/calibration/calibrate.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

#include "solver/base/errors.hpp"
#include "solver/files/folder_lock.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/replace_file.hpp"
#include "specimens/calibration/determination.hpp"
#include "specimens/calibration/linear_search.hpp"
#include "specimens/calibration/measurements.hpp"
#include "specimens/calibration/surface_search.hpp"
#include "specimens/statistics/spoken.hpp"

namespace crackle {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_rounds = 10;
// The search accepts a point if the deviation of every mean is at most this fraction of its tolerance, or at most one
// standard error.
constexpr double met_share = 0.5;
// A round makes no progress if the solution moves by less than no_way half-widths of the design. The same holds if no
// point is predicted to reach all targets and the largest deviation exceeds no_gain times that of the previous round.
constexpr double no_way = 0.15, no_gain = 0.9;
constexpr double widest_design = 0.8;
// The search has converged if the best point predicted by the response surfaces is close to the current point: at most
// this many design half-widths away.
constexpr double reach_at_rest = 1.0;
// If a correction changes a search variable by more than this, the means are measured again. Most search variables are
// logarithms of keys.
constexpr double large_correction = 0.1;
constexpr int most_corrections = 3;
// Weights of the target with the largest deviation; all other targets have weight 1. Each value gives one compromise.
constexpr double frontier_weights[]{0.03, 0.3, 1.0, 3.0, 30.0};

double t_95(Index count) {
    return boost::math::quantile(boost::math::students_t(static_cast<double>(std::max<Index>(1, count - 1))), 0.975);
}

MeanFigure mean_of_column(const MatrixXd& figures, Index column) {
    std::vector<double> values;
    for (Index k = 0; k < figures.rows(); ++k)
        if (std::isfinite(figures(k, column))) values.push_back(figures(k, column));
    return mean_of(values);
}

CampaignOptions campaign_options(const CalibrationOptions& options, const char* folder) {
    CampaignOptions all;
    all.folder = options.folder / folder;
    all.workers = options.workers;
    all.endless = options.endless;
    return all;
}

LinearRequest linear_request(const Rock& rock, const CalibrationOptions& options, const CalibrationHooks& hooks) {
    LinearRequest request;
    request.rock = &rock;
    request.packings = options.folder / "search" / "packings";
    request.workers = options.workers;
    request.interrupted = hooks.interrupted;
    return request;
}

/// Means of the results for all targets at one point of the search.
struct Measured {
    MatrixXd rows;           ///< results, one row for each packing that has a result for every target
    VectorXd means, errors;  ///< logarithms of the means; standard errors relative to the means
};

class Calibration {
  public:
    Calibration(const Rock& rock, const CalibrationOptions& options, const CalibrationHooks& hooks)
        : rock_(rock),
          hooks_(hooks),
          space_(rock),
          search_(rock, Keep::figures, campaign_options(options, "search"), campaign_hooks()),
          fresh_(rock, Keep::curves, campaign_options(options, "fresh"), campaign_hooks()),
          linear_(space_, linear_request(rock, options, hooks)),
          surfaces_(space_, [this](const VectorXd& x) { return search_.figures(space_.values_at(x), fit_packings()); }),
          x_(space_.start) {}

    CalibrationOutcome run() {
        search();
        polish();
        judge();
        draw_frontier();
        state_keys();
        list_tried();
        outcome_.surfaces = surfaces_.quality();
        outcome_.linear_solves = linear_.solves();
        outcome_.tests = search_.tests() + fresh_.tests();
        outcome_.processor_seconds = search_.processor_seconds() + fresh_.processor_seconds();
        return std::move(outcome_);
    }

  private:
    CampaignHooks campaign_hooks() {
        CampaignHooks all;
        all.interrupted = hooks_.interrupted;
        all.told = hooks_.told;
        if (hooks_.progress) all.progress = [this](const CampaignProgress& p) { hooks_.progress(stage_, p); };
        return all;
    }
    void begin(const std::string& stage) {
        stage_ = stage;
        if (hooks_.stage) hooks_.stage(stage);
    }
    void say_where(const VectorXd& off) {
        if (!hooks_.stage) return;
        std::string text;
        for (Index t = 0; t < space_.targets; ++t)
            text += fmt::format("{}{} {:+.1f} %", t == 0 ? "" : ", ", space_.target(t).name(rock_.tests),
                                100.0 * std::expm1(off[t]));
        hooks_.stage("  off by: " + text);
    }

    /// Reports the number of packings without a peak, in which the stress was still increasing when the test ended.
    void say_without_peak(const Measurements& tests, const VectorXd& x, PackingRange packings) const {
        if (!hooks_.stage) return;
        for (std::size_t t = 0; t < rock_.targets.size(); ++t) {
            const std::int64_t count = tests.without_peak(space_.values_at(x), packings, t);
            if (count == 0) continue;
            hooks_.stage(
                fmt::format("  no peak: {} in {} of {} packings, which are left out; their stress was still "
                            "increasing at loading.max_axial_strain",
                            rock_.targets[t].name(rock_.tests), count, packings.count));
        }
    }

    PackingRange fit_packings() const { return {0, rock_.fit}; }
    PackingRange polish_packings() const { return {0, rock_.polish}; }
    PackingRange fresh_packings() const { return {rock_.polish, rock_.fresh}; }

    void measure(const std::vector<VectorXd>& points, PackingRange packings) {
        std::vector<std::vector<double>> values;
        values.reserve(points.size());
        for (const VectorXd& x : points) values.push_back(space_.values_at(x));
        search_.measure(values, packings);
    }

    /// @throws InputError if too few packings have results for all targets
    Measured measured_at(const VectorXd& x, PackingRange packings) {
        measure({x}, packings);
        Measured point;
        say_without_peak(search_, x, packings);
        point.rows = complete_rows(search_.figures(space_.values_at(x), packings));
        if (!are_enough(point.rows.rows(), packings.count)) refuse_point(x, packings);
        const VectorXd mean = point.rows.colwise().mean();
        const auto n = static_cast<double>(point.rows.rows());
        point.means = mean.array().log();
        point.errors.resize(space_.targets);
        for (Index t = 0; t < space_.targets; ++t)
            point.errors[t] = std::sqrt((point.rows.col(t).array() - mean[t]).square().sum() / (n - 1.0) / n) / mean[t];
        return point;
    }

    /// Throws an InputError that names the target with the fewest usable results.
    [[noreturn]] void refuse_point(const VectorXd& x, PackingRange packings) const {
        const std::vector<double> values = space_.values_at(x);
        std::string at;
        for (std::size_t k = 0; k < values.size(); ++k)
            at += fmt::format("{}{} = {:.4g}", k == 0 ? "" : ", ", rock_.free[k].name(), values[k]);
        const MatrixXd figures = search_.figures(values, packings);
        Index worst = 0, fewest = figures.rows(), negative = 0;
        for (Index t = 0; t < space_.targets; ++t) {
            const auto above = static_cast<Index>((figures.col(t).array() > 0.0).count());
            if (above >= fewest) continue;
            fewest = above;
            worst = t;
            negative = static_cast<Index>((figures.col(t).array() <= 0.0).count());
        }
        const std::int64_t peakless = search_.without_peak(values, packings, static_cast<std::size_t>(worst));
        const char* remedy = "find out why these tests went wrong";
        if (negative > 0) remedy = "choose another target";
        if (peakless > 0)
            remedy =
                "such specimens are ductile: raise loading.max_axial_strain, or use largest_stress (the largest stress "
                "up to that strain) as the figure";
        throw InputError(
            fmt::format("{}: found {} of {} above 0 in only {} of {} packings (0 or less in {}; without a peak in {}; "
                        "missing in {}, which went wrong) at {}, expected figures for all targets from at least half "
                        "of the packings; {}; see `crackle campaign show {}`",
                        space_.target(worst).where, space_.target(worst).quantity(),
                        space_.target(worst).source(rock_.tests), fewest, packings.count, negative, peakless,
                        packings.count - fewest - negative - peakless, at, remedy, search_.options().folder.string()));
    }

    void search() {
        double width = wide_design, worst_before = std::numeric_limits<double>::infinity();
        bool levelled = false;
        int stalls = 0;
        for (int round = 1; round <= most_rounds; ++round) {
            outcome_.rounds = round;
            if (!linear_.empty()) begin("fitting moduli by linear solves");
            x_ = linear_.solve(x_);
            begin(fmt::format("round {}: measuring the centre point on {}", round, counted(rock_.fit, "packing")));
            const Measured middle = measured_at(x_, fit_packings());
            surfaces_.remember(x_);
            linear_.learn(x_, middle.means);
            const VectorXd off = middle.means - space_.logs;
            say_where(off);
            const VectorXd limits = space_.widths.cwiseMax(middle.errors);
            const double worst = off.cwiseAbs().cwiseQuotient(limits).maxCoeff();
            const bool met = is_met(middle);
            const bool alone = space_.other_targets.empty();  // only moduli are targets, so there are no surfaces
            if (met && (alone || !surfaces_.empty())) return;
            if (alone) {
                if (worst > no_gain * worst_before && ++stalls == 2) return;
                worst_before = worst;
                continue;
            }
            if (space_.level_key >= 0 && !levelled) {
                levelled = true;
                if (level(off)) continue;
            }
            design(width);
            const VectorXd next = surfaces_.solve(x_, width, VectorXd::Ones(space_.targets));
            if (met) return;
            // The search stops after two rounds without progress.
            const double moved = surfaces_.distance(next, x_, width);
            const bool solvable = ((surfaces_.predict(next) - space_.logs).cwiseAbs().array() <= limits.array()).all();
            if ((moved < no_way || (!solvable && worst > no_gain * worst_before)) && ++stalls == 2) return;
            worst_before = worst;
            x_ = next;
            // Widens the design if the solution lies at the largest allowed distance; narrows it if the solution lies
            // within the design.
            if (moved > 0.95 * reach_of_surface)
                width = std::min(1.5 * width, widest_design);
            else if (moved < 1.0)
                width = narrow_design;
        }
    }

    /// Whether each mean is within half its tolerance, or one standard error, of its target.
    bool is_met(const Measured& point) const {
        const VectorXd limits = (met_share * space_.widths).cwiseMax(point.errors);
        return ((point.means - space_.logs).cwiseAbs().array() <= limits.array()).all();
    }

    /// Scales all strengths by a common factor towards their targets. @return whether the correction was large
    bool level(const VectorXd& off) {
        double sum = 0.0, weight = 0.0;
        for (const Index t : space_.other_targets) {
            if (!space_.goes_with_level(t)) continue;
            const double w = 1.0 / (space_.widths[t] * space_.widths[t]);
            sum += w * off[t];
            weight += w;
        }
        if (weight == 0.0) return false;
        const Index key = space_.level_key;
        x_[key] = std::clamp(x_[key] - sum / weight, space_.low[key], space_.high[key]);
        return std::abs(sum / weight) > 0.5 * wide_design;
    }

    void design(double width) {
        std::vector<VectorXd> points = surfaces_.design(x_, width);
        begin(fmt::format("round {}: measuring {} around the centre on {}", outcome_.rounds,
                          counted(points.size(), "point"), counted(rock_.fit, "packing")));
        measure(points, fit_packings());
        for (const VectorXd& x : points) surfaces_.remember(x);
        const std::size_t near = surfaces_.fit(x_, width);
        if (surfaces_.empty())
            throw InputError(fmt::format(
                "{}: found {} with all targets' figures, expected {} or more; see `crackle campaign show {} --wrong`, "
                "and narrow the bounds of [[free]]",
                rock_.file.string(), counted(near, "point"), space_.other_keys.size() + 1,
                search_.options().folder.string()));
    }

    /// Applies the final corrections, based on means over `Rock::polish` packings instead of `Rock::fit`.
    void polish() {
        for (int k = 0; k < most_corrections; ++k) {
            begin(fmt::format("correction on {}", counted(rock_.polish, "packing")));
            const VectorXd middle = x_;
            polished_ = measured_at(middle, polish_packings());
            say_where(polished_.means - space_.logs);
            outcome_.targets.resize(rock_.targets.size());
            for (Index t = 0; t < space_.targets; ++t)
                outcome_.targets[static_cast<std::size_t>(t)].polish = mean_of_column(polished_.rows, t);
            surfaces_.shift(middle, polished_.means);
            linear_.learn(middle, polished_.means);
            if (!surfaces_.empty()) x_ = surfaces_.solve(middle, narrow_design, VectorXd::Ones(space_.targets));
            x_ = linear_.solve(x_);
            // The means are measured again only if they did not meet the targets and the correction of a variable was
            // large.
            if (is_met(polished_) || (x_ - middle).cwiseAbs().maxCoeff() < large_correction) break;
        }
    }

    /// Measures fresh packings, which were not used for fitting.
    void judge() {
        begin(counted(rock_.fresh, "fresh packing"));
        fresh_.measure({space_.values_at(x_)}, fresh_packings());
        say_without_peak(fresh_, x_, fresh_packings());
        const MatrixXd figures = complete_rows(fresh_.figures(space_.values_at(x_), fresh_packings()));
        const VectorXd expected = expected_off();
        const bool at_rest = is_at_rest();
        for (Index t = 0; t < space_.targets; ++t) {
            ReachedTarget& reached = outcome_.targets[static_cast<std::size_t>(t)];
            const Target& target = space_.target(t);
            reached.fresh = mean_of_column(figures, t);
            reached.without_peak =
                fresh_.without_peak(space_.values_at(x_), fresh_packings(), static_cast<std::size_t>(t));
            const bool within_reach = std::abs(expected[t]) <= std::max(space_.widths[t], 2.0 * polished_.errors[t]);
            crackle::judge(reached, target.value, target.tolerance,
                           {are_enough(figures.rows(), rock_.fresh), within_reach, at_rest});
        }
    }

    /// Whether the best point predicted by the surfaces lies close to x_.
    bool is_at_rest() const {
        if (surfaces_.empty()) return true;
        const VectorXd next = surfaces_.solve(x_, narrow_design, VectorXd::Ones(space_.targets));
        return surfaces_.distance(next, x_, narrow_design) < reach_at_rest;
    }

    /// Expected logarithms of all results at x_ minus the logarithms of their targets.
    VectorXd expected_off() {
        VectorXd off = surfaces_.predict(x_) - space_.logs;
        if (!linear_.empty())
            off(space_.linear_targets) = linear_.off(x_).cwiseProduct(space_.widths(space_.linear_targets));
        return off;
    }

    /// Computes and measures compromises between the target with the largest deviation and the others. Moduli are left
    /// out: they depend only on the elastic keys, so the point nearest to their targets is the only compromise.
    void draw_frontier() {
        Index worst = -1;
        double most = 0.0;
        const VectorXd expected = expected_off();
        for (const Index t : space_.other_targets) {
            if (outcome_.targets[static_cast<std::size_t>(t)].verdict != TargetVerdict::out_of_reach) continue;
            if (std::abs(expected[t]) / space_.widths[t] <= most) continue;
            most = std::abs(expected[t]) / space_.widths[t];
            worst = t;
        }
        if (worst < 0 || surfaces_.empty()) return;
        std::vector<VectorXd> points;
        std::vector<double> of_points;
        for (const double weight : frontier_weights) {
            VectorXd weights = VectorXd::Ones(space_.targets);
            weights[worst] = weight;
            const VectorXd x = surfaces_.solve(x_, wide_design, weights);
            // A compromise close to the previous one is not measured.
            if (!points.empty() && surfaces_.distance(x, points.back(), wide_design) < 0.03) continue;
            points.push_back(x);
            of_points.push_back(weight);
        }
        if (points.size() < 2) return;  // no compromise is possible
        begin(fmt::format("frontier: {} on {}", counted(points.size(), "compromise"), counted(rock_.fit, "packing")));
        measure(points, fit_packings());
        outcome_.frontier_of = static_cast<std::size_t>(worst);
        for (std::size_t k = 0; k < points.size(); ++k) {
            FrontierPoint point;
            point.weight = of_points[k];
            point.values = space_.values_at(points[k]);
            const MatrixXd figures = complete_rows(search_.figures(point.values, fit_packings()));
            for (Index t = 0; t < space_.targets; ++t) point.figures.push_back(mean_of_column(figures, t));
            outcome_.frontier.push_back(point);
        }
    }

    void state_keys() {
        MatrixXd slopes = surfaces_.slopes(x_);
        if (!linear_.empty()) slopes(space_.linear_targets, space_.linear_keys) = linear_.slopes();
        // Covariance of the targets' residuals, in squared tolerances: the scatter of the means plus the errors of the
        // laboratory values.
        const auto n = static_cast<double>(polished_.rows.rows());
        MatrixXd relative(polished_.rows.rows(), space_.targets);
        for (Index t = 0; t < space_.targets; ++t)
            relative.col(t) = (polished_.rows.col(t).array() / polished_.rows.col(t).mean() - 1.0) / space_.widths[t];
        MatrixXd covariance = relative.transpose() * relative / (n - 1.0) / n;
        for (Index t = 0; t < space_.targets; ++t)
            covariance(t, t) += std::pow(space_.target(t).error / space_.widths[t], 2.0);
        const Determination known = determine(slopes, covariance, wide_design);
        const std::vector<double> values = space_.values_at(x_);
        for (Index k = 0; k < space_.keys; ++k) {
            const FreeKey& free = space_.key(k);
            const double half = t_95(polished_.rows.rows()) * known.standard_errors[k];
            const double margin = 1e-6 * (space_.high[k] - space_.low[k]);
            FoundKey found;
            found.value = values[static_cast<std::size_t>(k)];
            found.determined = known.determined[static_cast<std::size_t>(k)];
            found.lost_in_scatter =
                found.determined && fills(x_[k] - half, x_[k] + half, space_.low[k], space_.high[k]);
            found.determined = found.determined && !found.lost_in_scatter;
            found.low = found.determined ? free.to_value(x_[k] - half) : free.from;
            found.high = found.determined ? free.to_value(x_[k] + half) : free.to;
            found.at_bound = x_[k] <= space_.low[k] + margin || x_[k] >= space_.high[k] - margin;
            outcome_.keys.push_back(found);
        }
        for (const OpenDirection& open : known.open) {
            FreeDirection direction;
            direction.change = open.change;
            for (Index k = 0; k < space_.keys; ++k)
                direction.factors.push_back(space_.key(k).logarithmic() ? std::exp(open.way[k]) : open.way[k]);
            outcome_.undetermined.push_back(direction);
        }
    }

    void list_tried() {
        for (const VectorXd& x : surfaces_.measured()) {
            const std::vector<double> values = space_.values_at(x);
            const MatrixXd rows = complete_rows(search_.figures(values, fit_packings()));
            if (!are_enough(rows.rows(), rock_.fit)) continue;
            const VectorXd means = rows.colwise().mean();
            outcome_.tried.push_back(values);
            outcome_.tried_means.emplace_back(means.data(), means.data() + means.size());
        }
    }

    const Rock& rock_;
    const CalibrationHooks& hooks_;
    const SearchSpace space_;
    std::string stage_;
    Measurements search_, fresh_;
    LinearSearch linear_;
    SurfaceSearch surfaces_;
    VectorXd x_;  // current point of the search
    Measured polished_;
    CalibrationOutcome outcome_;
};

}  // namespace

bool CalibrationOutcome::all_reached() const {
    return std::all_of(targets.begin(), targets.end(), [](const ReachedTarget& one) { return one.reached(); });
}

std::vector<double> CalibrationOutcome::values() const {
    std::vector<double> all;
    all.reserve(keys.size());
    for (const FoundKey& key : keys) all.push_back(key.value);
    return all;
}

CalibrationOutcome calibrate(const Rock& rock, const CalibrationOptions& options, const CalibrationHooks& hooks) {
    make_folder(options.folder);
    const FolderLock lock(options.folder);
    // Removes tests that ended without results in earlier calls. This is done only once, so that such tests of this
    // call stay in the ledger in every round.
    for (const char* folder : {"search", "fresh"}) {
        const std::filesystem::path ledger = ledger_file(options.folder / folder);
        if (options.retry && is_file(ledger)) CampaignLedger::open(ledger).drop_gone_wrong();
    }
    return Calibration(rock, options, hooks).run();
}

}  // namespace crackle
