// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/measures/cycles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace crackle {
namespace {

/// @param rows  rows of the cycle, including the row that ends it if there is one
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
    const auto unbalanced = [](const CurveRow& row) { return 0.5 * std::abs(row.stress_top - row.stress_bottom); };
    c.modulus_error = (unbalanced(turn) + unbalanced(low)) / std::abs(turn.axial_stress - low.axial_stress);
    c.breaks_of_unloading = low.bonds_broken - turn.bonds_broken;
    c.unbroken = rows.back().bonds_broken == 0;
    c.linear = c.unbroken && std::ranges::all_of(rows, [](const CurveRow& row) {
                   return row.bonds_slid == 0 && row.points_sliding == 0 && row.contacts_gained <= 0;
               });
    c.loop = ended ? 0.0 : std::numeric_limits<double>::quiet_NaN();
    for (std::size_t k = 1; k < rows.size(); ++k) {
        // The last segment is cut at the strain at which the loop closes.
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
    const auto strain = [&](std::size_t k) { return rows[k].axial_strain; };
    for (std::size_t turn = 0; turn + 1 < rows.size();) {
        if (strain(turn + 1) >= strain(turn)) {
            ++turn;
            continue;
        }
        std::size_t end = turn + 1;
        while (end + 1 < rows.size() && strain(end + 1) <= strain(end)) ++end;
        while (end + 1 < rows.size() && strain(end + 1) >= strain(end) && strain(end) <= strain(turn)) ++end;
        const bool turns_again = end + 1 < rows.size() && strain(end + 1) < strain(end);
        const bool ended = turns_again || strain(end) > strain(turn);
        cycles.push_back(cycle_of(rows.subspan(turn, end - turn + 1), ended, compression));
        turn = end;
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
