// SPDX-License-Identifier: GPL-3.0-or-later
// Cells of a partition that share their corners by number, so that one can be cut, moved or joined and its neighbours
// go with it. Tested by tests/mesher/cut_cells_test.cpp.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "mesher/partition.hpp"
#include "mesher/place_grid.hpp"

namespace crackle {

/// Outline of a cell; empty of one that is no more.
struct Loop {
    std::vector<int> corners;  // counter-clockwise
    std::vector<int> traces;   // by the edge to the next
    int centre = -1;

    std::size_t size() const { return corners.size(); }
    std::size_t next(std::size_t k) const { return k + 1 == corners.size() ? 0 : k + 1; }
    std::size_t before(std::size_t k) const { return k == 0 ? corners.size() - 1 : k - 1; }
};

class CellNet {
  public:
    using Box = std::pair<Point, Point>;  // lower left, upper right

    /// @param spacing  m, of the cells  @param margin  m, that a corner may be moved by  @param near  m, of rounding
    CellNet(double spacing, double margin, double near) : margin_(margin), near_(near), cells_at_(spacing) {}

    std::size_t corners() const { return places_.size(); }
    const std::vector<Loop>& loops() const { return loops_; }
    Point place(int corner) const { return places_[static_cast<std::size_t>(corner)]; }
    /// Cells that have a corner.
    const std::set<int>& around(int corner) const { return around_[static_cast<std::size_t>(corner)]; }
    Loop& loop(int cell) { return loops_[static_cast<std::size_t>(cell)]; }
    const Loop& loop(int cell) const { return loops_[static_cast<std::size_t>(cell)]; }

    /// The corner of these coordinates, bit for bit.
    int corner_at(Point p);
    int add(Loop made);
    void replace(int cell, Loop made);
    /// Into the edge between two corners, of all cells that have it.
    void insert_into(int u, int v, int corner);
    /// @return whether the cells around stay convex; else it stays where it was
    bool move_to(int corner, Point target);

    /// Whether it ends an edge on a trace.
    bool on_trace(int corner) const;
    bool inside(const Loop& l, Point p) const;
    /// Flat corners aside, which lie on the line between the two beside them.
    bool convex(const Loop& l) const;
    double area(const Loop& l) const;
    /// The union across the edges that both have, which follow each other; empty where one of these is a trace.
    static Loop together(const Loop& a, const Loop& b);

    /// That may reach into it, in the order of their numbers.
    std::set<int> cells_near(const Box& box) const;
    /// Calls use(i, j) for the squares of a grid of the spacing that a box meets.
    template <class Use>
    void each_square(const Box& box, Use use) const {
        for (std::int64_t i = cells_at_.index(box.first.x); i <= cells_at_.index(box.second.x); ++i)
            for (std::int64_t j = cells_at_.index(box.first.y); j <= cells_at_.index(box.second.y); ++j) use(i, j);
    }

  private:
    Box box_of(const Loop& l) const;

    double margin_, near_;
    std::vector<Point> places_;  // by corner
    std::map<std::pair<double, double>, int> numbers_;
    std::vector<std::set<int>> around_;  // cells, by corner
    std::vector<Loop> loops_;
    Squares cells_at_;
};

}  // namespace crackle
