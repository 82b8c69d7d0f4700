// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/measures/cycles.hpp"

#include <algorithm>
#include <limits>

namespace crackle {
namespace {

/// @param rows of the cycle, with the one that ends it if it has been ended
LoadingCycle cycle_of(std::span<const CurveRow> rows, bool ended, bool compression) {
    const CurveRow& turn = rows.front();
    const CurveRow& low = *std::ranges::min_element(rows, {}, &CurveRow::axial_strain);
    const double way = turn.axial_strain - low.axial_strain;
    LoadingCycle c;
    c.strain = turn.axial_strain;
    c.stress = turn.axial_stress;
    c.low_strain = low.axial_strain;
    c.low_stress = low.axial_stress;
    c.modulus = (turn.axial_stress - low.axial_stress) / way;
    c.poissons_ratio = (compression ? 1.0 : -1.0) * (turn.lateral_strain - low.lateral_strain) / way;
    c.permanent_strain = low.axial_strain - low.axial_stress / c.modulus;
    c.loop = ended ? 0.0 : std::numeric_limits<double>::quiet_NaN();
    for (std::size_t k = 1; k < rows.size(); ++k) {
        // The last piece goes only to where the loop closes.
        const CurveRow &a = rows[k - 1], &b = rows[k];
        if (a.axial_strain == b.axial_strain) continue;
        const double to = std::min(b.axial_strain, turn.axial_strain);
        const double share = (to - a.axial_strain) / (b.axial_strain - a.axial_strain);
        const double stress = a.axial_stress + share * (b.axial_stress - a.axial_stress);
        c.loop += 0.5 * (a.axial_stress + stress) * (to - a.axial_strain);
    }
    return c;
}

}  // namespace

std::vector<LoadingCycle> find_cycles(std::span<const CurveRow> rows, bool compression) {
    std::vector<LoadingCycle> cycles;
    for (std::size_t k = 0; k + 1 < rows.size();) {
        const auto farther = [&](const CurveRow& row) { return row.axial_strain > rows[k].axial_strain; };
        const auto rest = rows.subspan(k + 1);
        const auto end = std::ranges::find_if(rest, farther);
        const auto within = static_cast<std::size_t>(end - rest.begin());
        const bool ended = end != rest.end();
        if (within > 0) cycles.push_back(cycle_of(rows.subspan(k, 1 + within + (ended ? 1 : 0)), ended, compression));
        k += 1 + within;
    }
    return cycles;
}

FirstLoading first_loading(std::span<const CurveRow> rows, std::int64_t peak_row) {
    FirstLoading first;
    double farthest = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < rows.size(); ++k) {
        if (rows[k].axial_strain <= farthest) continue;
        farthest = rows[k].axial_strain;
        if (static_cast<std::int64_t>(k) == peak_row) first.peak_row = std::ssize(first.rows);
        first.rows.push_back(rows[k]);
    }
    return first;
}

}  // namespace crackle
