// SPDX-License-Identifier: GPL-3.0-or-later
// Springs between any number of bodies: each row r stores the energy ½k (r·u)², where u contains the motions of all
// bodies. The pressure of a cell is such a spring between the cell and all of its neighbours (linear/face_rows.hpp).
// Tested by tests/solver/linear/face_rows_test.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/linear/springs.hpp"

namespace crackle {

/// Coefficient of a row for one degree of freedom of a body: 0 for x and 1 for y (1 per m), 2 for the rotation (1 per
/// rad).
struct RowEntry {
    BodyIndex body;
    int freedom;
    double value;
};

/// A row of coefficients with the stiffness of its spring and its dashpot.
struct LinearRow {
    double stiffness;            // N/m if the row's product is a length
    double damping;              // N s/m if the row's product is a length
    std::uint32_t first, count;  // range in LinearRows::entries; a degree of freedom may occur several times
};

/// Rows of a world: springs that act in addition to the springs of its contact points.
struct LinearRows {
    std::vector<LinearRow> rows;
    std::vector<RowEntry> entries;

    /// Entries of a row.
    std::span<const RowEntry> of(const LinearRow& row) const {
        return std::span(entries).subspan(row.first, row.count);
    }
    /// Product of a row with the motions of the bodies.
    double times(const LinearRow& row, const std::vector<BodyMotion>& motion) const {
        double sum = 0.0;
        for (const RowEntry& entry : of(row)) sum += entry.value * component(motion[entry.body], entry.freedom);
        return sum;
    }
};

}  // namespace crackle
