// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/calibration/calibrate.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <Eigen/SVD>
#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <optional>

#include "solver/base/errors.hpp"
#include "solver/files/folder_lock.hpp"
#include "solver/files/replace_file.hpp"
#include "specimens/calibration/box_minimum.hpp"
#include "specimens/calibration/linear_figures.hpp"
#include "specimens/calibration/measurements.hpp"
#include "specimens/calibration/surface.hpp"
#include "specimens/campaign/point_table.hpp"
#include "specimens/making/hooks.hpp"

namespace crackle {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

// Half-widths of a design, in logarithms: 0.3 is from 0.74 to 1.35 of the middle. The next design is as wide until its
// solution lies within it.
constexpr double wide = 0.3, narrow = 0.18;
// Points of earlier designs this many half-widths away count, too.
constexpr double reach_of_points = 2.5;
// A solution may lie this many half-widths from the middle of the design.
constexpr double reach_of_surface = 1.6;
constexpr int most_rounds = 8;
// Pull of the start values where targets say nothing, in tolerances a unit of logarithm.
constexpr double pull_of_start = 0.02;
// Moduli are solved for to this share of a tolerance.
constexpr double linear_share = 0.02;
// A correction of more than this, in logarithms of figures, is measured again.
constexpr double large_correction = 0.1;
constexpr int most_corrections = 3;
// Less than this many tolerances along a step of 1.3: targets do not determine that direction.
constexpr double undetermined_change = 0.5;
// Share of the packings that must have given all figures at a point.
constexpr double least_share_done = 0.5;

double t_95(Index count) {
    return boost::math::quantile(boost::math::students_t(static_cast<double>(std::max<Index>(1, count - 1))), 0.975);
}

/// Rows without a gap.
MatrixXd complete_rows(const MatrixXd& figures) {
    MatrixXd kept(figures.rows(), figures.cols());
    Index count = 0;
    for (Index k = 0; k < figures.rows(); ++k)
        if ((figures.row(k).array() > 0.0).all()) kept.row(count++) = figures.row(k);
    return kept.topRows(count);
}

MeanFigure mean_of_column(const MatrixXd& figures, Index column) {
    std::vector<double> values;
    for (Index k = 0; k < figures.rows(); ++k)
        if (std::isfinite(figures(k, column))) values.push_back(figures(k, column));
    return mean_of(values);
}

class Calibration {
  public:
    Calibration(const Rock& rock, const CalibrationOptions& options, const CalibrationHooks& hooks)
        : rock_(rock),
          hooks_(hooks),
          search_(rock, Keep::figures, campaign_options(options, "search"), campaign_hooks()),
          fresh_(rock, Keep::curves, campaign_options(options, "fresh"), campaign_hooks()),
          keys_(static_cast<Index>(rock.free.size())),
          targets_(static_cast<Index>(rock.targets.size())) {
        sort_out();
    }

    CalibrationOutcome run() {
        search();
        polish();
        judge();
        if (!outcome_.out_of_reach.empty()) draw_frontier();
        find_directions();
        state_intervals();
        for (const VectorXd& x : tried_) outcome_.tried.push_back(values_at(x));
        outcome_.tests = search_.tests() + fresh_.tests();
        outcome_.processor_seconds = search_.processor_seconds() + fresh_.processor_seconds();
        return std::move(outcome_);
    }

  private:
    /// Means of a point's figures over the packings that have all of them, as logarithms.
    struct Point {
        VectorXd x, means;  // means: not a number where too few packings have them
        MatrixXd rows;      // figures of these packings
    };

    static CampaignOptions campaign_options(const CalibrationOptions& options, const char* folder) {
        CampaignOptions all;
        all.folder = options.folder / folder;
        all.workers = options.workers;
        all.endless = options.endless;
        return all;
    }
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

