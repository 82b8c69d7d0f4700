// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/measures/curve_analysis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace crackle {
namespace {

constexpr double initial_window = 1.0 / 20.0;  // strain at the window's end, relative to the strain at peak
// Stresses at the window's ends, relative to the peak stress.
constexpr double half_window_from = 0.4, half_window_to = 0.6;
constexpr double straight_window = 0.3;  // range of stress in the window, relative to the peak stress
constexpr int window_places = 100;       // number of window positions between zero and the peak stress
// Stresses at the window's ends, relative to the peak stress.
constexpr double fall_window_from = 0.9, fall_window_to = 0.6;

/// Least-squares slope of y over x, both measured from their means.
double slope(std::span<const CurveRow> rows, double CurveRow::*x, double CurveRow::*y) {
    double mean_x = 0.0, mean_y = 0.0;
    for (const CurveRow& row : rows) {
        mean_x += row.*x;
        mean_y += row.*y;
    }
    mean_x /= static_cast<double>(rows.size());
    mean_y /= static_cast<double>(rows.size());
    double xx = 0.0, xy = 0.0;
    for (const CurveRow& row : rows) {
        xx += (row.*x - mean_x) * (row.*x - mean_x);
        xy += (row.*x - mean_x) * (row.*y - mean_y);
    }
    return xy / xx;
}

Tangent tangent(std::span<const CurveRow> rows, bool compression) {
    Tangent t;
    t.rows = static_cast<std::int64_t>(rows.size());
    t.modulus = t.poissons_ratio = std::numeric_limits<double>::quiet_NaN();
    if (rows.size() < 3) return t;
    const CurveRow& first = rows.front();
    const CurveRow& last = rows.back();
    t.modulus = slope(rows, &CurveRow::axial_strain, &CurveRow::axial_stress);
    const double widening = slope(rows, &CurveRow::axial_strain, &CurveRow::lateral_strain);
    t.poissons_ratio = compression ? widening : -widening;
    t.strain_to = last.axial_strain;
    t.bonds_broken = last.bonds_broken - first.bonds_broken;
    t.points_sliding = last.points_sliding;
    t.contacts_gained = last.contacts_gained - first.contacts_gained;
    return t;
}

/// Root mean square deviation of the stress from a straight-line fit over the strain.
double misfit(std::span<const CurveRow> rows) {
    const double modulus = slope(rows, &CurveRow::axial_strain, &CurveRow::axial_stress);
    double mean = 0.0, square = 0.0;
    for (const CurveRow& row : rows) mean += row.axial_stress - modulus * row.axial_strain;
    mean /= static_cast<double>(rows.size());
    for (const CurveRow& row : rows) {
        const double left = row.axial_stress - modulus * row.axial_strain - mean;
        square += left * left;
    }
    return std::sqrt(square / static_cast<double>(rows.size()));
}

/// The rows from where the stress first reaches from_share·peak to where it first reaches to_share·peak.
std::span<const CurveRow> between(std::span<const CurveRow> rising, double from_share, double to_share) {
    const double peak = rising.back().axial_stress;
    const auto reaches = [&](double share) {
        return std::find_if(rising.begin(), rising.end(),
                            [&](const CurveRow& r) { return r.axial_stress >= share * peak; }) -
               rising.begin();
    };
    const auto from = reaches(from_share), to = std::min<std::ptrdiff_t>(reaches(to_share), std::ssize(rising) - 1);
    return rising.subspan(static_cast<std::size_t>(from), static_cast<std::size_t>(to - from + 1));
}

std::span<const CurveRow> up_to_peak(std::span<const CurveRow> rows, std::int64_t peak_row) {
    return rows.first(static_cast<std::size_t>(peak_row + 1));
}

}  // namespace

double area_strain(const CurveRow& row, bool compression) {
    return (compression ? row.axial_strain : -row.axial_strain) - row.lateral_strain;
}

