// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/calibration/linear_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/base/errors.hpp"
#include "specimens/calibration/box_minimum.hpp"

namespace crackle {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Accuracy to which the linear search meets the target moduli, as a fraction of a tolerance.
constexpr double close_to_targets = 0.02;
// Step of the finite differences for the first slopes. It may be large, because the moduli depend smoothly on the keys.
constexpr double difference = 0.1;
constexpr int most_steps = 12;

}  // namespace

LinearSearch::LinearSearch(const SearchSpace& space, LinearRequest request)
    : space_(space),
      request_(std::move(request)),
      factors_(VectorXd::Zero(static_cast<Index>(space.linear_targets.size()))) {
    for (const Index t : space_.linear_targets) {
        const std::size_t test = space_.target(t).test;
        if (std::find(request_.tests.begin(), request_.tests.end(), test) == request_.tests.end())
            request_.tests.push_back(test);
    }
}

VectorXd LinearSearch::solve(VectorXd x) {
    if (empty()) return x;
    const std::vector<Index>& keys = space_.linear_keys;
    const auto count = static_cast<Index>(keys.size());
    VectorXd own = x(keys);
    const VectorXd low = space_.low(keys), high = space_.high(keys);
    const auto at = [&](const VectorXd& some) {
        x(keys) = some;
        return x;
    };
    VectorXd residuals = off(at(own));
    if (slopes_.size() == 0) {
        slopes_.resize(residuals.size(), count);
        for (Index k = 0; k < count; ++k) {
            VectorXd other = own;
            const double step = std::min(difference, 0.5 * (high[k] - low[k]));
            other[k] += high[k] - own[k] > own[k] - low[k] ? step : -step;
            slopes_.col(k) = (off(at(other)) - residuals) / (other[k] - own[k]);
        }
    }
    VectorXd best = own;
    double least = residuals.squaredNorm();
    for (int k = 0; k < most_steps && residuals.cwiseAbs().maxCoeff() > close_to_targets; ++k) {
        const Residuals linear = [&](const VectorXd& some, VectorXd& r, MatrixXd& jacobian) {
            r = residuals + slopes_ * (some - own);
            jacobian = slopes_;
        };
        const VectorXd next = box_minimum(linear, own, low, high), way = next - own;
        if (way.cwiseAbs().maxCoeff() < 1e-9) break;  // x stays at the bounds
        const VectorXd there = off(at(next));
        // Broyden's update, which converges because the moduli have no noise.
        slopes_ += (there - residuals - slopes_ * way) * way.transpose() / way.squaredNorm();
        own = next;
        residuals = there;
        if (residuals.squaredNorm() < least) {
            least = residuals.squaredNorm();
            best = own;
        }
    }
    return at(best);
}

void LinearSearch::learn(const VectorXd& x, const VectorXd& means) {
    if (!empty()) factors_ = means(space_.linear_targets) - logs(x);
}

VectorXd LinearSearch::off(const VectorXd& x) {
    return (logs(x) + factors_ - space_.logs(space_.linear_targets))
        .cwiseQuotient(space_.widths(space_.linear_targets));
}

VectorXd LinearSearch::logs(const VectorXd& x) {
    const std::vector<double> values = space_.values_at(x);
    for (const auto& [known, found] : known_)
        if (known == values) return found;
    const auto means = mean_linear_figures(request_, values);
    solves_ += space_.rock.fit * static_cast<std::int64_t>(request_.tests.size());
    VectorXd all(static_cast<Index>(space_.linear_targets.size()));
    for (Index k = 0; k < all.size(); ++k) {
        const Target& target = space_.target(space_.linear_targets[static_cast<std::size_t>(k)]);
        const auto place = std::find(request_.tests.begin(), request_.tests.end(), target.test);
        const double mean = means[static_cast<std::size_t>(place - request_.tests.begin())]
                                 [static_cast<std::size_t>(*linear_figure_of(target.figure))];
        if (!(mean > 0.0))
            throw InputError(
                fmt::format("{}: {}: found {:.3g} from the linear solve, expected a number > 0; remove this "
                            "target, or use another test",
                            target.where, target.figure, mean));
        all[k] = std::log(mean);
    }
    known_.emplace_back(values, all);
    return all;
}

}  // namespace crackle