    /// Which keys and targets belong to the linear solve, and what is known of the others.
    void sort_out() {
        low_.resize(keys_);
        high_.resize(keys_);
        start_.resize(keys_);
        logs_.resize(targets_);
        widths_.resize(targets_);
        for (Index k = 0; k < keys_; ++k) {
            const FreeKey& free = rock_.free[static_cast<std::size_t>(k)];
            low_[k] = free.to_variable(free.from);
            high_[k] = free.to_variable(free.to);
            start_[k] = free.to_variable(free.start);
        }
        for (Index t = 0; t < targets_; ++t) {
            const Target& target = target_at(t);
            logs_[t] = std::log(target.value);
            widths_[t] = std::log1p(target.tolerance);
        }
        std::vector<Index> elastic;
        for (Index k = 0; k < keys_; ++k)
            if (is_elastic_key(rock_.free[static_cast<std::size_t>(k)].key)) elastic.push_back(k);
        for (Index t = 0; t < targets_; ++t)
            if (!elastic.empty() && linear_figure_of(target_at(t).figure)) linear_targets_.push_back(t);
        if (!linear_targets_.empty()) linear_keys_ = elastic;
        for (Index t = 0; t < targets_; ++t)
            if (!contains(linear_targets_, t)) other_targets_.push_back(t);
        for (Index k = 0; k < keys_; ++k)
            if (!contains(linear_keys_, k)) other_keys_.push_back(k);
        if (other_targets_.empty()) other_keys_.clear();  // nothing says where they are: they stay at their start
        find_level_key();
        x_ = start_;
        factors_ = VectorXd::Zero(targets_);
    }

    /// Strengths go with the first power of tensile_strength where cohesion goes with it, up to the ratio of strength
    /// to modulus.
    void find_level_key() {
        Index tensile = -1;
        bool cohesion = false;
        for (Index k = 0; k < keys_; ++k) {
            const FreeKey& free = rock_.free[static_cast<std::size_t>(k)];
            if (free.key == "material.tensile_strength" && free.of.empty() && free.logarithmic()) tensile = k;
            if (free.key == "material.cohesion" && free.of == "material.tensile_strength") cohesion = true;
        }
        if (tensile < 0 || !cohesion || !contains(other_keys_, tensile)) return;
        for (std::size_t test = 0; test < rock_.tests.size(); ++test) {
            const TestCase at = rock_.case_of(test, values_at(start_));
            if (at.bond.law != "coulomb" || !at.mineral.empty()) return;
        }
        level_key_ = tensile;
    }

    const Target& target_at(Index t) const { return rock_.targets[static_cast<std::size_t>(t)]; }
    static bool contains(const std::vector<Index>& all, Index one) {
        return std::find(all.begin(), all.end(), one) != all.end();
    }
    bool is_level_target(Index t) const {
        return level_key_ >= 0 && !unit_of_figure(target_at(t).figure, true).empty();
    }
    std::vector<double> values_at(const VectorXd& x) const {
        std::vector<double> values;
        for (Index k = 0; k < keys_; ++k) values.push_back(rock_.free[static_cast<std::size_t>(k)].to_value(x[k]));
        return values;
    }

    /// Moves the elastic keys until the linear moduli, times what tests measure beside them, are the targets.
    void solve_elastic() {
        if (linear_keys_.empty()) return;
        begin("moduli by the linear solve");
        const auto keys = static_cast<Index>(linear_keys_.size());
        const auto at = [&](const VectorXd& own) {
            VectorXd x = x_;
            for (Index k = 0; k < keys; ++k) x[linear_keys_[static_cast<std::size_t>(k)]] = own[k];
            return x;
        };
        VectorXd own(keys), low(keys), high(keys);
        for (Index k = 0; k < keys; ++k) {
            const Index key = linear_keys_[static_cast<std::size_t>(k)];
            own[k] = x_[key];
            low[k] = low_[key];
            high[k] = high_[key];
        }
        VectorXd residuals = linear_residuals(at(own));
        if (linear_slopes_.size() == 0) {
            // Steps of a tenth: the moduli are smooth, and solved to nine digits.
            constexpr double step = 0.1;
            linear_slopes_.resize(residuals.size(), keys);
            for (Index k = 0; k < keys; ++k) {
                VectorXd other = own;
                other[k] += own[k] + step <= high[k] ? step : -step;
                linear_slopes_.col(k) = (linear_residuals(at(other)) - residuals) / (other[k] - own[k]);
            }
        }
        constexpr int most_steps = 12;
        for (int k = 0; k < most_steps && residuals.cwiseAbs().maxCoeff() > linear_share; ++k) {
            const Residuals linear = [&](const VectorXd& x, VectorXd& r, MatrixXd& jacobian) {
                r = residuals + linear_slopes_ * (x - own);
                jacobian = linear_slopes_;
            };
            const VectorXd next = box_minimum(linear, own, low, high);
            const VectorXd way = next - own;
            if (way.cwiseAbs().maxCoeff() < 1e-9) break;  // at its bounds
            const VectorXd there = linear_residuals(at(next));
            // Broyden's update: without noise it converges.
            linear_slopes_ += (there - residuals - linear_slopes_ * way) * way.transpose() / way.squaredNorm();
            own = next;
            residuals = there;
        }
        x_ = at(own);
    }

