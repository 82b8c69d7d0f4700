// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/observers/curve_analysis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace crackle {
namespace {

constexpr double initial_window = 1.0 / 20.0;                   // of the strain at peak
constexpr double half_window_from = 0.4, half_window_to = 0.6;  // of the peak stress

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
    const double peak = rising.back().axial_stress;
    const auto reaches = [&](double share) {
        return std::find_if(rising.begin(), rising.end(),
                            [&](const CurveRow& r) { return r.axial_stress >= share * peak; });
    };
    const auto from = reaches(half_window_from) - rising.begin();
    const auto to = reaches(half_window_to) - rising.begin();
    return tangent(rising.subspan(static_cast<std::size_t>(from), static_cast<std::size_t>(to - from + 1)),
                   compression);
}

double platen_out_of_balance(std::span<const CurveRow> rows, std::int64_t peak_row) {
    if (peak_row < 0) return std::numeric_limits<double>::quiet_NaN();
    const auto rising = up_to_peak(rows, peak_row);
    double largest = 0.0;
    for (const CurveRow& row : rising) largest = std::max(largest, std::abs(row.stress_top - row.stress_bottom));
    return largest / rising.back().axial_stress;
}

}  // namespace crackle
