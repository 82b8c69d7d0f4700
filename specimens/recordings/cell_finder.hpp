// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the cell to which a contact of a body belongs.
// Tested by tests/tools/commands/view_test.cpp.
#pragma once

#include <cstdint>
#include <limits>
#include <unordered_map>
#include <vector>

#include "specimens/recordings/recording.hpp"

namespace crackle {

/// Finds the cells of a body by the body's id.
class CellFinder {
  public:
    /// @param cells  cells of a recording, at their positions in the first frame
    explicit CellFinder(const std::vector<RecordedCell>& cells) {
        for (const RecordedCell& cell : cells) {
            of_id_.emplace(cell.id, static_cast<std::int32_t>(places_.size()));
            places_.push_back({cell.centre, cell.radius});
        }
    }

    /// Index of a body's cell; for a clump, the cell of the circle nearest to `place` in the first frame.
    /// @return -1 if there is no such body
    std::int32_t find(int id, Vec2 place) const {
        double nearest = std::numeric_limits<double>::infinity();
        std::int32_t found = -1;
        const auto [begin, end] = of_id_.equal_range(id);
        for (auto entry = begin; entry != end; ++entry) {
            const Place& cell = places_[static_cast<std::size_t>(entry->second)];
            const double gap = norm(cell.centre - place) - cell.radius;
            if (found >= 0 && gap >= nearest) continue;
            nearest = gap;
            found = entry->second;
        }
        return found;
    }

    /// Whether a body is a circle or a clump of circles; false for an unknown body.
    bool is_circle(int id) const {
        const auto entry = of_id_.find(id);
        return entry != of_id_.end() && places_[static_cast<std::size_t>(entry->second)].radius > 0.0;
    }

  private:
    struct Place {
        Vec2 centre;
        double radius = 0.0;
    };
    std::vector<Place> places_;
    std::unordered_multimap<int, std::int32_t> of_id_;
};

}  // namespace crackle