    /// In tolerances, of the linear targets.
    VectorXd linear_residuals(const VectorXd& x) {
        const VectorXd logs = linear_logs(x);
        VectorXd all(static_cast<Index>(linear_targets_.size()));
        for (Index k = 0; k < all.size(); ++k) {
            const Index t = linear_targets_[static_cast<std::size_t>(k)];
            all[k] = (logs[k] + factors_[t] - logs_[t]) / widths_[t];
        }
        return all;
    }

    /// Logarithms of the linear figures of the linear targets.
    VectorXd linear_logs(const VectorXd& x) {
        for (const auto& [known, logs] : linear_known_)
            if (known == x) return logs;
        LinearRequest request;
        request.rock = &rock_;
        request.packings = search_.options().folder / "packings";
        request.workers = search_.options().workers;
        request.interrupted = hooks_.interrupted;
        for (const Index t : linear_targets_) {
            const std::size_t test = target_at(t).test;
            if (std::find(request.tests.begin(), request.tests.end(), test) == request.tests.end())
                request.tests.push_back(test);
        }
        const auto means = mean_linear_figures(request, values_at(x));
        outcome_.linear_solves += rock_.fit * static_cast<std::int64_t>(request.tests.size());
        VectorXd logs(static_cast<Index>(linear_targets_.size()));
        for (Index k = 0; k < logs.size(); ++k) {
            const Target& target = target_at(linear_targets_[static_cast<std::size_t>(k)]);
            const auto place = std::find(request.tests.begin(), request.tests.end(), target.test);
            const double mean = means[static_cast<std::size_t>(place - request.tests.begin())]
                                     [static_cast<std::size_t>(*linear_figure_of(target.figure))];
            if (!(mean > 0.0))
                throw InputError(fmt::format(
                    "{}: {}: found {:.3g} by the linear solve, expected a number > 0; leave the target out, or take "
                    "another test",
                    target.where, target.figure, mean));
            logs[k] = std::log(mean);
        }
        linear_known_.emplace_back(x, logs);
        return logs;
    }

    PackingRange fit_packings() const { return {0, rock_.fit}; }

    /// Points of a design, measured together. Means are those of the packings that all of them have done.
    void measure(const std::vector<VectorXd>& points, PackingRange packings) {
        std::vector<std::vector<double>> values;
        for (const VectorXd& x : points) values.push_back(values_at(x));
        search_.measure(values, packings);
    }
    Point point_at(const VectorXd& x, PackingRange packings) const {
        Point point;
        point.x = x;
        point.rows = complete_rows(search_.figures(values_at(x), packings));
        point.means = VectorXd::Constant(targets_, not_a_number);
        if (static_cast<double>(point.rows.rows()) >=
            std::max(3.0, least_share_done * static_cast<double>(packings.count)))
            point.means = point.rows.colwise().mean().transpose().array().log();
        return point;
    }

