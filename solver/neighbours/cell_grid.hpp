// SPDX-License-Identifier: GPL-3.0-or-later
// Uniform grid over points in the plane: one array of point indices, sorted by cell. Points outside the grid are
// assigned to the cells at its edge.
// Tested by tests/solver/neighbours/neighbours_test.cpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "solver/base/vec2.hpp"

namespace crackle {

/// Position and size of the cells.
struct CellLayout {
    Vec2 low;                              ///< m, corner of the first cell
    double per_width = 0, per_height = 0;  ///< cells per m in x and in y
    std::size_t columns = 1, rows = 1;
};

/// Points sorted into the cells of a grid.
class CellGrid {
  public:
    /// @param place function that returns the position of point k (0 <= k < count), m
    template <class Place>
    CellGrid(const CellLayout& layout, std::size_t count, Place&& place) : layout_(layout) {
        begin_.assign(layout.columns * layout.rows + 1, 0);
        std::vector<std::uint32_t> cell_of(count);
        for (std::size_t k = 0; k < count; ++k) {
            const Vec2 at = place(k);
            cell_of[k] = static_cast<std::uint32_t>(row(at.y) * layout.columns + column(at.x));
            ++begin_[cell_of[k] + 1];
        }
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        members_.resize(count);
        std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
        for (std::size_t k = 0; k < count; ++k) members_[next[cell_of[k]]++] = static_cast<std::uint32_t>(k);
    }

    /// Column that contains a coordinate; the nearest column if the coordinate is outside the grid. @param x
    /// coordinate, m
    std::size_t column(double x) const { return index((x - layout_.low.x) * layout_.per_width, layout_.columns); }
    /// Row that contains a coordinate; the nearest row if the coordinate is outside the grid. @param y coordinate, m
    std::size_t row(double y) const { return index((y - layout_.low.y) * layout_.per_height, layout_.rows); }
    /// Index of the last column.
    std::size_t last_column() const { return layout_.columns - 1; }
    /// Index of the last row.
    std::size_t last_row() const { return layout_.rows - 1; }

    /// Indices of all points, cell by cell and row by row.
    const std::vector<std::uint32_t>& members() const { return members_; }

    /// Calls visit_point(index) for the points in a rectangle of cells; column1 and row1 are included.
    template <class Visit>
    void visit(std::size_t column0, std::size_t column1, std::size_t row0, std::size_t row1,
               Visit&& visit_point) const {
        for (std::size_t r = row0; r <= row1; ++r) {
            const std::uint32_t end = begin_[r * layout_.columns + column1 + 1];
            for (std::uint32_t k = begin_[r * layout_.columns + column0]; k < end; ++k) visit_point(members_[k]);
        }
    }

  private:
    static std::size_t index(double place, std::size_t count) {
        if (!(place > 0.0)) return 0;
        return std::min(static_cast<std::size_t>(place), count - 1);
    }

    CellLayout layout_;
    std::vector<std::uint32_t> begin_, members_;
};

}  // namespace crackle
