// SPDX-License-Identifier: GPL-3.0-or-later
// Sets of centres for the mesher's tests, and the checks that every mesh must pass.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "mesher/mesher.hpp"
#include "tests/support/claim.hpp"

namespace crackle::testing {

inline double area_of(const Rectangle& r) { return (r.x2 - r.x1) * (r.y2 - r.y1); }
inline double scale_of(const Rectangle& r) {
    return std::max({std::abs(r.x1), std::abs(r.x2), std::abs(r.y1), std::abs(r.y2)});
}

class Dice {
  public:
    explicit Dice(std::uint64_t seed) : engine_(seed) {}
    /// Uniformly distributed number in [0, 1).
    double next() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

  private:
    std::mt19937_64 engine_;
};

inline std::vector<CellCentre> random_seeds(int count, const Rectangle& r, std::uint64_t seed) {
    Dice dice(seed);
    std::vector<CellCentre> centres;
    for (int k = 0; k < count; ++k) {
        const double x = r.x1 + (r.x2 - r.x1) * dice.next();
        centres.push_back({x, r.y1 + (r.y2 - r.y1) * dice.next()});
    }
    return centres;
}

/// Lattice of columns × rows with each centre displaced by up to jitter/2 spacings; without jitter all neighbours are
/// co-circular.
inline std::vector<CellCentre> lattice(int columns, int rows, const Rectangle& r, double jitter,
                                       std::uint64_t seed = 1) {
    Dice dice(seed);
    std::vector<CellCentre> centres;
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            const double dx = jitter * (dice.next() - 0.5), dy = jitter * (dice.next() - 0.5);
            centres.push_back(
                {r.x1 + (r.x2 - r.x1) * (i + 0.5 + dx) / columns, r.y1 + (r.y2 - r.y1) * (j + 0.5 + dy) / rows});
        }
    }
    return centres;
}

struct Specimen {
    std::string name;
    Rectangle domain;
    std::vector<CellCentre> centres;
};

/// Sets of centres: general, degenerate, thin, shifted, and with centres on the boundary.
inline std::vector<Specimen> specimens() {
    const Rectangle unit{0.0, 1.0, 0.0, 1.0}, rock{-0.3, 0.4, 0.1, 1.5}, thin{0.0, 10.0, 0.0, 0.05},
        far{1000.0, 1001.0, -2000.0, -1999.0};
    std::vector<Specimen> all;
    for (const int count : {1, 2, 3, 4, 7, 50, 304, 3000}) {
        all.push_back(
            {fmt::format("{} random", count), rock, random_seeds(count, rock, static_cast<std::uint64_t>(count))});
    }
    all.push_back({"jittered lattice", unit, lattice(40, 30, unit, 0.6)});
    all.push_back({"square lattice", unit, lattice(30, 30, unit, 0.0)});
    all.push_back({"lattice off by rounding", unit, lattice(30, 30, unit, 1e-13)});
    all.push_back({"lattice off by little", unit, lattice(30, 30, unit, 1e-9)});
    all.push_back({"thin domain", thin, random_seeds(300, thin, 5)});
    all.push_back({"far from the origin", far, random_seeds(500, far, 6)});
    all.push_back({"one line along x", unit, lattice(25, 1, unit, 0.0)});
    all.push_back({"one line, slanting", unit, {{0.1, 0.1}, {0.2, 0.2}, {0.5, 0.5}, {0.7, 0.7}}});
    all.push_back({"the four corners", unit, {{0, 0}, {1, 0}, {0, 1}, {1, 1}}});
    all.push_back({"one corner", unit, {{0, 0}}});
    all.push_back({"one on a wall", unit, {{0, 0.3}}});
    Specimen ringed{"random with some on the walls", unit, random_seeds(200, unit, 9)};
    for (const double s : {0.0, 0.11, 0.37, 0.5, 0.93}) {
        ringed.centres.push_back({s, 0.0});
        ringed.centres.push_back({1.0 - s, 1.0});
        ringed.centres.push_back({0.0, 0.07 + 0.9 * s});
    }
    all.push_back(ringed);
    Specimen circle{"on one circle", unit, {}};
    for (int k = 0; k < 24; ++k)
        circle.centres.push_back({0.5 + 0.3 * std::cos(0.2618 * k), 0.5 + 0.3 * std::sin(0.2618 * k)});
    all.push_back(circle);
    all.push_back(
        {"hardly off the wall", unit, {{1e-300, 0.4}, {0.6, 1e-17}, {0.5, 0.5}, {std::nextafter(1.0, 0.0), 0.5}}});
    Specimen graded{"graded", unit, {}};
    for (int k = 0; k < 18; ++k)
        graded.centres.push_back({0.31 + std::pow(0.5, k) * 0.6, 0.3 + std::pow(0.5, k) * 0.5 * ((k % 3) - 0.5)});
    all.push_back(graded);
    return all;
}