    /// @throws InputError where too few packings have given the figures of a point that is needed
    Point needed_point(const VectorXd& x, PackingRange packings) const {
        Point point = point_at(x, packings);
        if (point.means.array().isNaN().any()) {
            std::string at;
            const std::vector<double> values = values_at(x);
            for (std::size_t k = 0; k < values.size(); ++k)
                at += fmt::format("{}{} = {:.4g}", k == 0 ? "" : ", ", rock_.free[k].name(), values[k]);
            throw InputError(fmt::format(
                "{}: found all targets' figures of {} of {} packings at {}, expected at least half; see `crackle "
                "campaign show {}`: tests that do not fail want a larger loading.max_axial_strain",
                rock_.file.string(), point.rows.rows(), packings.count, at, search_.options().folder.string()));
        }
        return point;
    }

    /// Of the mean's logarithm, over packings.
    VectorXd standard_errors(const Point& point) const {
        const VectorXd mean = point.rows.colwise().mean();
        VectorXd errors(targets_);
        const auto n = static_cast<double>(point.rows.rows());
        for (Index t = 0; t < targets_; ++t)
            errors[t] = std::sqrt((point.rows.col(t).array() - mean[t]).square().sum() / (n - 1.0) / n) / mean[t];
        return errors;
    }

    void learn_factors(const Point& point) {
        if (linear_targets_.empty()) return;
        const VectorXd logs = linear_logs(point.x);
        // Of the packings that the linear means are of.
        for (std::size_t k = 0; k < linear_targets_.size(); ++k)
            factors_[linear_targets_[k]] = point.means[linear_targets_[k]] - logs[static_cast<Index>(k)];
    }

    void search() {
        double width = wide;
        double before = std::numeric_limits<double>::infinity();
        bool levelled = false;
        int stalls = 0;
        for (outcome_.rounds = 1; outcome_.rounds <= most_rounds; ++outcome_.rounds) {
            solve_elastic();
            begin(fmt::format("round {}: its middle on {} packings", outcome_.rounds, rock_.fit));
            measure({x_}, fit_packings());
            const Point centre = needed_point(x_, fit_packings());
            remember(centre);
            learn_factors(centre);
            const VectorXd off = centre.means - logs_, errors = standard_errors(centre);
            say_where(off);
            double worst = 0.0;
            bool met = true;
            for (Index t = 0; t < targets_; ++t) {
                met = met && std::abs(off[t]) <= std::max(0.5 * widths_[t], errors[t]);
                worst = std::max(worst, std::abs(off[t]) / std::max(widths_[t], errors[t]));
            }
            const bool surfaces_known = !surfaces_.empty() || other_targets_.empty();
            if (met && surfaces_known) break;
            if (level_key_ >= 0 && !levelled) {
                levelled = true;
                if (level(off)) continue;
            }
            if (other_targets_.empty()) {
                if (worst > 0.9 * before && ++stalls == 2) break;
                before = worst;
                continue;
            }
            design(width);
            const VectorXd next = solve(width, VectorXd::Ones(targets_));
            const double moved = distance(next, x_, width);
            const VectorXd foretold = foretell(next);
            bool solvable = true;
            for (const Index t : other_targets_)
                solvable = solvable && std::abs(foretold[t] - logs_[t]) <= std::max(widths_[t], errors[t]);
            if (met) break;
            // What cannot be reached is known once the surfaces have led nowhere twice.
            if (moved < 0.15 || (!solvable && worst > 0.9 * before)) {
                if (++stalls == 2) break;
            }
            before = worst;
            x_ = next;
            if (moved < 1.0) width = narrow;
        }
        outcome_.rounds = std::min(outcome_.rounds, most_rounds);
    }

    void say_where(const VectorXd& off) {
        if (!hooks_.stage) return;
        std::string text;
        for (Index t = 0; t < targets_; ++t)
            text += fmt::format("{}{} {:+.1f} %", t == 0 ? "" : ", ", target_at(t).name(rock_.tests),
                                100.0 * std::expm1(off[t]));
        hooks_.stage("  off by: " + text);
    }

