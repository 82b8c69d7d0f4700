// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/statistics/broken_stick.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "specimens/statistics/mean.hpp"
#include "specimens/statistics/random_numbers.hpp"

namespace crackle {
namespace {

/// Sums over the points from a given point to the last one; x is scaled to the range 0 to 1.
struct Sums {
    double n = 0.0, x = 0.0, xx = 0.0, y = 0.0, xy = 0.0, yy = 0.0;

    void add(double px, double py) {
        n += 1.0;
        x += px;
        xx += px * px;
        y += py;
        xy += px * py;
        yy += py * py;
    }
};

class Stick {
  public:
    Stick(std::span<const double> x, std::span<const double> y) : from_(x.front()), length_(x.back() - x.front()) {
        for (const double place : x) x_.push_back((place - from_) / length_);
        tails_.resize(x.size() + 1);
        for (std::size_t k = x.size(); k-- > 0;) {
            tails_[k] = tails_[k + 1];
            tails_[k].add(x_[k], y[k]);
        }
    }

    /// Coefficients a, b, c of the best fit with a break at s, and its sum of squared residuals.
    std::pair<Eigen::Vector3d, double> fit(double s) const {
        const auto beyond = std::upper_bound(x_.begin(), x_.end(), s) - x_.begin();
        const Sums& all = tails_.front();
        const Sums& tail = tails_[static_cast<std::size_t>(beyond)];
        const double t = tail.x - s * tail.n;                           // Σ max(0, x - s)
        const double xt = tail.xx - s * tail.x;                         // Σ x max(0, x - s)
        const double tt = tail.xx - 2.0 * s * tail.x + s * s * tail.n;  // Σ max(0, x - s)²
        const double yt = tail.xy - s * tail.y;
        Eigen::Matrix3d normal;
        normal << all.n, all.x, t, all.x, all.xx, xt, t, xt, tt;
        const Eigen::Vector3d right(all.y, all.xy, yt);
        const Eigen::Vector3d abc = normal.ldlt().solve(right);
        return {abc, all.yy - abc.dot(right)};
    }

    BrokenStick best() const {
        // Each line needs at least two points to be determined.
        std::size_t best = 1;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t k = 1; k + 2 < x_.size(); ++k) {
            const double left = fit(x_[k]).second;
            if (left < least) {
                least = left;
                best = k;
            }
        }
        constexpr int half_digits = 26;  // rounding limits the position of a minimum to half the digits of a double
        const double low = x_[std::max<std::size_t>(best, 2) - 1], high = x_[std::min(best + 1, x_.size() - 3)];
        const auto [s, left] =
            boost::math::tools::brent_find_minima([&](double at) { return fit(at).second; }, low, high, half_digits);
        const double at = left < least ? s : x_[best];
        const Eigen::Vector3d abc = fit(at).first;
        return {from_ + at * length_, abc[1] / length_, (abc[1] + abc[2]) / length_};
    }

  private:
    double from_, length_;
    std::vector<double> x_;
    std::vector<Sums> tails_;
};

constexpr std::size_t places = 200, redrawn = 1000, fewest_points = 5;
constexpr std::uint64_t bootstrap_seed = 1;

}  // namespace

BrokenStick fit_broken_stick(std::span<const double> x, std::span<const double> y) {
    return x.size() < fewest_points ? BrokenStick{} : Stick(x, y).best();
}

BurstBreak find_burst_break(std::span<const Burst> bursts, double end) {
    std::vector<double> x(places + 1);
    for (std::size_t k = 0; k <= places; ++k) x[k] = end * static_cast<double>(k) / static_cast<double>(places);
    struct Placed {
        std::size_t place;
        double count;
    };
    std::vector<Placed> placed;
    for (const Burst& burst : bursts) {
        if (!(burst.x <= end)) continue;
        const auto place = std::lower_bound(x.begin(), x.end(), burst.x) - x.begin();
        placed.push_back({static_cast<std::size_t>(place), static_cast<double>(burst.count)});
    }
    if (placed.size() < fewest_bursts) return {};
    std::vector<double> y(places + 1);
    const auto break_of = [&](auto&& drawn) {
        std::ranges::fill(y, 0.0);
        for (std::size_t k = 0; k < placed.size(); ++k) {
            const Placed& one = drawn(k);
            y[one.place] += one.count;
        }
        for (std::size_t k = 1; k < y.size(); ++k) y[k] += y[k - 1];
        return fit_broken_stick(x, y).at;
    };
    BurstBreak found;
    found.at = break_of([&](std::size_t k) -> const Placed& { return placed[k]; });
    std::mt19937_64 generator(bootstrap_seed);
    std::vector<double> breaks(redrawn);
    for (double& one : breaks)
        one = break_of([&](std::size_t) -> const Placed& { return placed[uniform_below(generator, placed.size())]; });
    std::ranges::sort(breaks);
    found.low = percentile(breaks, 0.025);
    found.high = percentile(breaks, 0.975);
    return found;
}

}  // namespace crackle