inline double cross(Point a, Point b, Point c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

/// Area by the shoelace formula, relative to the first corner.
inline double area_of(std::span<const Point> outline) {
    double twice = 0.0;
    for (std::size_t k = 2; k < outline.size(); ++k) twice += cross(outline[0], outline[k - 1], outline[k]);
    return 0.5 * twice;
}

/// Sum of areas in long double, independent of the report's sum.
inline double sum_of_areas(const Mesh& mesh) {
    long double sum = 0.0L;
    for (const Cell& cell : mesh.cells) sum += static_cast<long double>(area_of(mesh.outline(cell)));
    return static_cast<double>(sum);
}

/// Whether corners are in counter-clockwise order with no right turn, go around once, and are all distinct.
inline ::testing::AssertionResult convex_and_counter_clockwise(const Mesh& mesh, double scale) {
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        const auto corners = mesh.outline(mesh.cells[c]);
        const std::size_t n = corners.size();
        if (n < 3) return ::testing::AssertionFailure() << "cell " << c << " has " << n << " corners";
        double turned = 0.0;
        for (std::size_t k = 0; k < n; ++k) {
            const Point a = corners[k], b = corners[(k + 1) % n], d = corners[(k + 2) % n];
            if (a == b)
                return ::testing::AssertionFailure() << "cell " << c << " has a zero-length edge at corner " << k;
            const double turn = cross(a, b, d);
            if (turn < -1e-15 * scale * std::hypot(d.x - a.x, d.y - a.y)) {
                return ::testing::AssertionFailure()
                       << fmt::format("cell {} turns clockwise at corner {}: cross product {:.3g}", c, k, turn);
            }
            turned += std::atan2(turn, (b.x - a.x) * (d.x - b.x) + (b.y - a.y) * (d.y - b.y));
        }
        if (std::abs(turned - 6.283185307179586) > 1e-6)
            return ::testing::AssertionFailure() << "cell " << c << " turns by " << turned << " rad";
    }
    return ::testing::AssertionSuccess();
}

/// Table of directed edges, keyed by the bits of their end points; a shared edge occurs in reverse in the neighbour.
class EdgeTable {
  public:
    using Key = std::tuple<double, double, double, double>;
    explicit EdgeTable(const Mesh& mesh) {
        for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
            const auto corners = mesh.outline(mesh.cells[c]);
            for (std::size_t k = 0; k < corners.size(); ++k) {
                const Point a = corners[k], b = corners[(k + 1) % corners.size()];
                cell_[{a.x, a.y, b.x, b.y}] = static_cast<int>(c);
            }
        }
    }
    /// Cell on the other side of edge a-b; -1 if there is none.
    int beyond(Point a, Point b) const {
        const auto found = cell_.find({b.x, b.y, a.x, a.y});
        return found == cell_.end() ? -1 : found->second;
    }

  private:
    std::map<Key, int> cell_;
};

inline bool on_one_side(Point a, Point b, const Rectangle& r) {
    return (a.x == r.x1 && b.x == r.x1) || (a.x == r.x2 && b.x == r.x2) || (a.y == r.y1 && b.y == r.y1) ||
           (a.y == r.y2 && b.y == r.y2);
}

