// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/measures/crack_thresholds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "specimens/measures/curve_analysis.hpp"
#include "specimens/statistics/broken_stick.hpp"

namespace crackle {
namespace {

using Rows = std::span<const CurveRow>;

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double first_share = 0.01;  // fraction of the bonds broken at the peak
constexpr double counted_to = 0.8;    // stress up to which breaks are counted, relative to the peak stress
// Stress up to which the specimen is assumed free of cracks; 0 is the confining pressure, 1 the peak stress.
constexpr double quiet_to = 0.25;
constexpr double deviations_of_noise = 3.0;
constexpr std::size_t fewest_quiet_rows = 10;
constexpr std::size_t fewest_rows_to_damage = 10;
constexpr std::size_t opening_places = 200;   // number of trial values of `opening`, and of stresses in each fit
constexpr double compliance_of_cracks = 1.2;  // lateral compliance that indicates cracks, relative to the elastic one
constexpr double near_largest = 0.98;         // fraction of the largest area strain

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

/// Number of bond breaks at each stress. Breaks after a stress drop are assigned to the largest stress before it.
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

/// Stress at which the inelastic strain leaves its initial scatter.
/// @param rows  rows of the curve up to the largest area strain
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
    // If cracks open, the area is larger than in an elastic specimen.
    std::size_t last = rows.size();
    while (last > quiet && strain(rows[last - 1]) < mean - band) --last;
    return last < rows.size() ? rows[last].axial_stress : none;
}

/// Stress at which the lateral strain is farthest below a line through the first row. @param slope  slope of the line
double farthest_below(Rows rows, double slope) {
    const CurveRow& first = rows.front();
    const auto below = [&](const CurveRow& row) {
        return first.lateral_strain + slope * (row.axial_stress - first.axial_stress) - row.lateral_strain;
    };
    return std::ranges::max_element(rows, {}, below)->axial_stress;
}

/// Stress at which the lateral strain is farthest from the line between the first and the last row.
/// @param rows  rows of the curve up to the largest area strain
double farthest_from_chord(Rows rows) {
    const CurveRow &first = rows.front(), &last = rows.back();
    const double slope = (last.lateral_strain - first.lateral_strain) / (last.axial_stress - first.axial_stress);
    return std::isfinite(slope) ? farthest_below(rows, slope) : none;
}

/// Inelastic part of the lateral strain at equally spaced stresses from the first row's stress to the largest stress.
/// Each value is taken where the stress is first reached.
/// @param compliance  elastic lateral strain divided by the stress
std::array<double, opening_places + 1> inelastic_lateral_strain(Rows rows, double compliance, double largest) {
    std::array<double, opening_places + 1> strains;
    const CurveRow& first = rows.front();
    std::size_t next = 0;
    for (std::size_t k = 0; k <= opening_places; ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(opening_places);
        const double stress = k < opening_places ? std::lerp(first.axial_stress, largest, share) : largest;
        while (rows[next].axial_stress < stress) ++next;
        const CurveRow &reached = rows[next], &before = rows[next == 0 ? 0 : next - 1];
        const double rise = reached.axial_stress - before.axial_stress;
        const double part = rise > 0.0 ? (stress - before.axial_stress) / rise : 1.0;
        strains[k] = std::lerp(before.lateral_strain, reached.lateral_strain, part) - first.lateral_strain -
                     compliance * (stress - first.axial_stress);
    }
    return strains;
}

/// Stress beyond which the inelastic lateral strain is best described by a parabola (least squares).
/// @param rows  rows of the curve up to the largest area strain
/// @param compliance  elastic lateral strain divided by the stress
double opening(Rows rows, double compliance) {
    const double from = rows.front().axial_stress;
    const double largest = std::ranges::max_element(rows, {}, &CurveRow::axial_stress)->axial_stress;
    if (!(largest > from)) return none;
    const auto strains = inelastic_lateral_strain(rows, compliance, largest);
    double all = 0.0;
    for (const double strain : strains) all += strain * strain;
    // Sum of squared residuals of the fit c max(0, k - place)² with the best c, which must be positive because cracks
    // widen the specimen.
    const auto left = [&](std::size_t place) {
        double fits = 0.0, squares = 0.0;
        for (std::size_t k = place + 1; k <= opening_places; ++k) {
            const double parabola = std::pow(static_cast<double>(k - place), 2);
            fits += parabola * strains[k];
            squares += parabola * parabola;
        }
        return fits > 0.0 ? all - fits * fits / squares : std::numeric_limits<double>::infinity();
    };
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t place = 0; place + 2 < opening_places; ++place) {
        const double residual = left(place);
        if (residual < least) {
            least = residual;
            best = place;
        }
    }
    if (!std::isfinite(least)) return none;
    return std::lerp(from, largest, static_cast<double>(best) / static_cast<double>(opening_places));
}

/// Sets crack damage to the middle of the range of stresses in which the area strain is close to its largest value.
template <class Strain>
void set_damage(CrackThresholds& found, Rows rising, double largest, Strain&& strain) {
    const double least = std::lerp(strain(rising.front()), largest, near_largest);
    double reached = rising.front().axial_stress, low = none, high = none;
    for (const CurveRow& row : rising) {
        reached = std::max(reached, row.axial_stress);
        if (strain(row) < least) continue;
        if (std::isnan(low)) low = reached;
        high = reached;
    }
    found.damage = std::midpoint(low, high);
    found.damage_error = 0.5 * (high - low);
    found.damage_strain = std::ranges::find_if(rising, [&](const CurveRow& row) {
                              return row.axial_stress >= found.damage;
                          })->axial_strain;
}

}  // namespace

double CrackThresholds::initiation_error() const { return std::abs(opening - lateral_compliance); }

double CrackThresholds::spread() const {
    double low_end = std::numeric_limits<double>::infinity(), high_end = -low_end;
    int known = 0;
    for (const double one : {opening, lateral_compliance, first_percent, count_break, crack_strain, lateral_strain}) {
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
    const auto largest = std::ranges::max_element(rising, {}, area_strain_of);
    const Rows to_damage = rising.first(static_cast<std::size_t>(largest - rising.begin()) + 1);
    if (to_damage.size() < fewest_rows_to_damage) return found;
    found.reversal = largest->axial_stress;
    set_damage(found, rising, area_strain_of(*largest), area_strain_of);
    found.lateral_strain = farthest_from_chord(to_damage);
    const double lateral = poissons_ratio / youngs_modulus, compliance = (1.0 - poissons_ratio) / youngs_modulus;
    if (!std::isfinite(compliance)) return found;
    if (to_damage.back().bonds_broken > 0) {
        found.opening = opening(to_damage, lateral);
        found.lateral_compliance = farthest_below(to_damage, compliance_of_cracks * lateral);
    }
    const double quiet_stress = std::lerp(confining_pressure, peak_stress, quiet_to);
    found.crack_strain = departure(to_damage, quiet_stress, [&](const CurveRow& row) {
        return area_strain_of(row) - compliance * (row.axial_stress - confining_pressure);
    });
    return found;
}

}  // namespace crackle
