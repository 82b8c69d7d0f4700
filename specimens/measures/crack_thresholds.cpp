// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/measures/crack_thresholds.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "specimens/measures/curve_analysis.hpp"
#include "specimens/statistics/broken_stick.hpp"

namespace crackle {
namespace {

using Rows = std::span<const CurveRow>;

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double first_share = 0.01;  // fraction of the bonds broken at the peak
constexpr double counted_to = 0.8;    // stress up to which breaks are counted, relative to the peak stress
// End of the range assumed free of cracks, between the confining pressure (0) and the peak (1).
constexpr double quiet_to = 0.25;
constexpr double deviations_of_noise = 3.0;
constexpr std::size_t fewest_quiet_rows = 10;

double first_percent(Rows rising) {
    const std::int64_t broken = rising.back().bonds_broken;
    if (broken == 0) return none;
    return std::ranges::find_if(rising,
                                [&](const CurveRow& row) {
                                    return static_cast<double>(row.bonds_broken) >=
                                           first_share * static_cast<double>(broken);
                                })
        ->axial_stress;
}

/// Number of breakages by largest stress so far: breakages after a stress drop are assigned to the stress before it.
std::vector<Burst> bursts_of(Rows rising) {
    std::vector<Burst> bursts;
    std::int64_t before = 0;
    double largest = 0.0;
    for (const CurveRow& row : rising) {
        largest = std::max(largest, row.axial_stress);
        if (row.bonds_broken > before) bursts.push_back({largest, row.bonds_broken - before});
        before = row.bonds_broken;
    }
    return bursts;
}

/// Stress at which the inelastic strain leaves its initial scatter. @param rows  up to crack damage
/// @param strain  returns the inelastic strain of a row
template <class Strain>
double departure(Rows rows, double quiet_stress, Strain&& strain) {
    double sum = 0.0, squares = 0.0;
    std::size_t quiet = 0;
    for (; quiet < rows.size() && rows[quiet].axial_stress < quiet_stress; ++quiet) sum += strain(rows[quiet]);
    if (quiet < fewest_quiet_rows) return none;
    const double mean = sum / static_cast<double>(quiet);
    for (const CurveRow& row : rows.first(quiet)) squares += (strain(row) - mean) * (strain(row) - mean);
    const double band = deviations_of_noise * std::sqrt(squares / static_cast<double>(quiet - 1));
    // Cracks open, so the area becomes larger than the elastic one.
    std::size_t last = rows.size();
    while (last > quiet && strain(rows[last - 1]) < mean - band) --last;
    return last < rows.size() ? rows[last].axial_stress : none;
}

/// Stress at which the lateral strain is farthest from the chord. @param rows  up to crack damage
double farthest_from_chord(Rows rows) {
    const CurveRow &first = rows.front(), &last = rows.back();
    const double slope = (last.lateral_strain - first.lateral_strain) / (last.axial_stress - first.axial_stress);
    if (!std::isfinite(slope)) return none;
    const auto below = [&](const CurveRow& row) {
        return first.lateral_strain + slope * (row.axial_stress - first.axial_stress) - row.lateral_strain;
    };
    return std::ranges::max_element(rows, {}, below)->axial_stress;
}

}  // namespace

double CrackThresholds::spread() const {
    double low_end = std::numeric_limits<double>::infinity(), high_end = -low_end;
    int known = 0;
    for (const double one : {first_percent, count_break, crack_strain, lateral_strain}) {
        if (std::isnan(one)) continue;
        ++known;
        low_end = std::min(low_end, one);
        high_end = std::max(high_end, one);
    }
    return known < 2 ? none : high_end - low_end;
}

CrackThresholds find_crack_thresholds(Rows rows, std::int64_t peak_row, double youngs_modulus, double poissons_ratio,
                                      double confining_pressure) {
    CrackThresholds found;
    if (peak_row < 0) return found;
    const Rows rising = rows.first(static_cast<std::size_t>(peak_row + 1));
    const double peak_stress = rising.back().axial_stress;
    found.first_percent = first_percent(rising);
    const BurstBreak counts = find_burst_break(bursts_of(rising), counted_to * peak_stress);
    found.count_break = counts.at;
    found.low = counts.low;
    found.high = counts.high;
    const auto area_strain_of = [](const CurveRow& row) { return area_strain(row, true); };
    if (std::ranges::any_of(rising, [&](const CurveRow& row) { return std::isnan(row.lateral_strain); })) return found;
    const auto damage = std::ranges::max_element(rising, {}, area_strain_of);
    found.damage = damage->axial_stress;
    found.damage_strain = damage->axial_strain;
    const Rows to_damage = rising.first(static_cast<std::size_t>(damage - rising.begin()) + 1);
    found.lateral_strain = farthest_from_chord(to_damage);
    const double compliance = (1.0 - poissons_ratio) / youngs_modulus;
    if (!std::isfinite(compliance)) return found;
    const double quiet_stress = std::lerp(confining_pressure, peak_stress, quiet_to);
    found.crack_strain = departure(to_damage, quiet_stress, [&](const CurveRow& row) {
        return area_strain_of(row) - compliance * (row.axial_stress - confining_pressure);
    });
    return found;
}

}  // namespace crackle
