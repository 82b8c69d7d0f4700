// SPDX-License-Identifier: GPL-3.0-or-later
// Adds cells one by one to a mesh and measures them while they are at hand.
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
    /// @param cells, corners  about as many as will come: memory for them is set aside
    MeshBuilder(const Rectangle& domain, std::size_t cells, std::size_t corners);

    /// Adds the next cell in the order of space. @param before, after  its outline without and with the inset,
    /// counter-clockwise
    /// @return the cell, of no centre yet; valid until the next call
    Cell& add(std::span<const Point> before, std::span<const Point> after);
    /// The same of a mesh with traces. @param traces  of the edge from each corner of `before`; -1: none
    /// @param edges_kept  by the inset
    Cell& add(std::span<const Point> before, std::span<const Point> after, std::span<const int> traces,
              bool edges_kept);

    /// The cells in the order in which they came, and the report on them. The builder is empty afterwards.
    Mesh finish();

  private:
    // Neumaier's compensated sum: a million equal areas would lose the last five digits otherwise.
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
    double smallest_corner_ = 2.0;  // a measure of the angle, see measure_edges()
};

}  // namespace crackle
