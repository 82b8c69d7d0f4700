// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/measures/shear_box.hpp"

#include <cmath>
#include <numbers>

#include "solver/base/correctly_rounded.hpp"

namespace crackle {
namespace {

constexpr double end_share = 0.1;   // final fraction of the strain over which the residual stress is averaged
constexpr double peak_share = 0.1;  // half width of the range for the slope, relative to the strain at the peak

}  // namespace

ShearBoxFigures measure_shear_box(std::span<const CurveRow> rows, std::int64_t peak_row, bool reached_its_strain,
                                  double height, double length) {
    ShearBoxFigures figures;
    if (rows.empty()) return figures;
    if (reached_its_strain) {
        double sum = 0.0, count = 0.0;
        for (const CurveRow& row : rows) {
            if (row.axial_strain < (1.0 - end_share) * rows.back().axial_strain) continue;
            sum += row.axial_stress;
            ++count;
        }
        figures.residual = sum / count;
    }
    if (peak_row < 0) return figures;
    const double at = rows[static_cast<std::size_t>(peak_row)].axial_strain;
    double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
    for (const CurveRow& row : rows) {
        if (std::abs(row.axial_strain - at) > peak_share * at) continue;
        const double x = row.axial_strain * length, y = row.lateral_strain * height;
        ++n;
        sx += x;
        sy += y;
        sxx += x * x;
        sxy += x * y;
    }
    const double spread = n * sxx - sx * sx;
    if (n >= 3.0 && spread > 0.0)
        figures.dilation_at_peak = correctly_rounded::atan2(n * sxy - sx * sy, spread) * 180.0 / std::numbers::pi;
    return figures;
}

}  // namespace crackle
