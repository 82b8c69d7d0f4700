// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/joints/faults.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "mesher/place_grid.hpp"
#include "specimens/joints/joint_trace.hpp"

namespace crackle {
namespace {

// Cosines of the turn from one row to the next: for a bend of 60 degrees, and for a bend of 150 degrees, beyond which a
// row runs back.
constexpr double least_straight = 0.5, runs_back = -0.866;
constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

/// Joins rows at their ends. End 2r is the first point of row r, and end 2r + 1 its last point.
class RowJoiner {
  public:
    RowJoiner(const std::vector<std::vector<Vec2>>& rows, double reach)
        : rows_(rows), reach_(reach), partner_(2 * rows.size(), none), used_(rows.size(), 0) {
        for (const std::vector<std::size_t>& ends : ends_by_node()) pair_up(ends);
    }

    std::vector<Fault> faults() {
        std::vector<Fault> all;
        for (std::size_t row = 0; row < rows_.size(); ++row) {
            if (used_[row] != 0) continue;
            used_[row] = 1;
            Fault fault{rows_[row], row, 1};
            follow(fault, 2 * row + 1);
            std::reverse(fault.points.begin(), fault.points.end());
            follow(fault, 2 * row);
            std::reverse(fault.points.begin(), fault.points.end());
            all.push_back(std::move(fault));
        }
        return all;
    }

  private:
    Vec2 place(std::size_t end) const { return end % 2 == 0 ? rows_[end / 2].front() : rows_[end / 2].back(); }

    /// The ends at each node, in row order. An end belongs to the nearest node within the reach.
    std::vector<std::vector<std::size_t>> ends_by_node() const {
        double length = 0.0;
        for (const std::vector<Vec2>& row : rows_) length += length_of(row) / static_cast<double>(rows_.size());
        Squares squares(reach_ > 0.0 ? reach_ : length);
        squares.reserve(partner_.size());
        std::vector<std::vector<std::size_t>> nodes;
        for (std::size_t end = 0; end < partner_.size(); ++end) {
            const Vec2 p = place(end);
            const std::int64_t i = squares.index(p.x), j = squares.index(p.y);
            std::size_t nearest = none;
            double least = reach_;
            for (std::int64_t u = i - 1; u <= i + 1; ++u) {
                for (std::int64_t v = j - 1; v <= j + 1; ++v) {
                    squares.each_at(u, v, [&](std::size_t node) {
                        const double away = norm(place(nodes[node].front()) - p);
                        if (away > least || (away == least && nearest < node)) return;
                        least = away;
                        nearest = node;
                    });
                }
            }
            if (nearest == none) {
                squares.add(i, j, nodes.size());
                nodes.push_back({end});
            } else {
                nodes[nearest].push_back(end);
            }
        }
        return nodes;
    }

    /// Direction from an end of a row along that row, to the first point beyond the reach or to the other end.
    Vec2 direction(std::size_t end) const {
        const std::vector<Vec2>& row = rows_[end / 2];
        Vec2 way;
        for (std::size_t k = 1; k < row.size(); ++k) {
            way = row[end % 2 == 0 ? k : row.size() - 1 - k] - place(end);
            if (norm(way) > reach_) break;
        }
        const double size = norm(way);
        return size > 0.0 ? (1.0 / size) * way : way;
    }
    void pair_up(const std::vector<std::size_t>& ends) {
        struct Turn {
            double straight;  // cosine of the bend; 1 if there is no bend
            std::size_t first, second;
        };
        std::vector<Turn> turns;
        std::vector<Vec2> ways;
        ways.reserve(ends.size());
        for (const std::size_t end : ends) ways.push_back(direction(end));
        const double least = ends.size() == 2 ? runs_back : least_straight;
        for (std::size_t a = 0; a < ends.size(); ++a)
            for (std::size_t b = a + 1; b < ends.size(); ++b)
                if (const double straight = -dot(ways[a], ways[b]); straight >= least && ends[a] / 2 != ends[b] / 2)
                    turns.push_back({straight, ends[a], ends[b]});
        std::stable_sort(turns.begin(), turns.end(),
                         [](const Turn& a, const Turn& b) { return a.straight > b.straight; });
        for (const Turn& turn : turns) {
            if (partner_[turn.first] != none || partner_[turn.second] != none) continue;
            partner_[turn.first] = turn.second;
            partner_[turn.second] = turn.first;
        }
    }

    /// Appends the rows that follow an end to a fault.
    void follow(Fault& fault, std::size_t end) {
        for (std::size_t next = partner_[end]; next != none && used_[next / 2] == 0; next = partner_[next ^ 1U]) {
            const std::size_t row = next / 2;
            used_[row] = 1;
            ++fault.rows;
            std::vector<Vec2> points = rows_[row];
            if (next % 2 != 0) std::reverse(points.begin(), points.end());
            const bool same = points.front() == fault.points.back();
            fault.points.insert(fault.points.end(), points.begin() + (same ? 1 : 0), points.end());
        }
    }

    const std::vector<std::vector<Vec2>>& rows_;
    double reach_;
    std::vector<std::size_t> partner_;  // by end: the end to which it is joined
    std::vector<char> used_;            // by row
};

}  // namespace

std::vector<Fault> joined_rows(const std::vector<std::vector<Vec2>>& rows, double reach) {
    return RowJoiner(rows, reach).faults();
}

}  // namespace crackle
