// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/calibration/surface_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "specimens/calibration/box_minimum.hpp"

namespace crackle {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Points of earlier designs within this distance of the centre, in half-widths, are used too.
constexpr double reach_of_points = 2.5;
// Largest step of a solution along the level key, in logarithms. It may be large, since strengths are known to be
// proportional to that key.
constexpr double reach_of_level = 3.0;
// Weight of the penalty that keeps a key near its start value if the targets do not constrain the key: residual in
// tolerances, per unit change of the key's logarithm. It exceeds the noise but is small compared with the weight of a
// target.
constexpr double pull_of_start = 0.1;
// A point needs results for all targets in at least this fraction of its packings, and in at least fewest_done of them.
constexpr double least_share_done = 0.5;
constexpr double fewest_done = 3.0;

}  // namespace

MatrixXd complete_rows(const MatrixXd& figures) {
    MatrixXd kept(figures.rows(), figures.cols());
    Index count = 0;
    for (Index k = 0; k < figures.rows(); ++k)
        if ((figures.row(k).array() > 0.0).all()) kept.row(count++) = figures.row(k);
    return kept.topRows(count);
}

bool are_enough(Index done, Index asked) {
    return static_cast<double>(done) >= std::max(fewest_done, least_share_done * static_cast<double>(asked));
}

SurfaceSearch::SurfaceSearch(const SearchSpace& space, Figures figures) : space_(space), figures_(std::move(figures)) {}

std::vector<VectorXd> SurfaceSearch::design(const VectorXd& middle, double width) {
    const std::size_t p = space_.other_keys.size(), count = 2 * p + 2;
    const auto shares = design_points(Sequence::sobol, designed_ + count, p);
    std::vector<VectorXd> points;
    for (std::size_t k = designed_; k < designed_ + count; ++k) {
        VectorXd x = middle;
        for (std::size_t d = 0; d < p; ++d) {
            const Index key = space_.other_keys[d];
            // A box that would extend past a bound is shifted and keeps its width.
            const double last = std::max(space_.low[key], space_.high[key] - 2.0 * width);
            const double low = std::clamp(middle[key] - width, space_.low[key], last);
            const double high = std::min(low + 2.0 * width, space_.high[key]);
            x[key] = low + shares[k][d] * (high - low);
        }
        points.push_back(x);
    }
    designed_ += count;
    return points;
}

void SurfaceSearch::remember(const VectorXd& x) {
    if (std::find(measured_.begin(), measured_.end(), x) == measured_.end()) measured_.push_back(x);
}

std::size_t SurfaceSearch::fit(const VectorXd& middle, double width) {
    std::vector<VectorXd> near;
    std::vector<MatrixXd> figures;
    for (const VectorXd& x : measured_) {
        if (distance(x, middle, width) > reach_of_points) continue;
        MatrixXd all = figures_(x);
        if (!are_enough(complete_rows(all).rows(), all.rows())) continue;
        near.push_back(x);
        figures.push_back(std::move(all));
    }
    surfaces_.clear();
    if (near.size() < space_.other_keys.size() + 1) return near.size();
    // A packing that lacks results at one point is left out at all points if enough packings remain. All points are
    // then compared on the same packings.
    std::vector<Index> common;
    for (Index row = 0; row < figures.front().rows(); ++row)
        if (std::all_of(figures.begin(), figures.end(),
                        [&](const MatrixXd& all) { return (all.row(row).array() > 0.0).all(); }))
            common.push_back(row);
    const bool paired = are_enough(static_cast<Index>(common.size()), figures.front().rows());
    MatrixXd points(space_.keys, static_cast<Index>(near.size()));
    MatrixXd means(static_cast<Index>(near.size()), space_.targets);
    for (std::size_t k = 0; k < near.size(); ++k) {
        const auto at = static_cast<Index>(k);
        points.col(at) = near[k];
        const MatrixXd rows = paired ? MatrixXd(figures[k](common, Eigen::all)) : complete_rows(figures[k]);
        means.row(at) = rows.colwise().mean().array().log();
    }
    for (const Index t : space_.other_targets) {
        VectorXd slopes = VectorXd::Zero(space_.keys);
        for (const Index k : space_.other_keys) slopes[k] = std::numeric_limits<double>::quiet_NaN();
        if (space_.goes_with_level(t)) slopes[space_.level_key] = 1.0;
        surfaces_.emplace_back(middle, points, means.col(t), slopes);
    }
    return near.size();
}

VectorXd SurfaceSearch::predict(const VectorXd& x) const {
    VectorXd all = space_.logs;
    for (std::size_t k = 0; k < surfaces_.size(); ++k) all[space_.other_targets[k]] = surfaces_[k].value(x);
    return all;
}

VectorXd SurfaceSearch::solve(const VectorXd& middle, double width, const VectorXd& weights) const {
    const std::vector<Index>& keys = space_.other_keys;
    const auto p = static_cast<Index>(keys.size()), n = static_cast<Index>(surfaces_.size());
    VectorXd low(p), high(p);
    for (Index k = 0; k < p; ++k) {
        const Index key = keys[static_cast<std::size_t>(k)];
        const double reach = key == space_.level_key ? reach_of_level : reach_of_surface * width;
        low[k] = std::max(space_.low[key], middle[key] - reach);
        high[k] = std::min(space_.high[key], middle[key] + reach);
    }
    VectorXd x = middle;
    const Residuals residuals = [&](const VectorXd& own, VectorXd& r, MatrixXd& jacobian) {
        x(keys) = own;
        r.resize(n + p);
        jacobian = MatrixXd::Zero(n + p, p);
        for (Index k = 0; k < n; ++k) {
            const Index t = space_.other_targets[static_cast<std::size_t>(k)];
            const Surface& surface = surfaces_[static_cast<std::size_t>(k)];
            const double scale = weights[t] / space_.widths[t];
            r[k] = scale * (surface.value(x) - space_.logs[t]);
            jacobian.row(k) = scale * surface.gradient(x)(keys).transpose();
        }
        r.tail(p) = pull_of_start * (own - space_.start(keys));
        jacobian.bottomRows(p).diagonal().setConstant(pull_of_start);
    };
    const VectorXd best = box_minimum(residuals, middle(keys), low, high);
    x(keys) = best;
    return x;
}

void SurfaceSearch::shift(const VectorXd& x, const VectorXd& means) {
    for (std::size_t k = 0; k < surfaces_.size(); ++k)
        surfaces_[k].shift(means[space_.other_targets[k]] - surfaces_[k].value(x));
}

MatrixXd SurfaceSearch::slopes(const VectorXd& x) const {
    MatrixXd all = MatrixXd::Zero(space_.targets, space_.keys);
    for (std::size_t k = 0; k < surfaces_.size(); ++k) {
        const Index t = space_.other_targets[k];
        all.row(t) = surfaces_[k].gradient(x).transpose() / space_.widths[t];
    }
    return all;
}

std::vector<SurfaceQuality> SurfaceSearch::quality() const {
    std::vector<SurfaceQuality> all;
    for (std::size_t k = 0; k < surfaces_.size(); ++k)
        all.push_back({static_cast<std::size_t>(space_.other_targets[k]), surfaces_[k].quadratic(),
                       surfaces_[k].left_out_error()});
    return all;
}

double SurfaceSearch::distance(const VectorXd& a, const VectorXd& b, double width) const {
    double most = 0.0;
    for (const Index k : space_.other_keys) most = std::max(most, std::abs(a[k] - b[k]) / width);
    return most;
}

}  // namespace crackle