    /// All strengths at once. @return whether it moved
    bool level(const VectorXd& off) {
        double sum = 0.0, weight = 0.0;
        for (const Index t : other_targets_) {
            if (!is_level_target(t)) continue;
            const double w = 1.0 / (widths_[t] * widths_[t]);
            sum += w * off[t];
            weight += w;
        }
        if (weight == 0.0) return false;
        const double way = sum / weight;
        x_[level_key_] = std::clamp(x_[level_key_] - way, low_[level_key_], high_[level_key_]);
        return std::abs(way) > 0.5 * wide;
    }

    void remember(const Point& point) {
        for (const VectorXd& x : tried_)
            if (x == point.x) return;
        tried_.push_back(point.x);
        std::vector<double> means;
        for (Index t = 0; t < targets_; ++t) means.push_back(std::exp(point.means[t]));
        outcome_.tried_means.push_back(means);
    }

    double distance(const VectorXd& a, const VectorXd& b, double width) const {
        double most = 0.0;
        for (const Index k : other_keys_) most = std::max(most, std::abs(a[k] - b[k]) / width);
        return most;
    }

    /// Measures points around x_ and fits the surfaces.
    void design(double width) {
        const auto p = other_keys_.size();
        std::vector<VectorXd> points{x_};
        const std::size_t count = 2 * p + 2;
        const auto shares = design_points(Sequence::sobol, designed_ + count, p);
        for (std::size_t k = designed_; k < designed_ + count; ++k) {
            VectorXd x = x_;
            for (std::size_t d = 0; d < p; ++d) {
                const Index key = other_keys_[d];
                // A box that the bounds cut keeps its width.
                const double low =
                    std::clamp(x_[key] - width, low_[key], std::max(low_[key], high_[key] - 2.0 * width));
                const double high = std::min(low + 2.0 * width, high_[key]);
                x[key] = low + shares[k][d] * (high - low);
            }
            points.push_back(x);
        }
        designed_ += count;
        begin(fmt::format("round {}: {} points around it on {} packings", outcome_.rounds, count, rock_.fit));
        measure(points, fit_packings());
        for (const VectorXd& x : points) remember(point_at(x, fit_packings()));
        fit_surfaces(width);
    }

    void fit_surfaces(double width) {
        // A packing that one of the points lacks is left out of all; a point that too many lack is left out itself.
        std::vector<VectorXd> near;
        std::vector<MatrixXd> figures;
        for (const VectorXd& x : tried_) {
            if (distance(x, x_, width) > reach_of_points) continue;
            const MatrixXd all = search_.figures(values_at(x), fit_packings());
            if (static_cast<double>(complete_rows(all).rows()) < least_share_done * static_cast<double>(rock_.fit))
                continue;
            near.push_back(x);
            figures.push_back(all);
        }
        std::vector<Index> common;
        for (Index k = 0; k < rock_.fit; ++k) {
            bool all = true;
            for (const MatrixXd& one : figures) all = all && (one.row(k).array() > 0.0).all();
            if (all) common.push_back(k);
        }
        MatrixXd points(keys_, static_cast<Index>(near.size())), means(static_cast<Index>(near.size()), targets_);
        for (std::size_t k = 0; k < near.size(); ++k) {
            const auto at = static_cast<Index>(k);
            points.col(at) = near[k];
            if (static_cast<double>(common.size()) >=
                std::max(3.0, least_share_done * static_cast<double>(rock_.fit))) {
                VectorXd sum = VectorXd::Zero(targets_);
                for (const Index row : common) sum += figures[k].row(row).transpose();
                means.row(at) = (sum / static_cast<double>(common.size())).array().log().transpose();
            } else {
                means.row(at) = complete_rows(figures[k]).colwise().mean().array().log();
            }
        }
        surfaces_.clear();
        for (const Index t : other_targets_) {
            VectorXd slopes = VectorXd::Zero(keys_);
            for (const Index k : other_keys_) slopes[k] = not_a_number;
            if (is_level_target(t)) slopes[level_key_] = 1.0;
            try {
                surfaces_.emplace_back(x_, points, means.col(t), slopes);
            } catch (const std::invalid_argument&) {
                throw InputError(fmt::format(
                    "{}: found too few of {} points with all targets' figures, expected more; see `crackle campaign "
                    "show {} --wrong`, and narrow the bounds of [[free]]",
                    rock_.file.string(), near.size(), search_.options().folder.string()));
            }
        }
    }

