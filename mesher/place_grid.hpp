// SPDX-License-Identifier: GPL-3.0-or-later
// What lies near a place: straight segments, and places, by the squares of a grid.
// Tested by tests/mesher/place_grid_test.cpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
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

/// Numbers by the squares of a grid, in one table: a list a bucket, each in the order of adding.
class Squares {
  public:
    explicit Squares(double size) : size_(size), lists_(64) {}
    std::int64_t index(double x) const { return static_cast<std::int64_t>(std::floor(x / size_)); }
    void add(std::int64_t i, std::int64_t j, std::size_t number) {
        if (entries_.size() == lists_.size()) grow();
        entries_.push_back({i, j, number, none});
        append(static_cast<std::uint32_t>(entries_.size() - 1));
    }
    /// Calls use(number).
    template <class Use>
    void each_at(std::int64_t i, std::int64_t j, Use use) const {
        for (std::uint32_t e = lists_[bucket(i, j)].first; e != none; e = entries_[e].next)
            if (entries_[e].i == i && entries_[e].j == j) use(entries_[e].number);
    }

  private:
    static constexpr std::uint32_t none = ~0U;
    struct Entry {
        std::int64_t i, j;
        std::size_t number;
        std::uint32_t next;
    };
    struct List {
        std::uint32_t first = none, last = none;
    };
    std::size_t bucket(std::int64_t i, std::int64_t j) const {
        const std::uint64_t mixed =
            (static_cast<std::uint64_t>(i) * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(j)) *
            0xD6E8FEB86659FD93ULL;
        return (mixed >> 32) & (lists_.size() - 1);
    }
    void append(std::uint32_t entry) {
        List& list = lists_[bucket(entries_[entry].i, entries_[entry].j)];
        if (list.first == none)
            list.first = entry;
        else
            entries_[list.last].next = entry;
        list.last = entry;
    }
    void grow() {
        lists_.assign(2 * lists_.size(), {});
        for (std::uint32_t e = 0; e < entries_.size(); ++e) {
            entries_[e].next = none;
            append(e);
        }
    }

    double size_;
    std::vector<Entry> entries_;
    std::vector<List> lists_;  // a power of two
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
        squares_.each_at(squares_.index(p.x), squares_.index(p.y), use);
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
                squares_.each_at(u, v, [&](std::size_t k) {
                    const double away = distance(p, places_[k]);
                    if (away >= least) return;
                    least = away;
                    best = static_cast<int>(k);
                });
            }
        }
        return {best, least};
    }

    Squares squares_;
    double size_;
    std::vector<Point> places_;
};

}  // namespace crackle