/// Total length of facing edges that were checked, and the largest deviation of their distance from `gap` (at the
/// domain's sides, from gap/2). `whole` is the partition without inset, `apart` the inset partition with the same
/// cells. Pairs of edges are found by position and direction, then measured at three points of their common part.
struct GapCheck {
    std::int64_t interfaces = 0, faces = 0;
    double worst = 0.0;
};
inline GapCheck check_gaps(const Mesh& whole, const Mesh& apart, const Rectangle& domain, double gap) {
    GapCheck check;
    const EdgeTable table(whole);
    struct Stretch {
        double from, to, height;
        bool found = false;
    };
    // The edge of an inset cell parallel to t (in either sense) that is nearest to the line through `origin`.
    const auto along = [&](const Cell& cell, Point origin, Point t) {
        Stretch best{0.0, 0.0, 0.0, false};
        const auto corners = apart.outline(cell);
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const Point a = corners[k], b = corners[(k + 1) % corners.size()];
            const Point d{b.x - a.x, b.y - a.y};
            if (std::abs(t.x * d.y - t.y * d.x) > 1e-9 * std::hypot(d.x, d.y)) continue;
            const double height = std::abs(t.x * (a.y - origin.y) - t.y * (a.x - origin.x));
            if (best.found && height >= best.height) continue;
            const double p = t.x * (a.x - origin.x) + t.y * (a.y - origin.y),
                         q = t.x * (b.x - origin.x) + t.y * (b.y - origin.y);
            best = {std::min(p, q), std::max(p, q), height, true};
        }
        return best;
    };
    for (std::size_t c = 0; c < whole.cells.size(); ++c) {
        const auto corners = whole.outline(whole.cells[c]);
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const Point a = corners[k], b = corners[(k + 1) % corners.size()];
            const double length = std::hypot(b.x - a.x, b.y - a.y);
            const Point t{(b.x - a.x) / length, (b.y - a.y) / length};
            const int other = table.beyond(a, b);
            if (length < 2.0 * gap) continue;  // the edge may have vanished; its neighbours are then farther apart
            const Stretch mine = along(apart.cells[c], a, t);
            if (!mine.found || mine.height > gap) continue;
            if (other < 0) {
                if (!on_one_side(a, b, domain)) continue;
                ++check.faces;
                check.worst = std::max(check.worst, std::abs(mine.height - 0.5 * gap));
                continue;
            }
            const Stretch theirs = along(apart.cells[static_cast<std::size_t>(other)], a, t);
            if (!theirs.found || theirs.height > gap) continue;
            const double from = std::max(mine.from, theirs.from), to = std::min(mine.to, theirs.to);
            if (!(to > from)) continue;
            ++check.interfaces;
            // Distance from a sampled point of this cell's edge to the neighbour's outline.
            const auto edges = apart.outline(apart.cells[static_cast<std::size_t>(other)]);
            for (const double share : {0.01, 0.5, 0.99}) {
                const double s = from + share * (to - from);
                const Point p{a.x + s * t.x - mine.height * t.y, a.y + s * t.y + mine.height * t.x};
                double nearest = 1e300;
                for (std::size_t e = 0; e < edges.size(); ++e) {
                    const Point u = edges[e], v = edges[(e + 1) % edges.size()];
                    const double l2 = (v.x - u.x) * (v.x - u.x) + (v.y - u.y) * (v.y - u.y);
                    const double f = std::clamp(((p.x - u.x) * (v.x - u.x) + (p.y - u.y) * (v.y - u.y)) / l2, 0.0, 1.0);
                    nearest = std::min(nearest, std::hypot(u.x + f * (v.x - u.x) - p.x, u.y + f * (v.y - u.y) - p.y));
                }
                check.worst = std::max(check.worst, std::abs(nearest - gap));
            }
        }
    }
    return check;
}

}  // namespace crackle::testing