    /// Logarithms of all targets' figures at x by the surfaces; linear targets are at their targets.
    VectorXd foretell(const VectorXd& x) const {
        VectorXd all = logs_;
        for (std::size_t k = 0; k < surfaces_.size(); ++k) all[other_targets_[k]] = surfaces_[k].value(x);
        return all;
    }

    /// Best point by the surfaces around x_. @param weights of the targets
    VectorXd solve(double width, const VectorXd& weights) const {
        const auto p = static_cast<Index>(other_keys_.size()), n = static_cast<Index>(other_targets_.size());
        const auto at = [&](const VectorXd& own) {
            VectorXd x = x_;
            for (Index k = 0; k < p; ++k) x[other_keys_[static_cast<std::size_t>(k)]] = own[k];
            return x;
        };
        VectorXd own(p), low(p), high(p);
        for (Index k = 0; k < p; ++k) {
            const Index key = other_keys_[static_cast<std::size_t>(k)];
            own[k] = x_[key];
            // What is known of the level holds everywhere.
            const double reach = key == level_key_ ? 3.0 : reach_of_surface * width;
            low[k] = std::max(low_[key], x_[key] - reach);
            high[k] = std::min(high_[key], x_[key] + reach);
        }
        const Residuals residuals = [&](const VectorXd& q, VectorXd& r, MatrixXd& jacobian) {
            const VectorXd x = at(q);
            r.resize(n + p);
            jacobian = MatrixXd::Zero(n + p, p);
            for (Index k = 0; k < n; ++k) {
                const Index t = other_targets_[static_cast<std::size_t>(k)];
                const Surface& surface = surfaces_[static_cast<std::size_t>(k)];
                const double scale = weights[t] / widths_[t];
                r[k] = scale * (surface.value(x) - logs_[t]);
                const VectorXd slope = surface.gradient(x);
                for (Index d = 0; d < p; ++d) jacobian(k, d) = scale * slope[other_keys_[static_cast<std::size_t>(d)]];
            }
            for (Index d = 0; d < p; ++d) {
                r[n + d] = pull_of_start * (q[d] - start_[other_keys_[static_cast<std::size_t>(d)]]);
                jacobian(n + d, d) = pull_of_start;
            }
        };
        return at(box_minimum(residuals, own, low, high));
    }

    /// Corrects on many packings.
    void polish() {
        const PackingRange packings{0, rock_.polish};
        for (int k = 0; k < most_corrections; ++k) {
            begin(fmt::format("correction on {} packings", rock_.polish));
            measure({x_}, packings);
            polished_ = needed_point(x_, packings);
            say_where(polished_.means - logs_);
            outcome_.targets.resize(static_cast<std::size_t>(targets_));
            for (Index t = 0; t < targets_; ++t)
                outcome_.targets[static_cast<std::size_t>(t)].polish = mean_of_column(polished_.rows, t);
            for (std::size_t s = 0; s < surfaces_.size(); ++s)
                surfaces_[s].shift(polished_.means[other_targets_[s]] - surfaces_[s].value(x_));
            const VectorXd middle = x_;
            if (!surfaces_.empty()) x_ = solve(narrow, VectorXd::Ones(targets_));
            if (!linear_targets_.empty()) {
                const VectorXd logs = linear_logs(middle);
                for (std::size_t t = 0; t < linear_targets_.size(); ++t)
                    factors_[linear_targets_[t]] = polished_.means[linear_targets_[t]] - logs[static_cast<Index>(t)];
                solve_elastic();
            }
            if ((x_ - middle).cwiseAbs().maxCoeff() < large_correction) break;
        }
    }

