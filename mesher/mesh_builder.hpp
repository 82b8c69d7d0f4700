// SPDX-License-Identifier: GPL-3.0-or-later
// Adds cells to a mesh one by one and measures each of them.
// Tested by tests/mesher/voronoi_test.cpp.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "mesher/mesher.hpp"

namespace crackle {

class MeshBuilder {
  public:
    /// An empty mesh. @param cells, corners expected numbers of cells and corners, for which memory is reserved
    MeshBuilder(const Rectangle& domain, std::size_t cells, std::size_t corners);

    /// Adds the next cell in spatial order. @param before, after outlines of the cell before and after the inset,
    /// counter-clockwise
    /// @return the cell, whose centre is not set yet; valid until the next call
    Cell& add(std::span<const Point> before, std::span<const Point> after);
    /// Adds a cell of a mesh with traces. @param traces for each corner of `before`, the trace on the edge to the next
    /// corner, or -1
    /// @param edges_kept whether all edges remain after the inset
    Cell& add(std::span<const Point> before, std::span<const Point> after, std::span<const int> traces,
              bool edges_kept);

    /// Returns the mesh with its report; cells are in the order in which they were added. Afterwards the builder is
    /// empty.
    Mesh finish();

  private:
    // Neumaier's compensated sum. With plain addition, the sum of a million equal areas would lose the last five
    // digits.
    class Sum {
      public:
        void add(double value);
        double value() const { return total_ + lost_; }

      private:
        double total_ = 0.0, lost_ = 0.0;
    };

    void measure_edges(std::span<const Point> outline);

    Rectangle domain_;
    Mesh mesh_;
    Sum area_before_, area_after_, trace_length_;
    double shortest_edge_ = std::numeric_limits<double>::infinity();
    double smallest_corner_ = 2.0;  // a monotonic function of the angle, see measure_edges()
};

}  // namespace crackle