Tangent initial_tangent(std::span<const CurveRow> rows, std::int64_t peak_row, bool compression) {
    const auto rising = up_to_peak(rows, peak_row);
    if (rising.empty()) return tangent(rising, compression);
    const double end = initial_window * rising.back().axial_strain;
    const auto beyond =
        std::find_if(rising.begin(), rising.end(), [&](const CurveRow& r) { return r.axial_strain > end; });
    return tangent(rising.first(static_cast<std::size_t>(beyond - rising.begin())), compression);
}

Tangent tangent_at_half_peak(std::span<const CurveRow> rows, std::int64_t peak_row, bool compression) {
    const auto rising = up_to_peak(rows, peak_row);
    if (rising.empty()) return tangent(rising, compression);
    return tangent(between(rising, half_window_from, half_window_to), compression);
}

Tangent tangent_of_straightest(std::span<const CurveRow> rows, std::int64_t peak_row, bool compression) {
    const auto rising = up_to_peak(rows, peak_row);
    std::span<const CurveRow> best;
    double least = std::numeric_limits<double>::infinity();
    constexpr int last = static_cast<int>(window_places * (1.0 - straight_window));
    for (int k = 0; k <= last && !rising.empty(); ++k) {
        const double from = static_cast<double>(k) / window_places;
        const auto window = between(rising, from, from + straight_window);
        if (window.size() < 3) continue;
        const double left = misfit(window);
        if (!(left < least)) continue;
        least = left;
        best = window;
    }
    return tangent(best, compression);
}

Tangent secant_to_half_peak(std::span<const CurveRow> rows, std::int64_t peak_row, bool compression) {
    const auto rising = up_to_peak(rows, peak_row);
    Tangent t = tangent({}, compression);
    if (rising.empty()) return t;
    const auto window = between(rising, 0.0, 0.5);
    const CurveRow &first = rows.front(), &last = window.back();
    t.rows = std::ssize(window);
    t.strain_to = last.axial_strain;
    const double shortening = last.axial_strain - first.axial_strain;
    if (!(shortening > 0.0)) return t;
    t.modulus = (last.axial_stress - first.axial_stress) / shortening;
    const double widening = (last.lateral_strain - first.lateral_strain) / shortening;
    t.poissons_ratio = compression ? widening : -widening;
    return t;
}

Tangent tangent_beyond_peak(std::span<const CurveRow> rows, std::int64_t peak_row, bool compression) {
    if (peak_row < 0) return tangent({}, compression);
    const auto falling = rows.subspan(static_cast<std::size_t>(peak_row));
    const double peak = falling.front().axial_stress;
    const auto falls_to = [&](double share) {
        return std::find_if(falling.begin(), falling.end(),
                            [&](const CurveRow& r) { return r.axial_stress <= share * peak; });
    };
    const auto from = falls_to(fall_window_from), to = falls_to(fall_window_to);
    if (to == falling.end()) return tangent({}, compression);
    Tangent fall = tangent(
        falling.subspan(static_cast<std::size_t>(from - falling.begin()), static_cast<std::size_t>(to - from + 1)),
        compression);
    // If the stress drops, exceeds the peak again and falls much later, the slope is meaningless.
    if (!(fall.modulus < 0.0)) fall.modulus = std::numeric_limits<double>::quiet_NaN();
    return fall;
}

double brittleness_index(double youngs_modulus, double modulus_beyond_peak) {
    return (modulus_beyond_peak - youngs_modulus) / modulus_beyond_peak;
}

double platen_out_of_balance(std::span<const CurveRow> rows, std::int64_t peak_row) {
    if (peak_row < 0) return std::numeric_limits<double>::quiet_NaN();
    const auto rising = up_to_peak(rows, peak_row);
    double largest = 0.0;
    for (const CurveRow& row : rising) largest = std::max(largest, std::abs(row.stress_top - row.stress_bottom));
    return largest / rising.back().axial_stress;
}

}  // namespace crackle
