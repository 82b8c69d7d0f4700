// SPDX-License-Identifier: GPL-3.0-or-later
// Cells of a partition that share corners by index, so that cutting, moving or merging a cell also updates its
// neighbours. Tested by tests/mesher/cell_net_test.cpp and cut_cells_test.cpp.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "mesher/partition.hpp"
#include "mesher/place_grid.hpp"

namespace crackle {

/// Outline of a cell; empty if the cell no longer exists.
struct Loop {
    std::vector<int> corners;  // counter-clockwise
    std::vector<int> traces;   // for each corner: trace on the edge to the next corner, or -1
    int centre = -1;

    std::size_t size() const { return corners.size(); }
    std::size_t next(std::size_t k) const { return k + 1 == corners.size() ? 0 : k + 1; }
    std::size_t before(std::size_t k) const { return k == 0 ? corners.size() - 1 : k - 1; }
};

class CellNet {
  public:
    using Box = std::pair<Point, Point>;  // lower left and upper right corners

    /// @param spacing mean spacing of the cells, m @param margin largest distance by which a corner may be moved, m
    /// @param near tolerance for round-off, m
    CellNet(double spacing, double margin, double near) : margin_(margin), near_(near), cells_at_(spacing) {}

    std::size_t corners() const { return places_.size(); }
    const std::vector<Loop>& loops() const { return loops_; }
    Point place(int corner) const { return places_[static_cast<std::size_t>(corner)]; }
    /// Cells that have this corner.
    const std::set<int>& around(int corner) const { return around_[static_cast<std::size_t>(corner)]; }
    Loop& loop(int cell) { return loops_[static_cast<std::size_t>(cell)]; }
    const Loop& loop(int cell) const { return loops_[static_cast<std::size_t>(cell)]; }

    /// Index of the corner with exactly these coordinates, which is added if it does not exist.
    int corner_at(Point p);
    int add(Loop made);
    void replace(int cell, Loop made);
    /// Inserts a corner into the edge between corners u and v, in all cells that have this edge.
    void insert_into(int u, int v, int corner);
    /// Moves a corner if the cells around it remain convex. @return whether it was moved
    bool move_to(int corner, Point target);

    /// Whether the corner is an end of an edge that lies on a trace.
    bool on_trace(int corner) const;
    bool inside(const Loop& l, Point p) const;
    /// Whether the cell is convex. Flat corners, which lie on the line between their neighbours, are ignored.
    bool convex(const Loop& l) const;
    double area(const Loop& l) const;
    /// Union of two cells across their common edges. It is empty if the common edges are not consecutive, or if one of
    /// them lies on a trace.
    static Loop together(const Loop& a, const Loop& b);
    /// Part of a cell's outline between the corners at positions `begin` and `end`, closed by a straight edge.
    static Loop part_of(const Loop& l, std::size_t begin, std::size_t end);

    /// Merges a piece of a cut cell with a neighbour, across the longest edge that is not on a trace and for which the
    /// union is convex. @return index of the union; -1 if no neighbour qualifies
    int join(int piece);
    /// Unites a piece of a cut cell with a neighbour and cuts the union between two of its corners. Both parts are
    /// convex, and the smaller part is as large as possible. @return false, and nothing changes, if every such cut
    /// leaves a part smaller than `least_area` @param least_area smallest area of a part, m2
    bool divide_again(int piece, double least_area);

    /// Cells that may extend into the box, in ascending order.
    std::set<int> cells_near(const Box& box) const;
    /// Calls use(i, j) for the grid squares that a box touches.
    template <class Use>
    void each_square(const Box& box, Use use) const {
        for (std::int64_t i = cells_at_.index(box.first.x); i <= cells_at_.index(box.second.x); ++i)
            for (std::int64_t j = cells_at_.index(box.first.y); j <= cells_at_.index(box.second.y); ++j) use(i, j);
    }

  private:
    Box box_of(const Loop& l) const;
    /// Calls use(neighbour, union, length) for each neighbour across an edge that is not on a trace. `union` is the
    /// outline of both cells together, `length` the length of their common edge.
    template <class Use>
    void each_union(int piece, Use use) const;

    double margin_, near_;
    std::vector<Point> places_;  // position of each corner
    std::map<std::pair<double, double>, int> numbers_;
    std::vector<std::set<int>> around_;  // for each corner, the cells that have it
    std::vector<Loop> loops_;
    Squares cells_at_;
};

}  // namespace crackle
