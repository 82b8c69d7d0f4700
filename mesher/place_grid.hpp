// SPDX-License-Identifier: GPL-3.0-or-later
// What lies near a place: straight segments, and places, by the squares of a grid.
// Tested by tests/mesher/place_grid_test.cpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mesher/mesher.hpp"

namespace crackle {

struct Segment {
    Point a, b;
};

inline double distance_to(const Segment& s, Point p) {
    const double dx = s.b.x - s.a.x, dy = s.b.y - s.a.y;
    const double share = std::clamp(((p.x - s.a.x) * dx + (p.y - s.a.y) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
    return distance(p, {s.a.x + share * dx, s.a.y + share * dy});
}

/// Numbers by the squares of a grid. Two squares may share an entry (their keys are 64 bits of two numbers): what comes
/// with them is further away and must be told by its distance.
class Squares {
  public:
    explicit Squares(double size) : size_(size) {}
    std::int64_t index(double x) const { return static_cast<std::int64_t>(std::floor(x / size_)); }
    void add(std::int64_t i, std::int64_t j, std::size_t number) { squares_[key(i, j)].push_back(number); }
    const std::vector<std::size_t>& at(std::int64_t i, std::int64_t j) const {
        static const std::vector<std::size_t> none;
        const auto found = squares_.find(key(i, j));
        return found == squares_.end() ? none : found->second;
    }

  private:
    static std::uint64_t key(std::int64_t i, std::int64_t j) {
        return static_cast<std::uint64_t>(i) * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(j);
    }
    double size_;
    std::unordered_map<std::uint64_t, std::vector<std::size_t>> squares_;
};

/// Segments that may come within a reach of a place.
class SegmentGrid {
  public:
    SegmentGrid(std::vector<Segment> segments, double reach) : segments_(std::move(segments)), squares_(reach) {
        for (std::size_t k = 0; k < segments_.size(); ++k) {
            // Along the segment from column to column: a long one does not fill the box about it.
            const auto [x1, x2] = std::minmax(segments_[k].a.x, segments_[k].b.x);
            for (std::int64_t i = squares_.index(x1 - reach); i <= squares_.index(x2 + reach); ++i) {
                const double low = static_cast<double>(i) * reach - reach, high = low + 3.0 * reach;
                const auto [y1, y2] = heights(segments_[k], low, high);
                for (std::int64_t j = squares_.index(y1 - reach); j <= squares_.index(y2 + reach); ++j)
                    squares_.add(i, j, k);
            }
        }
    }

    const std::vector<Segment>& segments() const { return segments_; }
    /// Calls use(number): all within the reach, some beyond.
    template <class Use>
    void each_near(Point p, Use use) const {
        for (const std::size_t k : squares_.at(squares_.index(p.x), squares_.index(p.y))) use(k);
    }

  private:
    /// Of the part of a segment between two x.
    static std::pair<double, double> heights(const Segment& s, double low, double high) {
        if (s.a.x == s.b.x) return std::minmax(s.a.y, s.b.y);
        const auto at = [&](double x) {
            const double share = std::clamp((x - s.a.x) / (s.b.x - s.a.x), 0.0, 1.0);
            return s.a.y + share * (s.b.y - s.a.y);
        };
        return std::minmax(at(low), at(high));
    }

    std::vector<Segment> segments_;
    Squares squares_;
};

/// Places that lie near another.
class PlaceGrid {
  public:
    explicit PlaceGrid(double size) : squares_(size), size_(size) {}
    void add(Point p) {
        squares_.add(squares_.index(p.x), squares_.index(p.y), places_.size());
        places_.push_back(p);
    }
    /// @param reach at most the grid's size
    bool any_within(Point p, double reach) const {
        const auto [number, away] = nearest_of_squares(p, 1);
        return number >= 0 && away < reach;
    }
    /// Number of the nearest place; there is one.
    int nearest(Point p) const {
        for (std::int64_t rings = 1;; rings *= 2) {
            const auto [number, away] = nearest_of_squares(p, rings);
            if (number >= 0 && away <= static_cast<double>(rings) * size_) return number;
        }
    }

  private:
    std::pair<int, double> nearest_of_squares(Point p, std::int64_t rings) const {
        int best = -1;
        double least = std::numeric_limits<double>::infinity();
        const std::int64_t i = squares_.index(p.x), j = squares_.index(p.y);
        for (std::int64_t u = i - rings; u <= i + rings; ++u) {
            for (std::int64_t v = j - rings; v <= j + rings; ++v) {
                for (const std::size_t k : squares_.at(u, v)) {
                    const double away = distance(p, places_[k]);
                    if (away >= least) continue;
                    least = away;
                    best = static_cast<int>(k);
                }
            }
        }
        return {best, least};
    }

    Squares squares_;
    double size_;
    std::vector<Point> places_;
};

}  // namespace crackle