    /// On packings that nothing was fitted to.
    void judge() {
        begin(fmt::format("{} fresh packings", rock_.fresh));
        const PackingRange packings{rock_.polish, rock_.fresh};
        fresh_.measure({values_at(x_)}, packings);
        const MatrixXd figures = fresh_.figures(values_at(x_), packings);
        for (Index t = 0; t < targets_; ++t) {
            ReachedTarget& reached = outcome_.targets[static_cast<std::size_t>(t)];
            const Target& target = target_at(t);
            reached.fresh = mean_of_column(figures, t);
            reached.deviation = reached.fresh.mean / target.value - 1.0;
            reached.limit = std::max(target.tolerance, 2.0 * reached.fresh.standard_error / target.value);
            reached.reached = std::abs(reached.deviation) <= reached.limit;
        }
        const VectorXd foretold = foretell(x_), errors = standard_errors(polished_);
        for (const Index t : other_targets_) {
            const double off = std::abs(foretold[t] - logs_[t]);
            ReachedTarget& reached = outcome_.targets[static_cast<std::size_t>(t)];
            reached.within_reach = off <= std::max(widths_[t], 2.0 * errors[t]);
            if (!reached.within_reach) outcome_.out_of_reach.push_back(static_cast<std::size_t>(t));
        }
        for (const Index t : linear_targets_) {
            ReachedTarget& reached = outcome_.targets[static_cast<std::size_t>(t)];
            const VectorXd logs = linear_logs(x_);
            const auto place = std::find(linear_targets_.begin(), linear_targets_.end(), t) - linear_targets_.begin();
            reached.within_reach = std::abs(logs[place] + factors_[t] - logs_[t]) <= widths_[t];
            if (!reached.within_reach) outcome_.out_of_reach.push_back(static_cast<std::size_t>(t));
        }
        // Few packings that scatter widely allow everything: what is known to be out of reach is not reached by that.
        for (ReachedTarget& reached : outcome_.targets) reached.reached = reached.reached && reached.within_reach;
    }

    /// From «the others first» to «this one first», for the target that is missed by most.
    void draw_frontier() {
        Index worst = -1;
        double most = 0.0;
        const VectorXd foretold = foretell(x_);
        for (const std::size_t t : outcome_.out_of_reach) {
            const auto at = static_cast<Index>(t);
            const double off = std::abs(foretold[at] - logs_[at]) / widths_[at];
            if (off > most) {
                most = off;
                worst = at;
            }
        }
        if (worst < 0 || surfaces_.empty()) return;
        std::vector<VectorXd> points;
        constexpr double weights[]{0.03, 0.3, 1.0, 3.0, 30.0};
        for (const double weight : weights) {
            VectorXd all = VectorXd::Ones(targets_);
            all[worst] = weight;
            points.push_back(solve(wide, all));
        }
        begin(fmt::format("frontier: {} compromises on {} packings", points.size(), rock_.fit));
        measure(points, fit_packings());
        for (std::size_t k = 0; k < points.size(); ++k) {
            FrontierPoint point;
            point.weight = weights[k];
            point.values = values_at(points[k]);
            const MatrixXd figures = search_.figures(point.values, fit_packings());
            for (Index t = 0; t < targets_; ++t) point.figures.push_back(mean_of_column(figures, t));
            outcome_.frontier.push_back(point);
        }
    }

    /// Of figures' logarithms in tolerances, a row a target, over the variables.
    MatrixXd jacobian() const {
        MatrixXd all = MatrixXd::Zero(targets_, keys_);
        for (std::size_t k = 0; k < surfaces_.size(); ++k)
            all.row(other_targets_[k]) = surfaces_[k].gradient(x_).transpose() / widths_[other_targets_[k]];
        for (std::size_t t = 0; t < linear_targets_.size(); ++t)
            for (std::size_t k = 0; k < linear_keys_.size(); ++k)
                all(linear_targets_[t], linear_keys_[k]) = linear_slopes_(static_cast<Index>(t), static_cast<Index>(k));
        return all;
    }

