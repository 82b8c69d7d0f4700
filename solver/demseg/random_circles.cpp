// SPDX-License-Identifier: GPL-3.0-or-later
// See random_circles.hpp.

#include "solver/demseg/random_circles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "solver/base/errors.hpp"

namespace crackle {
namespace {

/// Uniformly distributed number in [low, high), with 53 random bits.
double uniform(std::mt19937_64& generator, double low, double high) {
    constexpr double unit = 1.0 / 9007199254740992.0;  // 2^-53
    return low + (high - low) * (static_cast<double>(generator() >> 11) * unit);
}

/// Circles placed so far, sorted into square cells. Cells are at least as large as the largest diameter, so all circles
/// that overlap a new one lie in nine cells.
class PlacedCircles {
  public:
    PlacedCircles(const Domain& domain, double radius_max, std::int64_t count) : origin_{domain.x1, domain.y1} {
        const double width = domain.x2 - domain.x1, height = domain.y2 - domain.y1, n = static_cast<double>(count);
        // In a sparse domain cells are larger, so that memory is proportional to the number of circles.
        size_ = std::max({2.0 * radius_max, std::sqrt(width / n * height), std::max(width, height) / (n + 64.0)});
        columns_ = static_cast<std::size_t>(width / size_) + 1;
        rows_ = static_cast<std::size_t>(height / size_) + 1;
        cells_.resize(columns_ * rows_);
    }

    /// Σ δ² over the circles that a new circle overlaps: the energy of these contacts divided by k_n/2.
    double squared_overlaps(const CircleElement& circle) const {
        const std::size_t column = column_of(circle.centre), row = row_of(circle.centre);
        double sum = 0.0;
        for (std::size_t y = row > 0 ? row - 1 : 0; y <= std::min(row + 1, rows_ - 1); ++y) {
            for (std::size_t x = column > 0 ? column - 1 : 0; x <= std::min(column + 1, columns_ - 1); ++x) {
                for (const CircleElement& other : cells_[y * columns_ + x]) {
                    const double overlap = circle.radius + other.radius - norm(other.centre - circle.centre);
                    if (overlap > 0.0) sum += overlap * overlap;
                }
            }
        }
        return sum;
    }
    void add(const CircleElement& circle) {
        cells_[row_of(circle.centre) * columns_ + column_of(circle.centre)].push_back(circle);
    }

  private:
    std::size_t column_of(Vec2 p) const {
        return std::min(static_cast<std::size_t>((p.x - origin_.x) / size_), columns_ - 1);
    }
    std::size_t row_of(Vec2 p) const {
        return std::min(static_cast<std::size_t>((p.y - origin_.y) / size_), rows_ - 1);
    }

    Vec2 origin_;
    double size_ = 0.0;
    std::size_t columns_ = 0, rows_ = 0;
    std::vector<std::vector<CircleElement>> cells_;
};

// Number of random positions tried for each circle; the one with the least overlap is used. With a single try, some
// circles land nearly on top of each other and are pushed out through the walls. Thirty tries reduce the initial energy
// to a twelfth (for the DEMseg guide's example of 582 circles), and more tries help little.
constexpr int places_tried = 30;

}  // namespace

std::int64_t random_circle_count(const RandomGeometry& geometry) {
    const double r1 = geometry.radius_min, r2 = geometry.radius_max;
    const double area = (geometry.domain.x2 - geometry.domain.x1) * (geometry.domain.y2 - geometry.domain.y1);
    const double mean_square = (r1 * r1 + r1 * r2 + r2 * r2) / 3.0;
    const double count = std::round(area / ((1.0 + geometry.void_ratio) * std::numbers::pi * mean_square));
    if (!(count >= 1.0 && count <= 1e7)) {
        throw InputError(fmt::format(
            "in_gm.dat: random circles: domain, radii and void ratio give {} circles, expected 1 to 1e7", count));
    }
    return static_cast<std::int64_t>(count);
}

DeckGeometry make_random_circles(const RandomGeometry& geometry, std::uint64_t seed) {
    const Domain& domain = geometry.domain;
    const double room = std::min(domain.x2 - domain.x1, domain.y2 - domain.y1);
    if (2.0 * geometry.radius_max > room) {
        throw InputError(fmt::format("in_gm.dat: rmax: found {}, expected at most half the domain's smaller side, {}",
                                     geometry.radius_max, 0.5 * room));
    }
    DeckGeometry result;
    Scene& scene = result.scene;
    scene.time_step = geometry.time_step;
    scene.gravity = geometry.gravity;
    scene.materials = geometry.materials;
    scene.domain = domain;
    scene.thick = geometry.thick;
    scene.first_kick = FirstKick::full;
    scene.bare_segment_width = deck_bare_segment_width;
    std::mt19937_64 generator(seed);
    const std::int64_t count = random_circle_count(geometry);
    PlacedCircles placed(domain, geometry.radius_max, count);
    for (std::int64_t k = 1; k <= count; ++k) {
        CircleElement circle;
        circle.radius = uniform(generator, geometry.radius_min, geometry.radius_max);
        double least = std::numeric_limits<double>::infinity();
        for (int place = 0; place < places_tried; ++place) {
            CircleElement tried = circle;
            tried.centre.x = uniform(generator, domain.x1 + circle.radius, domain.x2 - circle.radius);
            tried.centre.y = uniform(generator, domain.y1 + circle.radius, domain.y2 - circle.radius);
            const double squared = placed.squared_overlaps(tried);
            if (squared >= least) continue;
            least = squared;
            circle.centre = tried.centre;
        }
        placed.add(circle);
        scene.add_circle_body(static_cast<int>(k), geometry.material, circle);
    }
    validate(scene);
    return result;
}

}  // namespace crackle
