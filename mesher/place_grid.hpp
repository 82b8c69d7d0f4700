// SPDX-License-Identifier: GPL-3.0-or-later
// Grids for finding straight segments, or points, near a given point.
// Tested by tests/mesher/place_grid_test.cpp.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "mesher/mesher.hpp"

namespace crackle {

/// A straight segment between two points, m.
struct Segment {
    Point a, b;
};

/// Whether the segment's bounding box is farther from p than `reach`. This test is cheaper than computing the distance,
/// and excludes most segments.
inline bool surely_beyond(const Segment& s, Point p, double reach) {
    const double room = 1.001 * reach;  // includes a margin for round-off
    return p.x + room < std::min(s.a.x, s.b.x) || p.x - room > std::max(s.a.x, s.b.x) ||
           p.y + room < std::min(s.a.y, s.b.y) || p.y - room > std::max(s.a.y, s.b.y);
}
/// Squared distance of a point from a segment, m2.
inline double squared_distance_to(const Segment& s, Point p) {
    const double dx = s.b.x - s.a.x, dy = s.b.y - s.a.y;
    const double share = std::clamp(((p.x - s.a.x) * dx + (p.y - s.a.y) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
    const Point off{s.a.x + share * dx - p.x, s.a.y + share * dy - p.y};
    return dot(off, off);
}
/// Distance of a point from a segment, m.
inline double distance_to(const Segment& s, Point p) { return std::sqrt(squared_distance_to(s, p)); }

/// A square of a grid. Indices are taken modulo 2^32; this is harmless, since the distances of candidates are always
/// checked.
struct Square {
    /// The square in this column and row of a grid.
    Square(std::int64_t column, std::int64_t row)
        : i(static_cast<std::uint32_t>(column)), j(static_cast<std::uint32_t>(row)) {}
    /// Whether column and row are the same.
    bool operator==(const Square&) const = default;
    /// Bucket in a table of `buckets`, which must be a power of two and at least 64. Blocks of eight by eight squares
    /// are stored together, since consecutive look-ups are close to each other. Within a square region that fits into
    /// the table, no two blocks share a bucket.
    std::size_t bucket(std::size_t buckets) const {
        const int across = (std::countr_zero(buckets) - 6) / 2, high = 3 + across;
        const std::uint32_t within = (1U << across) - 1;
        const std::uint64_t mixed = ((std::uint64_t{i >> high} << 32) | (j >> high)) * 0x9E3779B97F4A7C15ULL;
        const std::uint64_t tile = (((i >> 3) & within) << across) | ((j >> 3) & within);
        return (((tile ^ (mixed >> 32)) << 6) | ((i & 7) << 3) | (j & 7)) & (buckets - 1);
    }

    std::uint32_t i, j;
};

/// Indices of points or segments, stored by grid square in a hash table. Each bucket is a list in insertion order. One
/// table serves all squares.
class Squares {
  public:
    /// An empty grid. @param size side length of the squares, m, > 0
    explicit Squares(double size) : size_(size), lists_(64) {}
    /// Index of the column or row in which a coordinate lies. @param x coordinate, m
    std::int64_t index(double x) const {
        const double exactly = x / size_;
        const auto truncated = static_cast<std::int64_t>(exactly);
        return truncated - (exactly < static_cast<double>(truncated) ? 1 : 0);
    }
    /// Reserves memory for `count` numbers.
    void reserve(std::size_t count) {
        entries_.reserve(count);
        while (lists_.size() < count) grow();
    }
    /// Adds a number to the list of the square in column i and row j.
    void add(std::int64_t i, std::int64_t j, std::size_t number) {
        if (entries_.size() == lists_.size()) grow();
        entries_.push_back({{i, j}, static_cast<std::uint32_t>(number), none});
        append(static_cast<std::uint32_t>(entries_.size() - 1));
    }
    /// Calls use(number) for the numbers stored in a square.
    template <class Use>
    void each_at(std::int64_t i, std::int64_t j, Use use) const {
        any_at(i, j, [&](std::size_t number) {
            use(number);
            return false;
        });
    }
    /// Whether test(number) is true for any number stored in a square.
    template <class Test>
    bool any_at(std::int64_t i, std::int64_t j, Test test) const {
        const Square square(i, j);
        for (std::uint32_t e = lists_[square.bucket(lists_.size())].first; e != none; e = entries_[e].next)
            if (entries_[e].square == square && test(std::size_t{entries_[e].number})) return true;
        return false;
    }

  private:
    static constexpr std::uint32_t none = ~0U;
    struct Entry {
        Square square;
        std::uint32_t number, next;
    };
    struct List {
        std::uint32_t first = none, last = none;
    };
    void append(std::uint32_t entry) {
        List& list = lists_[entries_[entry].square.bucket(lists_.size())];
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
    std::vector<List> lists_;  // the size is a power of two
};

/// Finds the segments that may be within a given reach of a point.
class SegmentGrid {
  public:
    SegmentGrid(std::vector<Segment> segments, double reach) : segments_(std::move(segments)), squares_(reach) {
        std::vector<Entry> entries;
        entries.reserve(12 * segments_.size());  // sufficient for segments as long as the reach
        for (std::size_t k = 0; k < segments_.size(); ++k) {
            // Segments are entered column by column, so that a long oblique segment does not occupy its whole bounding
            // box.
            const auto [x1, x2] = std::minmax(segments_[k].a.x, segments_[k].b.x);
            const std::int64_t last = squares_.index(x2 + reach);
            for (std::int64_t i = squares_.index(x1 - reach); i <= last; ++i) {
                const double low = static_cast<double>(i) * reach - reach, high = low + 3.0 * reach;
                const auto [y1, y2] = heights(segments_[k], low, high);
                const std::int64_t top = squares_.index(y2 + reach);
                for (std::int64_t j = squares_.index(y1 - reach); j <= top; ++j)
                    entries.push_back({{i, j}, static_cast<std::uint32_t>(k)});
            }
        }
        sort_into_buckets(entries);
    }

    /// All segments, in their original order.
    const std::vector<Segment>& segments() const { return segments_; }
    /// Whether two points have the same candidate segments.
    bool same_near(Point p, Point q) const {
        return squares_.index(p.x) == squares_.index(q.x) && squares_.index(p.y) == squares_.index(q.y);
    }
    /// Calls use(number) with the index of each segment within the reach, and of some segments farther away.
    template <class Use>
    void each_near(Point p, Use use) const {
        any_near(p, [&](std::size_t number) {
            use(number);
            return false;
        });
    }
    /// Whether test(number) is true for the index of any segment within the reach. Some segments farther away are
    /// tested as well.
    template <class Test>
    bool any_near(Point p, Test test) const {
        const Square square(squares_.index(p.x), squares_.index(p.y));
        const std::size_t bucket = square.bucket(ends_.size());
        for (std::uint32_t e = bucket == 0 ? 0 : ends_[bucket - 1]; e < ends_[bucket]; ++e)
            if (entries_[e].square == square && test(std::size_t{entries_[e].number})) return true;
        return false;
    }

  private:
    struct Entry {
        Square square;
        std::uint32_t number;
    };
    /// Sorts entries into buckets, keeping their order within each bucket.
    void sort_into_buckets(const std::vector<Entry>& entries) {
        std::size_t buckets = 64;
        while (buckets < entries.size()) buckets *= 2;
        std::vector<std::uint32_t> next(buckets + 1), bucket_of(entries.size());
        for (std::size_t e = 0; e < entries.size(); ++e) {
            bucket_of[e] = static_cast<std::uint32_t>(entries[e].square.bucket(buckets));
            ++next[bucket_of[e] + 1];
        }
        std::partial_sum(next.begin(), next.end(), next.begin());
        entries_.assign(entries.size(), {{0, 0}, 0});
        for (std::size_t e = 0; e < entries.size(); ++e) entries_[next[bucket_of[e]]++] = entries[e];
        next.pop_back();  // the remaining values are the ends of the buckets
        ends_ = std::move(next);
    }
    /// Range of y of the part of a segment between two values of x.
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
    std::vector<Entry> entries_;
    std::vector<std::uint32_t> ends_;  // end of the entries of each bucket
};

/// Finds points near a given point.
class PlaceGrid {
  public:
    /// An empty grid. @param size side length of the squares, m, > 0
    explicit PlaceGrid(double size) : squares_(size), size_(size) {}
    /// Reserves memory for `count` points.
    void reserve(std::size_t count) {
        squares_.reserve(count);
        places_.reserve(count);
    }
    /// Adds a point, m.
    void add(Point p) {
        squares_.add(squares_.index(p.x), squares_.index(p.y), places_.size());
        places_.push_back(p);
    }
    /// Whether any point of the grid is within `reach` of p. @param reach distance, m; the time needed grows with it
    bool any_within(Point p, double reach) const {
        const double room = 1.001 * reach;  // includes a margin for round-off
        for (std::int64_t u = squares_.index(p.x - room); u <= squares_.index(p.x + room); ++u)
            for (std::int64_t v = squares_.index(p.y - room); v <= squares_.index(p.y + room); ++v)
                if (squares_.any_at(u, v, [&](std::size_t k) { return distance(p, places_[k]) < reach; })) return true;
        return false;
    }
    /// Index of the nearest point; the grid must not be empty.
    int nearest(Point p) const {
        for (std::int64_t rings = 1;; rings *= 2) {
            const auto [number, away] = nearest_of_squares(p, rings);
            if (number >= 0 && away <= static_cast<double>(rings) * size_) return number;
        }
    }

  private:
    /// Nearest point within `rings` rings of squares; among equally near points, the one in the first square in the
    /// order of rows and columns. The square of `p` is searched first, since the distance found there excludes most
    /// other squares.
    std::pair<int, double> nearest_of_squares(Point p, std::int64_t rings) const {
        int best = -1;
        double least = std::numeric_limits<double>::infinity();
        const std::int64_t i = squares_.index(p.x), j = squares_.index(p.y);
        std::pair<std::int64_t, std::int64_t> of{i, j};
        const auto look_at = [&](std::int64_t u, std::int64_t v) {
            squares_.each_at(u, v, [&](std::size_t k) {
                const Point d{places_[k].x - p.x, places_[k].y - p.y};
                if (dot(d, d) > 1.001 * least * least) return;  // avoids the square root for most points
                const double away = distance(p, places_[k]);
                if (away > least || (away == least && std::pair{u, v} >= of)) return;
                least = away;
                best = static_cast<int>(k);
                of = {u, v};
            });
        };
        // Distance along one axis from x to the square with index `other`.
        const auto gap = [&](double x, std::int64_t own, std::int64_t other) {
            return other == own  ? 0.0
                   : other < own ? x - static_cast<double>(other + 1) * size_
                                 : static_cast<double>(other) * size_ - x;
        };
        look_at(i, j);
        for (std::int64_t u = i - rings; u <= i + rings; ++u) {
            const double across = gap(p.x, i, u);
            if (across > 1.001 * least) continue;
            for (std::int64_t v = j - rings; v <= j + rings; ++v)
                if ((u != i || v != j) && gap(p.y, j, v) <= 1.001 * least) look_at(u, v);
        }
        return {best, least};
    }

    Squares squares_;
    double size_;
    std::vector<Point> places_;
};

}  // namespace crackle