    void find_directions() {
        const Eigen::JacobiSVD<MatrixXd> svd(jacobian() * wide, Eigen::ComputeThinU | Eigen::ComputeFullV);
        determined_ = MatrixXd::Zero(keys_, targets_);  // of the pseudo-inverse without what is not determined
        for (Index k = 0; k < keys_; ++k) {
            const double change = k < svd.singularValues().size() ? svd.singularValues()[k] : 0.0;
            if (change >= undetermined_change) {
                determined_ += svd.matrixV().col(k) * svd.matrixU().col(k).transpose() * (wide / change);
                continue;
            }
            FreeDirection direction;
            const VectorXd v = svd.matrixV().col(k) / svd.matrixV().col(k).cwiseAbs().maxCoeff();
            for (Index d = 0; d < keys_; ++d) {
                const double way = wide * v[d];
                direction.factors.push_back(rock_.free[static_cast<std::size_t>(d)].logarithmic() ? std::exp(way)
                                                                                                  : way);
            }
            direction.change = change;
            outcome_.undetermined.push_back(direction);
        }
    }

    void state_intervals() {
        // Covariance of the targets' residuals, in tolerances: of the polished means, the surfaces and the laboratory.
        const auto n = static_cast<double>(polished_.rows.rows());
        MatrixXd relative(polished_.rows.rows(), targets_);
        for (Index t = 0; t < targets_; ++t)
            relative.col(t) = (polished_.rows.col(t).array() / polished_.rows.col(t).mean() - 1.0) / widths_[t];
        MatrixXd covariance = relative.transpose() * relative / (n - 1.0) / n;
        for (Index t = 0; t < targets_; ++t) covariance(t, t) += std::pow(target_at(t).error / widths_[t], 2.0);
        const MatrixXd of_keys = determined_ * covariance * determined_.transpose();
        const double t = t_95(polished_.rows.rows());
        const std::vector<double> values = values_at(x_);
        for (Index k = 0; k < keys_; ++k) {
            const FreeKey& free = rock_.free[static_cast<std::size_t>(k)];
            FoundKey found;
            found.value = values[static_cast<std::size_t>(k)];
            const double half = t * std::sqrt(std::max(0.0, of_keys(k, k)));
            found.low = free.to_value(x_[k] - half);
            found.high = free.to_value(x_[k] + half);
            for (const FreeDirection& direction : outcome_.undetermined) {
                const double factor = direction.factors[static_cast<std::size_t>(k)];
                const double way = free.logarithmic() ? std::log(factor) : factor;
                // It moves by more than a tenth of the largest.
                if (std::abs(way) > 0.1 * wide) found.determined = false;
            }
            if (!found.determined) {
                found.low = free.from;
                found.high = free.to;
            }
            const double margin = 1e-6 * (high_[k] - low_[k]);
            found.at_bound = x_[k] <= low_[k] + margin || x_[k] >= high_[k] - margin;
            outcome_.keys.push_back(found);
        }
    }

    const Rock& rock_;
    const CalibrationHooks& hooks_;
    std::string stage_;
    Measurements search_, fresh_;
    Index keys_, targets_;
    VectorXd low_, high_, start_;  // of the variables
    VectorXd logs_, widths_;       // of the targets: logarithm, and that of 1 + tolerance
    std::vector<Index> linear_keys_, other_keys_, linear_targets_, other_targets_;
    Index level_key_ = -1;
    VectorXd x_;        // where the search is
    VectorXd factors_;  // logarithms of measured over linear figures, of the linear targets
    MatrixXd linear_slopes_;
    std::vector<std::pair<VectorXd, VectorXd>> linear_known_;
    std::vector<VectorXd> tried_;
    std::size_t designed_ = 0;       // points of the sequence that designs have used
    std::vector<Surface> surfaces_;  // of other_targets_
    Point polished_;
    MatrixXd determined_;
    CalibrationOutcome outcome_;
};

}  // namespace

bool CalibrationOutcome::all_reached() const {
    return std::all_of(targets.begin(), targets.end(), [](const ReachedTarget& one) { return one.reached; });
}

std::vector<double> CalibrationOutcome::values() const {
    std::vector<double> all;
    for (const FoundKey& key : keys) all.push_back(key.value);
    return all;
}

CalibrationOutcome calibrate(const Rock& rock, const CalibrationOptions& options, const CalibrationHooks& hooks) {
    make_folder(options.folder);
    const FolderLock lock(options.folder);
    return Calibration(rock, options, hooks).run();
}

}  // namespace crackle
